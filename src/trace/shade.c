/* shade.c - a hit to a colour: textures, layers, their light, and the rays that go on (04-shading, sections 3, 4, 7). */
#include "trace/path.h"

/* Kept apart, so that the ways taken most need not make room for what the others do. */
#define ALONE __attribute__((noinline))

enum { MIRRORS_MAX = 8 };                      /* layers that reflect, kept until it is known what passes through */

typedef struct Mirror {
    Polish polish;
    Rgb share;
    double weight;
    Rgb light;                                 /* once its ray is back */
} Mirror;

typedef struct Mirrors {
    uint32_t n;
    Rgb rest;                                  /* reflected by layers that found no room here */
    Mirror mirror[MIRRORS_MAX + 1];            /* the last is never kept */
} Mirrors;

typedef struct Around {                        /* light from all around, gathered once for all layers */
    bool known;
    Rgb front, back;
} Around;

typedef struct Stack {                         /* a leaf's layers, as far as they have been gone through */
    Rgb sum, filter;
    double through;
    bool filtered;                             /* some layer had a colour */
    bool open;                                 /* some shadows are still to be asked for: they leave from `sum` up to `most` */
    Rgb most, own;                             /* own: without any lights */
} Stack;

/* ---- reflectivity ---- */

static double fresnel(double q, double cosine)
{
    double s = q * q + cosine * cosine - 1;
    if (s <= 0)
        return 1;
    double g = sqrt(s), minus = g - cosine, plus = g + cosine;
    double a = minus / plus, b = (cosine * plus - 1) / (cosine * minus + 1);
    double share = 0.5 * a * a * (1 + b * b);
    return share > 1 ? 1 : share > 0 ? share : 0;
}

static Rgb mix(Rgb low, Rgb high, double x)
{
    return rgb_add(rgb_scaled(high, (float)x), rgb_scaled(low, (float)(1 - x)));
}

static Rgb reflectivity(const Shade *s, const Layer *layer, const Vec3 *n)
{
    const Finish *f = layer->finish;
    double cosine = -dot(s->path->ray.d, *n);
    Rgb r;
    if (f->reflection_fresnel) {
        double share = fresnel(interior_ratio(s->t->world, s->path->in, s->interior), cosine);
        r = mix(f->reflection_min, f->reflection_max, share);
    } else {
        double x = f->reflection_falloff == 1 ? 1 - cosine : pow(1 - cosine, (double)f->reflection_falloff);
        if (fabs(x) < TINY)
            r = f->reflection_min;
        else if (fabs(x - 1) < TINY)
            r = f->reflection_max;
        else
            r = mix(f->reflection_min, f->reflection_max, x);
    }
    if (f->reflection_metallic != 0) {
        float m = f->reflection_metallic * (1 - (float)finish_metallic_fresnel(cosine));
        r = rgb_mul(r, rgb_add(rgb_grey(1), rgb_scaled(rgb_sub(layer->colour, rgb_grey(1)), m)));
    }
    return r;
}

/* Rays are given up by the most that a finish may reflect, unless that depends on the angle by its nature. */
static double mirror_weight(const Finish *f, Rgb share)
{
    float most = rgb_max(f->reflection_max), least = rgb_max(f->reflection_min);
    return (double)(f->reflection_fresnel ? rgb_max(share) : most > least ? most : least);
}

static Rgb mirror_light(const Shade *s, const Mirror *m)
{
    Rgb seen = rgb_of(shade_reflect(s, &m->polish, m->weight));
    float e = m->polish.finish->reflection_exponent;
    if (e != 1 && e != 0)
        seen = rgb(powf(seen[0], 1 / e), powf(seen[1], 1 / e), powf(seen[2], 1 / e));
    return rgb_mul(seen, m->share);
}

static void remember_mirror(const Shade *s, const Finish *f, const Vec3 *n, Rgb share, double through, Mirrors *mirrors)
{
    if (rgb_is_zero(share) || s->t->tracing->quality < 8)
        return;
    double weight = s->path->weight * through * mirror_weight(f, share);
    if (shade_gives_up(s, weight) && f->reflection_exponent >= 0)
        return;                                /* black, and a power of black */
    Mirror *m = &mirrors->mirror[mirrors->n];
    m->polish.finish = f;
    m->polish.n = *n;
    m->share = share;
    m->weight = weight;
    if (mirrors->n < MIRRORS_MAX)
        mirrors->n++;
    else
        mirrors->rest = rgb_add(mirrors->rest, mirror_light(s, m));
}

/* ---- the look of a layer ---- */

static float opacity(const Tracing *tracing, Colour c)
{
    if (tracing->legacy)
        return 1 - (c.f * rgb_max(rgb_of(c)) + c.t);
    return 1 - c.f - c.t;
}

static inline Layer layer_of(const Tracing *tracing, const Finish *finish, Colour c)
{
    return (Layer){ finish, rgb_of(c), (double)opacity(tracing, c) };
}

/* What the layer sends out without any light. */
static inline Rgb layer_glow(const Tracing *tracing, const Layer *layer)
{
    Rgb glow = rgb_add(rgb_mul(layer->finish->ambient, tracing->ambient_light), layer->finish->emission);
    return rgb_scaled(rgb_mul(layer->colour, glow), (float)layer->opacity);
}

/* Highlights of a clear thing, and no other light of lights. */
static inline bool shines_only(const Tracing *tracing, const Layer *layer)
{
    return tracing->shadows_dim && layer->finish->traits & FINISH_GLOSSY && !(layer->finish->traits & (FINISH_GRAINY | FINISH_FILM)) &&
           (layer->opacity == 0 || layer->finish->diffuse == 0);
}

static inline void look_start(Look *out, const Tracing *tracing, const Finish *finish, Colour c, bool found)
{
    out->layer = layer_of(tracing, finish, c);
    out->glow = layer_glow(tracing, &out->layer);
    out->pass = colour_transmittance(c);
    out->found = found;
    out->hides = found && tracing->quality > 1 && rgb_is_zero(out->pass) && !(finish->traits & FINISH_MIRRORS);
    out->shines_only = shines_only(tracing, &out->layer);
}

/* n: that of the layer, perhaps kept in `bumps`. */
static inline const Vec3 *look_at(Shade *s, const TextureLeaf *leaf, const Texture *texture, Look *out, Vec3 *bumps)
{
    const Tracing *tracing = s->t->tracing;
    const Vec3 *n = &s->surface->normal;
    if (texture->normal != NULL && tracing->quality >= 8) {
        *bumps = texture_layer_bumps(leaf, texture, *n, &s->at);
        n = bumps;
    }
    bool found = true;                         /* else clear white: what is metallic mirrors and shines untinted */
    Colour c = texture_layer_colour(leaf, texture, &s->at, &found);
    look_start(out, tracing, texture->finish, c, found);
    return n;
}

/* ---- what a layer sends ---- */

/* Gathered for the first layer that shows enough of it. */
static Rgb light_around(const Shade *s, const Layer *layer, const Vec3 *n, Rgb filter, Around *around)
{
    const Finish *f = layer->finish;
    if (f->has_subsurface || !gather_here(s))
        return rgb_grey(0);
    double seen = (double)rgb_greyness(rgb_mul(filter, layer->colour)) * layer->opacity *
                  (double)f->diffuse;
    if (!around->known && seen > s->path->ticket->adc_bailout) {
        around->known = true;
        around->front = around->back = rgb_grey(0);
        Vec3 raw = s->surface->normal;
        around->front = gathered_light(s, *n, raw, s->path->weight * seen);
        if (f->diffuse_back != 0)
            around->back = gathered_light(s, negated(*n), negated(raw), s->path->weight * seen);
    }
    if (!around->known)
        return rgb_grey(0);
    Rgb light = rgb_add(rgb_scaled(around->front, f->diffuse), rgb_scaled(around->back, f->diffuse_back));
    return rgb_scaled(rgb_mul(layer->colour, light), (float)layer->opacity);
}

/* Without lights, mirrors left aside. */
static inline Rgb layer_own(Shade *s, const Look *look, const Vec3 *n, Rgb filter, Around *around)
{
    return s->t->tracing->radiosity ? rgb_add(look->glow, light_around(s, &look->layer, n, filter, around)) : look->glow;
}

static inline float kept(float share)          /* of the light that conserves its energy */
{
    return 1 - share < 1 ? 1 - share : 1;
}

static Rgb layer_light(Shade *s, const Look *look, const Vec3 *n, Stack *k, Around *around)
{
    Rgb own = layer_own(s, look, n, k->filter, around);
    if (!k->open)
        return rgb_add(own, shade_lights(s, &look->layer, n));
    Rgb most, least = shade_lights_loosely(s, &look->layer, n, &most);
    k->open = !rgb_same(least, most);
    k->own = own;
    k->most = rgb_add(own, most);
    return rgb_add(own, least);
}

static void add_layer(Shade *s, const Look *look, const Vec3 *n, Stack *k, Mirrors *mirrors, Around *around)
{
    Rgb share = rgb_grey(0);
    if (s->t->tracing->quality <= 1) {
        k->sum = look->layer.colour;
    } else {
        if (look->layer.finish->traits & FINISH_MIRRORS) {
            share = reflectivity(s, &look->layer, n);
            remember_mirror(s, look->layer.finish, n, share, k->through, mirrors);
        }
        k->sum = rgb_add(k->sum, rgb_mul(layer_light(s, look, n, k, around), k->filter));
    }
    if (look->found) {
        k->filter = rgb_mul(k->filter, look->pass);
        k->filtered = true;
        if (look->layer.finish->conserve_energy)
            k->filter = rgb_mul(k->filter, rgb(kept(share[0]), kept(share[1]), kept(share[2])));
    }
    double grey = fabs((double)rgb_greyness(k->filter));
    k->through = grey < 1 ? grey : 1;
}

static bool same_normal(Vec3 a, Vec3 b)
{
    return fabs(a.x - b.x) <= TINY && fabs(a.y - b.y) <= TINY && fabs(a.z - b.z) <= TINY;
}

/* What the layers send, and what the rays have brought. */
static Rgb all_seen(Rgb layers, const Mirrors *mirrors, const Passed *passed)
{
    Rgb sum = rgb_add(rgb_add(layers, mirrors->rest), passed->light);
    for (uint32_t i = 0; i < mirrors->n; i++)
        sum = rgb_add(sum, mirrors->mirror[i].light);
    return sum;
}

/* Sends the rays of a leaf, and sees its layers under what they bring. Highlights of clear things are faint nearly everywhere: where
 * more light passes, all sums come out alike whoever hides the light, and nobody need ask (rounding is monotone). */
static Rgb shade_rays(Shade *s, const Polish *top, const Look *look, const Stack *k, Mirrors *mirrors, Passed *passed)
{
    bool total = false;
    if (k->through > s->path->ticket->adc_bailout && s->t->tracing->quality >= 6)
        total = shade_transmit(s, top, k->filter, k->filtered, k->through, passed);
    for (uint32_t i = 0; i < mirrors->n; i++) {
        Mirror *m = &mirrors->mirror[i];
        bool came_back = total && same_normal(m->polish.n, top->n);    /* the same light, already */
        m->light = came_back ? rgb_grey(0) : mirror_light(s, m);
    }
    Rgb seen = all_seen(k->sum, mirrors, passed);
    if (!k->open || rgb_same(seen, all_seen(k->most, mirrors, passed)))
        return seen;
    return all_seen(rgb_add(k->own, shade_lights(s, &look->layer, &top->n)), mirrors, passed);
}

/* The way of all leaves that mirror or let through, the top layer looked at. */
ALONE static void shade_stack(Shade *s, const TextureLeaf *leaf, const Look *look, const Vec3 *n)
{
    double bailout = s->path->ticket->adc_bailout;
    Stack k;
    k.sum = rgb_grey(0);
    k.filter = rgb_grey(1);
    k.through = 1;
    k.filtered = false;
    k.most = k.own = rgb_grey(0);
    k.open = look->shines_only && leaf->top->below == NULL && s->t->tracing->quality > 1;
    Polish top = { leaf->top->finish, *n };
    Around around;                             /* not cleared, as the mirrors: large, and few */
    around.known = false;
    Mirrors mirrors;
    mirrors.n = 0;
    mirrors.rest = rgb_grey(0);
    Look below;
    Vec3 bumps;
    for (const Texture *texture = leaf->top;;) {
        add_layer(s, look, n, &k, &mirrors, &around);
        texture = texture->below;
        if (texture == NULL || !(k.through > bailout))
            break;
        n = look_at(s, leaf, texture, &below, &bumps);
        look = &below;
    }
    Passed passed = { rgb_grey(0), 0 };
    Rgb seen = shade_rays(s, &top, look, &k, &mirrors, &passed);
    s->sum = colour_add(s->sum, colour_scaled(colour_of(seen, 0, passed.t), leaf->weight));
}

/* Most leaves are matte, and need no stack: their light is all. */
ALONE static void shade_only(Shade *s, const TextureLeaf *leaf, const Look *look, const Vec3 *n)
{
    Around around;
    around.known = false;
    Rgb own = layer_own(s, look, n, rgb_grey(1), &around);
    Rgb light = rgb_scaled(rgb_add(own, shade_lights(s, &look->layer, n)), leaf->weight);
    s->sum = colour_of(rgb_add(rgb_of(s->sum), light), s->sum.f, s->sum.t);
}

static inline void shade_look(Shade *s, const TextureLeaf *leaf, const Look *look, const Vec3 *n)
{
    if (look->hides && s->path->ticket->adc_bailout >= 0)
        shade_only(s, leaf, look, n);
    else
        shade_stack(s, leaf, look, n);
}

static void shade_leaf(void *user, const TextureLeaf *leaf)
{
    Shade *s = user;
    if (!(s->path->ticket->adc_bailout < 1))
        return;                                /* not even the top layer counts */
    Look look;
    Vec3 bumps;
    const Vec3 *n = look_at(s, leaf, leaf->top, &look, &bumps);
    shade_look(s, leaf, &look, n);
}

/* A ray that gathers light has its own bailout, and brings what the layer itself does not know of. */
void coat_prepare(Coat *coat, const Tracing *tracing, const Texture *texture)
{
    double bailout = tracing->ticket.adc_bailout;
    const Pigment *pigment = texture->pigment;
    bool alone = !tracing->radiosity && bailout < 1;
    if (texture_is_flat(texture)) {
        coat->leaf = (TextureLeaf){ .top = texture, .weight = 1 };
        look_start(&coat->look, tracing, texture->finish, pigment->colour, true);
        coat->matte = alone && bailout >= 0 && coat->look.hides;
        coat->once = texture->below == NULL && !coat->look.shines_only;
    } else if (texture->kind == TEXTURE_PLAIN && pigment->kind == PIGMENT_PATTERN && pigment->quick == NULL && pigment_is_opaque(pigment)) {
        look_start(&coat->look, tracing, texture->finish, (Colour){ 1, 1, 1, 0, 0 }, true);
        coat->matte = alone && bailout >= 0 && coat->look.hides;
        coat->pattern = pigment;
    }
}

/* ---- a hit ---- */

/* Where textures are asked. */
static inline Vec3 texture_place(const Shade *s)
{
    return s->material->flags & MATERIAL_UV ? vec3(s->surface->uv.u, s->surface->uv.v, 0) : s->at.point;
}

ALONE static void shade_uneven(Shade *s, uint32_t texture)
{
    if (!s->at.hit)                            /* once: what a normal does to it is seen by the textures that follow */
        s->at = texture_context(s->t->tracing, s->surface, s->path->ray.d);
    texture_resolve(&s->t->world->texture[texture], texture_place(s), &s->at, shade_leaf, s);
}

static inline void shade_texture(Shade *s, uint32_t texture)
{
    const Coat *coat = &s->t->tracing->coat[texture];
    if (coat->leaf.top != NULL) {
        if (s->path->ticket->adc_bailout < 1)
            shade_look(s, &coat->leaf, &coat->look, &s->surface->normal);
    } else if (texture != 0)
        shade_uneven(s, texture);
}

/* The light of a matte coat, without a walk through its texture. False: something shines through it, if less than counts. */
static inline bool shade_matte(Shade *s, const Coat *coat, uint32_t texture, Rgb *out)
{
    const Tracing *tracing = s->t->tracing;
    s->lamps = s->path->ticket->lamps & ~(unsigned)LAMP_REMEMBERED;    /* nobody asks again */
    if (coat->pattern == NULL) {
        *out = rgb_add(coat->look.glow, shade_lights(s, &coat->look.layer, &s->surface->normal));
        return true;
    }
    const PlacedTexture *placed = &s->t->world->texture[texture];
    const Texture *top = placed->texture;
    s->at = texture_context(tracing, s->surface, s->path->ray.d);
    Vec3 p = texture_place(s), bumps;
    if (placed->place != NULL)
        p = affine_point_back(placed->place, p);
    const Vec3 *n = &s->surface->normal;
    if (top->normal != NULL && tracing->quality >= 8) {
        TextureLeaf leaf = { .top = top, .p = p, .weight = 1, .place = placed->place };
        bumps = texture_layer_bumps(&leaf, top, *n, &s->at);
        n = &bumps;
    }
    Colour c = pigment_patterned(coat->pattern, &p, &s->at);
    Layer layer = { top->finish, rgb_of(c), 1 };
    if (layer.colour[3] != 0 || c.t != 0)
        return false;
    Rgb glow = rgb_mul(layer.colour, coat->look.glow);
    *out = rgb_add(glow, shade_lights(s, &layer, n));
    return true;
}

/* One of several. */
static void shade_share(Shade *s, uint32_t texture, float weight)
{
    if (weight < (float)s->path->ticket->adc_bailout)
        return;
    Colour before = s->sum;
    s->sum = (Colour){ 0, 0, 0, 0, 0 };
    shade_texture(s, texture);
    s->sum = colour_add(before, weight == 1 ? s->sum : colour_scaled(s->sum, weight));
}

ALONE static void shade_shares(Shade *s, uint32_t texture)
{
    const Surface *surface = s->surface;
    for (uint32_t i = 0; i < surface->n_textures; i++)
        shade_share(s, surface->texture[i].texture != 0 ? surface->texture[i].texture : texture, surface->texture[i].weight);
}

/* The way of all hits that no matte coat makes short, `s` begun. Kept apart: the short way need not save what this needs. */
ALONE static void shade_textures(Shade *s, const Hit *hit, uint32_t texture)
{
    const Path *path = s->path;
    bool alone = s->surface->n_textures == 0;
    s->lamps = path->ticket->lamps;
    if (alone && s->t->tracing->coat[texture].once)
        s->lamps &= ~(unsigned)LAMP_REMEMBERED;
    s->interior = s->material->interior;
    s->depth = hit->t;
    s->level = path->level + (path->straight ? 0 : 1);
    s->at.hit = false;
    s->known = 0;
    s->sum = (Colour){ 0, 0, 0, 0, 0 };
    s->t->nesting++;
    if (alone)
        shade_texture(s, texture);
    else
        shade_shares(s, texture);
    s->t->nesting--;
}

/* What is seen of a hit, and how far it is. */
static inline Colour shaded(Tracer *t, const Path *path, const Material *m, double depth, Colour c)
{
    t->depth = depth;
    return t->tracing->has_media ? media_bodies(t, path, m, depth, c) : c;
}

Colour shade_hit(Tracer *t, const Path *path, const Hit *hit)
{
    const World *w = t->world;
    const Tracing *tracing = t->tracing;
    uint32_t material = w->prim[hit->prim].material;
    const Material *m = &w->material[material];
    Surface surface;
    world_surface(w, &path->ray, hit, tracing->wants_uv, &surface);
    uint32_t texture = surface.back && (m->flags & MATERIAL_HAS_INTERIOR_TEXTURE) ? m->interior_texture : m->texture;
    Shade s;                                   /* not cleared: nothing of `light` is known, nor the context */
    s.t = t;
    s.path = path;
    s.surface = &surface;
    s.material = m;
    s.lit_by = &tracing->lit_by[material];
    s.spot = (Spot){ t, surface.p, &surface, path->in, hit->prim };
    const Coat *coat = &tracing->coat[texture];
    Rgb light;
    if (coat->matte && surface.n_textures == 0 && shade_matte(&s, coat, texture, &light))
        return shaded(t, path, m, hit->t, colour_of(light, 0, 0));
    shade_textures(&s, hit, texture);
    return shaded(t, path, m, hit->t, s.sum);
}
