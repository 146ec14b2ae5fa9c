/* shadow.c - how much light gets from a light source to a surface (04-shading, section 6).
 *
 * One walk over all that lies between: the first opaque hit ends it, whichever comes first, and transparent ones are collected and
 * multiplied afterwards in their order along the ray. The prim that hid a light last is asked first; that changes no answer, since
 * any opaque blocker means dark. */
#include "trace/path.h"

enum { VEILS_MAX = 32 };                       /* transparent hits kept at once; more are walked in further rounds */

typedef struct Veils {
    const World *world;
    Hit hit[VEILS_MAX];
    uint32_t n;
    bool overflowed;                           /* those kept are the nearest */
    uint32_t blocker;                          /* the opaque prim found */
} Veils;

static int hit_order(const Hit *h, const Hit *k)
{
    if (h->t != k->t)
        return h->t < k->t ? -1 : 1;
    if (h->prim != k->prim)
        return h->prim < k->prim ? -1 : 1;
    return h->part < k->part ? -1 : h->part > k->part;
}

static void sort_hits(Hit *hit, uint32_t n)     /* few */
{
    for (uint32_t i = 1; i < n; i++) {
        Hit h = hit[i];
        uint32_t at = i;
        for (; at > 0 && hit_order(&hit[at - 1], &h) > 0; at--)
            hit[at] = hit[at - 1];
        hit[at] = h;
    }
}

static bool keep_veil(void *user, const Hit *hit)
{
    Veils *veils = user;
    if (veils->world->prim[hit->prim].flags & PRIM_OPAQUE) {
        veils->blocker = hit->prim;
        return true;
    }
    for (uint32_t i = 0; i < veils->n; i++)    /* walks may offer a hit twice */
        if (hit_order(&veils->hit[i], hit) == 0)
            return false;
    if (veils->n < VEILS_MAX) {
        veils->hit[veils->n++] = *hit;
        return false;
    }
    veils->overflowed = true;
    uint32_t last = 0;
    for (uint32_t i = 1; i < VEILS_MAX; i++)
        if (hit_order(&veils->hit[i], &veils->hit[last]) > 0)
            last = i;
    if (hit_order(hit, &veils->hit[last]) < 0)
        veils->hit[last] = *hit;
    return false;
}

/* ---- one surface in the way ---- */

typedef struct Veil {
    const Tracer *t;
    const Surface *surface;
    Vec3 l;
    double caustics;
    TextureContext at;                         /* if at.hit: a texture asked for it */
    float weight;                              /* of the texture among several */
    Rgb sum;
} Veil;

/* Light gathers where it falls straight on the surface. */
static Rgb caustic(Veil *veil, const TextureLeaf *leaf, const Texture *layer, TextureContext *at, Rgb pass)
{
    Vec3 n = texture_layer_normal(leaf, layer, veil->surface->normal, at);
    return rgb_scaled(pass, (float)(1 + pow(fabs(dot(n, veil->l)), veil->caustics)));
}

static void pass_leaf(void *user, const TextureLeaf *leaf)
{
    Veil *veil = user;
    Rgb pass = rgb_grey(1);
    TextureContext bumpy, *at = &veil->at;
    if (veil->caustics != 0) {                 /* each leaf begins with the surface's own normal */
        bumpy = veil->at;
        at = &bumpy;
    }
    for (const Texture *layer = leaf->top; layer != NULL; layer = layer->below) {
        if (veil->caustics != 0)
            pass = caustic(veil, leaf, layer, at, pass);
        bool found = true;
        Colour c = texture_layer_colour(leaf, layer, at, &found);
        if (found)
            pass = rgb_mul(pass, colour_transmittance(c));
    }
    veil->sum = rgb_add(veil->sum, rgb_scaled(pass, leaf->weight * veil->weight));
}

static void pass_texture(Veil *veil, const Material *m, uint32_t texture)
{
    const Tracing *tracing = veil->t->tracing;
    const TextureLeaf *flat = &tracing->coat[texture].leaf;
    if (veil->weight < (float)tracing->ticket.adc_bailout || texture == 0)
        return;
    if (flat->top != NULL) {
        pass_leaf(veil, flat);
        return;
    }
    const Surface *surface = veil->surface;
    if (!veil->at.hit)
        veil->at = texture_context(tracing, surface, veil->l);
    Vec3 p = m->flags & MATERIAL_UV ? vec3(surface->uv.u, surface->uv.v, 0) : veil->at.point;
    texture_resolve(&tracing->world->texture[texture], p, &veil->at, pass_leaf, veil);
}

static Rgb surface_passes(const Tracer *t, const Ray *ray, const Surface *surface, const Material *m)
{
    const World *w = t->world;
    Veil veil;                                 /* not cleared: few textures ask for the context */
    veil.t = t;
    veil.surface = surface;
    veil.l = ray->d;
    veil.caustics = (double)w->interior[m->interior].interior->caustics;
    veil.at.hit = false;
    veil.weight = 1;
    veil.sum = rgb_grey(0);
    uint32_t texture = surface->back && (m->flags & MATERIAL_HAS_INTERIOR_TEXTURE) ? m->interior_texture : m->texture;
    if (surface->n_textures == 0)
        pass_texture(&veil, m, texture);
    for (uint32_t i = 0; i < surface->n_textures; i++) {
        veil.weight = surface->texture[i].weight;
        pass_texture(&veil, m, surface->texture[i].texture != 0 ? surface->texture[i].texture : texture);
    }
    return veil.sum;
}

/* ---- the walk ---- */

typedef struct Walk {
    Tracer *t;
    Ray ray;
    Interiors in;
    double done;                               /* how far it has come */
    double clear;                              /* surfaces up to here coincide with the last one ... */
    const Hit *last;                           /* ... once this one is looked at; NULL: it was */
    bool stepwise;                             /* a new ray begins behind each surface: some shapes tell only their first hits */
    bool in_air;                               /* fog and media of the air dim this light */
    Rgb colour;
} Walk;

static void dim_by_air(Walk *walk, double to)
{
    if (walk->t->world->scene->n_media > 0)
        walk->colour = rgb_mul(walk->colour, media_dims_air(walk->t, ray_at(&walk->ray, walk->done), walk->ray.d, to - walk->done));
    if (walk->t->tracing->n_fog == 0 || !interiors_hollow(walk->t->world, &walk->in))
        return;
    FogPass pass = fog_pass(walk->t->tracing, ray_at(&walk->ray, walk->done), walk->ray.d, to - walk->done);
    walk->colour = rgb_mul(walk->colour, pass.factor);
}

static void look_at(Walk *walk, const Hit *hit, Surface *surface)
{
    world_surface(walk->t->world, &walk->ray, hit, walk->t->tracing->wants_uv, surface);
    double slope = fabs(dot(surface->geometric, walk->ray.d));
    walk->clear = hit->t + 2 * surface->error / (slope > 0x1p-20 ? slope : 0x1p-20);
}

/* The last surface of an even pane is looked at when another one follows. */
static inline bool coincides(Walk *walk, const Hit *hit)
{
    if (walk->last != NULL) {
        Surface surface;
        look_at(walk, walk->last, &surface);
        walk->last = NULL;
    }
    return hit->t <= walk->clear;
}

/* behind: where a new ray begins, if the walk is stepwise. */
static Rgb pane_passes(Walk *walk, const Hit *hit, uint32_t material, Vec3 *behind)
{
    const Pane *pane = &walk->t->tracing->pane[material];
    if (pane->even && !walk->stepwise) {
        walk->last = hit;
        return pane->passes;
    }
    Surface surface;
    look_at(walk, hit, &surface);
    *behind = surface_offset(&surface, walk->ray.d);
    return surface_passes(walk->t, &walk->ray, &surface, &walk->t->world->material[material]);
}

static void pass_surface(Walk *walk, const Hit *hit)
{
    Tracer *t = walk->t;
    const World *w = t->world;
    uint32_t material = w->prim[hit->prim].material, interior = w->material[material].interior;
    Vec3 behind;
    walk->colour = rgb_mul(walk->colour, pane_passes(walk, hit, material, &behind));
    const Interior *body = w->interior[interior].interior;
    int place = interiors_find(&walk->in, interior);
    if (place >= 0 && body->fade_power > 0 && body->fade_distance != 0)
        walk->colour = rgb_mul(walk->colour, interior_fade(body, (hit->t - walk->done) * t->tracing->to_scene));
    if (t->tracing->has_media)
        walk->colour = rgb_mul(walk->colour, media_dims_bodies(t, &walk->in, ray_at(&walk->ray, walk->done), walk->ray.d,
                                                               hit->t - walk->done));
    if (walk->in_air)
        dim_by_air(walk, hit->t);
    if (place >= 0)
        interiors_remove(&walk->in, (uint32_t)place);
    else
        interiors_add(&walk->in, interior);
    if (walk->stepwise) {
        walk->ray = (Ray){ behind, walk->ray.d, 0, walk->ray.t_max - hit->t };
        walk->done = walk->clear = 0;
        return;
    }
    walk->done = hit->t;
}

/* Not for a light that an object of the scene has to pass first. */
static bool still_hidden(Tracer *t, uint32_t light, const Ray *ray)
{
    uint32_t last = t->last_blocker[light];
    if (last == 0)
        return false;
    if (prim_meets(t->world, last - 1, ray, PRIM_NO_SHADOW))
        return true;
    t->last_blocker[light] = 0;
    return false;
}

/* Fills `veils` with what the ray meets next; false: something opaque stands in the way. */
static inline bool find_veils(Tracer *t, const Ray *ray, uint32_t light, const Shaft *among, Veils *veils)
{
    const World *w = t->world;
    veils->world = w;
    veils->n = 0;
    veils->overflowed = false;
    bool hidden = among != NULL ? shaft_each_hit(w, among, ray, keep_veil, veils)
                                : world_each_hit(w, ray, PRIM_NO_SHADOW, keep_veil, veils);
    if (hidden)
        t->last_blocker[light] = veils->blocker + 1;
    return !hidden;
}

/* Passes the surfaces found, and goes on. Kept out of the way of rays that meet none. */
__attribute__((noinline)) static Rgb pass_veils(const Spot *spot, uint32_t light, const Shaft *among, const Ray *ray, Veils *veils, Rgb colour)
{
    Walk walk;
    walk.t = spot->t;
    walk.ray = *ray;
    walk.done = walk.clear = 0;
    walk.stepwise = (spot->t->world->features & WORLD_HAS_FIRST_HITS) != 0;
    walk.last = NULL;
    walk.in_air = shadow_dims(spot->t, &spot->t->world->light[light]);
    walk.colour = colour;
    interiors_copy(&walk.in, spot->in);
    for (;;) {
        sort_hits(veils->hit, veils->n);
        uint32_t n = walk.stepwise && veils->n > 0 ? 1 : veils->n;
        for (uint32_t i = 0; i < n; i++) {
            if (coincides(&walk, &veils->hit[i]))
                continue;                      /* seen as one surface, as rays that go on from it see it */
            pass_surface(&walk, &veils->hit[i]);
            if (rgb_is_zero(walk.colour))
                return walk.colour;
        }
        if (walk.stepwise ? n == 0 : !veils->overflowed)
            break;
        if (!walk.stepwise) {
            const Hit *last = &veils->hit[veils->n - 1];
            walk.ray.t_min = last->t;
            coincides(&walk, last);            /* looks at it while it is there */
        }
        if (!find_veils(walk.t, &walk.ray, light, among, veils))
            return rgb_grey(0);
    }
    if (walk.in_air)
        dim_by_air(&walk, walk.ray.t_max);
    return walk.colour;
}

bool shadow_dims(const Tracer *t, const Light *light)
{
    return t->tracing->air_dims && light->def->media_attenuation && light->def->media_interaction;
}

static bool darkened(Beam *beam)
{
    beam->colour = rgb_grey(0);
    return false;
}

bool shadow_walk(const Spot *spot, uint32_t light, Beam *beam, const Shaft *among)
{
    Tracer *t = spot->t;
    const Light *source = &t->world->light[light];
    Seen seen = among == NULL && t->nook_credit[light] >= 0 ? nook_sees(spot, light, beam) : SEEN_PERHAPS;
    if (seen != SEEN_PERHAPS)
        return seen == SEEN_FULLY || darkened(beam);
    Ray ray = shadow_ray(spot, beam->l, beam->d);
    if (source->projected_through != 0) {
        Hit hit;
        if (!item_nearest(t->world, source->projected_through - 1, &ray, &hit))
            return darkened(beam);
        if (source->def->shadowless)
            return true;
        ray.t_max = hit.t * LIGHT_END;         /* only what stands on this side of the projecting surface counts */
    }
    if (among == NULL && still_hidden(t, light, &ray))
        return darkened(beam);
    Veils veils;                               /* not cleared: its hits are many */
    if (!find_veils(t, &ray, light, among, &veils))
        return darkened(beam);
    if (veils.n == 0 && !shadow_dims(t, source))
        return true;
    beam->colour = pass_veils(spot, light, among, &ray, &veils, beam->colour);
    return !is_dark(beam->colour);
}
