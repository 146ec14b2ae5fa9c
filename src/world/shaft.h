/* shaft.h - what lies between a point and a box: found once, then asked by every ray from one to the other. */
#ifndef WORLD_SHAFT_H
#define WORLD_SHAFT_H

#include "world/fan.h"
#include "world/prim.h"

enum { SHAFT_MAX = 24 };

/* All prims that a ray from `o` to a point of a box may hit, each once, opaque ones first, or `crowded`: too many to keep. */
typedef struct Shaft {
    uint32_t n, n_opaque, prim[SHAFT_MAX];
    bool crowded;
} Shaft;

/* Holds for rays whose range of t is that from o to a point of `to`, or shorter. */
void world_shaft(const World *w, Vec3 o, Bounds to, uint32_t skip, Shaft *out);

/* A parallelogram, middle +- half1 +- half2, in which rays of a shaft end. */
typedef struct Window { Vec3 middle, half1, half2; } Window;

/* Leaves out what no ray from o to a point of the window can meet. up: all rays lead clearly to its side of the plane through o,
 * which may touch a prim to within the error of a surface; zero: nothing is known. */
void shaft_narrow(const World *w, Vec3 o, const Window *to, Vec3 up, Shaft *shaft);

/* Which of these prims, + 1, is opaque and alone stands in the way of every ray from o to a point of the window? 0: none, or it is
 * not easily said. */
uint32_t window_closed_by(const World *w, Vec3 o, const Window *to, const uint32_t *prim, uint32_t n);

/* As world_each_hit, for a ray within a shaft that is not crowded. */
bool shaft_each_hit(const World *w, const Shaft *shaft, const Ray *ray, HitVisit *visit, void *user);

/* Which rays of a fan does something opaque hide? `veiled`: those of the others that meet anything. */
uint32_t shaft_hides(const World *w, Shaft *shaft, const Fan *fan, uint32_t rays, uint32_t *veiled);

/* Do the bodies that contain o contain all of the box, too? False if that is not easily said. */
bool world_same_bodies(const World *w, Vec3 o, Bounds box);

#endif
