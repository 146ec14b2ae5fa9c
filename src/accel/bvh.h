/* bvh.h - the tree that bvh.c builds and bvh_kernel.c walks. */
#ifndef ACCEL_BVH_H
#define ACCEL_BVH_H

#include <float.h>
#include <string.h>

#include "base/bits.h"
#include "base/cpu.h"
#include "world/world.h"

enum {
    BVH_WIDTH = 8,
    BVH_MAX_DEPTH = 64,                        /* of wide nodes; bvh.c keeps to it */
    BVH_STACK = BVH_MAX_DEPTH * (BVH_WIDTH - 1) + 1,
    BVH_COUNT_BITS = 3                         /* of BvhNode.child */
};

/* Boxes are the items' own rounded outward and one ulp more: whole-number coordinates round to themselves, and rays along
 * their faces would slip through. Four lines of the cache. */
typedef struct BvhNode {
    float side[6][BVH_WIDTH];                  /* low x, y, z, then high x, y, z */
    uint32_t child[BVH_WIDTH];                 /* bvh_child: a node, or a leaf's first place in Bvh.item */
    uint32_t used;                             /* bit i: there is a child i */
    uint32_t unused[7];
} BvhNode;

typedef struct Bvh {
    BvhNode *node;                             /* node 0 is the root */
    uint32_t *item;                            /* in the order of the leaves */
    uint32_t n_nodes, n_items;
    CpuIsa isa;
} Bvh;

/* count: items of the leaf; 0: a node. */
static inline uint32_t bvh_child(uint32_t at, uint32_t count) { return at << BVH_COUNT_BITS | count; }
static inline uint32_t bvh_at(uint32_t child) { return child >> BVH_COUNT_BITS; }
static inline uint32_t bvh_count(uint32_t child) { return child & ((1 << BVH_COUNT_BITS) - 1); }

/* The next float towards zero (away from it) in size; for 0 itself see below. */
static inline float float_step(float f, int by)
{
    return float_of_bits(float_bits(f) + (uint32_t)by);
}

static inline float float_down(float f)        /* f > -INFINITY */
{
    return f == 0 ? -0x1p-149f : float_step(f, f > 0 ? -1 : 1);
}

static inline float float_up(float f)          /* f < INFINITY */
{
    return f == 0 ? 0x1p-149f : float_step(f, f > 0 ? 1 : -1);
}

/* The largest float <= x, the smallest >= x; infinities and NaN stay. */
static inline float float_below(double x)
{
    float f = (float)x;
    return (double)f > x ? float_down(f) : f;
}

static inline float float_above(double x)
{
    float f = (float)x;
    return (double)f < x ? float_up(f) : f;
}

typedef bool BvhWalk(const Bvh *b, const Ray *ray, double *t_max, AccelVisit *visit, void *user);
typedef bool BvhAround(const Bvh *b, Vec3 p, AccelVisit *visit, void *user);
typedef bool BvhBetween(const Bvh *b, Vec3 o, Bounds to, AccelVisit *visit, void *user);

#define DECLARE_BVH(isa) extern BvhWalk bvh_walk_##isa; extern BvhAround bvh_around_##isa; extern BvhBetween bvh_between_##isa;
CPU_ISAS(DECLARE_BVH)

#endif
