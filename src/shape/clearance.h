/* clearance.h - how far along a line a solid may lie, by a grid of cells that know how much air is around them. */
#ifndef SHAPE_CLEARANCE_H
#define SHAPE_CLEARANCE_H

#include <stdint.h>

#include "math/bounds.h"

enum { CLEARANCE_LEVELS = 5, CLEARANCE_SIDE = 1 << CLEARANCE_LEVELS };

typedef struct Clearance {
    Bounds box;                                /* nothing of the solid is outside */
    Vec3 lo, per_cell;                             /* of the grid: its corner, cells per length */
    double cell;                               /* the shortest side of one; 0: nothing anywhere */
    uint8_t gap[CLEARANCE_SIDE][CLEARANCE_SIDE][CLEARANCE_SIDE];     /* [z][y][x]: layers of cells around it that are empty */
} Clearance;

/* Bit i: a point of the ball around centre[i] might be in the solid. May say so of any ball. */
typedef uint32_t MayHold(const void *solid, const Vec3 centre[8], double radius);

/* For a solid in the cube from -size to size. */
void clearance_build(Clearance *c, MayHold *may_hold, const void *solid, double size);

/* From which s on o + s u, u of unit length, is certainly outside the solid, -INFINITY if it always is. */
double clearance_from(const Clearance *c, Vec3 o, Vec3 u);

#endif
