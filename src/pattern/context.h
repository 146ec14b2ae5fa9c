/* context.h - what is known of the surface and the ray while a texture is evaluated. */
#ifndef PATTERN_CONTEXT_H
#define PATTERN_CONTEXT_H

#include "math/vec.h"

/* NULL in place of a context means: no surface (media, sky, functions), quality 9, the defaults. */
typedef struct TextureContext {
    Vec3 point;                                /* the hit in scene space, moved by no chain */
    Vec3 ray;                                  /* unit direction of the ray */
    Vec3 normal;                               /* facing the ray; perturbed as far as the layer has come (07, section 5.1) */
    Vec2 uv;
    bool hit;                                  /* false: slope and aoi are 0 */
    int quality;                               /* as +Q: up to 5 quick colours count, below 8 normals do not */
    int number_of_waves;                       /* of global_settings; 0: 10 */
    int noise_generator;                       /* of global_settings, for iridescence; 0: 2 */
} TextureContext;

#endif
