/* disc.c - a flat ring: disc { centre, normal, outer [, hole] }. */
#include "sdl/parse.h"
#include "shape/shape.h"
#include "world/fan.h"

typedef struct { Vec3 centre, normal; double outer, hole; } Params;
typedef struct { Vec3 centre, normal; double outer2, hole2; } Disc;

static void parse(Parser *p, void *params)
{
    Params *d = params;
    d->centre = parse_vec3(p);
    Vec3 n = parse_next_vec3(p);
    d->normal = normalized(scaled(n, 1 / build_unit(max_abs(n))));
    d->outer = parse_next_float(p);
    d->hole = parse_optional_float(p, 0);
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *d = params;
    if (max_abs(d->normal) == 0)               /* POV: no message, nothing to see */
        return;
    double unit = shape_unit(b, fabs(d->outer)), outer = d->outer / unit, hole = d->hole / unit;
    Disc *out = build_data(b, sizeof *out);
    Vec3 n = d->normal;
    *out = (Disc){ scaled(d->centre, 1 / unit), n, outer * outer, hole * hole };
    Vec3 reach = scaled(vec3(sqrt(fmax(0, 1 - n.x * n.x)), sqrt(fmax(0, 1 - n.y * n.y)), sqrt(fmax(0, 1 - n.z * n.z))),
                        fabs(outer) * (1 + 1e-7));         /* the roots lose half the digits near 0 */
    Affine place = build_place(b, unit);
    build_prim(b, out, &place, shape_padded(bounds_grown((Bounds){ sub(out->centre, reach), add(out->centre, reach) },
                                                         1e-7 * fabs(outer))));
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Disc *d = shape;
    double slope = dot(d->normal, ray->d);
    if (slope == 0)
        return;                                /* in the plane: a disc has no edge to hit */
    Vec3 v = sub(ray->o, d->centre);
    double t = -dot(d->normal, v) / slope, r2 = length2(add(v, scaled(ray->d, t)));
    if (d->hole2 <= r2 && r2 <= d->outer2)
        hit_add(sink, t, 0);
}

static void fan_hits(const void *shape, const Fan *fan, FanHits *out)
{
    const Disc *d = shape;
    Vec3 v = sub(fan->o, d->centre);
    d4 t = d4_div(d4_set(-dot(d->normal, v)), vec3s_dot(vec3s_set(d->normal), fan->d));    /* a slope of 0: never within the ring */
    Vec3s on = vec3s_add(vec3s_set(v), vec3s_scaled(fan->d, t));
    d4 r2 = vec3s_dot(on, on);
    fan_hit(fan, out, 0, t, d4_le(d4_set(d->hole2), r2) & d4_le(r2, d4_set(d->outer2)));
}

/* POV: everything behind the disc's plane is inside, however far from the ring. */
static bool inside(const void *shape, Vec3 p)
{
    const Disc *d = shape;
    return dot(d->normal, sub(p, d->centre)) < 0;
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    (void)hit;
    const Disc *d = shape;
    out->normal = d->normal;
    out->p = sub(out->p, scaled(d->normal, dot(d->normal, sub(out->p, d->centre))));
}

static Bounds extent(const void *params, const Affine *place)
{
    const Params *d = params;
    Affine frame = affine_frame(d->centre, d->normal, 1, 1);
    double thick = 0.001;                      /* POV: whatever the size of the disc */
    return shape_hull((Bounds){ vec3(-d->outer, -d->outer, -thick), vec3(d->outer, d->outer, thick) }, &frame, place);
}

const ShapeOps shape_disc = {
    .keyword = "disc", .params_size = sizeof(Params), .flags = SHAPE_NO_BOX_IN_CSG | SHAPE_FLAT, .parse = parse, .compile = compile,
    .hits = hits, .fan_hits = fan_hits, .inside = inside, .surface = surface, .extent = extent,
};
