/* wave.h - the periodic functions and the odd floor that pattern formulas share. */
#ifndef PATTERN_WAVE_H
#define PATTERN_WAVE_H

#include <math.h>

static const double PATTERN_TINY = 1e-10;      /* POV: lattice patterns are shifted by this, and it shows on planes through 0 */

/* v - floor(v) for v >= 0, which is most often below 1. */
static inline double wave_fraction(double v)
{
    return v < 1 ? v : v - floor(v);
}

/* One period per unit, odd. */
static inline double wave_sine(double v)
{
    double s = sin(2 * 3.14159265358979323846 * wave_fraction(fabs(v)));
    return v < 0 ? -s : s;
}

static inline double wave_triangle(double v)
{
    double o = v > 0 ? wave_fraction(v) : v + 1 + floor(fabs(v));
    return o < 0.5 ? 2 * o : 2 * (1 - o);
}

/* POV: floor, but one lower at negative whole numbers. */
static inline double wave_floor(double x)
{
    return x >= 0 ? floor(x) : -floor(-x) - 1;
}

static inline double wave_clamp(double v)
{
    return v < 0 ? 0 : v > 1 ? 1 : v;
}

#endif
