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

typedef bool BvhWalk(const Bvh *b, const Ray *ray, double *t_max, AccelVisit *visit, void *user);
typedef bool BvhAround(const Bvh *b, Vec3 p, AccelVisit *visit, void *user);
typedef bool BvhBetween(const Bvh *b, Vec3 o, Bounds to, AccelVisit *visit, void *user);

#define DECLARE_BVH(isa) extern BvhWalk bvh_walk_##isa; extern BvhAround bvh_around_##isa; extern BvhBetween bvh_between_##isa;
CPU_ISAS(DECLARE_BVH)

#endif
