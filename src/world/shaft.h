/* shaft.h - what lies between a point and a box: found once, then asked by every ray from one to the other. */
#ifndef WORLD_SHAFT_H
#define WORLD_SHAFT_H

#include "world/prim.h"

enum { SHAFT_MAX = 24 };

/* All prims that a ray from `o` to a point of a box may hit, each once, or `crowded`: too many to keep. */
typedef struct Shaft {
    uint32_t n, prim[SHAFT_MAX];
    bool crowded;
} Shaft;

/* Holds for rays whose range of t is that from o to a point of `to`, or shorter. */
void world_shaft(const World *w, Vec3 o, Bounds to, uint32_t skip, Shaft *out);

/* As world_each_hit, for a ray within a shaft that is not crowded. */
bool shaft_each_hit(const World *w, const Shaft *shaft, const Ray *ray, HitVisit *visit, void *user);

/* Do the bodies that contain o contain all of the box, too? False if that is not easily said. */
bool world_same_bodies(const World *w, Vec3 o, Bounds box);

#endif
