/* nook.c - shadow rays from small cubes of space: what may lie between one and a light is looked up once and remembered.
 *
 * Neighbouring pixels, and all the samples of a blurred one, ask for the same lights from the same places. Mostly nothing is in
 * the way, or one thing. Nothing else is remembered than what may be: each ray is asked by itself. A light for which this does
 * not pay is left alone. */
#include "trace/path.h"
#include "world/glance.h"

enum { NOOKS = 4096, VISITS = 3 };             /* VISITS: before it is looked up */

/* Edge of the cubes, in the world, which is as large as 1 or 2; and how far outside of them rays may start. */
static const double EDGE = 0x1p-6, MARGIN = 0x1p-14;

/* The sum of this and a number is rounded to a whole number of edges. */
static const double ROUNDED = 0x1.8p46;

/* What they cost and what they save, counted in visits. */
enum { CREDIT = 1000, CREDIT_MAX = 1 << 24, PRICE = 30, SAVED = 4 };

/* Rays have to lead away more steeply for roundings not to matter. */
static const double STEEP = 0x1p-10;

static bool remembers(const Tracer *t, const Light *light)
{
    const LightSource *def = light->def;
    bool meet = !def->parallel && def->kind != LIGHT_CYLINDER && light->projected_through == 0;
    return meet && !def->area && !shadow_dims(t, light);
}

void nooks_start(Arena *arena, Tracer *t)
{
    const World *w = t->world;
    bool any = false;
    t->nook_credit = arena_array(arena, int32_t, w->n_lights + 1);
    for (uint32_t i = 0; i < w->n_lights; i++) {
        t->nook_credit[i] = remembers(t, &w->light[i]) ? CREDIT : -1;
        any |= t->nook_credit[i] > 0;
    }
    t->nook = any ? arena_array(arena, Nook, NOOKS) : NULL;
}

/* Rays that lead away from the outside of these do not meet them again: they are convex, whatever is cut from them, and their
 * normals lead outward. */
static bool can_be_left(const Prim *prim)
{
    Solid solid;
    bool convex = (prim->flags & (PRIM_CONVEX | PRIM_INVERSE)) == PRIM_CONVEX;
    return convex && (prim->ops->half_space != NULL || (prim->ops->solid != NULL && prim->ops->solid(prim->data, &solid)));
}

static void look_up(Nook *nook, const World *w, uint32_t light)
{
    Vec3 middle = sub(nook->at, vec3(ROUNDED, ROUNDED, ROUNDED));
    Shaft shaft;
    if (!(max_abs(middle) < 0x1p20))
        return;
    world_shaft(w, w->light[light].location, bounds_grown((Bounds){ middle, middle }, EDGE / 2 + MARGIN), PRIM_NO_SHADOW, &shaft);
    if (shaft.crowded || shaft.n > NOOK_PRIMS)
        return;
    nook->known = true;
    nook->n = (uint8_t)shaft.n;
    for (uint32_t i = 0; i < shaft.n; i++) {
        nook->prim[i] = shaft.prim[i];
        nook->can_be_left |= (uint8_t)(can_be_left(&w->prim[shaft.prim[i]]) << i);
    }
}

static inline uint32_t low_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return (uint32_t)bits;
}

/* NULL: not known, or too much. */
static inline const Nook *find(Tracer *t, Vec3 p, uint32_t light)
{
    Vec3 at = add(p, vec3(ROUNDED, ROUNDED, ROUNDED));
    uint32_t hash = low_bits(at.x) * 73856093u + low_bits(at.y) * 19349663u + low_bits(at.z) * 83492791u + light;
    Nook *nook = &t->nook[hash * 2654435761u / (UINT32_MAX / NOOKS + 1)];
    int32_t *credit = &t->nook_credit[light];
    --*credit;
    if (nook->at.x != at.x || nook->at.y != at.y || nook->at.z != at.z || nook->light != light)
        *nook = (Nook){ .at = at, .light = light };
    if (nook->visits < VISITS && ++nook->visits == VISITS) {
        look_up(nook, t->world, light);
        *credit -= PRICE;
    }
    if (!nook->known)
        return NULL;
    *credit += *credit < CREDIT_MAX ? SAVED : 0;
    return nook;
}

/* Half spaces from either side: their surface is flat. */
static inline bool is_left(const Spot *spot, uint32_t prim, Vec3 l)
{
    const Surface *surface = spot->surface;
    if (surface == NULL || spot->prim != prim)
        return false;
    double slope = dot(surface->geometric, l);
    bool flat = spot->t->world->prim[prim].ops->half_space != NULL;
    return (flat ? fabs(slope) : surface->back ? -slope : slope) > STEEP;
}

Seen nook_sees(const Spot *spot, uint32_t light, const Beam *beam)
{
    Tracer *t = spot->t;
    if (spot->surface != NULL && spot->surface->error > MARGIN / 4)
        return SEEN_PERHAPS;
    const Nook *nook = find(t, spot->p, light);
    if (nook == NULL)
        return SEEN_PERHAPS;
    const World *w = t->world;
    for (uint32_t i = 0; i < nook->n; i++) {
        uint32_t prim = nook->prim[i];
        if ((nook->can_be_left >> i & 1) && is_left(spot, prim, beam->l))
            continue;
        Ray ray = shadow_ray(spot, beam->l, beam->d);
        if (!prim_meets(w, prim, &ray, PRIM_NO_SHADOW))
            continue;
        if (w->prim[prim].flags & PRIM_OPAQUE)
            return SEEN_NOT;
        t->nook_credit[light] -= SAVED + SAVED;
        return SEEN_PERHAPS;
    }
    return SEEN_FULLY;
}
