/* box.c - box { corner, corner }: three slabs. A hit's part is its side: axis + 3 for the high one; entries come after
 * exits, so that a box without thickness shows its far side, as POV-Ray's does. */
#include "base/simd.h"
#include "sdl/parse.h"
#include "shape/shape.h"
#include "world/fan.h"
#include "world/glance.h"

typedef struct { Vec3 a, b; } Params;
typedef struct { double side[2][3]; } Box;                 /* low, high */

enum { ENTRY = 8 };

static void parse(Parser *p, void *params)
{
    Params *box = params;
    Vec3 a = parse_vec3(p), b = parse_next_vec3(p);
    box->a = shape_min(a, b);
    box->b = shape_max(a, b);
}

static bool along_axes(const Affine *place)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (i != j && place->m[i][j] != 0)
                return false;
    return true;
}

static void build(ShapeBuild *b, Vec3 lo, Vec3 hi, const Affine *place)
{
    Box *out = build_data(b, sizeof *out);
    *out = (Box){ { { lo.x, lo.y, lo.z }, { hi.x, hi.y, hi.z } } };
    build_prim(b, out, place, shape_padded((Bounds){ lo, hi }));
}

/* Moved and stretched boxes stay boxes, so they go to the world as they are (08-shapes, section 2.2): sides that coincide
 * there are then met at the same t, and the first object wins everywhere instead of here and there. */
static void compile(ShapeBuild *b, const void *params)
{
    const Params *box = params;
    if (along_axes(&b->place)) {
        Affine world = affine_identity();
        Vec3 p = affine_point(&b->place, box->a), q = affine_point(&b->place, box->b);
        build(b, shape_min(p, q), shape_max(p, q), &world);
        return;
    }
    double unit = shape_unit(b, fmax(max_abs(box->a), max_abs(box->b)));
    Affine place = build_place(b, unit);
    build(b, scaled(box->a, 1 / unit), scaled(box->b, 1 / unit), &place);
}

/* Where a ray enters and leaves the slabs of the three axes. */
typedef struct Slabs { double in[3], out[3]; } Slabs;

/* A ray that does not move along an axis is within that slab always or never. */
static __attribute__((noinline)) bool keeps_within(const Box *box, const Ray *ray, Slabs *s)
{
    for (int axis = 0; axis < 3; axis++) {
        double o = vec3_at(ray->o, axis);
        if (vec3_at(ray->d, axis) != 0)
            continue;
        if (o < box->side[0][axis] || o > box->side[1][axis])
            return false;
        s->in[axis] = -INFINITY;
        s->out[axis] = INFINITY;
    }
    return max_abs(ray->d) > 0;
}

/* Of the axes that meet a side there, the one along which the ray is steepest: an edge is part of that side. */
static __attribute__((noinline)) uint32_t steepest(Vec3 d, uint32_t axes)
{
    double x = axes & 1 ? fabs(d.x) : -1, y = axes & 2 ? fabs(d.y) : -1, z = axes & 4 ? fabs(d.z) : -1;
    return z > greater(x, y) ? 2 : y > x ? 1 : 0;
}

static inline uint32_t side_at(const Ray *ray, uint32_t axes, bool high)
{
    uint32_t axis = (axes & (axes - 1)) == 0 ? axes >> 1 : steepest(ray->d, axes);
    return (vec3_at(ray->d, (int)axis) < 0) != high ? axis + 3 : axis;
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Box *box = shape;
    d2 o = d2_load(&ray->o.x), d = d2_load(&ray->d.x);         /* x and y */
    d2 a = d2_div(d2_sub(d2_load(box->side[0]), o), d), b = d2_div(d2_sub(d2_load(box->side[1]), o), d);
    d2 in = d2_min(a, b), out = d2_max(a, b);
    double az = (box->side[0][2] - ray->o.z) / ray->d.z, bz = (box->side[1][2] - ray->o.z) / ray->d.z;
    double in_z = lesser(az, bz), out_z = greater(az, bz);
    if (ray->d.x * ray->d.y * ray->d.z == 0) {
        Slabs s;
        d2_store(s.in, in);
        d2_store(s.out, out);
        s.in[2] = in_z;
        s.out[2] = out_z;
        if (!keeps_within(box, ray, &s))
            return;
        in = d2_load(s.in);
        out = d2_load(s.out);
        in_z = s.in[2];
        out_z = s.out[2];
    }
    double enter = greater(greater(d2_low(in), d2_high(in)), in_z), leave = lesser(lesser(d2_low(out), d2_high(out)), out_z);
    if (enter > leave || leave <= sink->t_min)
        return;
    if (enter > sink->t_min && enter <= sink->limit)
        hit_offer(sink, enter, side_at(ray, d2_eq(in, d2_set(enter)) | (uint32_t)(in_z == enter) << 2, false) + ENTRY, 0, 0);
    if (leave <= sink->limit)
        hit_offer(sink, leave, side_at(ray, d2_eq(out, d2_set(leave)) | (uint32_t)(out_z == leave) << 2, true), 0, 0);
}

static inline void cut_four(d4 *in, d4 *out, double lo, double hi, d4 d)
{
    d4 a = d4_div(d4_set(lo), d), b = d4_div(d4_set(hi), d);
    *in = d4_max(*in, d4_min(a, b));
    *out = d4_min(*out, d4_max(a, b));
}

/* A ray along a side is left to `hits`. Edges are shared by two sides, which does not matter here. */
static void fan_hits(const void *shape, const Fan *fan, FanHits *out)
{
    const Box *box = shape;
    const double *lo = box->side[0], *hi = box->side[1];
    d4 enter = d4_set(-INFINITY), leave = d4_set(INFINITY);
    cut_four(&enter, &leave, lo[0] - fan->o.x, hi[0] - fan->o.x, fan->d.x);
    cut_four(&enter, &leave, lo[1] - fan->o.y, hi[1] - fan->o.y, fan->d.y);
    cut_four(&enter, &leave, lo[2] - fan->o.z, hi[2] - fan->o.z, fan->d.z);
    uint32_t meets = d4_le(enter, leave);
    fan_hit(fan, out, 0, enter, meets);
    fan_hit(fan, out, 1, leave, meets);
    out->unsaid = d4_eq(d4_mul(d4_mul(fan->d.x, fan->d.y), fan->d.z), d4_set(0));
}

static bool solid(const void *shape, Solid *out)
{
    const double *lo = ((const Box *)shape)->side[0], *hi = ((const Box *)shape)->side[1];
    *out = (Solid){ .lo = vec3(lo[0], lo[1], lo[2]), .hi = vec3(hi[0], hi[1], hi[2]) };
    return true;
}

static double reach(const void *shape, Vec3 n)
{
    const Box *box = shape;
    return n.x * box->side[n.x > 0][0] + n.y * box->side[n.y > 0][1] + n.z * box->side[n.z > 0][2];
}

static bool inside(const void *shape, Vec3 p)
{
    const Box *box = shape;
    return p.x >= box->side[0][0] && p.x <= box->side[1][0] && p.y >= box->side[0][1] && p.y <= box->side[1][1] &&
           p.z >= box->side[0][2] && p.z <= box->side[1][2];
}

static inline uint32_t between_four(double lo, d4 x, double hi)
{
    return d4_le(d4_set(lo), x) & d4_le(x, d4_set(hi));
}

static uint32_t fan_inside(const void *shape, const Vec3s *p)
{
    const Box *box = shape;
    const double *lo = box->side[0], *hi = box->side[1];
    return between_four(lo[0], p->x, hi[0]) & between_four(lo[1], p->y, hi[1]) & between_four(lo[2], p->z, hi[2]);
}

/* A cross of six squares in a picture four wide and three high (08-shapes, section 8). */
static Vec2 unfolded(const Box *box, uint32_t side, Vec3 p)
{
    double f[3];
    for (int i = 0; i < 3; i++) {
        double size = box->side[1][i] - box->side[0][i];
        f[i] = size > 0 ? (vec3_at(p, i) - box->side[0][i]) / size : 0;
    }
    switch (side) {
    case 0: return (Vec2){ f[2] / 4, (1 + f[1]) / 3 };
    case 1: return (Vec2){ (1 + f[0]) / 4, f[2] / 3 };
    case 2: return (Vec2){ 1 - f[0] / 4, (1 + f[1]) / 3 };
    case 3: return (Vec2){ (3 - f[2]) / 4, (1 + f[1]) / 3 };
    case 4: return (Vec2){ (1 + f[0]) / 4, 1 - f[2] / 3 };
    default: return (Vec2){ (1 + f[0]) / 4, (1 + f[1]) / 3 };
    }
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    const Box *box = shape;
    uint32_t side = hit->part % ENTRY;
    int axis = (int)side % 3, high = side >= 3;
    vec3_set(&out->p, axis, box->side[high][axis]);
    out->normal = vec3(0, 0, 0);
    vec3_set(&out->normal, axis, high ? 1 : -1);
    if (out->want_uv)
        out->uv = unfolded(box, side, out->p);
}

static Bounds extent(const void *params, const Affine *place)
{
    const Params *box = params;
    return bounds_transformed((Bounds){ box->a, box->b }, place);
}

const ShapeOps shape_box = {
    .keyword = "box", .params_size = sizeof(Params), .flags = SHAPE_HAS_UV | SHAPE_CONVEX | SHAPE_FLAT, .parse = parse, .compile = compile,
    .hits = hits, .fan_hits = fan_hits, .fan_inside = fan_inside, .solid = solid, .reach = reach, .inside = inside, .surface = surface, .extent = extent,
};
