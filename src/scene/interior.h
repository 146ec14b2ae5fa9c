/* interior.h - what fills objects: refraction, attenuation, media. */
#ifndef SCENE_INTERIOR_H
#define SCENE_INTERIOR_H

#include "scene/texture.h"

typedef struct Scattering {
    int type;                                  /* 0 none, 1 isotropic ... 5 Henyey-Greenstein */
    Rgb colour;
    float eccentricity, extinction;
} Scattering;

typedef struct Media {
    int method, intervals, samples_min, samples_max, aa_level;
    float ratio, confidence, variance, aa_threshold, jitter;
    Rgb absorption, emission;
    Scattering scattering;
    bool collect;
    const Pigment *const *density;             /* multiplied; none means 1 everywhere */
    uint32_t n_density;
    Loc loc;
} Media;

typedef struct Interior {
    float ior, dispersion, caustics, old_refraction;
    int dispersion_samples;
    double fade_distance;                      /* a length: scenes of any size need its exponent */
    float fade_power;
    Rgb fade_colour;
    const Media *media;
    uint32_t n_media;
    Loc loc;
} Interior;

#endif
