/* trace.h - what comes along a ray: the recursion of 04-shading.
 *
 * Tracing (shared, const while rays fly) holds what is worked out once per picture; a Tracer is what one thread owns. */
#ifndef TRACE_TRACE_H
#define TRACE_TRACE_H

#include "trace/random.h"
#include "world/world.h"

enum { INTERIORS_MAX = 64 };

/* The bodies a ray is in, in the order of entering (indices of World.interior). What finds no room is not remembered. */
typedef struct Interiors {
    uint32_t n;
    uint32_t at[INTERIORS_MAX];
} Interiors;

typedef struct Tracing Tracing;
typedef struct Radiosity Radiosity;            /* trace/radiosity.h */
typedef struct Tracer Tracer;

/* Lives in `arena`, as long as it. quality: 0..11; alpha: is the background to be seen through? */
const Tracing *tracing_new(Arena *arena, const World *w, int quality, bool alpha);
/* radiosity: NULL if there is none. What the tracer allocated beyond the arena goes by tracer_free. */
Tracer *tracer_new(Arena *arena, const Tracing *tracing, Radiosity *radiosity);
void tracer_free(Tracer *t);

/* A new stretch of chance; what follows depends on the tile alone. */
void tracer_start_tile(Tracer *t, uint32_t tile);

/* Has the tile used any? If not, its colours are those of any other tile. */
bool tracer_took_chances(const Tracer *t);

/* The bodies around a point in world space. */
void tracer_interiors(const Tracer *t, Vec3 p, Interiors *out);

/* The camera's ray, to be written before a look: world space, d of unit length, from t_min 0 (as it is) as far as is seen. It
 * keeps what it holds: cameras need write only what changes. */
Ray *tracer_eye(Tracer *t);

/* What it sees, in the bodies around its origin. Filter is 0 in the answer. */
Colour tracer_look(Tracer *t, const Interiors *around);

#endif
