/* bodies.c - see bodies.h. */
#include "lib/bodies.h"

#include "compile/compile.h"
#include "world/build.h"
#include "world/prim.h"

typedef struct Ball { Vec3 centre; double radius; } Ball;
typedef struct Half { Vec3 normal; double distance; } Half;

/* ---- ball ---- */

static Bounds ball_box(const Ball *b)
{
    return bounds_grown((Bounds){ b->centre, b->centre }, b->radius);
}

static void ball_compile(ShapeBuild *b, const void *params)
{
    Ball *ball = build_data(b, sizeof *ball);
    const Ball *as_written = params;
    double s = build_unit(as_written->radius);
    *ball = (Ball){ scaled(as_written->centre, 1 / s), as_written->radius / s };
    Affine place = build_place(b, s);
    build_prim(b, ball, &place, ball_box(ball));
}

static void ball_hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Ball *b = shape;
    Vec3 o = sub(ray->o, b->centre);
    double aa = length2(ray->d), bb = dot(o, ray->d), cc = length2(o) - b->radius * b->radius, h = bb * bb - aa * cc;
    if (h <= 0)
        return;
    hit_add(sink, (-bb - sqrt(h)) / aa, 0);
    hit_add(sink, (-bb + sqrt(h)) / aa, 1);
}

static bool ball_inside(const void *shape, Vec3 p)
{
    const Ball *b = shape;
    return length2(sub(p, b->centre)) < b->radius * b->radius;
}

static void ball_surface(const void *shape, const Hit *hit, Surface *out)
{
    (void)hit;
    out->normal = sub(out->p, ((const Ball *)shape)->centre);
}

static Bounds ball_extent(const void *params, const Affine *place)
{
    return bounds_transformed(ball_box(params), place);
}

const ShapeOps body_ball = { .keyword = "ball", .params_size = sizeof(Ball), .flags = SHAPE_CONVEX, .compile = ball_compile,
                             .hits = ball_hits, .inside = ball_inside, .surface = ball_surface, .extent = ball_extent };

/* ---- block ---- */

static void block_compile(ShapeBuild *b, const void *params)
{
    Bounds *block = build_data(b, sizeof *block);
    const Bounds *as_written = params;
    double s = build_unit(fmax(max_abs(as_written->lo), max_abs(as_written->hi)));
    *block = (Bounds){ scaled(as_written->lo, 1 / s), scaled(as_written->hi, 1 / s) };
    Affine place = build_place(b, s);
    build_prim(b, block, &place, *block);
}

static void block_hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Bounds *b = shape;
    double near = -INFINITY, far = INFINITY;
    uint32_t near_axis = 0, far_axis = 0;
    for (int axis = 0; axis < 3; axis++) {
        double o = vec3_at(ray->o, axis), d = vec3_at(ray->d, axis), lo = vec3_at(b->lo, axis), hi = vec3_at(b->hi, axis);
        if (d == 0) {
            if (o < lo || o > hi)
                return;
            continue;
        }
        double enter = ((d > 0 ? lo : hi) - o) / d, leave = ((d > 0 ? hi : lo) - o) / d;
        if (enter > near) {
            near = enter;
            near_axis = (uint32_t)axis;
        }
        if (leave < far) {
            far = leave;
            far_axis = (uint32_t)axis;
        }
    }
    if (near > far)
        return;
    hit_add(sink, near, near_axis);
    hit_add(sink, far, 3 + far_axis);
}

static bool block_inside(const void *shape, Vec3 p)
{
    return bounds_contain(*(const Bounds *)shape, p);
}

static void block_surface(const void *shape, const Hit *hit, Surface *out)
{
    const Bounds *b = shape;
    int axis = (int)hit->part % 3;
    double middle = vec3_at(b->lo, axis) / 2 + vec3_at(b->hi, axis) / 2;
    out->normal = vec3(0, 0, 0);
    vec3_set(&out->normal, axis, vec3_at(out->p, axis) < middle ? -1 : 1);
}

static Bounds block_extent(const void *params, const Affine *place)
{
    return bounds_transformed(*(const Bounds *)params, place);
}

static double block_reach(const void *shape, Vec3 n)
{
    const Bounds *b = shape;
    return fmax(n.x * b->lo.x, n.x * b->hi.x) + fmax(n.y * b->lo.y, n.y * b->hi.y) + fmax(n.z * b->lo.z, n.z * b->hi.z);
}

const ShapeOps body_block = { .keyword = "block", .params_size = sizeof(Bounds), .flags = SHAPE_CONVEX | SHAPE_SHARED,
                              .compile = block_compile, .hits = block_hits, .reach = block_reach, .inside = block_inside, .surface = block_surface,
                              .extent = block_extent };

/* ---- half space ---- */

static void half_compile(ShapeBuild *b, const void *params)
{
    Half *half = build_data(b, sizeof *half);
    *half = *(const Half *)params;
    double s = build_unit(half->distance);
    half->distance /= s;
    Affine place = build_place(b, s);
    build_prim(b, half, &place, bounds_everything());
}

static void half_hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Half *h = shape;
    double slope = dot(h->normal, ray->d);
    if (slope != 0)
        hit_add(sink, (h->distance - dot(h->normal, ray->o)) / slope, 0);
}

static bool half_inside(const void *shape, Vec3 p)
{
    const Half *h = shape;
    return dot(h->normal, p) <= h->distance;
}

static void half_surface(const void *shape, const Hit *hit, Surface *out)
{
    (void)hit;
    out->normal = ((const Half *)shape)->normal;
}

static void half_of(const void *shape, Vec3 *normal, double *distance)
{
    const Half *h = shape;
    *normal = h->normal;
    *distance = h->distance;
}

const ShapeOps body_half = { .keyword = "half", .params_size = sizeof(Half), .compile = half_compile, .hits = half_hits,
                             .half_space = half_of, .inside = half_inside, .surface = half_surface };

/* ---- objects ---- */

static const Object *shape(Arena *a, const ShapeOps *ops, const void *params)
{
    Object *o = arena_new(a, Object);
    *o = (Object){ .kind = OBJECT_SHAPE, .ops = ops, .params = arena_copy(a, params, ops->params_size) };
    return o;
}

const Object *ball(Arena *a, Vec3 centre, double radius)
{
    return shape(a, &body_ball, &(Ball){ centre, radius });
}

const Object *block(Arena *a, Vec3 lo, Vec3 hi)
{
    return shape(a, &body_block, &(Bounds){ lo, hi });
}

const Object *half_space(Arena *a, Vec3 normal, double distance)
{
    return shape(a, &body_half, &(Half){ normal, distance });
}

const Object *combined(Arena *a, ObjectKind kind, uint32_t n, const Object *const *child)
{
    Object *o = arena_new(a, Object);
    *o = (Object){ .kind = kind, .child = arena_copy(a, child, n * sizeof *child), .n_child = n };
    return o;
}

const Object *combined2(Arena *a, ObjectKind kind, const Object *one, const Object *two)
{
    return combined(a, kind, 2, (const Object *const[]){ one, two });
}

static Object *copy(Arena *a, const Object *o)
{
    return arena_copy(a, o, sizeof *o);
}

static ObjectMore *own_more(Arena *a, Object *o)
{
    ObjectMore *more = arena_copy(a, object_more(o), sizeof *more);
    o->more = more;
    return more;
}

const Object *inverted(Arena *a, const Object *o)
{
    Object *out = copy(a, o);
    out->flags ^= OBJECT_INVERSE;
    return out;
}

static const Object *const *placed_list(Arena *a, const Object *const *list, uint32_t n, Affine place)
{
    const Object **out = arena_array(a, const Object *, n);
    for (uint32_t i = 0; i < n; i++)
        out[i] = placed(a, list[i], place);
    return out;
}

const Object *placed(Arena *a, const Object *o, Affine place)
{
    Object *out = copy(a, o);
    Affine both = affine_then(affine_of(o->place), place);
    out->place = arena_copy(a, &both, sizeof both);
    ObjectMore *more = own_more(a, out);
    more->clipped_by = placed_list(a, more->clipped_by, more->n_clipped_by, place);
    more->bounded_by = placed_list(a, more->bounded_by, more->n_bounded_by, place);
    return out;
}

const Object *clipped_to(Arena *a, const Object *o, const Object *clip)
{
    Object *out = copy(a, o);
    ObjectMore *more = own_more(a, out);
    more->clipped_by = arena_copy(a, &clip, sizeof clip);
    more->n_clipped_by = 1;
    return out;
}

const Object *bounded_to(Arena *a, const Object *o, const Object *bound)
{
    Object *out = copy(a, o);
    ObjectMore *more = own_more(a, out);
    more->bounded_by = arena_copy(a, &bound, sizeof bound);
    more->n_bounded_by = 1;
    return out;
}

const Object *flagged(Arena *a, const Object *o, uint32_t flags)
{
    Object *out = copy(a, o);
    out->flags |= flags;
    return out;
}

/* ---- chance ---- */

double dice(Dice *d)
{
    d->state = d->state * 6364136223846793005u + 1442695040888963407u;
    uint64_t x = d->state;
    x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdu;
    return (double)((x ^ (x >> 29)) >> 11) * 0x1p-53;
}

double dice_between(Dice *d, double lo, double hi)
{
    return lo + dice(d) * (hi - lo);
}

Vec3 dice_point(Dice *d, double size)
{
    double x = dice_between(d, -size, size), y = dice_between(d, -size, size);
    return vec3(x, y, dice_between(d, -size, size));
}

Vec3 dice_direction(Dice *d)
{
    for (;;) {
        Vec3 v = dice_point(d, 1);
        if (length2(v) > 0.01 && length2(v) < 1)
            return normalized(v);
    }
}

Ray random_ray(Dice *d, double size)
{
    Vec3 from = dice_point(d, 2 * size), to = dice_point(d, size);
    return (Ray){ from, normalized(sub(to, from)), 0, INFINITY };
}

static Affine random_place(Dice *d, double size)
{
    Vec3 turn = dice_point(d, 180), by = dice_point(d, size / 4);
    Affine place = affine_then(affine_rotate(turn), affine_translate(by));
    if (dice(d) < 0.3)
        place = affine_then(affine_scale(vec3(dice_between(d, 0.5, 1.5), dice_between(d, 0.5, 1.5), 1)), place);
    return place;
}

static const Object *random_shape(Arena *a, Dice *d, double size)
{
    double kind = dice(d);
    Vec3 at = dice_point(d, size / 2);
    if (kind < 0.45)
        return ball(a, at, dice_between(d, 0.2, 0.8) * size);
    if (kind < 0.9) {
        Vec3 half = vec3(dice_between(d, 0.2, 0.7) * size, dice_between(d, 0.2, 0.7) * size, dice_between(d, 0.2, 0.7) * size);
        return block(a, sub(at, half), add(at, half));
    }
    return half_space(a, dice_direction(d), dice_between(d, -size, size) / 4);
}

const Object *random_body(Arena *a, Dice *d, int depth, double size)
{
    const Object *o;
    if (depth == 0 || dice(d) < 0.25)
        o = random_shape(a, d, size);
    else {
        static const ObjectKind kinds[] = { OBJECT_UNION, OBJECT_MERGE, OBJECT_INTERSECTION, OBJECT_DIFFERENCE };
        const Object *child[12];
        uint32_t n = dice(d) < 0.15 ? 12 : 2 + (uint32_t)(dice(d) * 2);
        for (uint32_t i = 0; i < n; i++)
            child[i] = random_body(a, d, depth - 1, size);
        o = combined(a, kinds[(int)(dice(d) * 4)], n, child);
    }
    if (dice(d) < 0.15)
        o = inverted(a, o);
    if (dice(d) < 0.15)
        o = clipped_to(a, o, random_shape(a, d, size));
    if (dice(d) < 0.1)
        o = bounded_to(a, o, random_shape(a, d, size));
    if (dice(d) < 0.5)
        o = placed(a, o, random_place(d, size));
    return o;
}

World *world_of(Arena *a, uint32_t n, const Object *const *object, const char *accel)
{
    static const ShapeOps *const shapes[] = { &body_ball, &body_block, &body_half, NULL };
    static const PatternOps *const patterns[] = { NULL };
    static const Registry registry = { shapes, patterns };
    World *w = arena_new(a, World);
    Scene *scene = arena_new(a, Scene);
    scene->object = arena_copy(a, object, n * sizeof *object);
    scene->n_objects = n;
    w->arena = *a;
    compile_world(w, scene, &registry, accel, NULL);
    *a = w->arena;                             /* one arena for all: the World's copy goes stale */
    w->arena = (Arena){ 0 };
    return w;
}
