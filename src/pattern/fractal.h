/* fractal.h - escape times in the plane: what is asked, and one step of each formula.
 *
 * The steps are over REAL: a number, or as many as a vector has lanes (fractal_kernel.c). */
#ifndef PATTERN_FRACTAL_H
#define PATTERN_FRACTAL_H

#include <stdbool.h>
#include <stdint.h>

#include "math/vec.h"

#ifndef REAL
#define REAL double
#endif

typedef enum FractalKind { FRACTAL_MANDEL, FRACTAL_JULIA, FRACTAL_MAGNET_MANDEL, FRACTAL_MAGNET_JULIA } FractalKind;

typedef struct Fractal {
    FractalKind kind;
    int magnet;                                /* 1 or 2 */
    Vec2 c;                                    /* of the julia kinds */
    int iterations, exponent;
    int exterior, interior;
    double exterior_factor, interior_factor;
} Fractal;

enum { FRACTAL_MANY = 4 };

/* How the orbits of four points end. */
typedef struct FractalEnds {
    double a[FRACTAL_MANY], b[FRACTAL_MANY], smallest2[FRACTAL_MANY], step[FRACTAL_MANY];     /* step: the last */
    uint32_t lost;                             /* bit i: i is; the rest stay for all steps */
} FractalEnds;

/* For those points whose bits are set. */
typedef void FractalOrbits(const Fractal *f, const Vec3 p[FRACTAL_MANY], uint32_t points, FractalEnds *out);

typedef struct Number { REAL a, b; } Number;                 /* a + i b */

static inline Number plus(Number x, Number y) { return (Number){ x.a + y.a, x.b + y.b }; }
static inline Number times(Number x, Number y) { return (Number){ x.a * y.a - x.b * y.b, x.a * y.b + x.b * y.a }; }
static inline REAL size2(Number x) { return x.a * x.a + x.b * x.b; }

static inline Number over(Number x, Number y)
{
    REAL n = size2(y);
    return (Number){ (x.a * y.a + x.b * y.b) / n, (x.b * y.a - x.a * y.b) / n };
}

static inline Number power(Number x, int n)
{
    Number result = x;
    for (int bit = 1 << (30 - __builtin_clz((unsigned)n)); bit != 0; bit >>= 1) {
        result = times(result, result);
        if (n & bit)
            result = times(result, x);
    }
    return result;
}

typedef Number Next(const Fractal *f, Number z, Number c);

static inline Number next_square(const Fractal *f, Number z, Number c)
{
    (void)f;
    return plus(times(z, z), c);
}

static inline Number next_power(const Fractal *f, Number z, Number c)
{
    return plus(power(z, f->exponent), c);
}

static inline Number next_magnet1(const Fractal *f, Number z, Number c)
{
    (void)f;
    Number top = plus(times(z, z), (Number){ c.a - 1, c.b });
    Number bottom = { 2 * z.a + c.a - 2, 2 * z.b + c.b };
    Number q = over(top, bottom);
    return times(q, q);
}

static inline Number next_magnet2(const Fractal *f, Number z, Number c)
{
    (void)f;
    Number c1 = { c.a - 1, c.b }, c2 = { c.a - 2, c.b }, c12 = times(c1, c2), z2 = times(z, z);
    Number top = plus(times(z2, z), plus(times((Number){ 3 * c1.a, 3 * c1.b }, z), c12));
    Number bottom = plus((Number){ 3 * z2.a, 3 * z2.b }, plus(times((Number){ 3 * c2.a, 3 * c2.b }, z), c12));
    bottom.a += 1;
    Number q = over(top, bottom);
    return times(q, q);
}

#endif
