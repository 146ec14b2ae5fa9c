/* pattern.c - the value of a pattern: its row's formula, then frequency and phase, then the wave. */
#include "pattern/pattern.h"

#include "math/noise.h"
#include "pattern/wave.h"

void pattern_points(const Pattern *pattern, Vec3 *p, int n)
{
    chain_apply_many(&pattern->chain, !pattern_has_own_turbulence(pattern), p, n);
}

static double wave_value(const Pattern *pattern, double v)
{
    switch (pattern->wave) {
    case WAVE_TRIANGLE: return wave_triangle(v);
    case WAVE_SINE: return (1 + wave_sine(v)) * 0.5;
    case WAVE_SCALLOP: return fabs(wave_sine(v * 0.5));
    case WAVE_CUBIC: return v * v * (3 - 2 * v);
    case WAVE_POLY: return pow(v, (double)pattern->wave_exponent);
    case WAVE_RAMP: break;
    }
    return v;
}

/* fmod(v, 1.00001), which is a slow call. Of up to 2^20 turns the product with each half of the modulus is exact, and so are the
 * differences: the same bits. */
static inline double within_turn(double v)
{
    static const double turn = 1.00001, per_turn = 1 / 1.00001, high = 0x1.00008p0, low = 1.00001 - 0x1.00008p0;
    double x = fabs(v);
    if (x < turn)
        return v;
    if (!(x < 0x1p20))
        return fmod(v, turn);
    double n = (double)(int)(x * per_turn), rest = x - n * high - n * low;
    if (rest < 0)
        rest += turn;                          /* per_turn is rounded up: the quotient can be too large, never too small */
    return v < 0 ? -rest : rest;
}

static inline double finished(const Pattern *pattern, double v)
{
    double frequency = (double)pattern->frequency;
    /* POV: the modulus is 1.00001, so each turn loses a little and ramps drift far from the origin. */
    if (frequency != 0)
        v = within_turn(v * frequency + (double)pattern->phase);
    if (v < 0)
        v -= floor(v);
    return wave_value(pattern, v);
}

double pattern_value(const PatternPoint *at)
{
    const Pattern *pattern = at->pattern;
    return finished(pattern, pattern->ops->value(pattern->params, at));
}

void pattern_values(const Pattern *pattern, const Vec3 *at, double *out, int n)
{
    if (pattern->ops->values != NULL && n > 1) {
        pattern->ops->values(pattern->params, pattern, at, out, n);
    } else {
        PatternPoint point = { .pattern = pattern };
        for (int i = 0; i < n; i++) {
            point.p = at[i];
            out[i] = pattern->ops->value(pattern->params, &point);
        }
    }
    for (int i = 0; i < n; i++)
        out[i] = finished(pattern, out[i]);
}

double pattern_turbulence(const Turbulence *t, int noise_generator, Vec3 p)
{
    return noise_turbulence(noise_generator, p, t->octaves, (double)t->omega, (double)t->lambda);
}
