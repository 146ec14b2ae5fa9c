/* fog.c - fogs over a stretch of air (04-shading, section 10.1). All fogs act together; none hides another. */
#include "pattern/pattern.h"
#include "trace/path.h"

/* Mean density of a ground fog between two heights, in units of its altitude above its offset. */
static double ground_density(double s, double e)
{
    if (s <= 0 && e <= 0)
        return 1;
    if (s <= 0)
        return (atan(e) - s) / (e - s);
    if (e <= 0)
        return (atan(s) - e) / (s - e);
    if (fabs(s - e) <= TINY)
        return 1 / (s * s + 1);
    return (atan(s) - atan(e)) / (s - e);
}

/* Scene units. */
static double fog_thins(const FogDef *fog, int noise_generator, Vec3 o, Vec3 d, double width)
{
    double w = width;
    if (fog->has_turbulence) {
        Vec3 middle = add(o, scaled(d, width / 2));
        double t = pattern_turbulence(&fog->turbulence, noise_generator, mul(fog->turbulence.amount, middle));
        w *= 1 - exp(-w / fog->distance) * fmin(1, fog->turb_depth * t);
    }
    if (fog->type == 2) {
        double start = (dot(o, fog->up) - fog->offset) / fog->altitude;
        double end = (dot(add(o, scaled(d, width)), fog->up) - fog->offset) / fog->altitude;
        w *= ground_density(start, end);
    }
    return exp(-w / fog->distance);
}

FogPass fog_pass(const Tracing *tracing, Vec3 o, Vec3 d, double depth)
{
    FogPass pass = { rgb_grey(1), rgb_grey(0) };
    Vec3 from = scaled(o, tracing->to_scene);
    double width = depth * tracing->to_scene;
    for (uint32_t i = 0; i < tracing->n_fog; i++) {
        const FogDef *fog = tracing->fog[i];
        float k = (float)fog_thins(fog, tracing->world->globals.noise_generator, from, d, width);
        k = fmaxf(k, fog->colour.t);
        Rgb tint = rgb_of(fog->colour);
        float f = fog->colour.f;
        pass.factor = rgb_mul(pass.factor, rgb_scaled(rgb_add(rgb_grey(1 - f), rgb_scaled(tint, f)), k));
        pass.added = rgb_add(pass.added, rgb_scaled(tint, 1 - k));
    }
    return pass;
}

Colour fog_apply(const Tracing *tracing, Vec3 o, Vec3 d, double depth, Colour c)
{
    FogPass pass = fog_pass(tracing, o, d, depth);
    Rgb seen = rgb_add(pass.added, rgb_mul(pass.factor, rgb_of(c)));
    return colour_of(seen, c.f, c.t * rgb_greyness(pass.factor));
}
