/* sky.c - what a ray sees that hits nothing: sky sphere, then background (04-shading, section 9). */
#include "trace/path.h"

static float clamped_grey(Rgb filter)
{
    float grey = fabsf(rgb_greyness(filter));
    return grey < 1 ? grey : 1;
}

Backdrop backdrop_of(Colour background, bool alpha)
{
    if (!alpha)
        background.f = background.t = 0;
    return (Backdrop){ rgb_scaled(rgb_of(background), 1 - background.f - background.t), colour_transmittance(background) };
}

/* From 3.7 on the pigments of a sky sphere lie over each other, and over the background, like the layers of a texture. */
static Colour layered_sky(const SkySphere *sky, Vec3 p, const Backdrop *background)
{
    Rgb sum = rgb_grey(0), filter = rgb_grey(1);
    for (uint32_t i = sky != NULL ? sky->n : 0; i-- > 0;) {
        Colour c = pigment_colour(sky->pigment[i], p, NULL, NULL);
        Rgb lit = rgb_mul(rgb_scaled(rgb_of(c), 1 - c.f - c.t), filter);
        sum = rgb_add(sum, rgb_mul(lit, sky->emission));
        filter = rgb_mul(filter, colour_transmittance(c));
    }
    sum = rgb_add(sum, rgb_mul(background->light, filter));
    filter = rgb_mul(filter, background->through);
    return colour_of(sum, 0, clamped_grey(filter));
}

/* POV: before 3.7, filter and transmit of the layers are multiplied each on its own. */
static Colour legacy_sky(const SkySphere *sky, Vec3 p, Colour background)
{
    Rgb sum = rgb_grey(0);
    Colour passed = { 1, 1, 1, 1, 1 };
    float through = 1;
    for (uint32_t i = sky->n; i-- > 0;) {
        Colour c = pigment_colour(sky->pigment[i], p, NULL, NULL);
        sum = rgb_add(sum, rgb_scaled(rgb_of(c), through * (1 - c.f - c.t)));
        passed = (Colour){ passed.r * c.r, passed.g * c.g, passed.b * c.b, passed.f * c.f, passed.t * c.t };
        through = fabsf(passed.f) + fabsf(passed.t);
    }
    sum = rgb_mul(sum, sky->emission);
    sum = rgb_add(sum, rgb_mul(rgb_of(background), colour_transmittance(passed)));
    return colour_of(sum, 0, background.t * passed.t);
}

Colour sky_colour(const Tracing *tracing, Vec3 d, bool alpha)
{
    if (tracing->legacy && alpha)
        return (Colour){ 0, 0, 0, 0, 1 };
    const SkySphere *sky = tracing->world->scene->sky_sphere;
    Vec3 p = sky != NULL ? affine_point_back(&sky->place, d) : d;
    if (tracing->legacy)
        return sky != NULL && sky->n > 0 ? legacy_sky(sky, p, tracing->background) : tracing->background;
    return layered_sky(sky, p, &tracing->backdrop[alpha]);
}
