/* bvh_kernel.c - walking the tree, eight boxes at a time; built once per instruction set (base/cpu.h).
 *
 * The box test never misses. Each side is met by a line that starts a little further out, so that the sign of a distance is
 * right whatever was rounded; distances are then right to a few digits less than floats have, and the far end is stretched by
 * that. A near side behind the origin may come out too far forward, but not beyond 0, where every walk begins at the earliest.
 * A side for which NaN comes out (the ray starts beyond all floats) is ignored by f8_max and f8_min. */
#include "accel/bvh.h"

#include <stddef.h>

#include "base/simd.h"

/* The three axes of a ray at once; the fourth number is nothing. */
typedef double Axes64 __attribute__((vector_size(32), aligned(8), may_alias));
typedef float Axes __attribute__((vector_size(16)));
typedef int32_t AxisBits __attribute__((vector_size(16)));

typedef struct BoxRay {
    float above[4], below[4];                  /* the origin, as the low and the high sides see it */
    float inverse[4];                          /* of the direction, the negative: a side is taken from the origin */
    float start;
} BoxRay;

static const double SHRINK = 1 - 0x1p-22, STRETCH = 1 + 0x1p-22;

/* A distance is rounded four times, and so is the one it is compared with. */
static const float DISTANCE_STRETCH = 1 + 0x1p-20f;

/* Not above x, within two roundings of it. Never +INFINITY, which would hide what lies there. */
static inline float under(double x)
{
    float f = (float)(x - (fabs(x) * 0x1p-23 + 0x1p-149));
    return f < FLT_MAX ? f : FLT_MAX;
}

static inline float over(double x)
{
    return -under(-x);
}

/* Three numbers of a ray, and the one that follows them. */
static inline Axes axes_at(const Ray *ray, size_t offset)
{
    const double *x = (const double *)(const void *)((const char *)ray + offset);
    return (Axes){ (float)x[0], (float)x[1], (float)x[2], 0 };
}

static inline Axes axes_abs(Axes a)
{
    return (Axes)((AxisBits)a & 0x7fffffff);
}

/* A direction of 0 gives infinite distances, and NaN for a side exactly the margin away: a box that is not met. */
static inline void box_ray(BoxRay *r, const Ray *ray)
{
    Axes o = axes_at(ray, offsetof(Ray, o)), d = axes_at(ray, offsetof(Ray, d));
    Axes part = o - o * (1 - 0x1p-21f);        /* NaN of an infinite one */
    Axes loose = axes_abs(part), above = o + loose, below = o - loose, inverse = -1 / d;
    memcpy(r->above, &above, sizeof above);
    memcpy(r->below, &below, sizeof below);
    memcpy(r->inverse, &inverse, sizeof inverse);
    r->start = (float)ray->t_min;
}

/* The children whose boxes the ray may meet between its start and the limit, and where it enters them. */
static inline uint32_t meet(const BvhNode *node, const BoxRay *r, float limit, float near_out[BVH_WIDTH])
{
    f8 near = f8_set(r->start), far = f8_set(limit);
    for (int axis = 0; axis < 3; axis++) {
        f8 inverse = f8_set(r->inverse[axis]);
        f8 low = f8_mul(f8_sub(f8_set(r->above[axis]), f8_load(node->side[axis])), inverse);
        f8 high = f8_mul(f8_sub(f8_set(r->below[axis]), f8_load(node->side[axis + 3])), inverse);
        near = f8_max(f8_min(low, high), near);
        far = f8_min(f8_max(low, high), far);
    }
    f8_store(near_out, near);
    return f8_le(near, f8_mul(far, f8_set(DISTANCE_STRETCH))) & node->used;
}

/* A child and where it is entered, in one number that grows with the distance: the bits of a float, then the child. */
static inline int64_t visit_of(const BvhNode *node, uint32_t mask, const float near[BVH_WIDTH])
{
    size_t first = (size_t)__builtin_ctz(mask);
    return (int64_t)((uint64_t)float_bits(near[first]) << 32 | node->child[first]);
}

static inline float visit_near(int64_t visit)
{
    return float_of_bits((uint32_t)((uint64_t)visit >> 32));
}

/* Puts the children on the stack, the nearer on top of the farther, but for the nearest, which is to be visited now. */
static inline int64_t open_node(const BvhNode *node, uint32_t mask, const float near[BVH_WIDTH], int64_t **top)
{
    int64_t nearest = visit_of(node, mask, near), *first = *top;
    while ((mask &= mask - 1) != 0) {
        int64_t visit = visit_of(node, mask, near), other = visit < nearest ? nearest : visit, *at = (*top)++;
        nearest = visit < nearest ? visit : nearest;
        for (; at > first && at[-1] < other; at--)
            *at = at[-1];
        *at = other;
    }
    return nearest;
}

bool ISA_NAME(bvh_walk)(const Bvh *b, const Ray *ray, double *t_max, AccelVisit *visit, void *user)
{
    int64_t stack[BVH_STACK], *top = stack;
    float near[BVH_WIDTH], limit = (float)*t_max;
    BoxRay r;
    box_ray(&r, ray);
    uint32_t child = bvh_child(0, 0);
    for (;;) {
        uint32_t at = bvh_at(child), count = bvh_count(child);
        if (count == 0) {
            const BvhNode *node = &b->node[at];
            uint32_t mask = meet(node, &r, limit, near);
            if (mask != 0) {
                child = (uint32_t)open_node(node, mask, near, &top);
                continue;
            }
        } else {
            const uint32_t *item = b->item + at, *end = item + count;
            do {
                if (visit(user, *item, t_max))
                    return true;
            } while (++item < end);
            limit = (float)*t_max;
            __asm__ volatile("" : "+m"(r));    /* to be read again: registers would be saved and restored around every item */
        }
        do {
            if (top == stack)
                return false;
            child = (uint32_t)*--top;
        } while (visit_near(*top) > limit * DISTANCE_STRETCH);
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
