/* plane.c - plane { normal, distance }: the half space on the side that the normal leaves is solid. */
#include "sdl/parse.h"
#include "shape/shape.h"
#include "world/fan.h"

typedef struct { Vec3 normal; double distance; } Params;

/* POV: a ray within this angle of the plane misses it, and a point this close, relative to where it is, is inside:
 * so coplanar faces of other members of a CSG survive. */
static const double FLAT = 1e-10;

static void parse(Parser *p, void *params)
{
    Params *plane = params;
    Vec3 n = parse_vec3(p);
    double unit = build_unit(max_abs(n));
    plane->normal = normalized(scaled(n, 1 / unit));
    plane->distance = parse_next_float(p);
    if (max_abs(n) == 0)
        parse_fail(p, "the normal of a plane needs a length");
}

/* In the world's space, wherever it was moved (08-shapes, section 2.2): so that it meets rays at the same t as the sides of
 * boxes that it coincides with, and the first object wins. */
static void compile(ShapeBuild *b, const void *params)
{
    const Params *plane = params;
    Vec3 on = affine_point(&b->place, scaled(plane->normal, plane->distance));
    Vec3 across = affine_normal(&b->place, plane->normal);
    Params *out = build_data(b, sizeof *out);
    out->normal = normalized(scaled(across, 1 / build_unit(max_abs(across))));
    out->distance = dot(out->normal, on);
    Affine place = affine_identity();
    Bounds box = bounds_everything();
    Vec3 n = out->normal;
    for (int i = 0; i < 3; i++) {              /* along an axis: bounds the other members of an intersection */
        double side = vec3_at(n, i);
        if (fabs(side) == 1 && length2(n) == 1)
            vec3_set(side > 0 ? &box.hi : &box.lo, i, side * (out->distance + 4 * FLAT * fabs(out->distance)));
    }
    build_prim(b, out, &place, box);
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Params *plane = shape;
    double slope = dot(plane->normal, ray->d), way = plane->distance - dot(plane->normal, ray->o);
    if (way * slope < 0 && sink->t_min >= 0)   /* behind the ray: most rays that leave a floor */
        return;
    if (fabs(slope) <= FLAT * max_abs(ray->d))
        return;
    hit_add(sink, way / slope, 0);
}

static void fan_hits(const void *shape, const Fan *fan, FanHits *out)
{
    const Params *plane = shape;
    d4 slope = vec3s_dot(vec3s_set(plane->normal), fan->d);
    uint32_t steep = d4_lt(d4_mul(d4_set(FLAT), vec3s_max_abs(fan->d)), d4_abs(slope));
    fan_hit(fan, out, 0, d4_div(d4_set(plane->distance - dot(plane->normal, fan->o)), slope), steep);
}

static bool inside(const void *shape, Vec3 p)
{
    const Params *plane = shape;
    return dot(plane->normal, p) - plane->distance <= FLAT * (max_abs(p) + fabs(plane->distance));
}

static uint32_t fan_inside(const void *shape, const Vec3s *p)
{
    const Params *plane = shape;
    d4 height = d4_sub(vec3s_dot(vec3s_set(plane->normal), *p), d4_set(plane->distance));
    return d4_le(height, d4_mul(d4_set(FLAT), d4_add(vec3s_max_abs(*p), d4_set(fabs(plane->distance)))));
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    (void)hit;
    const Params *plane = shape;
    out->normal = plane->normal;
    out->p = add(out->p, scaled(plane->normal, plane->distance - dot(plane->normal, out->p)));
}

static void half_space(const void *shape, Vec3 *normal, double *distance)
{
    const Params *plane = shape;
    *normal = plane->normal;
    *distance = plane->distance;
}

static Bounds extent(const void *params, const Affine *place)
{
    (void)params;
    (void)place;
    return bounds_everything();
}

const ShapeOps shape_plane = {
    .keyword = "plane", .params_size = sizeof(Params), .flags = SHAPE_CONVEX | SHAPE_FLAT, .parse = parse, .compile = compile,
    .hits = hits, .fan_hits = fan_hits, .fan_inside = fan_inside, .inside = inside, .surface = surface, .half_space = half_space, .extent = extent,
};
