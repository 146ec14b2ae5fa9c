/* compile.h - Scene to World: flat arrays, only what this scene uses. */
#ifndef COMPILE_COMPILE_H
#define COMPILE_COMPILE_H

#include "world/world.h"

/* Fills w, whose arena is initialised and whose lifetime is the caller's. `accel`: "bvh", "list"; NULL: the best.
 * Mistakes jump to diag's landing. The scene must outlive the World: textures, lights and fog stay in it. */
void compile_world(World *w, const Scene *scene, const Registry *registry, const char *accel, Diag *diag);

/* What sdl asks while it parses: trace(), inside(), min_extent, max_extent. Small Worlds of single objects, made when first
 * asked and kept in `arena`. */
typedef struct Query Query;
Query *query_new(Arena *arena, const Registry *registry, Diag *diag);
bool query_trace(void *query, const Object *o, Vec3 from, Vec3 direction, Vec3 *point, Vec3 *normal);
bool query_inside(void *query, const Object *o, Vec3 p);
Bounds query_extent(void *query, const Object *o);
const World *query_world(void *query, const Object *o, uint32_t *item);    /* lives as long as `arena`; NULL: contains nothing */

/* A readable plan of the World: what is modelled, what was dropped and why, which shortcuts are on. */
Str compile_explain(Arena *a, const World *w);

#endif
