/* spiral.c - spiral1 and spiral2: n arms about the z axis. */
#include "pattern/map.h"
#include "pattern/pattern.h"
#include "pattern/wave.h"
#include "sdl/parse.h"

static void parse(Parser *p, void *params)
{
    *(double *)params = parse_int(p);
}

static double arm(double arms, const PatternPoint *at, double *radius)
{
    Vec3 p = at->p;
    double r = sqrt(p.x * p.x + p.y * p.y), angle = 0;
    if (r != 0) {
        double s = p.y / r;
        s = asin(s < -1 ? -1 : s > 1 ? 1 : s);
        angle = p.x >= 0 ? PI / 2 + s : 3 * PI / 2 - s;
    }
    *radius = r;
    double v = p.z + r + arms * angle / (2 * PI);
    const WarpChain *chain = &at->pattern->chain;
    if (chain->has_turbulence && chain->turbulence.amount.x != 0)
        v += chain->turbulence.amount.x * pattern_turbulence(&chain->turbulence, at->pattern->noise_generator, p);
    return v;
}

static double spiral1(const void *params, const PatternPoint *at)
{
    double radius;
    return arm(*(const double *)params, at, &radius);
}

static double spiral2(const void *params, const PatternPoint *at)
{
    double radius, v = arm(*(const double *)params, at, &radius);
    return wave_triangle(radius) + wave_triangle(v);
}

const PatternOps pattern_spiral1 = {
    .keyword = "spiral1", .params_size = sizeof(double), .default_wave = WAVE_TRIANGLE, .parse = parse, .value = spiral1,
};
const PatternOps pattern_spiral2 = {
    .keyword = "spiral2", .params_size = sizeof(double), .default_wave = WAVE_TRIANGLE, .parse = parse, .value = spiral2,
};
