/* crackle.h - one random point in every unit cube, and the nearest of them. */
#ifndef PATTERN_CRACKLE_H
#define PATTERN_CRACKLE_H

#include "math/vec.h"

typedef struct CrackleNear {
    double s[3];                               /* the three smallest sums of |d|^metric */
    Vec3 nearest;
} CrackleNear;

/* The cubes looked at are those of 06, section 6: up to two away along one axis, one along the others. */
CrackleNear crackle_near(Vec3 p, double metric);

/* The point with the lowest dx + dy + dz, for facets with metric 1 (07, section 5.7). */
Vec3 crackle_lowest(Vec3 p);

#endif
