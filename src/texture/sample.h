/* sample.h - the image of a map at a point: where it falls, and what is there (07-textures, section 6). */
#ifndef TEXTURE_SAMPLE_H
#define TEXTURE_SAMPLE_H

#include "scene/image_map.h"

/* A position in the image: x in [0, width) to the right, y in [0, height) down. */
typedef struct ImageSpot { double x, y; } ImageSpot;

/* False where an image with `once` is not, or the mapping has no value. */
bool image_spot(const ImageMap *map, Vec3 p, ImageSpot *out);

/* Interpolated as the map says, with the map's own filter and transmit. Positions outside wrap round. */
Colour image_sample(const ImageMap *map, ImageSpot at);

/* For bump maps with use_index: the interpolated number of the palette entry. */
double image_sample_index(const ImageMap *map, ImageSpot at);

/* For material_map: a whole number, never interpolated. */
int image_spot_index(const ImageMap *map, ImageSpot at);

#endif
