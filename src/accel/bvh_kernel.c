/* bvh_kernel.c - walking the tree, eight boxes at a time; built once per instruction set (base/cpu.h).
 *
 * The box test never misses: the near side is computed with the origin rounded along the ray and the inverse direction shrunk
 * by more than the rounding of the two operations that follow, the far side the other way round. A near side behind the
 * origin may come out too far forward, but not beyond 0, where every walk begins at the earliest. Zero directions have
 * infinite inverses; the only NaN, 0 * infinity, is a ray in the plane of a side and is ignored by f8_max and f8_min. */
#include "accel/bvh.h"

#include "base/simd.h"

typedef struct BoxRay {
    f8 o_near[3], o_far[3], inv_near[3], inv_far[3];
    int near[3], far[3];                       /* the sides it enters and leaves by */
} BoxRay;

typedef struct Visit {
    float near;
    uint32_t child;
    uint32_t count;
} Visit;

static const double SHRINK = 1 - 0x1p-22, STRETCH = 1 + 0x1p-22;

/* Not above x, within two roundings of it: float_below without branches. Never +INFINITY, which would hide what lies there. */
static inline float under(double x)
{
    float f = (float)(x - (fabs(x) * 0x1p-23 + 0x1p-149));
    return f < FLT_MAX ? f : FLT_MAX;
}

static inline float over(double x)
{
    return -under(-x);
}

static inline void box_ray_axis(BoxRay *r, int axis, double o, double d)
{
    double inv = 1 / d, large = fabs(inv), small = large * SHRINK;
    float small_inv = d == 0 ? INFINITY : (float)(small < (double)FLT_MAX ? small : (double)FLT_MAX);
    float large_inv = (float)(large * STRETCH);
    float below = under(o), above = over(o);
    bool back = signbit(d);
    r->near[axis] = back ? axis + 3 : axis;
    r->far[axis] = back ? axis : axis + 3;
    r->o_near[axis] = f8_set(back ? below : above);
    r->o_far[axis] = f8_set(back ? above : below);
    r->inv_near[axis] = f8_set(back ? -small_inv : small_inv);
    r->inv_far[axis] = f8_set(back ? -large_inv : large_inv);
}

static inline void box_ray(BoxRay *r, const Ray *ray)
{
    box_ray_axis(r, 0, ray->o.x, ray->d.x);
    box_ray_axis(r, 1, ray->o.y, ray->d.y);
    box_ray_axis(r, 2, ray->o.z, ray->d.z);
}

/* The children whose boxes the ray may meet in [t_min, t_max], and where it enters them. */
static inline uint32_t meet(const BvhNode *node, const BoxRay *r, float t_min, float t_max, float near_out[BVH_WIDTH])
{
    f8 near = f8_set(t_min), far = f8_set(t_max);
    for (int axis = 0; axis < 3; axis++) {
        f8 enter = f8_load(node->side[r->near[axis]]), leave = f8_load(node->side[r->far[axis]]);
        near = f8_max(f8_mul(f8_sub(enter, r->o_near[axis]), r->inv_near[axis]), near);
        far = f8_min(f8_mul(f8_sub(leave, r->o_far[axis]), r->inv_far[axis]), far);
    }
    f8_store(near_out, near);
    return f8_le(near, far) & node->used;
}

static inline Visit visit_of(const BvhNode *node, uint32_t i, float near)
{
    return (Visit){ near, node->child[i], node->count[i] };
}

/* Puts the children on the stack, the nearest on top. */
static inline uint32_t push(Visit *stack, uint32_t n, const BvhNode *node, uint32_t mask, const float near[BVH_WIDTH])
{
    uint32_t first = n;
    for (; mask != 0; mask &= mask - 1) {
        uint32_t i = (uint32_t)__builtin_ctz(mask), at = n++;
        for (; at > first && stack[at - 1].near < near[i]; at--)
            stack[at] = stack[at - 1];
        stack[at] = visit_of(node, i, near[i]);
    }
    return n;
}

bool ISA_NAME(bvh_walk)(const Bvh *b, const Ray *ray, double *t_max, AccelVisit *visit, void *user)
{
    Visit stack[BVH_STACK];
    float near[BVH_WIDTH];
    BoxRay r;
    box_ray(&r, ray);
    double best = *t_max;
    float t_min = under(ray->t_min), limit = over(best);
    uint32_t n = 0;
    Visit v = { t_min, 0, 0 };
    for (;;) {
        if (v.count == 0) {
            const BvhNode *node = &b->node[v.child];
            uint32_t mask = meet(node, &r, t_min, limit, near), more = mask & (mask - 1);
            if (mask != 0 && more == 0) {      /* one child, as most often: go on with it */
                uint32_t i = (uint32_t)__builtin_ctz(mask);
                v = visit_of(node, i, near[i]);
                continue;
            }
            n = push(stack, n, node, mask, near);
        } else {
            for (uint32_t i = 0; i < v.count; i++)
                if (visit(user, b->item[v.child + i], t_max))
                    return true;
            if (*t_max < best) {
                best = *t_max;
                limit = over(best);
            }
        }
        do {
            if (n == 0)
                return false;
            v = stack[--n];
        } while (v.near > limit);
    }
}

/* The children of the mask: nodes go on the stack, items are offered without a range. */
static inline bool open_children(const Bvh *b, const BvhNode *node, uint32_t mask, uint32_t *stack, uint32_t *n,
                                 AccelVisit *visit, void *user)
{
    double t_max = INFINITY;
    for (; mask != 0; mask &= mask - 1) {
        uint32_t i = (uint32_t)__builtin_ctz(mask);
        if (node->count[i] == 0)
            stack[(*n)++] = node->child[i];
        for (uint32_t k = 0; k < node->count[i]; k++)
            if (visit(user, b->item[node->child[i] + k], &t_max))
                return true;
    }
    return false;
}

bool ISA_NAME(bvh_around)(const Bvh *b, Vec3 p, AccelVisit *visit, void *user)
{
    uint32_t stack[BVH_STACK];
    f8 below[3], above[3];
    for (int axis = 0; axis < 3; axis++) {
        below[axis] = f8_set(under(vec3_at(p, axis)));
        above[axis] = f8_set(over(vec3_at(p, axis)));
    }
    uint32_t n = 1;
    stack[0] = 0;
    while (n > 0) {
        const BvhNode *node = &b->node[stack[--n]];
        uint32_t mask = node->used;
        for (int axis = 0; axis < 3; axis++)
            mask &= f8_le(f8_load(node->side[axis]), above[axis]) & f8_le(below[axis], f8_load(node->side[axis + 3]));
        if (open_children(b, node, mask, stack, &n, visit, user))
            return true;
    }
    return false;
}

/* ---- between a point and a box ---- */

/* At s in [0, 1] the lines from o fill the box from o + s (to.lo - o) to o + s (to.hi - o). Each of its six sides, as it
 * moves, meets a child's opposite side at one s, which bounds s from above if it moves away and from below otherwise. */
typedef struct Side {
    f8 o, inv;
    bool below;                                /* bounds s from below */
} Side;

/* A side that starts at o and moves by d, to pass places on its upper side (upper) or lower side. Loosened as for rays. */
static inline Side side_of(double o, double d, bool upper)
{
    double inv = 1 / d, large = fabs(inv), small = large * SHRINK;
    bool away = upper ? d < 0 : d > 0;
    float loose = !away ? (float)(large * STRETCH) : (float)(small < (double)FLT_MAX ? small : (double)FLT_MAX);
    return (Side){ f8_set(upper ? under(o) : over(o)), f8_set(upper != away ? loose : -loose), away };
}

static inline void clip(f8 *near, f8 *far, const Side *side, const float *at)
{
    f8 s = f8_mul(f8_sub(f8_load(at), side->o), side->inv);
    if (side->below)
        *near = f8_max(s, *near);
    else
        *far = f8_min(s, *far);
}

bool ISA_NAME(bvh_between)(const Bvh *b, Vec3 o, Bounds to, AccelVisit *visit, void *user)
{
    uint32_t stack[BVH_STACK];
    Side low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        double from = vec3_at(o, axis);
        low[axis] = side_of(from, vec3_at(to.lo, axis) - from, true);
        high[axis] = side_of(from, vec3_at(to.hi, axis) - from, false);
    }
    uint32_t n = 1;
    stack[0] = 0;
    while (n > 0) {
        const BvhNode *node = &b->node[stack[--n]];
        f8 near = f8_set(0), far = f8_set(1 + 0x1p-20f);
        for (int axis = 0; axis < 3; axis++) {
            clip(&near, &far, &low[axis], node->side[axis + 3]);
            clip(&near, &far, &high[axis], node->side[axis]);
        }
        if (open_children(b, node, f8_le(near, far) & node->used, stack, &n, visit, user))
            return true;
    }
    return false;
}
