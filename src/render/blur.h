/* blur.h - focal blur: where rays pass the aperture, and when they are enough (03-camera-and-sampling, section 4). */
#ifndef RENDER_BLUR_H
#define RENDER_BLUR_H

#include "base/arena.h"
#include "scene/scene.h"

typedef struct Blur {
    uint32_t n, n_min;                         /* samples at most, at least */
    const Vec2 *place;                         /* n places in an aperture of diameter 1 */
    double jitter;                             /* radius around each */
    const double *threshold;                   /* [m]: of the variance after m samples, 1..n */
    const uint8_t *chunk;                      /* sizes of the first chunks, ended by 0; then 4 each */
} Blur;

const Blur *blur_new(Arena *arena, const CameraDef *def);      /* NULL: no blur */

#endif
