/* sphere.c - sphere { centre, radius }. */
#include "sdl/parse.h"
#include "shape/shape.h"
#include "world/fan.h"
#include "world/glance.h"

typedef struct { Vec3 centre; double radius; } Params;
typedef struct { Vec3 centre; double radius, radius2, inner2; bool inward; } Sphere;     /* inner2: surely inside, whatever is rounded */

static void parse(Parser *p, void *params)
{
    Params *s = params;
    s->centre = parse_vec3(p);
    s->radius = parse_next_float(p);
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *s = params;
    double r = fabs(s->radius), unit = shape_unit(b, r);
    if (r == 0)
        return;
    Sphere *out = build_data(b, sizeof *out);
    *out = (Sphere){ .centre = scaled(s->centre, 1 / unit), .radius = r / unit, .inward = s->radius < 0 };
    out->radius2 = out->radius * out->radius;
    out->inner2 = out->radius2 * (1 - 0x1p-30);
    Affine place = build_place(b, unit);
    build_prim(b, out, &place, shape_padded(bounds_grown((Bounds){ out->centre, out->centre }, out->radius)));
}

/* The distance to the centre is taken where the ray comes nearest to it, so that it loses no digits to a far origin
 * (after Haines, Guenther, Akenine-Moeller, Precision Improvements for Ray/Sphere Intersection, 2019). */
static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Sphere *s = shape;
    Vec3 v = sub(ray->o, s->centre);
    if (length2(v) < s->inner2 && length2(add(v, scaled(ray->d, hit_limit(sink)))) < s->inner2)
        return;                                /* from within to within: air around a scene, asked by every shadow ray */
    double a = length2(ray->d), middle = -dot(v, ray->d) / a;
    double h2 = s->radius2 - length2(add(v, scaled(ray->d, middle)));
    if (!(h2 > 0))
        return;
    double half = sqrt(h2 / a);
    hit_add(sink, middle - half, 0);
    hit_add(sink, middle + half, 0);
}

static void fan_hits(const void *shape, const Fan *fan, FanHits *out)
{
    const Sphere *s = shape;
    Vec3s v = vec3s_set(sub(fan->o, s->centre));
    d4 a = vec3s_dot(fan->d, fan->d), middle = d4_div(d4_sub(d4_set(0), vec3s_dot(v, fan->d)), a);
    Vec3s nearest = vec3s_add(v, vec3s_scaled(fan->d, middle));
    d4 h2 = d4_sub(d4_set(s->radius2), vec3s_dot(nearest, nearest)), half = d4_sqrt(d4_div(h2, a));
    uint32_t meets = d4_lt(d4_set(0), h2);
    fan_hit(fan, out, 0, d4_sub(middle, half), meets);
    fan_hit(fan, out, 1, d4_add(middle, half), meets);
}

static bool solid(const void *shape, Solid *out)
{
    const Sphere *s = shape;
    Bounds all = bounds_everything();
    *out = (Solid){ all.lo, all.hi, 3, s->centre, s->radius };
    return !s->inward;
}

static double reach(const void *shape, Vec3 n)
{
    const Sphere *s = shape;
    return dot(n, s->centre) + s->radius * length(n);
}

static bool inside(const void *shape, Vec3 p)
{
    const Sphere *s = shape;
    return length2(sub(p, s->centre)) < s->radius2;
}

static uint32_t fan_inside(const void *shape, const Vec3s *p)
{
    const Sphere *s = shape;
    Vec3s v = vec3s_sub(*p, vec3s_set(s->centre));
    return d4_lt(vec3s_dot(v, v), d4_set(s->radius2));
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    (void)hit;
    const Sphere *s = shape;
    Vec3 n = normalized(sub(out->p, s->centre));
    out->p = add(s->centre, scaled(n, s->radius));
    out->normal = s->inward ? negated(n) : n;
    if (out->want_uv)
        out->uv = (Vec2){ shape_longitude(n.x, n.z), 0.5 + asin(fmax(-1, fmin(1, n.y))) / PI };
}

/* POV: translations, rotations and even scales move centre and radius; others hull the corners of a box. */
static Bounds extent(const void *params, const Affine *place)
{
    const Params *s = params;
    double k;
    Vec3 c = affine_point(place, s->centre);
    if (shape_keeps_balls(place, &k))
        return bounds_grown((Bounds){ c, c }, k * s->radius);
    return bounds_transformed(bounds_grown((Bounds){ s->centre, s->centre }, s->radius), place);
}

const ShapeOps shape_sphere = {
    .keyword = "sphere", .params_size = sizeof(Params), .flags = SHAPE_HAS_UV | SHAPE_CONVEX, .parse = parse, .compile = compile,
    .hits = hits, .fan_hits = fan_hits, .fan_inside = fan_inside, .solid = solid, .reach = reach, .inside = inside, .surface = surface, .extent = extent,
};
