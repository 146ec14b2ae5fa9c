/* fan.c - see fan.h. A shape that knows how answers for all four rays; what is left open is asked ray by ray. */
#include "world/fan.h"

#include "world/prim.h"

static Ray ray_of(const Fan *fan, int i)
{
    double x[FAN_RAYS], y[FAN_RAYS], z[FAN_RAYS], t_max[FAN_RAYS];
    d4_store(x, fan->d.x);
    d4_store(y, fan->d.y);
    d4_store(z, fan->d.z);
    d4_store(t_max, fan->t_max);
    return (Ray){ fan->o, vec3(x[i], y[i], z[i]), fan->t_min, t_max[i] };
}

/* One coordinate of affine_apply_linear. */
static inline d4 coordinate(const double m[4][3], int i, const Vec3s *d)
{
    return d4_add(d4_add(d4_mul(d->x, d4_set(m[0][i])), d4_mul(d->y, d4_set(m[1][i]))), d4_mul(d->z, d4_set(m[2][i])));
}

static inline Vec3s vectors_back(const double inv[4][3], const Vec3s *d)
{
    return (Vec3s){ coordinate(inv, 0, d), coordinate(inv, 1, d), coordinate(inv, 2, d) };
}

static void roots_of(const Prim *prim, const Fan *fan, FanHits *out)
{
    const Affine *place = prim->place;
    out->in_range[0] = out->in_range[1] = out->unsaid = 0;
    if (place->identity) {
        prim->ops->fan_hits(prim->data, fan, out);
        return;
    }
    Fan local = { affine_apply(place->inv, fan->o), fan->t_min, vectors_back(place->inv, &fan->d), fan->t_max };
    prim->ops->fan_hits(prim->data, &local, out);
}

/* ---- set operations: as in prim.c ---- */

static uint32_t inside_prim(const Prim *prim, const Vec3s *p)
{
    const Affine *place = prim->place;
    uint32_t in;
    if (place->identity) {
        in = prim->ops->fan_inside(prim->data, p);
    } else {
        Vec3s local = vec3s_add(vectors_back(place->inv, p), vec3s_set(vec3(place->inv[3][0], place->inv[3][1], place->inv[3][2])));
        in = prim->ops->fan_inside(prim->data, &local);
    }
    return prim->flags & PRIM_INVERSE ? ~in & FAN_ALL : in;
}

bool fan_climbs(const World *w, const Prim *prim)
{
    if (prim->flags & (PRIM_BOUNDED | PRIM_BOXED))
        return false;
    for (uint32_t c = prim->csg; c != 0; c = w->csg[c].parent) {
        const CsgNode *node = &w->csg[c];
        if (node->op == CSG_ANY && !(node->flags & CSG_MERGE))
            continue;
        if (node->op == CSG_ANY || node->accel != NULL)
            return false;
        for (uint32_t i = node->first; i < node->first + node->n; i++) {
            uint32_t child = w->csg_child[i];
            if (child >= w->n_prims || (w->prim[child].flags & PRIM_PATCH) || w->prim[child].ops->fan_inside == NULL)
                return false;
        }
    }
    return true;
}

/* Which of the roots does the CSG above leave? */
static uint32_t csg_leaves(const World *w, uint32_t self, const Fan *fan, d4 t, uint32_t rays)
{
    Vec3s p = vec3s_add(vec3s_set(fan->o), vec3s_scaled(fan->d, t));
    for (uint32_t c = w->prim[self].csg; c != 0 && rays != 0; c = w->csg[c].parent) {
        const CsgNode *node = &w->csg[c];
        if (node->op == CSG_ALL)
            for (uint32_t i = node->first; i < node->first + node->n && rays != 0; i++)
                if (w->csg_child[i] != self)
                    rays &= inside_prim(&w->prim[w->csg_child[i]], &p);
    }
    return rays;
}

/* ---- a prim ---- */

static uint32_t ask_one_by_one(const World *w, uint32_t index, const Fan *fan, uint32_t rays)
{
    uint32_t found = 0;
    for (int i = 0; rays >> i != 0; i++)
        if (rays >> i & 1) {
            Ray ray = ray_of(fan, i);
            found |= (uint32_t)prim_meets(w, index, &ray, 0) << i;
        }
    return found;
}

uint32_t fan_meets(const World *w, uint32_t index, const Fan *fan, uint32_t rays)
{
    const Prim *prim = &w->prim[index];
    if (prim->ops->fan_hits == NULL)
        return ask_one_by_one(w, index, fan, rays);
    FanHits hits;
    roots_of(prim, fan, &hits);
    uint32_t said = rays & ~hits.unsaid, found = (hits.in_range[0] | hits.in_range[1]) & said;
    if (prim->csg != 0 && found != 0) {
        if (!fan_climbs(w, prim))
            return ask_one_by_one(w, index, fan, found | (rays & hits.unsaid));
        found = csg_leaves(w, index, fan, hits.t[0], hits.in_range[0] & said);
        found |= csg_leaves(w, index, fan, hits.t[1], hits.in_range[1] & said & ~found);
    }
    return rays == said ? found : found | ask_one_by_one(w, index, fan, rays & hits.unsaid);
}
