/* cone.c - cone { end1, radius1, end2, radius2 [open] }: traced as x^2 + y^2 <= (base + slope z)^2, 0 <= z <= 1, in units of
 * the larger radius, which stands at z = 1.
 *
 * A closed cone is convex: its nappe and a slab in common, an interval of the ray each, so no ray slips through the
 * rims. POV-Ray measures z from the tip, which for nearly equal radii is far away; here z never leaves the cone.
 * Parts: 0 side, 1 and 2 the ends at z = 0 and 1. */
#include "math/roots.h"
#include "sdl/parse.h"
#include "shape/shape.h"

typedef struct { Vec3 end1, end2; double radius1, radius2; } Params;
typedef struct { double base, slope; bool open; } Cone;

static const double MARGIN = 1e-10;            /* POV: as in cylinder.c */

static void parse(Parser *p, void *params)
{
    Params *c = params;
    c->end1 = parse_vec3(p);
    c->radius1 = parse_next_float(p);
    c->end2 = parse_next_vec3(p);
    c->radius2 = parse_next_float(p);
    if (max_abs(sub(c->end1, c->end2)) == 0)
        parse_fail(p, "Degenerate cone/cylinder.");
}

static Affine frame(const Params *c, double *base)
{
    bool first = fabs(c->radius1) > fabs(c->radius2);      /* is the first end the larger one? */
    double larger = fmax(fabs(c->radius1), fabs(c->radius2)), smaller = fmin(fabs(c->radius1), fabs(c->radius2));
    Vec3 from = first ? c->end2 : c->end1, axis = sub(first ? c->end1 : c->end2, from);
    double unit = build_unit(max_abs(axis));
    axis = scaled(axis, 1 / unit);
    *base = larger > 0 ? smaller / larger : 0;
    return affine_frame(from, axis, larger, length(axis) * unit);
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *c = params;
    if (c->radius1 == 0 && c->radius2 == 0)
        return;
    Cone *out = build_data(b, sizeof *out);
    Affine own = frame(c, &out->base), place = affine_then(own, b->place);
    out->slope = 1 - out->base;
    out->open = b->object->flags & OBJECT_OPEN;
    build_prim(b, out, &place, shape_padded((Bounds){ vec3(-1, -1, 0), vec3(1, 1, 1) }));
}

/* Where the line is within the double cone, cut to the nappe of the slab; false if nowhere. The parameter is counted from
 * `o`, near the cone. */
static bool nappe(const Cone *c, Vec3 o, Vec3 d, double end_in, double end_out, double *in, double *out)
{
    double r = c->base + c->slope * o.z, dr = c->slope * d.z, root[2];
    double qa = d.x * d.x + d.y * d.y - dr * dr, qh = o.x * d.x + o.y * d.y - r * dr, qc = o.x * o.x + o.y * o.y - r * r;
    int n = roots_quadratic(qa, qh, qc, root);
    *in = -INFINITY;
    *out = INFINITY;
    if (qa > 0) {
        if (n < 2)
            return false;
        *in = root[0];
        *out = root[1];
    } else if (qa < 0) {
        double first = n == 2 ? root[0] : -qh / qa, last = n == 2 ? root[1] : first;
        double before = first - end_in, after = end_out - last;
        if (before < 0 && after < 0)
            return false;                      /* passes between the nappes */
        if (before >= after)
            *out = first;                      /* enters by an end, leaves by the side */
        else
            *in = last;
    } else if (n == 1) {                       /* parallel to the side */
        if (qh > 0)
            *out = root[0];
        else
            *in = root[0];
    } else if (qc > 0)
        return false;
    return true;
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Cone *c = shape;
    Vec3 d = ray->d, centred = vec3(ray->o.x, ray->o.y, ray->o.z - 0.5);
    double shift = -dot(centred, d) / length2(d), in, out, end_in = -INFINITY, end_out = INFINITY;
    Vec3 o = ray_at(ray, shift);
    if (d.z != 0) {
        double t0 = -o.z / d.z, t1 = (1 - o.z) / d.z;
        end_in = lesser(t0, t1);
        end_out = greater(t0, t1);
    } else if (o.z < 0 || o.z > 1)
        return;
    if (!nappe(c, o, d, end_in, end_out, &in, &out) || in > end_out || out < end_in)
        return;
    if (in >= end_in)
        hit_add(sink, shift + in, 0);
    else if (!c->open)
        hit_add(sink, shift + end_in, d.z > 0 ? 1 : 2);
    if (out <= end_out)
        hit_add(sink, shift + out, 0);
    else if (!c->open)
        hit_add(sink, shift + end_out, d.z > 0 ? 2 : 1);
}

static double reach(const void *shape, Vec3 n)
{
    const Cone *c = shape;
    double across = sqrt(n.x * n.x + n.y * n.y);
    return greater(c->base * across, across + n.z);
}

static bool inside(const void *shape, Vec3 p)
{
    const Cone *c = shape;
    double margin = c->open ? MARGIN : -MARGIN, r = c->base + c->slope * p.z + margin;
    return r > 0 && p.x * p.x + p.y * p.y < r * r && p.z > -margin && p.z < 1 + margin;
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    const Cone *c = shape;
    if (hit->part) {
        out->normal = vec3(0, 0, hit->part == 1 ? -1 : 1);
        out->p.z = hit->part - 1;
        return;
    }
    double r = c->base + c->slope * out->p.z, now = sqrt(out->p.x * out->p.x + out->p.y * out->p.y);
    if (now > 0 && r > 0) {
        out->p.x *= r / now;
        out->p.y *= r / now;
        out->normal = vec3(out->p.x / r, out->p.y / r, -c->slope);
    } else
        out->normal = vec3(0, 0, -1);          /* the tip; POV-Ray has no normal there */
}

static Bounds extent(const void *params, const Affine *place)
{
    double base;
    Affine own = frame(params, &base);
    return shape_hull((Bounds){ vec3(-1, -1, 0), vec3(1, 1, 1) }, &own, place);
}

const ShapeOps shape_cone = {
    .keyword = "cone", .params_size = sizeof(Params), .flags = SHAPE_HAS_OPEN | SHAPE_CONVEX, .parse = parse, .compile = compile,
    .hits = hits, .reach = reach, .inside = inside, .surface = surface, .extent = extent,
};
