/* render.h - a World to pixels: tiles, threads, antialiasing. */
#ifndef RENDER_RENDER_H
#define RENDER_RENDER_H

#include "world/world.h"

typedef struct RenderOptions {
    int width, height;
    int threads;                               /* at least 1 */
    int quality;                               /* 0..11 */
    int antialias;                             /* 0 off, 1, 2: the method */
    double threshold;                          /* 0..1 */
    int depth;                                 /* 1..9 */
    double jitter;                             /* 0: off */
    double antialias_gamma;
    bool output_alpha;
    int first_column, last_column, first_row, last_row;        /* from 0, inclusive: what is rendered of the picture */
} RenderOptions;

/* Told after every tile, from one thread at a time; false cancels. */
typedef bool RenderProgress(void *user, int done_tiles, int all_tiles);

/* rgba: width * height * 4 floats, top row first: working space, premultiplied, unclipped, alpha = 1 - transmit. Pixels outside
 * the region are left alone. The bytes depend on nothing but the World and the options, not on threads. False: cancelled. */
bool render(const World *w, const RenderOptions *options, float *rgba, RenderProgress *progress, void *user);

#endif
