/* curve.h - plane curves in pieces, for lathes, prisms and letters; every spline becomes Bezier pieces that share their ends. */
#ifndef SHAPE_CURVE_H
#define SHAPE_CURVE_H

#include <stdint.h>

#include "base/arena.h"
#include "math/vec.h"

typedef struct CurvePiece {
    Vec2 p[4];                                 /* control points 0 ... degree */
    int degree;                                /* 1, 2, 3 */
    Vec2 lo, hi;                               /* of the control points, which hold the piece */
} CurvePiece;

/* The pieces by rows of v: those that touch row k are piece[first[k]] to piece[first[k + 1] - 1]. */
typedef struct CurveRows {
    double lo, scale;                          /* row = (v - lo) * scale */
    uint32_t n;
    const uint32_t *first, *piece;
} CurveRows;

typedef struct Curve {
    CurvePiece *piece;
    uint32_t n;
    CurveRows rows;
} Curve;

typedef enum CurveKind { CURVE_LINEAR, CURVE_QUADRATIC, CURVE_CUBIC, CURVE_BEZIER } CurveKind;

CurvePiece curve_piece(const Vec2 *p, int degree);         /* from Bezier control points */

/* The piece of 08-shapes, section 16.1, that uses the points p[0] ... (2, 3, 4 or 4 of them). */
CurvePiece curve_spline_piece(CurveKind kind, const Vec2 *p);

Vec2 curve_at(const CurvePiece *c, double w);
Vec2 curve_slope(const CurvePiece *c, double w);           /* derivative by w */

/* To be called when all pieces are there, before curve_inside. */
void curve_sort(Arena *arena, Curve *c);

static inline uint32_t curve_row(const CurveRows *r, double v)
{
    double row = (v - r->lo) * r->scale;
    return row < r->n - 1.0 ? (row > 0 ? (uint32_t)row : 0) : r->n - 1;
}

/* Even-odd: an odd number of crossings at this v with u or more. Pieces that share an end count it once. */
bool curve_inside(const Curve *c, double u, double v);

/* Of the piece itself, not of its control points. */
void curve_extent(const CurvePiece *c, Vec2 *lo, Vec2 *hi);

Curve curve_scaled(Arena *arena, Curve c, double by);       /* sorted */

#endif
