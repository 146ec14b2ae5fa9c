/* radiosity.h - light that surfaces throw at each other: what the renderer does about it.
 *
 * Samples of it are kept in a cache, which grows in passes. Within a pass a tile sees what earlier passes found and what it finds
 * itself, so neither the number of threads nor their order leaves a trace. */
#ifndef TRACE_RADIOSITY_H
#define TRACE_RADIOSITY_H

#include "trace/trace.h"

/* NULL: the scene does without. Lives in `arena`, and owns memory: radiosity_free. */
Radiosity *radiosity_new(Arena *arena, const World *w, int quality, uint32_t n_tiles);
void radiosity_free(Radiosity *r);

/* Passes before the picture. width, height: of the whole picture. */
int radiosity_passes(const Radiosity *r, int width, int height);
double radiosity_step(const Radiosity *r, int width, int height, int pass);     /* pixels */

/* Starts a tile; pass -1 is the picture itself. */
void tracer_start_gathering(Tracer *t, uint32_t tile, int pass);
/* Ends it: what a pass has found there waits for radiosity_merge. Tiles may end in several threads at once. */
void tracer_end_gathering(Tracer *t, uint32_t tile);
/* All tiles of the pass are done: adds what they found, in their order. One thread. last: the picture comes next. */
void radiosity_merge(Radiosity *r, bool last);

#endif
