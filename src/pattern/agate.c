/* agate.c - bands along z, bent by turbulence. */
#include "pattern/map.h"
#include "pattern/pattern.h"
#include "pattern/wave.h"
#include "sdl/parse.h"

typedef struct { float turbulence; } Agate;

static const MapEntry map[] = {
    MAP_RGB(0, 1, 1, 1), MAP_RGB(0.5f, 0.95f, 0.75f, 0.5f), MAP_RGB(0.5f, 0.9f, 0.7f, 0.5f), MAP_RGB(0.6f, 0.9f, 0.7f, 0.4f),
    MAP_RGB(0.6f, 1, 0.7f, 0.4f), MAP_RGB(1, 0.6f, 0.3f, 0),
};

static void parse(Parser *p, void *params)
{
    (void)p;
    *(Agate *)params = (Agate){ 1 };
}

static bool item(Parser *p, void *params)
{
    if (!parse_accept(p, KW_AGATE_TURB))
        return false;
    ((Agate *)params)->turbulence = (float)parse_float(p);
    return true;
}

/* The record of turbulence always exists here: octaves, omega and lambda act without the word `turbulence`. */
static double value(const void *params, const PatternPoint *at)
{
    static const Turbulence plain = { .octaves = 6, .omega = 0.5f, .lambda = 2 };
    const WarpChain *chain = &at->pattern->chain;
    const Turbulence *t = chain->has_turbulence ? &chain->turbulence : &plain;
    double turbulence = (double)((const Agate *)params)->turbulence;
    double bend = turbulence * pattern_turbulence(t, at->pattern->noise_generator, at->p);
    double n = (wave_sine(1.3 * bend + 1.1 * at->p.z) + 1) / 2;
    return n < 0 ? 0 : pow(n < 1 ? n : 1, 0.77);
}

const PatternOps pattern_agate = {
    .keyword = "agate", .params_size = sizeof(Agate), MAP_OF(map), .parse = parse, .item = item, .value = value,
};
