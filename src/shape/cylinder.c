/* cylinder.c - cylinder { end, end, radius [open] }: traced as x^2 + y^2 <= 1, 0 <= z <= 1, second end at z = 0.
 *
 * A closed one is an infinite cylinder and a slab in common, an interval of the ray each, so no ray slips through the
 * rims. Parts: 0 side, 1 and 2 the ends at z = 0 and 1. */
#include "sdl/parse.h"
#include "shape/shape.h"
#include "world/fan.h"
#include "world/glance.h"

typedef struct { Vec3 end1, end2; double radius; } Params;
typedef struct { bool open; } Cylinder;

/* POV: points this close to the surface are outside a closed cylinder and inside an open one; in units of its radius and
 * of its length. */
static const double MARGIN = 1e-10;

static void parse(Parser *p, void *params)
{
    Params *c = params;
    c->end1 = parse_vec3(p);
    c->end2 = parse_next_vec3(p);
    c->radius = parse_next_float(p);
    if (max_abs(sub(c->end1, c->end2)) == 0)
        parse_fail(p, "Degenerate cylinder, base point = apex point.");
}

/* The place of z = 0..1 from end2 to end1. Lengths are taken in a unit of their own size. */
static Affine frame(const Params *c)
{
    Vec3 axis = sub(c->end1, c->end2);
    double unit = build_unit(max_abs(axis));
    axis = scaled(axis, 1 / unit);
    return affine_frame(c->end2, axis, fabs(c->radius), length(axis) * unit);
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *c = params;
    if (c->radius == 0)
        return;
    Cylinder *out = build_data(b, sizeof *out);
    out->open = b->object->flags & OBJECT_OPEN;
    Affine place = affine_then(frame(c), b->place);
    build_prim(b, out, &place, shape_padded((Bounds){ vec3(-1, -1, 0), vec3(1, 1, 1) }));
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Cylinder *c = shape;
    Vec3 o = ray->o, d = ray->d;
    double a = d.x * d.x + d.y * d.y, in = -INFINITY, out = INFINITY;
    double middle = a > 0 ? -(o.x * d.x + o.y * d.y) / a : 0, x = o.x + middle * d.x, y = o.y + middle * d.y;
    double h2 = 1 - (x * x + y * y);
    if (h2 < 0)
        return;
    if (a > 0) {
        double half = sqrt(h2 / a);
        in = middle - half;
        out = middle + half;
    }
    double end_in = -INFINITY, end_out = INFINITY;
    if (d.z != 0) {
        double t0 = -o.z / d.z, t1 = (1 - o.z) / d.z;
        end_in = lesser(t0, t1);
        end_out = greater(t0, t1);
    } else if (o.z < 0 || o.z > 1)
        return;
    if (in > end_out || out < end_in)
        return;
    if (in >= end_in)
        hit_add(sink, in, 0);
    else if (!c->open)
        hit_add(sink, end_in, d.z > 0 ? 1 : 2);
    if (out <= end_out)
        hit_add(sink, out, 0);
    else if (!c->open)
        hit_add(sink, end_out, d.z > 0 ? 2 : 1);
}

static void fan_hits(const void *shape, const Fan *fan, FanHits *out)
{
    const Cylinder *c = shape;
    Vec3 o = fan->o;
    d4 dx = fan->d.x, dy = fan->d.y, dz = fan->d.z, zero = d4_set(0), ox = d4_set(o.x), oy = d4_set(o.y);
    d4 a = d4_add(d4_mul(dx, dx), d4_mul(dy, dy));
    d4 middle = d4_div(d4_sub(zero, d4_add(d4_mul(ox, dx), d4_mul(oy, dy))), a);
    d4 x = d4_add(ox, d4_mul(middle, dx)), y = d4_add(oy, d4_mul(middle, dy));
    d4 h2 = d4_sub(d4_set(1), d4_add(d4_mul(x, x), d4_mul(y, y))), half = d4_sqrt(d4_div(h2, a));
    d4 enter = d4_sub(middle, half), leave = d4_add(middle, half);
    d4 t0 = d4_div(d4_set(-o.z), dz), t1 = d4_div(d4_set(1 - o.z), dz), end_in = d4_min(t0, t1), end_out = d4_max(t0, t1);
    uint32_t meets = d4_le(zero, h2) & d4_le(enter, end_out) & d4_le(end_in, leave);
    fan_hit(fan, out, 0, d4_max(enter, end_in), c->open ? meets & d4_le(end_in, enter) : meets);
    fan_hit(fan, out, 1, d4_min(leave, end_out), c->open ? meets & d4_le(leave, end_out) : meets);
    out->unsaid = d4_eq(d4_mul(a, dz), zero);      /* along the axis or the ends */
}

static bool solid(const void *shape, Solid *out)
{
    *out = (Solid){ vec3(-INFINITY, -INFINITY, 0), vec3(INFINITY, INFINITY, 1), 2, vec3(0, 0, 0), 1 };
    return !((const Cylinder *)shape)->open;
}

static double reach(const void *shape, Vec3 n)
{
    (void)shape;
    return sqrt(n.x * n.x + n.y * n.y) + greater(n.z, 0);
}

static bool inside(const void *shape, Vec3 p)
{
    double margin = ((const Cylinder *)shape)->open ? MARGIN : -MARGIN;
    return p.x * p.x + p.y * p.y < (1 + margin) * (1 + margin) && p.z > -margin && p.z < 1 + margin;
}

static uint32_t fan_inside(const void *shape, const Vec3s *p)
{
    double margin = ((const Cylinder *)shape)->open ? MARGIN : -MARGIN;
    d4 r2 = d4_add(d4_mul(p->x, p->x), d4_mul(p->y, p->y));
    return d4_lt(r2, d4_set((1 + margin) * (1 + margin))) & d4_lt(d4_set(-margin), p->z) & d4_lt(p->z, d4_set(1 + margin));
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    (void)shape;
    if (hit->part) {
        out->normal = vec3(0, 0, hit->part == 1 ? -1 : 1);
        out->p.z = hit->part - 1;
    } else {
        double r = sqrt(out->p.x * out->p.x + out->p.y * out->p.y);
        out->p.x /= r;
        out->p.y /= r;
        out->normal = vec3(out->p.x, out->p.y, 0);
    }
}

static Bounds extent(const void *params, const Affine *place)
{
    Affine own = frame(params);
    return shape_hull((Bounds){ vec3(-1, -1, 0), vec3(1, 1, 1) }, &own, place);
}

const ShapeOps shape_cylinder = {
    .keyword = "cylinder", .params_size = sizeof(Params), .flags = SHAPE_HAS_OPEN | SHAPE_CONVEX, .parse = parse,
    .compile = compile, .hits = hits, .fan_hits = fan_hits, .fan_inside = fan_inside, .solid = solid, .reach = reach, .inside = inside, .surface = surface, .extent = extent,
};
