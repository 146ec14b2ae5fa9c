/* ripples.c - waves that spread from fixed sources on the unit sphere: ripples and waves.
 *
 * POV: frequency and phase act inside the formula and once more on its result, as on every pattern. */
#include "math/noise.h"
#include "pattern/context.h"
#include "pattern/wave.h"
#include "sdl/parse.h"

enum { KEPT = 32 };                            /* sources beyond are computed when asked */

typedef struct Source { Vec3 at; double frequency; } Source;
typedef struct { Source source[KEPT]; unsigned state; } Ripples;

static Source next_source(int i, unsigned *state)
{
    double frequency = 0.000030518509476 * noise_sample(state) + 0.01;
    return (Source){ normalized(noise_vector(&(Vec3){ i, 0, 0 })), frequency };
}

static void parse(Parser *p, void *params)
{
    (void)p;
    Ripples *r = params;
    r->state = 0u - 560851967u;
    for (int i = 0; i < KEPT; i++)
        r->source[i] = next_source(i, &r->state);
}

typedef struct Walk { const Ripples *ripples; const PatternPoint *at; unsigned state; int n; } Walk;

static Walk walk_of(const void *params, const PatternPoint *at)
{
    const Ripples *r = params;
    int n = at->context != NULL ? at->context->number_of_waves : 0;
    return (Walk){ r, at, r->state, n > 0 ? n : 10 };
}

/* The i-th source, the vector from it to the point, and its length. */
static inline __attribute__((always_inline)) Source step(Walk *w, int i, Vec3 *from, double *far)
{
    Source s = i < KEPT ? w->ripples->source[i] : next_source(i, &w->state);
    *from = sub(w->at->p, s.at);
    *far = length(*from);
    if (*far == 0)
        *far = 1;
    return s;
}

static double height(const PatternPoint *at, double far, double factor)
{
    return wave_sine(far * (double)at->pattern->frequency * factor + (double)at->pattern->phase);
}

static double ripples(const void *params, const PatternPoint *at)
{
    Walk w = walk_of(params, at);
    double sum = 0, far;
    Vec3 from;
    for (int i = 0; i < w.n; i++) {
        step(&w, i, &from, &far);
        sum += height(at, far, 1);
    }
    return (1 + sum / w.n) / 2;
}

static Vec3 ripples_bump(const void *params, const PatternPoint *at, Vec3 normal, double amount)
{
    Walk w = walk_of(params, at);
    double far;
    Vec3 from;
    for (int i = 0; i < w.n; i++) {
        step(&w, i, &from, &far);
        normal = add(normal, scaled(from, amount * height(at, far, 1) / (far * w.n)));
    }
    return normal;
}

static double waves(const void *params, const PatternPoint *at)
{
    Walk w = walk_of(params, at);
    double sum = 0, far;
    Vec3 from;
    for (int i = 0; i < w.n; i++) {
        Source s = step(&w, i, &from, &far);
        sum += height(at, far, s.frequency) / s.frequency;
    }
    return 0.2 * (2.5 + sum / w.n);
}

static Vec3 waves_bump(const void *params, const PatternPoint *at, Vec3 normal, double amount)
{
    Walk w = walk_of(params, at);
    double far;
    Vec3 from;
    for (int i = 0; i < w.n; i++) {
        Source s = step(&w, i, &from, &far);
        normal = add(normal, scaled(from, amount * height(at, far, s.frequency) / (s.frequency * far * w.n)));
    }
    return normal;
}

const PatternOps pattern_ripples = {
    .keyword = "ripples", .params_size = sizeof(Ripples), .flags = PATTERN_OWN_NORMAL, .parse = parse, .value = ripples,
    .bump = ripples_bump,
};
const PatternOps pattern_waves = {
    .keyword = "waves", .params_size = sizeof(Ripples), .flags = PATTERN_OWN_NORMAL, .parse = parse, .value = waves,
    .bump = waves_bump,
};
