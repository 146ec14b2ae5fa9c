/* granite.c - sums of octaves: granite and wrinkles. */
#include "math/noise.h"
#include "pattern/wave.h"
#include "scene/ops.h"

static double granite(const void *params, const PatternPoint *at)
{
    (void)params;
    return noise_ridges(at->pattern->noise_generator, &at->p);        /* doubled, it is |1 - 2 noise| to the bit */
}

enum { WRINKLES = 10 };

static double wrinkles(const void *params, const PatternPoint *at)
{
    (void)params;
    int generator = at->pattern->noise_generator;
    double noise[WRINKLES], sum = 0, weight = 1;
    noise_octaves(generator, at->p, 1, 2, WRINKLES, noise);
    for (int i = 0; i < WRINKLES; i++, weight *= 0.5)
        sum += weight * (generator >= 2 ? wave_clamp(2 * noise[i] - 0.5) : noise[i]);
    return sum / 2;
}

static Vec3 wrinkle_normal(const void *params, const PatternPoint *at, Vec3 normal, double amount)
{
    (void)params;
    Vec3 noise[WRINKLES], sum = { 0 };
    double scale = 1;
    noise_vector_octaves(at->p, 1, 2, WRINKLES, noise);
    for (int i = 0; i < WRINKLES; i++, scale *= 2) {
        Vec3 d = noise[i];
        sum = add(sum, scaled(vec3(fabs(d.x), fabs(d.y), fabs(d.z)), 1 / scale));
    }
    return add(normal, scaled(sum, amount));
}

const PatternOps pattern_granite = { .keyword = "granite", .value = granite };
const PatternOps pattern_wrinkles = {
    .keyword = "wrinkles", .flags = PATTERN_OWN_NORMAL, .value = wrinkles, .bump = wrinkle_normal,
};
