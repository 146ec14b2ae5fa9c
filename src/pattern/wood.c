/* wood.c - layers along x and rings about z, with turbulence inside the formula: marble and wood. */
#include "math/noise.h"
#include "pattern/map.h"
#include "pattern/pattern.h"
#include "pattern/wave.h"

static const MapEntry marble_map[] = { MAP_RGB(0, 0.9f, 0.8f, 0.8f), MAP_RGB(0.9f, 0.9f, 0.08f, 0.08f), MAP_RGB(0.9f, 0, 0, 0) };
static const MapEntry wood_map[] = { MAP_RGB(0.6f, 0.666f, 0.312f, 0.2f), MAP_RGB(0.6f, 0.4f, 0.1333f, 0.066f) };

static double marble(const void *params, const PatternPoint *at)
{
    (void)params;
    const WarpChain *chain = &at->pattern->chain;
    if (!chain->has_turbulence || chain->turbulence.amount.x == 0)
        return at->p.x;
    return at->p.x + chain->turbulence.amount.x * pattern_turbulence(&chain->turbulence, at->pattern->noise_generator, at->p);
}

static double wood(const void *params, const PatternPoint *at)
{
    (void)params;
    Vec3 p = at->p;
    double x = p.x, y = p.y;
    if (at->pattern->chain.has_turbulence) {
        const Turbulence *t = &at->pattern->chain.turbulence;
        Vec2 v = noise_pair_turbulence(&at->p, t->octaves, (double)t->omega, (double)t->lambda);
        x += wave_sine((p.x + v.u) * t->amount.x);
        y += wave_sine((p.y + v.v) * t->amount.y);
    }
    return sqrt(x * x + y * y);
}

const PatternOps pattern_marble = {
    .keyword = "marble", .flags = PATTERN_OWN_TURBULENCE, MAP_OF(marble_map), .default_wave = WAVE_TRIANGLE, .value = marble,
};
const PatternOps pattern_wood = {
    .keyword = "wood", .flags = PATTERN_OWN_TURBULENCE, MAP_OF(wood_map), .default_wave = WAVE_TRIANGLE, .value = wood,
};
