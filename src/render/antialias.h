/* antialias.h - how the pixels of one tile get their colours (03-camera-and-sampling, section 5). */
#ifndef RENDER_ANTIALIAS_H
#define RENDER_ANTIALIAS_H

#include "render/sampler.h"

enum { TILE_SIZE = 32 };                       /* POV: method 1 depends on it */

typedef struct Tile {                          /* columns x0 <= x < x1, rows y0 <= y < y1 */
    int x0, y0, x1, y1;
    uint32_t index;
} Tile;

typedef struct Antialiasing Antialiasing;      /* shared by all threads */
typedef struct Antialias Antialias;            /* buffers of one */

/* Tiles are numbered by rows of `across`. alike: may a tile take over colours that its neighbours have found? */
Antialiasing *antialiasing_new(Arena *arena, const World *w, const RenderOptions *options, uint32_t across, uint32_t n_tiles, bool alike);
Antialias *antialias_new(Arena *arena, Antialiasing *all);

/* rgba: the whole picture. */
void antialias_tile(Antialias *a, Sampler *s, const Tile *tile, float *rgba);

#endif
