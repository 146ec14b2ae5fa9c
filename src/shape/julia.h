/* julia.h - Julia sets of powers in four dimensions, as julia_kernel.c iterates them: several points of a ray side by side. */
#ifndef SHAPE_JULIA_H
#define SHAPE_JULIA_H

#include <stdint.h>

#include "math/vec.h"

typedef struct JuliaSet {
    Vec4 c, slice;                             /* slice: normalised */
    double slice_distance;
    bool level;                                /* the slice is one of a constant fourth coordinate, as nearly all are: */
    double fourth;
    bool hypercomplex, cube;                   /* cube: of quaternions alone */
    int n;                                     /* steps of an orbit */
    double step;                               /* the least along a ray */
    double radius, escape;                     /* of the ball that holds it; |z|^2 of what is lost */
} JuliaSet;

static const double JULIA_ACCURACY = 1e-7;

/* The fourth coordinate comes from the slice. */
static inline Vec4 julia_start(const JuliaSet *j, Vec3 p)
{
    double t = j->level ? j->fourth : (j->slice_distance - (j->slice.x * p.x + j->slice.y * p.y + j->slice.z * p.z)) / j->slice.t;
    return (Vec4){ p.x, p.y, p.z, t };
}

typedef struct JuliaLine { Vec3 o, u; } JuliaLine;               /* o + s u, u of unit length */

/* What is known of points on a line, the first at s, each a least step behind the one before. */
typedef struct JuliaRun {
    int n;                                     /* at least 1: as many as the ray surely goes to */
    uint32_t inside;                           /* bit i: point i is inside */
    double step;                               /* from the last */
} JuliaRun;

typedef struct JuliaKernel {
    /* `alone`: this point will do. */
    JuliaRun (*ahead)(const JuliaSet *j, const JuliaLine *l, double s, bool alone);
    /* Where inside and outside meet between lo and hi: bisected; the inner end. */
    double (*closed_in)(const JuliaSet *j, const JuliaLine *l, double lo, double hi, bool inside_lo);
    /* Of a quaternion's last point: its gradient, of any length. */
    Vec3 (*normal)(const JuliaSet *j, Vec3 p);
    /* Bit i: a point of the ball around centre[i] might be inside. */
    uint32_t (*may_hold)(const JuliaSet *j, const Vec3 centre[8], double radius);
} JuliaKernel;

#endif
