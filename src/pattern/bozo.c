/* bozo.c - noise itself: bozo, spotted, bumps, and its cube: dents. */
#include "math/noise.h"
#include "pattern/map.h"
#include "scene/ops.h"

static const MapEntry bozo_map[] = {
    MAP_RGB(0.4f, 1, 1, 1), MAP_RGB(0.4f, 0, 1, 0), MAP_RGB(0.6f, 0, 1, 0), MAP_RGB(0.6f, 0, 0, 1), MAP_RGB(0.8f, 0, 0, 1),
    MAP_RGB(0.8f, 1, 0, 0),
};

static double noise(const void *params, const PatternPoint *at)
{
    (void)params;
    return noise_value(at->pattern->noise_generator, &at->p);
}

static Vec3 bumps(const void *params, const PatternPoint *at, Vec3 normal, double amount)
{
    (void)params;
    return add(normal, scaled(noise_vector(&at->p), amount));
}

static double cube(const void *params, const PatternPoint *at)
{
    double v = noise(params, at);
    return v * v * v;
}

static Vec3 dents(const void *params, const PatternPoint *at, Vec3 normal, double amount)
{
    return add(normal, scaled(noise_vector(&at->p), amount * cube(params, at)));
}

const PatternOps pattern_bozo = { .keyword = "bozo", MAP_OF(bozo_map), .value = noise };
const PatternOps pattern_spotted = { .keyword = "spotted", .value = noise };
const PatternOps pattern_bumps = { .keyword = "bumps", .flags = PATTERN_OWN_NORMAL, .value = noise, .bump = bumps };
const PatternOps pattern_dents = { .keyword = "dents", .flags = PATTERN_OWN_NORMAL, .value = cube, .bump = dents };
