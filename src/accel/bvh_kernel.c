/* bvh_kernel.c - walking the tree, eight boxes at a time; built once per instruction set (base/cpu.h).
 *
 * The box test never misses: the near side is computed with the origin rounded along the ray and the inverse direction shrunk
 * by more than the rounding of all operations, the far side the other way round. A near side behind the origin may come out
 * too far forward, but not beyond 0, where every walk begins at the earliest. A side for which NaN comes out (the ray is in
 * its plane, or starts beyond all floats) is ignored by f8_max and f8_min. */
#include "accel/bvh.h"

#include "base/simd.h"

/* The three axes of a ray at once; the fourth number is nothing. */
typedef float Axes __attribute__((vector_size(16)));
typedef int32_t AxisBits __attribute__((vector_size(16)));

typedef struct BoxRay {
    float o_near[4], o_far[4], inv_near[4], inv_far[4];    /* of the inverse the negative: a side is taken from o */
    uint32_t near[4], far[4];                  /* the sides it enters and leaves by: where in BvhNode.side */
} BoxRay;

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

static inline Axes axes_of(Vec3 v)
{
    return (Axes){ (float)v.x, (float)v.y, (float)v.z, 1 };
}

static inline Axes axes_abs(Axes a)
{
    return (Axes)((AxisBits)a & 0x7fffffff);
}

static inline Axes axes_choose(AxisBits which, Axes a, Axes b)
{
    return (Axes)((which & (AxisBits)a) | (~which & (AxisBits)b));
}

/* Five roundings lie between d and a distance, the margins are of eight. Floats near the least normal one have fewer digits:
 * small is kept below the inverse of that by what is added, large is infinite there by an overflow. */
static inline void box_ray(BoxRay *r, const Ray *ray)
{
    Axes o = axes_of(ray->o), d = axes_of(ray->d), loose = axes_abs(o) * 0x1p-22f + 0x1p-149f, size = axes_abs(d);
    Axes small = (1 - 0x1p-21f) / (size + 0x1p-126f), large = (4 + 0x1p-19f) / size * 0.25f;
    Axes below = o - loose, above = o + loose;
    AxisBits back = (AxisBits)d >> 31, turned = ~(AxisBits)d & (int32_t)0x80000000;
    AxisBits side = { 0, BVH_WIDTH, 2 * BVH_WIDTH, 0 }, other = back & 3 * BVH_WIDTH;
    Axes o_near = axes_choose(back, below, above), o_far = axes_choose(back, above, below);
    Axes inv_near = (Axes)((AxisBits)small | turned), inv_far = (Axes)((AxisBits)large | turned);
    AxisBits near = side + other, far = side + 3 * BVH_WIDTH - other;
    memcpy(r->o_near, &o_near, sizeof o_near);
    memcpy(r->o_far, &o_far, sizeof o_far);
    memcpy(r->inv_near, &inv_near, sizeof inv_near);
    memcpy(r->inv_far, &inv_far, sizeof inv_far);
    memcpy(r->near, &near, sizeof near);
    memcpy(r->far, &far, sizeof far);
}

/* The children whose boxes the ray may meet in [t_min, t_max], and where it enters them. Not inlined: the compiler would keep
 * the ray in registers, and save and restore them all around every item. */
static __attribute__((noinline)) uint32_t meet(const BvhNode *node, const BoxRay *r, float t_min, float t_max, float near_out[BVH_WIDTH])
{
    const float *side = node->side[0];
    f8 near = f8_set(t_min), far = f8_set(t_max);
    for (int axis = 0; axis < 3; axis++) {
        f8 enter = f8_sub(f8_set(r->o_near[axis]), f8_load(side + r->near[axis]));
        f8 leave = f8_sub(f8_set(r->o_far[axis]), f8_load(side + r->far[axis]));
        near = f8_max(f8_mul(enter, f8_set(r->inv_near[axis])), near);
        far = f8_min(f8_mul(leave, f8_set(r->inv_far[axis])), far);
    }
    f8_store(near_out, near);
    return f8_le(near, far) & node->used;
}

/* A child and where it is entered, in one number that grows with the distance: the bits of a float, then the child. (Below 0
 * the order is another; all a ray begins with is a little below.) */
static inline int64_t visit_of(const BvhNode *node, uint32_t i, const float near[BVH_WIDTH])
{
    return (int64_t)((uint64_t)float_bits(near[i]) << 32 | node->child[i]);
}

static inline float visit_near(int64_t visit)
{
    return float_of_bits((uint32_t)((uint64_t)visit >> 32));
}

/* Puts the children on the stack, the nearest on top. */
static inline uint32_t push(int64_t *stack, uint32_t n, const BvhNode *node, uint32_t mask, const float near[BVH_WIDTH])
{
    uint32_t first = n;
    for (; mask != 0; mask &= mask - 1) {
        int64_t visit = visit_of(node, (uint32_t)__builtin_ctz(mask), near);
        uint32_t at = n++;
        for (; at > first && stack[at - 1] < visit; at--)
            stack[at] = stack[at - 1];
        stack[at] = visit;
    }
    return n;
}

bool ISA_NAME(bvh_walk)(const Bvh *b, const Ray *ray, double *t_max, AccelVisit *visit, void *user)
{
    int64_t stack[BVH_STACK];
    float near[BVH_WIDTH];
    BoxRay r;
    box_ray(&r, ray);
    double best = *t_max;
    float t_min = under(ray->t_min), limit = over(best);
    uint32_t n = 0, child = bvh_child(0, 0);
    for (;;) {
        uint32_t at = bvh_at(child), count = bvh_count(child);
        if (count == 0) {
            const BvhNode *node = &b->node[at];
            uint32_t mask = meet(node, &r, t_min, limit, near);
            if (mask != 0 && (mask & (mask - 1)) == 0) {   /* one child, as most often: go on with it */
                child = node->child[__builtin_ctz(mask)];
                continue;
            }
            n = push(stack, n, node, mask, near);
        } else {
            for (uint32_t i = 0; i < count; i++)
                if (visit(user, b->item[at + i], t_max))
                    return true;
            if (*t_max < best) {
                best = *t_max;
                limit = over(best);
            }
        }
        do {
            if (n == 0)
                return false;
            child = (uint32_t)stack[--n];
        } while (visit_near(stack[n]) > limit);
    }
}

/* The children of the mask: nodes go on the stack, items are offered without a range. */
static inline bool open_children(const Bvh *b, const BvhNode *node, uint32_t mask, uint32_t *stack, uint32_t *n,
                                 AccelVisit *visit, void *user)
{
    double t_max = INFINITY;
    for (; mask != 0; mask &= mask - 1) {
        uint32_t i = (uint32_t)__builtin_ctz(mask);
        uint32_t at = bvh_at(node->child[i]), count = bvh_count(node->child[i]);
        if (count == 0)
            stack[(*n)++] = at;
        for (uint32_t k = 0; k < count; k++)
            if (visit(user, b->item[at + k], &t_max))
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
