/* prim.h - questions a ray asks the World: what is hit first, is anything in the way, what is the surface there. */
#ifndef WORLD_PRIM_H
#define WORLD_PRIM_H

#include "world/world.h"

/* Prims with any of `skip` among their flags are not seen: PRIM_NO_SHADOW for shadow rays, PRIM_NO_IMAGE for the camera's own
 * rays, PRIM_NO_IMAGE | PRIM_NO_IMAGE_LATER for what passed a surface, PRIM_NO_REFLECTION after a reflection. */
bool world_nearest(const World *w, const Ray *ray, uint32_t skip, Hit *out);

/* Offers hits in (t_min, t_max) to `visit` in no order; true stops: "blocked". For shadow rays. */
typedef bool HitVisit(void *user, const Hit *hit);
bool world_each_hit(const World *w, const Ray *ray, uint32_t skip, HitVisit *visit, void *user);

/* Has one prim, counted with its CSG, any hit in the ray's range? */
bool prim_meets(const World *w, uint32_t prim, const Ray *ray, uint32_t skip);

/* Only one CSG item (projected_through, looks_like, trace()). */
bool item_nearest(const World *w, uint32_t item, const Ray *ray, Hit *out);
bool item_inside(const World *w, uint32_t item, Vec3 p);               /* item: prim, or ~csg node */

/* The surface in world space: unit normals facing the ray (normal and geometric each on its own), `back` set if `normal` was
 * turned, error in world lengths. uv without want_uv is not filled. For cut faces of cutaway_textures the textures of the
 * bodies they cut are listed in `texture`. */
void world_surface(const World *w, const Ray *ray, const Hit *hit, bool want_uv, Surface *out);

/* Where a new ray from this surface into direction d starts: moved off the surface, to d's side, by the error bound, so
 * that t_min = 0 suffices and no absolute epsilon is needed. */
static inline Vec3 surface_offset(const Surface *s, Vec3 d)
{
    double side = dot(s->geometric, d) < 0 ? -2 : 2;       /* twice: the far side of the error, and as far again */
    return add(s->p, scaled(s->geometric, side * s->error));
}

/* Interiors of the bodies that contain p, each once, in scene order, their clips left aside; returns how many (at most max). */
uint32_t world_interiors_at(const World *w, Vec3 p, uint32_t *interior, uint32_t max);

#endif
