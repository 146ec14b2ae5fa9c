/* shaft.c - gathers the prims that rays from one point into a box may hit (after Haines and Wallace, Shaft culling for
 * efficient ray-traced radiosity, 1991). */
#include "world/shaft.h"

/* How far, relative to all distances, a box must stay on one side of a plane for rounding not to matter. */
static const double ASIDE = 0x1p-20;

typedef struct Gather {
    const World *world;
    uint32_t skip;
    Shaft *shaft;
} Gather;

static bool keep(const Gather *g, uint32_t prim)
{
    Shaft *s = g->shaft;
    if (g->world->prim[prim].flags & g->skip)
        return false;
    for (uint32_t i = 0; i < s->n; i++)
        if (s->prim[i] == prim)
            return false;
    s->crowded = s->n == SHAFT_MAX;
    if (!s->crowded)
        s->prim[s->n++] = prim;
    return s->crowded;
}

static bool keep_item(void *user, uint32_t i, double *t_max)
{
    (void)t_max;
    const Gather *g = user;
    return keep(g, g->world->accel_prim[i]);
}

/* A plane with o and the whole box on its outer side is hit by no ray between them. o may lie close to it: the plane's own
 * formula then finds every root behind the origin, as the ray leads clearly away from it. */
static bool stays_outside(const Prim *prim, Vec3 o, Bounds to)
{
    if (prim->ops->half_space == NULL)
        return false;
    const Affine *place = prim->place;
    Vec3 n;
    double distance;
    prim->ops->half_space(prim->data, &n, &distance);
    if (!(dot(n, affine_point_back(place, o)) > distance))
        return false;
    /* n' x = n (x back), for points of the world. */
    Vec3 m = affine_normal(place, n), middle = scaled(add(to.lo, to.hi), 0.5), half = sub(to.hi, middle);
    double offset = place->identity ? 0 : dot(n, vec3(place->inv[3][0], place->inv[3][1], place->inv[3][2]));
    double least = dot(m, middle) + offset - distance - (fabs(m.x) * half.x + fabs(m.y) * half.y + fabs(m.z) * half.z);
    double size = length(m) * (max_abs(middle) + max_abs(half) + max_abs(o)) + fabs(offset) + fabs(distance);
    return least > ASIDE * size;
}

void world_shaft(const World *w, Vec3 o, Bounds to, uint32_t skip, Shaft *out)
{
    Gather g = { w, skip, out };
    out->n = 0;
    out->crowded = false;
    for (uint32_t i = 0; i < w->n_unbounded; i++)
        if (!stays_outside(&w->prim[w->unbounded[i]], o, to) && keep(&g, w->unbounded[i]))
            return;
    if (w->n_accel_prims > 0)
        w->accel_ops->between(w->accel, o, to, keep_item, &g);
}

/* Nothing changes on the way if no surface lies in between. Bodies that are set operations of their own may be clipped: inside
 * beyond their surface. */
bool world_same_bodies(const World *w, Vec3 o, Bounds box)
{
    for (uint32_t i = 0; i < w->n_bodies; i++)
        if (w->body[i] >= w->n_prims)
            return false;
    Shaft shaft;
    world_shaft(w, o, box, 0, &shaft);
    return shaft.n == 0;
}
