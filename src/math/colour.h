/* colour.h - colours: five single-precision numbers, as the scene language has them. */
#ifndef MATH_COLOUR_H
#define MATH_COLOUR_H

#include <math.h>
#include <stdbool.h>
#include <string.h>
#include <stdint.h>

typedef struct Colour { float r, g, b, f, t; } Colour;     /* red, green, blue, filter, transmit */
typedef float Rgb __attribute__((vector_size(16)));    /* c[0], c[1], c[2]: red, green, blue; the fourth means nothing */

static inline Rgb rgb(float r, float g, float b) { return (Rgb){ r, g, b, 0 }; }
static inline Rgb rgb_grey(float v) { return (Rgb){ v, v, v, v }; }
static inline Rgb rgb_of(Colour c) { return (Rgb){ c.r, c.g, c.b, c.f }; }
static inline Colour colour_of(Rgb c, float f, float t)        /* in one piece, as it will be loaded */
{
    Colour out = { .t = t };
    c[3] = f;
    memcpy(&out, &c, sizeof c);
    return out;
}
static inline Rgb rgb_add(Rgb a, Rgb b) { return a + b; }
static inline Rgb rgb_sub(Rgb a, Rgb b) { return a - b; }
static inline Rgb rgb_mul(Rgb a, Rgb b) { return a * b; }
static inline Rgb rgb_scaled(Rgb a, float s) { return a * s; }
static inline float rgb_greyness(Rgb c) { return 0.297f * c[0] + 0.589f * c[1] + 0.114f * c[2]; }
static inline float rgb_max(Rgb c)              /* fmaxf would be a call */
{
    float most = c[1] > c[2] ? c[1] : c[2];
    return most > c[0] ? most : c[0];
}
static inline float rgb_max_abs(Rgb c) { return rgb_max((Rgb){ fabsf(c[0]), fabsf(c[1]), fabsf(c[2]), 0 }); }
static inline bool rgb_is_zero(Rgb c)           /* by all bits but the signs: one test, not three */
{
    typedef uint64_t Pair __attribute__((vector_size(16)));
    Pair bits = (Pair)c;
    return ((bits[0] & 0x7fffffff7fffffff) | (bits[1] & 0x7fffffff)) == 0;
}

static inline bool rgb_same(Rgb a, Rgb b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

static inline Colour colour_add(Colour a, Colour b)
{
    return (Colour){ a.r + b.r, a.g + b.g, a.b + b.b, a.f + b.f, a.t + b.t };
}

static inline Colour colour_scaled(Colour a, float s)
{
    return (Colour){ a.r * s, a.g * s, a.b * s, a.f * s, a.t * s };
}

/* a at t = 0, b at t = 1: a + t (b - a), in single precision. */
static inline Colour colour_lerp(Colour a, Colour b, float t)
{
    return (Colour){ a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b), a.f + t * (b.f - a.f),
                     a.t + t * (b.t - a.t) };
}

/* What passes through a surface of this colour: c.rgb * filter + transmit (04-shading). */
static inline Rgb colour_transmittance(Colour c)
{
    return rgb_of(c) * c.f + c.t;
}

#endif
