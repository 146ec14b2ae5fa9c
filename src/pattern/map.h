/* map.h - writing the default maps of patterns. */
#ifndef PATTERN_MAP_H
#define PATTERN_MAP_H

#include "scene/texture.h"

#define MAP_RGB(at, red, green, blue) { .key = (at), .colour = { (red), (green), (blue), 0, 0 } }
#define MAP_OF(entries) .default_map = (entries), .n_default_map = sizeof(entries) / sizeof *(entries)

#endif
