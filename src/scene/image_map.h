/* image_map.h - an image in a scene: its pixels, and how points are mapped to them (07-textures, section 6). */
#ifndef SCENE_IMAGE_MAP_H
#define SCENE_IMAGE_MAP_H

#include "math/colour.h"
#include "math/vec.h"

struct Image;                                  /* image/image.h */

typedef struct ImageMap {
    const struct Image *image;                 /* decoded to the working space as section 6.4 says for its use */
    int map_type;                              /* 0 planar, 1 spherical, 2 cylindrical, 5 torus */
    int interpolate;                           /* 0 none, 2 bilinear, 3 bicubic, 4 normalised distance */
    bool once, use_index, use_alpha, premultiplied;
    bool has_transparency;                     /* some pixel or entry has filter or transmit, or `once`: shadows must ask */
    Vec2 repeat, offset;                       /* default <1,1>, <0,0> */
    float filter_all, transmit_all;            /* image_map without palette: added to every sampled pixel */
    const float *palette_filter, *palette_transmit;    /* image_map with palette: one number per entry; NULL when none */
} ImageMap;

#endif
