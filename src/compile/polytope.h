/* polytope.h - the box of an intersection of half spaces. */
#ifndef COMPILE_POLYTOPE_H
#define COMPILE_POLYTOPE_H

#include <stdint.h>

#include "math/bounds.h"

enum { POLYTOPE_MAX = 32 };

typedef struct HalfSpace {                     /* normal . p <= distance */
    Vec3 normal;                               /* unit */
    double distance;
} HalfSpace;

/* A box around it, a little larger; everything when it is endless or nearly so, and when it is empty. */
Bounds polytope_box(const HalfSpace *h, uint32_t n);

/* For a finite box and n <= POLYTOPE_MAX: around what lies in the box and in all half spaces, and around the part of a plane that
 * does. Both hold points that rounding or the tolerance of an inside test puts there, too; empty if there are none. */
Bounds polytope_within(Bounds box, const HalfSpace *h, uint32_t n);
Bounds polytope_face(HalfSpace plane, Bounds box, const HalfSpace *h, uint32_t n);

#endif
