/* glance.h - which of four rays from a point to a window do some prims hide? Told at once, in floats, and left open in doubt.
 *
 * Samples of a light are hidden or not: where on the way does not matter, and few pass close to an edge. */
#ifndef WORLD_GLANCE_H
#define WORLD_GLANCE_H

#include "base/simd.h"
#include "world/shaft.h"

/* A convex solid in a prim's space: what lies within lo and hi, unbounded where infinite, and within a sphere (round 3) or a
 * cylinder along z (round 2). */
struct Solid {
    Vec3 lo, hi;
    int round;
    Vec3 centre;
    double radius;
};

/* Rays from o by to + s along1 + r along2, s and r in [-1, 1], their ends not included. */
typedef struct Sight { Vec3 o, to, along1, along2; } Sight;

enum { GLANCE_BODIES = 12, GLANCE_SIBLINGS = 32 };

/* A number that is linear in s and r. */
typedef struct Plain { f4 at, by_s, by_r; } Plain;

typedef struct Slab {
    Plain step;                                /* of the rays, across it */
    f4 lo, hi;                                 /* seen from o */
    f4 least;                                  /* slower rays are in doubt */
} Slab;

typedef struct Round {
    Plain step[3];
    f4 o[3];                                   /* seen from its centre */
    f4 radius2, least2;                        /* least2: of the square of the step */
    f4 doubt, doubt_roots;                     /* of a square in units of radius2; the same for good roots, times the step's square */
} Round;

typedef struct Body {
    uint32_t prim;
    bool inverse;
    uint32_t n_slabs;
    int round;
    Slab slab[3];
    Round ball;
} Body;

/* One of the prims: body[i] with those that cut it. */
typedef struct Sighted { uint32_t body, first, n; } Sighted;

typedef struct Glance {
    uint32_t n, n_opaque;                      /* of sighted: opaque ones first */
    Sighted sighted[GLANCE_BODIES];
    uint32_t n_bodies, n_siblings;
    uint8_t sibling[GLANCE_SIBLINGS];
    bool blind;                                /* there are other prims */
    Body body[GLANCE_BODIES];
} Glance;

/* Of the prims of a shaft, which is not crowded. */
void glance_start(Glance *g, const World *w, const Shaft *among, const Sight *from);

/* Bit i: something opaque surely hides ray i, one of `rays`. clear: those that surely meet nothing. */
uint32_t glance_hides(Glance *g, f4 s, f4 r, uint32_t rays, uint32_t *clear);

#endif
