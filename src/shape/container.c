/* container.c - see container.h. */
#include "shape/container.h"

Container container_default(void)
{
    return (Container){ .box = { { -1, -1, -1 }, { 1, 1, 1 } } };
}

Container container_parse(Parser *p)
{
    Container c = { 0 };
    parse_open(p);
    if (parse_accept(p, KW_BOX)) {
        parse_open(p);
        Vec3 a = parse_vec3(p), b = parse_next_vec3(p);
        c.box = bounds_of_points((const Vec3[]){ a, b }, 2);
    } else {
        parse_expect(p, KW_SPHERE);
        parse_open(p);
        c.sphere = true;
        c.centre = parse_vec3(p);
        c.radius = parse_next_float(p);
        if (c.radius < 0)
            c.radius = -c.radius;
        c.box = bounds_grown((Bounds){ c.centre, c.centre }, c.radius);
    }
    parse_close(p);
    parse_close(p);
    return c;
}

static bool span_of_sphere(const Container *c, const Ray *ray, double *enter, double *leave)
{
    Vec3 v = sub(ray->o, c->centre);
    double a = length2(ray->d), middle = -dot(v, ray->d) / a;
    double h2 = c->radius * c->radius - length2(add(v, scaled(ray->d, middle)));
    if (!(h2 > 0))
        return false;
    double half = sqrt(h2 / a);
    *enter = middle - half;
    *leave = middle + half;
    return true;
}

bool container_span(const Container *c, const Ray *ray, double *enter, double *leave, uint32_t *enter_side, uint32_t *leave_side)
{
    *enter_side = *leave_side = CONTAINER_SPHERE;
    if (c->sphere)
        return span_of_sphere(c, ray, enter, leave);
    *enter = -INFINITY;
    *leave = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double o = vec3_at(ray->o, axis), d = vec3_at(ray->d, axis), lo = vec3_at(c->box.lo, axis), hi = vec3_at(c->box.hi, axis);
        if (d == 0) {
            if (o < lo || o > hi)
                return false;
            continue;
        }
        double near = ((d > 0 ? lo : hi) - o) / d, far = ((d > 0 ? hi : lo) - o) / d;
        uint32_t low_side = CONTAINER_SIDES + 2 * (uint32_t)axis, high_side = low_side + 1;
        if (near > *enter) {
            *enter = near;
            *enter_side = d > 0 ? low_side : high_side;
        }
        if (far < *leave) {
            *leave = far;
            *leave_side = d > 0 ? high_side : low_side;
        }
    }
    return *enter <= *leave;
}

bool container_holds(const Container *c, Vec3 p)
{
    return c->sphere ? length2(sub(p, c->centre)) <= c->radius * c->radius : bounds_contain(c->box, p);
}

Vec3 container_normal(const Container *c, uint32_t side, Vec3 p)
{
    if (side == CONTAINER_SPHERE)
        return sub(p, c->centre);
    Vec3 n = { 0, 0, 0 };
    vec3_set(&n, (int)(side - CONTAINER_SIDES) / 2, (side - CONTAINER_SIDES) % 2 ? 1 : -1);
    return n;
}
