/* affine.h - affine transforms of row vectors, p' = p M, kept with their inverse.
 *
 * The inverse is composed alongside (08-shapes, section 2.1), never recomputed, except for `matrix`. */
#ifndef MATH_AFFINE_H
#define MATH_AFFINE_H

#include <stddef.h>

#include "math/vec.h"

typedef struct Affine {
    double m[4][3];                            /* rows: images of x, y, z, then the translation */
    double inv[4][3];
    bool identity;                             /* exactly; lets users skip the arithmetic */
} Affine;

Affine affine_identity(void);
Affine affine_translate(Vec3 by);
Affine affine_scale(Vec3 by);                  /* components must not be 0 */
Affine affine_rotate(Vec3 degrees);            /* about x, then y, then z; left-handed as POV-Ray's */
Affine affine_matrix(const double rows[12]);   /* inverse by cofactors; a singular one is mended as 08-shapes 2.1 says */
Affine affine_frame(Vec3 origin, Vec3 axis, double radius, double length);   /* K(o, a, r, L) of 08-shapes 2.2 */
Affine affine_then(Affine first, Affine second);
Affine affine_inverse(Affine a);

/* Where NULL stands for the identity. */
static inline Affine affine_of(const Affine *a) { return a != NULL ? *a : affine_identity(); }

static inline Vec3 affine_apply(const double m[4][3], Vec3 p)
{
    return vec3(p.x * m[0][0] + p.y * m[1][0] + p.z * m[2][0] + m[3][0],
                p.x * m[0][1] + p.y * m[1][1] + p.z * m[2][1] + m[3][1],
                p.x * m[0][2] + p.y * m[1][2] + p.z * m[2][2] + m[3][2]);
}

static inline Vec3 affine_apply_linear(const double m[4][3], Vec3 d)
{
    return vec3(d.x * m[0][0] + d.y * m[1][0] + d.z * m[2][0],
                d.x * m[0][1] + d.y * m[1][1] + d.z * m[2][1],
                d.x * m[0][2] + d.y * m[1][2] + d.z * m[2][2]);
}

/* n (M^T) in row form: multiplying by the transpose of the linear part of m. */
static inline Vec3 affine_apply_transposed(const double m[4][3], Vec3 n)
{
    return vec3(n.x * m[0][0] + n.y * m[0][1] + n.z * m[0][2],
                n.x * m[1][0] + n.y * m[1][1] + n.z * m[1][2],
                n.x * m[2][0] + n.y * m[2][1] + n.z * m[2][2]);
}

static inline Vec3 affine_point(const Affine *a, Vec3 p) { return a->identity ? p : affine_apply(a->m, p); }
static inline Vec3 affine_point_back(const Affine *a, Vec3 p) { return a->identity ? p : affine_apply(a->inv, p); }
static inline Vec3 affine_vector(const Affine *a, Vec3 d) { return a->identity ? d : affine_apply_linear(a->m, d); }
static inline Vec3 affine_vector_back(const Affine *a, Vec3 d) { return a->identity ? d : affine_apply_linear(a->inv, d); }

/* Normals, not renormalised: outward (local to world) and back. */
static inline Vec3 affine_normal(const Affine *a, Vec3 n) { return a->identity ? n : affine_apply_transposed(a->inv, n); }
static inline Vec3 affine_normal_back(const Affine *a, Vec3 n) { return a->identity ? n : affine_apply_transposed(a->m, n); }

#endif
