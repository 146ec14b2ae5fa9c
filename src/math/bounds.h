/* bounds.h - axis-aligned boxes in double; accelerators round them outward to float themselves.
 *
 * An empty box has lo > hi; an unbounded one reaches from -INFINITY to INFINITY on some axis. */
#ifndef MATH_BOUNDS_H
#define MATH_BOUNDS_H

#include <stddef.h>

#include "math/affine.h"

typedef struct Bounds { Vec3 lo, hi; } Bounds;

Bounds bounds_empty(void);
Bounds bounds_everything(void);
Bounds bounds_of_points(const Vec3 *p, size_t n);
Bounds bounds_union(Bounds a, Bounds b);
Bounds bounds_intersection(Bounds a, Bounds b);
Bounds bounds_include(Bounds a, Vec3 p);
Bounds bounds_grown(Bounds a, double by);      /* by >= 0 on every side */
Bounds bounds_transformed(Bounds a, const Affine *place);   /* hull of the corners, padded by the rounding error */
bool bounds_is_empty(Bounds a);
bool bounds_is_finite(Bounds a);
double bounds_area(Bounds a);                  /* of the surface; 0 if empty, INFINITY if unbounded */

static inline bool bounds_contain(Bounds a, Vec3 p)
{
    return a.lo.x <= p.x && p.x <= a.hi.x && a.lo.y <= p.y && p.y <= a.hi.y && a.lo.z <= p.z && p.z <= a.hi.z;
}

#endif
