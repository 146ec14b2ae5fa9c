/* prim.c - a ray's questions to the World, answered by asking prims and climbing their set operations.
 *
 * Set operations are flattened: the accelerator sees leaves only. A shape reports its roots to a HitSink; a root of a leaf
 * that sits in CSG climbs from parent to parent, asking the siblings whether they contain the point (08-shapes, section 10.4).
 * The sink keeps the least hit by a total order, so neither the order nor the number of offers matters. */
#include "world/prim.h"

#include <string.h>

#include "base/simd.h"
#include "world/shaft.h"

/* How far computed points may lie off their surface, relative to the coordinates that went into them: many times the
 * rounding of o + t d and two transforms (a few 2^-53), so that near-double roots of quartics and coincident faces are
 * stepped over too. On a scene of size 1 it is 2e-12. */
static const double SURFACE_ERROR = 0x1p-39;

typedef struct Search {
    HitSink sink;                              /* what shapes see; first, so that a sink leads back here */
    bool found, stop;
    uint32_t prim;                             /* being asked */
    uint32_t skip;
    uint32_t csg;                              /* the node above the prim */
    uint32_t above;                            /* climbing ends here: the parent of the item in question, or 0 */
    const World *world;
    const Ray *ray;                            /* in world space */
    HitVisit *visit;                           /* each hit goes here; NULL: keep the nearest */
    void *user;
    Hit *hit;                                  /* the nearest, if found; the one being visited */
    uint32_t bound;                            /* the BOUND node asked last; 0: none yet */
    bool bound_met;
    const Affine *place;                       /* where `local` is the ray; NULL: nowhere yet */
    Ray local;
} Search;

/* ---- inside ---- */

static bool is_node(uint32_t item)
{
    return (item & 0x80000000u) != 0;
}

static inline bool prim_inside(const Prim *prim, Vec3 p)
{
    if ((prim->flags & PRIM_PATCH) || prim->ops->inside == NULL)
        return false;                          /* POV: also when inverted */
    return prim->ops->inside(prim->data, affine_point_back(prim->place, p)) != ((prim->flags & PRIM_INVERSE) != 0);
}

/* Prims with a flag of `skip` are not asked. */
static inline bool part_answers(const World *w, const CsgPart *part, uint32_t self, const Vec3 *p, uint32_t skip)
{
    if (part->item == self)
        return false;
    if (!bounds_contain(part->box, *p))
        return part->far_answer;
    if (is_node(part->item))
        return item_inside(w, part->item, *p) == part->near_answer;
    if (skip != 0 && (w->prim[part->item].flags & skip))
        return false;
    return part->inside(part->data, part->place != NULL ? affine_apply(part->place->inv, *p) : *p) == part->near_answer;
}

typedef struct Ask {                           /* does any child but `self` answer? */
    const World *world;
    const CsgPart *part;
    uint32_t self, skip;
    const Vec3 *p;
    bool yes;
} Ask;

static bool ask_part(void *user, uint32_t i, double *t_max)
{
    (void)t_max;
    Ask *ask = user;
    ask->yes = part_answers(ask->world, &ask->part[i], ask->self, ask->p, ask->skip);
    return ask->yes;
}

/* The accelerator holds only children that do not answer outside their box. */
static __attribute__((noinline)) bool some_unlisted(const World *w, const CsgNode *node, uint32_t self, const Vec3 *p, uint32_t skip)
{
    Ask ask = { w, w->csg_part + node->first + node->n_listed, self, skip, p, false };
    w->accel_ops->around(node->accel, *p, ask_part, &ask);
    return ask.yes;
}

static inline bool some_part(const World *w, const CsgNode *node, uint32_t self, const Vec3 *p, uint32_t skip)
{
    const CsgPart *part = w->csg_part + node->first, *end = part + node->n_listed;
    for (; part < end; part++)
        if (part_answers(w, part, self, p, skip))
            return true;
    return node->accel != NULL && some_unlisted(w, node, self, p, skip);
}

enum { NO_ITEM = 0x7fffffff };

bool item_inside(const World *w, uint32_t item, Vec3 p)
{
    if (!is_node(item))
        return prim_inside(&w->prim[item], p);
    const CsgNode *node = &w->csg[~item];
    if (node->flags & CSG_BOUND)
        return item_inside(w, w->csg_child[node->first], p);
    if (!bounds_contain(node->box, p))
        return (node->flags & CSG_INVERSE) != 0;
    return some_part(w, node, NO_ITEM, &p, 0) == (node->op == CSG_ANY);
}

/* ---- which hits count ---- */

static bool ray_meets_box(const Ray *ray, Bounds box)
{
    double near = 0, far = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double o = vec3_at(ray->o, axis), d = vec3_at(ray->d, axis);
        double lo = vec3_at(box.lo, axis), hi = vec3_at(box.hi, axis);
        if (d == 0) {
            if (o < lo || o > hi)
                return false;
            continue;
        }
        near = fmax(near, ((d > 0 ? lo : hi) - o) / d);
        far = fmin(far, ((d > 0 ? hi : lo) - o) / d);
    }
    return near <= far;
}

/* A bound is met by a ray that hits it ahead or starts inside (08-shapes, section 5.1). Without bound objects the node's box
 * stands for them. */
static bool ray_meets_bounds(const World *w, const CsgNode *node, const Ray *ray)
{
    if (node->n == 1)
        return ray_meets_box(ray, node->box);
    Ray ahead = { ray->o, ray->d, 0, INFINITY };
    for (uint32_t i = 1; i < node->n; i++) {
        uint32_t item = w->csg_child[node->first + i];
        Hit hit;
        if (!item_nearest(w, item, &ahead, &hit) && !item_inside(w, item, ray->o))
            return false;
    }
    return true;
}

/* Does the ray meet all bounds above the prim? Asked before its roots are sought; neighbours often have the same bound. */
static __attribute__((noinline)) bool bounds_let_through(Search *search, uint32_t csg)
{
    const World *w = search->world;
    for (uint32_t c = csg; c != search->above; c = w->csg[c].parent) {
        if (!(w->csg[c].flags & CSG_BOUND))
            continue;
        if (search->bound != c) {
            search->bound_met = ray_meets_bounds(w, &w->csg[c], search->ray);
            search->bound = c;
        }
        if (!search->bound_met)
            return false;
    }
    return true;
}

/* POV: what a ray does not see hides nothing from it in a merge, but still cuts in an intersection. BOUND nodes let all count, as
 * bounds_let_through has found. */
static inline bool node_keeps(const World *w, const CsgNode *node, uint32_t self, const Vec3 *p, uint32_t skip)
{
    if (node->op == CSG_ALL ? node->flags & CSG_BOUND : !(node->flags & CSG_MERGE))
        return true;
    return !some_part(w, node, self, p, node->op == CSG_ALL ? 0 : skip);
}

static inline bool csg_keeps(const Search *search, double t)
{
    const World *w = search->world;
    Vec3 p = ray_at(search->ray, t);
    uint32_t self = search->prim;
    if ((w->prim[self].flags & PRIM_BOXED) && !bounds_contain(w->box[self], p))
        return false;
    for (uint32_t c = search->csg; c != search->above; c = w->csg[c].parent) {
        if (!node_keeps(w, &w->csg[c], self, &p, search->skip))
            return false;
        self = ~c;
    }
    return true;
}

/* The total order of hits: nearer, then earlier in the World, then the smaller part. */
static bool wins_tie(uint32_t prim, uint32_t part, const Hit *b)
{
    return prim != b->prim ? prim < b->prim : part < b->part;
}

static void hit_visit(Search *search)
{
    if (search->visit(search->user, search->hit)) {
        search->stop = true;
        search->sink.limit = -INFINITY;
    }
}

static inline void hit_keep(Search *search, double t, uint32_t part, double u, double v)
{
    *search->hit = (Hit){ .t = t, .u = u, .v = v, .prim = search->prim, .part = part };
    if (search->visit == NULL) {
        search->found = true;
        search->sink.limit = t;
    } else
        hit_visit(search);
}

static __attribute__((noinline)) void hit_climb(Search *search, double t, uint32_t part, double u, double v)
{
    if (csg_keeps(search, t))
        hit_keep(search, t, part, u, v);
}

/* t <= sink->limit, which is that of the nearest hit found. */
void hit_offer(HitSink *sink, double t, uint32_t part, double u, double v)
{
    Search *search = (Search *)sink;
    if (search->found && t == sink->limit && !wins_tie(search->prim, part, search->hit))
        return;
    if (search->csg == search->above)
        hit_keep(search, t, part, u, v);
    else
        hit_climb(search, t, part, u, v);
}

/* ---- rays ---- */

/* As affine_apply and affine_apply_linear have it, x and y side by side: 52 instructions instead of 77. */
static inline void ray_carried(const double m[4][3], const Ray *ray, Ray *out)
{
    d2 r0 = d2_load(m[0]), r1 = d2_load(m[1]), r2 = d2_load(m[2]);
    Vec3 o = ray->o, d = ray->d;
    d2 to = d2_add(d2_add(d2_mul(d2_set(d.x), r0), d2_mul(d2_set(d.y), r1)), d2_mul(d2_set(d.z), r2));
    d2 at = d2_add(d2_add(d2_mul(d2_set(o.x), r0), d2_mul(d2_set(o.y), r1)), d2_mul(d2_set(o.z), r2));
    d2_store(&out->o.x, d2_add(at, d2_load(m[3])));
    out->o.z = o.x * m[0][2] + o.y * m[1][2] + o.z * m[2][2] + m[3][2];
    d2_store(&out->d.x, to);
    out->d.z = d.x * m[0][2] + d.y * m[1][2] + d.z * m[2][2];
    out->t_min = ray->t_min;
    out->t_max = ray->t_max;
}

/* The ray in a prim's space. Most prims have no place of their own, and neighbours may share one. */
static __attribute__((noinline)) const Ray *ray_within(Search *search, const Affine *place)
{
    if (search->place != place) {
        search->place = place;
        ray_carried(place->inv, search->ray, &search->local);
    }
    return &search->local;
}

static inline void prim_test(Search *search, uint32_t index)
{
    const Prim *prim = &search->world->prim[index];
    search->prim = index;
    search->csg = prim->csg;
    if ((prim->flags & (search->skip | PRIM_BOUNDED)) && ((prim->flags & search->skip) || !bounds_let_through(search, prim->csg)))
        return;
    prim->ops->hits(prim->data, prim->place->identity ? search->ray : ray_within(search, prim->place), &search->sink);
}

static bool test_item(void *user, uint32_t i, double *t_max)
{
    (void)t_max;                               /* is sink.limit itself */
    Search *search = user;
    prim_test(search, search->world->accel_prim[i]);
    return search->stop;
}

static inline void all_prims(Search *search)
{
    const World *w = search->world;
    for (uint32_t i = 0; i < w->n_unbounded && !search->stop; i++)
        prim_test(search, w->unbounded[i]);
    if (!search->stop && w->n_accel_prims > 0)
        w->accel_ops->walk(w->accel, search->ray, &search->sink.limit, test_item, search);
}

static inline void search_start(Search *search, const World *w, const Ray *ray, uint32_t skip, Hit *hit)
{
    search->sink = (HitSink){ ray->t_min, ray->t_max };
    search->found = search->stop = false;
    search->skip = skip;
    search->above = search->bound = 0;
    search->world = w;
    search->ray = ray;
    search->visit = NULL;
    search->hit = hit;
    search->place = NULL;
}

bool world_nearest(const World *w, const Ray *ray, uint32_t skip, Hit *out)
{
    Search search;                             /* not cleared: the local ray is large, and seldom used */
    search_start(&search, w, ray, skip, out);
    all_prims(&search);
    return search.found;
}

bool world_each_hit(const World *w, const Ray *ray, uint32_t skip, HitVisit *visit, void *user)
{
    Hit hit;
    Search search;
    search_start(&search, w, ray, skip, &hit);
    search.visit = visit;
    search.user = user;
    all_prims(&search);
    return search.stop;
}

bool shaft_each_hit(const World *w, const Shaft *shaft, const Ray *ray, HitVisit *visit, void *user)
{
    Hit hit;
    Search search;
    search_start(&search, w, ray, 0, &hit);    /* what is to be skipped was not gathered */
    search.visit = visit;
    search.user = user;
    for (uint32_t i = 0; i < shaft->n && !search.stop; i++)
        prim_test(&search, shaft->prim[i]);
    return search.stop;
}

static bool first_will_do(void *user, const Hit *hit)
{
    (void)user;
    (void)hit;
    return true;
}

bool prim_meets(const World *w, uint32_t prim, const Ray *ray, uint32_t skip)
{
    Hit hit;
    Search search;
    search_start(&search, w, ray, skip, &hit);
    search.visit = first_will_do;
    prim_test(&search, prim);
    return search.stop;
}

static void item_test(Search *search, uint32_t item)
{
    const World *w = search->world;
    if (!is_node(item)) {
        prim_test(search, item);
        return;
    }
    const CsgNode *node = &w->csg[~item];
    uint32_t n = node->flags & (CSG_CLIP | CSG_BOUND) ? 1 : node->n;       /* helpers show no surface */
    for (uint32_t i = 0; i < n; i++)
        item_test(search, w->csg_child[node->first + i]);
}

bool item_nearest(const World *w, uint32_t item, const Ray *ray, Hit *out)
{
    Search search;
    search_start(&search, w, ray, 0, out);
    search.above = is_node(item) ? w->csg[~item].parent : w->prim[item].csg;
    item_test(&search, item);
    return search.found;
}

/* ---- the surface ---- */

static void add_texture(Surface *s, uint32_t texture)
{
    if (s->n_textures < SURFACE_MAX_TEXTURES) {
        s->texture[s->n_textures].texture = texture;
        s->texture[s->n_textures].weight = 1;
        s->n_textures++;
    }
}

/* The textures of the bodies below `item` that contain p (08-shapes, section 10.5); clips are not asked. */
static void cutaway_textures(const World *w, uint32_t item, Vec3 p, Surface *s)
{
    if (!is_node(item)) {
        uint32_t texture = w->material[w->prim[item].material].texture;
        if (texture != 0 && prim_inside(&w->prim[item], p))
            add_texture(s, texture);
        return;
    }
    const CsgNode *node = &w->csg[~item];
    uint32_t n = node->flags & (CSG_CLIP | CSG_BOUND | CSG_DIFFERENCE) ? 1 : node->n;
    for (uint32_t i = 0; i < n; i++)
        cutaway_textures(w, w->csg_child[node->first + i], p, s);
}

/* A leaf without texture takes those of what it cuts, as the outermost set operation around it sees them. */
static void cutaway_surface(const World *w, const Prim *prim, Surface *s)
{
    uint32_t top = 0;
    for (uint32_t c = prim->csg; c != 0; c = w->csg[c].parent)
        if (!(w->csg[c].flags & (CSG_CLIP | CSG_BOUND)))
            top = c;
    if (top == 0)
        return;
    s->n_textures = 0;
    cutaway_textures(w, ~top, s->p, s);
    for (uint32_t i = 0; i < s->n_textures; i++)
        s->texture[i].weight = 1 / (float)s->n_textures;
}

static bool same_point(Vec3 a, Vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static bool is_zero(Vec3 a)
{
    return a.x == 0 && a.y == 0 && a.z == 0;
}

/* The largest number in what was added to make o + t d, times SURFACE_ERROR: rounding errors are relative to it. */
static inline double error_at(Vec3 o, Vec3 d, double t)
{
    d2 most = d2_max(d2_max(d2_abs(d2_of(o.x, d.x)), d2_abs(d2_of(o.y, d.y))), d2_abs(d2_of(o.z, d.z)));
    double from = d2_low(most), along = fabs(t) * d2_high(most);
    return SURFACE_ERROR * (from > along ? from : along);
}

static Vec3 towards_ray(const Affine *place, const Ray *ray)
{
    return normalized(negated(affine_vector_back(place, ray->d)));
}

/* The same arithmetic with and without a place: one that only scales by a power of two must change no bit. Returns the normal; without
 * `smooth` both are one. Inline, as all waits for it: what comes back through memory comes late. */
__attribute__((always_inline)) static inline Vec3 carry_normals(const Affine *place, bool smooth, double world_error, const Ray *ray,
                                                                Surface *s, Vec3 *geometric)
{
    double l = length(s->normal);
    Vec3 n = l > 0 ? scaled(s->normal, 1 / l) : is_zero(s->normal) ? towards_ray(place, ray) : s->normal;
    Vec3 across = affine_normal(place, smooth ? normalized(s->geometric) : n);
    double stretch = length(across), error = s->error / stretch;
    s->error = error > world_error ? error : world_error;  /* planes a apart become planes a / |across| apart */
    *geometric = stretch > 0 ? scaled(across, 1 / stretch) : across;
    return smooth ? normalized(affine_normal(place, n)) : *geometric;
}

static inline void turn_to_ray(Surface *s, Vec3 n, Vec3 d)
{
    s->back = dot(n, d) > 0;
    n = s->back ? negated(n) : n;
    d2 xy = d2_of(n.x, n.y);                   /* stored as they will be loaded: both at once */
    d2_store(&s->normal.x, xy);
    s->normal.z = n.z;
    d2_store(&s->geometric.x, xy);
    s->geometric.z = n.z;
}

#define ALONE __attribute__((noinline))

ALONE static void carry_face(const Affine *place, const Ray *ray, double t, Surface *s)
{
    Vec3 g;
    s->normal = carry_normals(place, false, error_at(ray->o, ray->d, t), ray, s, &g);
}

/* The normal of a face is mostly of length 1 and stays as it is: no need to wait for roots and quotients that are 1. */
ALONE static void face_surface(const Prim *prim, const Ray *ray, const Hit *hit, Surface *out)
{
    out->error = error_at(ray->o, ray->d, hit->t);
    out->p = ray_at(ray, hit->t);
    prim->ops->surface(prim->data, hit, out);
    if (length2(out->normal) != 1)
        carry_face(prim->place, ray, hit->t, out);
    turn_to_ray(out, out->normal, ray->d);
}

ALONE static void placed_surface(const World *w, const Prim *prim, const Ray *ray, const Hit *hit, Surface *out)
{
    const ShapeOps *ops = prim->ops;
    const Affine *place = prim->place;
    double world_error = error_at(ray->o, ray->d, hit->t);
    Vec3 local = ray_at(ray, hit->t);
    out->error = world_error;
    if (!place->identity) {
        Ray own;
        ray_carried(place->inv, ray, &own);
        out->error = error_at(own.o, own.d, hit->t);
        local = ray_at(&own, hit->t);
    }
    out->p = local;
    bool smooth = (ops->flags & SHAPE_SMOOTH) != 0;
    if (smooth)
        out->geometric = vec3(0, 0, 0);
    ops->surface(prim->data, hit, out);

    Vec3 g;
    smooth = smooth && !is_zero(out->geometric);
    Vec3 n = carry_normals(place, smooth, world_error, ray, out, &g);
    if (!place->identity)
        out->p = same_point(out->p, local) ? ray_at(ray, hit->t) : affine_apply(place->m, out->p);
    bool turned = (prim->flags & PRIM_INVERSE) && !(ops->flags & SHAPE_NORMAL_STAYS);
    turn_to_ray(out, turned ? negated(n) : n, ray->d);
    if (smooth || turned)
        out->geometric = dot(g, ray->d) > 0 ? negated(g) : g;
    if (w->material[prim->material].flags & MATERIAL_CUTAWAY)
        cutaway_surface(w, prim, out);
}

ALONE static void flat_uv_surface(const World *w, const Ray *ray, const Hit *hit, Surface *out)
{
    world_surface(w, ray, hit, false, out);
    out->uv = (Vec2){ out->p.x / w->unit, out->p.y / w->unit };
}

/* Each way by itself, so that the short one need not save what the long one needs. */
void world_surface(const World *w, const Ray *ray, const Hit *hit, bool want_uv, Surface *out)
{
    const Prim *prim = &w->prim[hit->prim];
    if (want_uv && !(prim->ops->flags & SHAPE_HAS_UV)) {
        flat_uv_surface(w, ray, hit, out);
        return;
    }
    out->uv = (Vec2){ 0, 0 };
    out->want_uv = want_uv;
    out->n_textures = 0;
    if (prim->flags & PRIM_FACE)
        face_surface(prim, ray, hit, out);
    else
        placed_surface(w, prim, ray, hit, out);
}

/* ---- bodies around a point ---- */

enum { MAX_BODIES = 64 };

typedef struct Bodies {
    const World *world;
    Vec3 p;
    uint32_t n, item[MAX_BODIES];              /* by scene order */
} Bodies;

static uint32_t item_order(const World *w, uint32_t item)
{
    return is_node(item) ? w->csg[~item].first_prim : item;
}

static void add_body(Bodies *b, uint32_t item)
{
    uint32_t at = b->n, order = item_order(b->world, item);
    while (at > 0 && item_order(b->world, b->item[at - 1]) > order)
        at--;
    if ((at > 0 && b->item[at - 1] == item) || b->n == MAX_BODIES)
        return;
    memmove(&b->item[at + 1], &b->item[at], (b->n - at) * sizeof b->item[0]);
    b->item[at] = item;
    b->n++;
}

/* Below clips and bounds: their body. */
static uint32_t unclipped(const World *w, uint32_t item)
{
    while (is_node(item) && (w->csg[~item].flags & (CSG_CLIP | CSG_BOUND)))
        item = w->csg_child[w->csg[~item].first];
    return item;
}

/* A bounded body that contains p has a leaf whose cut box contains p. */
static bool leaf_around(void *user, uint32_t i, double *t_max)
{
    (void)t_max;
    Bodies *b = user;
    const World *w = b->world;
    uint32_t item = w->accel_prim[i];
    if (!bounds_contain(w->box[item], b->p))
        return false;                          /* accelerators may offer more than they have to */
    for (uint32_t c = w->prim[item].csg; c != 0; c = w->csg[c].parent)
        item = ~c;
    if (item_inside(w, item, b->p))
        add_body(b, item);
    return false;
}

/* POV: who lies outside the box of a body is not in it, though its inside may reach further: a disc's, an inverse sphere's,
 * that of a clipped plane. */
static bool boxed_around(const World *w, uint32_t item, Vec3 p)
{
    if (!is_node(item))
        return bounds_contain(w->box[item], p);
    const CsgNode *node = &w->csg[~item];
    for (uint32_t i = node->first_prim; i < node->first_prim + node->n_prims; i++)
        if (!(w->prim[i].flags & PRIM_HELPER) && bounds_contain(w->box[i], p))
            return true;
    return false;
}

uint32_t world_interiors_at(const World *w, Vec3 p, uint32_t *interior, uint32_t max)
{
    Bodies b = { .world = w, .p = p };
    for (uint32_t i = 0; i < w->n_bodies; i++)
        if (boxed_around(w, w->body[i], p) && item_inside(w, unclipped(w, w->body[i]), p))
            add_body(&b, w->body[i]);
    if (w->n_accel_prims > 0)
        w->accel_ops->around(w->accel, p, leaf_around, &b);
    uint32_t n = 0;
    for (uint32_t i = 0; i < b.n && n < max; i++) {
        uint32_t item = unclipped(w, b.item[i]);
        uint32_t found = is_node(item) ? w->csg[~item].interior : w->material[w->prim[item].material].interior;
        uint32_t j = 0;
        while (j < n && interior[j] != found)
            j++;
        if (j == n)
            interior[n++] = found;
    }
    return n;
}
