/* shape.h - what the files of shapes have in common: units, and boxes of round things. */
#ifndef SHAPE_SHAPE_H
#define SHAPE_SHAPE_H

#include <float.h>

#include "world/build.h"

/* The unit, a power of two, in which a shape of this size keeps its numbers. The scene's own unit serves all shapes that
 * are not very much larger or smaller, so that most need no place of their own. Both sides of the comparison scale
 * with the scene: the choice does not depend on the units an author works in. */
static inline double shape_unit(const ShapeBuild *b, double size)
{
    double relative = size * b->unit;
    return relative > 0x1p-40 && relative < 0x1p40 ? 1 / b->unit : size > 0 ? build_unit(size) : 1 / b->unit;
}

static inline Vec3 shape_min(Vec3 a, Vec3 b) { return vec3(fmin(a.x, b.x), fmin(a.y, b.y), fmin(a.z, b.z)); }
static inline Vec3 shape_max(Vec3 a, Vec3 b) { return vec3(fmax(a.x, b.x), fmax(a.y, b.y), fmax(a.z, b.z)); }

/* A box with a margin that covers the rounding of a hit's coordinates. */
static inline Bounds shape_padded(Bounds b)
{
    return bounds_grown(b, 64 * DBL_EPSILON * fmax(max_abs(b.lo), max_abs(b.hi)));
}

/* The ray's parameter nearest to the origin of local space. Roots are sought from there: however far the ray starts,
 * the numbers are then those of the shape (08-shapes 24.7). */
static inline double shape_nearest_t(const Ray *ray)
{
    return -dot(ray->o, ray->d) / length2(ray->d);
}

/* For an equation whose largest coefficient of degree k is by_degree[k]: the power of two near the size of its surface, in
 * which the coefficients balance. It follows the scale of the equation exactly. */
double shape_algebraic_unit(const double *by_degree, int n);

/* POV: the hull of a box in a frame, as extents report it. */
Bounds shape_hull(Bounds local, const Affine *frame, const Affine *place);

/* Does `place` take balls to balls? Their radii are then multiplied by *by. */
bool shape_keeps_balls(const Affine *place, double *by);

/* (08-shapes 8): 0..1 around y from x through z. */
double shape_longitude(double x, double z);

#endif
