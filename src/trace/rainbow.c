/* rainbow.c - rainbows: colours on a cone around the antisolar direction (04-shading, section 10.3). */
#include "trace/path.h"

static double radians(double degrees)
{
    return degrees * (PI / 180);
}

static double acos_safe(double x)
{
    return acos(fmin(1, fmax(-1, x)));
}

/* A whole circle has no ends that could fade. */
void bow_prepare(Bow *bow, const RainbowDef *def)
{
    Vec3 antisolar = normalized(def->direction);
    Vec3 right = normalized(cross(def->up, antisolar));
    *bow = (Bow){
        .def = def, .antisolar = antisolar, .right = right, .up = normalized(cross(antisolar, right)),
        .angle = radians(def->angle) - radians(def->width) / 2, .width = radians(def->width),
        .distance = def->distance, .jitter = def->jitter,
        .arc = radians(def->arc_angle) / 2, .falloff = radians(def->arc_angle < 360 ? def->falloff_angle : 360) / 2
    };
}

static Colour map_colour(const BlendMap *map, double v)
{
    if (v >= (double)map->entry[map->n - 1].key)
        return map->entry[map->n - 1].colour;
    uint32_t i = 0;
    while (v > (double)map->entry[i].key)
        i++;
    if (i == 0 || v == (double)map->entry[i].key)
        return map->entry[i].colour;
    double low = (double)map->entry[i - 1].key, high = (double)map->entry[i].key;
    return colour_lerp(map->entry[i - 1].colour, map->entry[i].colour, (float)((v - low) / (high - low)));
}

static Colour bow_colour(const Bow *bow, double index)
{
    if (bow->def->pigment != NULL)
        return pigment_colour(bow->def->pigment, vec3(index, 0, 0), NULL, NULL);
    return map_colour(&bow->def->map, index);
}

/* Where across the bow the ray points, 0 inside to 1 outside; false: beside it. `fade`: how far its end has faded. */
static bool bow_index(Tracer *t, const Bow *bow, Vec3 d, double *index, double *fade)
{
    double x = dot(d, bow->right), y = dot(d, bow->up), z = dot(d, bow->antisolar);
    double r = sqrt(x * x + y * y);
    double arc = r > 0 ? acos_safe(y / r) : 0;
    if (arc > bow->arc || z < 0)
        return false;
    *index = (acos_safe(z) - bow->angle) / bow->width;
    if (bow->jitter != 0)
        *index += (2 * streams_uniform(&t->chance) - 1) * bow->jitter;
    *fade = 0;
    if (arc > bow->falloff && bow->arc > bow->falloff) {
        double f = (arc - bow->falloff) / (bow->arc - bow->falloff);
        *fade = (3 - 2 * f) * f * f;
    }
    return *index >= 0 && *index <= 1 - TINY;
}

Colour rainbow_apply(Tracer *t, Vec3 d, double depth, Colour c)
{
    Rgb sum = rgb_grey(0), seen = rgb_of(c);
    float n = 0, through = 1;
    for (uint32_t i = 0; i < t->tracing->n_bows; i++) {
        const Bow *bow = &t->tracing->bow[i];
        double index, fade;
        if (!bow_index(t, bow, d, &index, &fade))
            continue;
        Colour b = bow_colour(bow, index);
        double thin = exp(-depth * t->tracing->to_scene / bow->distance);
        float k = (float)fmax(thin, fade * (1 - (double)b.t) + (double)b.t);
        float g = b.f * (1 - k);
        Rgb tint = rgb_add(rgb_grey(1 - g), rgb_scaled(rgb_of(b), g));
        sum = rgb_add(sum, rgb_add(rgb_scaled(rgb_mul(seen, tint), k), rgb_scaled(rgb_of(b), 1 - k)));
        through *= k * b.t;
        n++;
    }
    if (n == 0)
        return c;
    sum = rgb_scaled(sum, 1 / n);
    return colour_of(sum, c.f, c.t * through);
}
