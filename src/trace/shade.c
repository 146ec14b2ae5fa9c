/* shade.c - a hit to a colour: textures, layers, their light, and the rays that go on (04-shading, sections 3, 4, 7). */
#include "trace/path.h"

enum { MIRRORS_MAX = 8 };                      /* layers that reflect, kept until it is known what passes through */

typedef struct Mirror {
    Polish polish;
    Rgb share;
    double weight;
} Mirror;

typedef struct Stack {                         /* a leaf's layers, as far as they have been gone through */
    Shade *s;
    const TextureLeaf *leaf;
    Rgb sum, filter;
    double through;
    bool filtered;                             /* some layer had a colour */
    bool gathered;                             /* light from all around, in front and behind: */
    Rgb around, around_back;
    Vec3 top;                                  /* normal of the top layer */
    Mirror mirror[MIRRORS_MAX];
    uint32_t n_mirrors;
    Rgb reflected;                             /* by layers that found no room above */
} Stack;

/* ---- reflectivity ---- */

static double fresnel(double q, double cosine)
{
    double s = q * q + cosine * cosine - 1;
    if (s <= 0)
        return 1;
    double g = sqrt(s), minus = g - cosine, plus = g + cosine;
    double a = minus / plus, b = (cosine * plus - 1) / (cosine * minus + 1);
    return fmin(1, fmax(0, 0.5 * a * a * (1 + b * b)));
}

static Rgb mix(Rgb low, Rgb high, double x)
{
    return rgb_add(rgb_scaled(high, (float)x), rgb_scaled(low, (float)(1 - x)));
}

static Rgb reflectivity(const Shade *s, const Finish *f, Vec3 n, Rgb colour)
{
    if (rgb_is_zero(f->reflection_max) && rgb_is_zero(f->reflection_min))
        return rgb_grey(0);
    double cosine = -dot(s->path->ray.d, n);
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
        r = rgb_mul(r, rgb_add(rgb_grey(1), rgb_scaled(rgb_sub(colour, rgb_grey(1)), m)));
    }
    return r;
}

/* Rays are given up by the most that a finish may reflect, unless that depends on the angle by its nature. */
static double mirror_weight(const Finish *f, Rgb share)
{
    return (double)(f->reflection_fresnel ? rgb_max(share) : fmaxf(rgb_max(f->reflection_max), rgb_max(f->reflection_min)));
}

static Rgb mirror_light(const Shade *s, const Mirror *m)
{
    Rgb seen = rgb_of(shade_reflect(s, &m->polish, m->weight));
    float e = m->polish.finish->reflection_exponent;
    if (e != 1 && e != 0)
        seen = rgb(powf(seen.r, 1 / e), powf(seen.g, 1 / e), powf(seen.b, 1 / e));
    return rgb_mul(seen, m->share);
}

static void remember_mirror(Stack *k, const Finish *f, Vec3 n, Rgb share)
{
    if (rgb_is_zero(share) || k->s->t->tracing->quality < 8)
        return;
    Mirror m = { { f, n }, share, k->s->path->weight * k->through * mirror_weight(f, share) };
    if (k->n_mirrors < MIRRORS_MAX)
        k->mirror[k->n_mirrors++] = m;
    else
        k->reflected = rgb_add(k->reflected, mirror_light(k->s, &m));
}

/* ---- one layer ---- */

static float opacity(const Tracing *tracing, Colour c)
{
    if (tracing->legacy)
        return 1 - (c.f * rgb_max(rgb_of(c)) + c.t);
    return 1 - c.f - c.t;
}

static void darken_filter(Stack *k, const Finish *f, Colour c, Rgb share)
{
    k->filter = rgb_mul(k->filter, colour_transmittance(c));
    k->filtered = true;
    if (f->conserve_energy)
        k->filter = rgb_mul(k->filter, rgb(fminf(1, 1 - share.r), fminf(1, 1 - share.g), fminf(1, 1 - share.b)));
}

/* Gathered once, for the first layer that shows enough of it. */
static Rgb light_around(Stack *k, const Layer *layer)
{
    const Shade *s = k->s;
    const Finish *f = layer->finish;
    if (f->has_subsurface || !gather_here(s))
        return rgb_grey(0);
    double seen = (double)rgb_greyness(rgb_mul(k->filter, layer->colour)) * layer->opacity *
                  (double)f->diffuse;
    if (!k->gathered && seen > s->path->ticket->adc_bailout) {
        k->gathered = true;
        Vec3 raw = s->surface->normal;
        k->around = gathered_light(s, layer->n, raw, s->path->weight * seen);
        if (f->diffuse_back != 0)
            k->around_back = gathered_light(s, negated(layer->n), negated(raw), s->path->weight * seen);
    }
    Rgb light = rgb_add(rgb_scaled(k->around, f->diffuse), rgb_scaled(k->around_back, f->diffuse_back));
    return rgb_scaled(rgb_mul(layer->colour, light), (float)layer->opacity);
}

static void shade_layer(Stack *k, const Texture *layer)
{
    Shade *s = k->s;
    const Tracing *tracing = s->t->tracing;
    const Finish *f = layer->finish;
    Vec3 n = texture_layer_normal(k->leaf, layer, s->surface->normal, &s->at);
    if (layer == k->leaf->top)
        k->top = n;
    bool found = true;
    Colour c = texture_layer_colour(k->leaf, layer, &s->at, &found);
    if (!found && tracing->quality > 1)        /* POV: low quality shows the white that stands for nothing */
        c = (Colour){ 0, 0, 0, 0, 0 };
    Rgb share = rgb_grey(0);
    if (tracing->quality <= 1) {
        k->sum = rgb_of(c);
    } else {
        share = reflectivity(s, f, n, rgb_of(c));
        remember_mirror(k, f, n, share);
        Layer at = { f, n, rgb_of(c), (double)opacity(tracing, c) };
        Rgb glow = f->emission;                /* POV: with radiosity, ambient light is for old scenes only */
        if (!tracing->radiosity || tracing->legacy)
            glow = rgb_add(rgb_mul(f->ambient, s->t->world->globals.ambient_light), glow);
        Rgb light = rgb_scaled(rgb_mul(rgb_of(c), glow), (float)at.opacity);
        if (tracing->radiosity)
            light = rgb_add(light, light_around(k, &at));
        light = rgb_add(light, shade_lights(s, &at));
        k->sum = rgb_add(k->sum, rgb_mul(light, k->filter));
    }
    if (found)
        darken_filter(k, f, c, share);
    double grey = fabs((double)rgb_greyness(k->filter));
    k->through = grey < 1 ? grey : 1;
}

static bool same_normal(Vec3 a, Vec3 b)
{
    return fabs(a.x - b.x) <= TINY && fabs(a.y - b.y) <= TINY && fabs(a.z - b.z) <= TINY;
}

static void shade_leaf(void *user, const TextureLeaf *leaf)
{
    Shade *s = user;
    Stack k;                                   /* not cleared: the mirrors are large, and few */
    k.s = s;
    k.leaf = leaf;
    k.sum = k.reflected = rgb_grey(0);
    k.filter = rgb_grey(1);
    k.through = 1;
    k.filtered = false;
    k.gathered = false;
    k.around = k.around_back = rgb_grey(0);
    k.top = s->surface->normal;
    k.n_mirrors = 0;
    for (const Texture *layer = leaf->top; layer != NULL && k.through > s->path->ticket->adc_bailout; layer = layer->below)
        shade_layer(&k, layer);
    Colour c = { k.sum.r + k.reflected.r, k.sum.g + k.reflected.g, k.sum.b + k.reflected.b, 0, 0 };
    bool total = false;
    if (k.through > s->path->ticket->adc_bailout && s->t->tracing->quality >= 6)
        total = shade_transmit(s, &(Polish){ leaf->top->finish, k.top }, k.filter, k.filtered, k.through, &c);
    for (uint32_t i = 0; i < k.n_mirrors; i++) {
        if (total && same_normal(k.mirror[i].polish.n, k.top))
            continue;                          /* the same light came back already */
        Rgb light = mirror_light(s, &k.mirror[i]);
        c = (Colour){ c.r + light.r, c.g + light.g, c.b + light.b, 0, c.t };
    }
    s->sum = colour_add(s->sum, colour_scaled(c, leaf->weight));
}

/* ---- a hit ---- */

static void shade_texture(Shade *s, uint32_t texture, float weight)
{
    if (texture == 0 || weight < (float)s->path->ticket->adc_bailout)
        return;
    Vec3 p = s->material->flags & MATERIAL_UV ? vec3(s->surface->uv.u, s->surface->uv.v, 0) : s->at.point;
    Colour before = s->sum;
    s->sum = (Colour){ 0, 0, 0, 0, 0 };
    texture_resolve(&s->t->world->texture[texture], p, &s->at, shade_leaf, s);
    s->sum = colour_add(before, weight == 1 ? s->sum : colour_scaled(s->sum, weight));
}

Colour shade_hit(Tracer *t, const Path *path, const Hit *hit, int level)
{
    const World *w = t->world;
    const Material *m = &w->material[w->prim[hit->prim].material];
    Surface surface;
    world_surface(w, &path->ray, hit, t->tracing->wants_uv, &surface);
    Shade s;                                   /* not cleared: nothing of `light` is known */
    s.t = t;
    s.path = path;
    s.surface = &surface;
    s.material = m;
    s.interior = m->interior;
    s.depth = hit->t;
    s.level = level;
    s.spot = (Spot){ t, surface.p, &surface, path->in, path->ticket->bounces > 0 };
    s.known = 0;
    s.sum = (Colour){ 0, 0, 0, 0, 0 };
    s.at = (TextureContext){ .point = scaled(surface.p, t->tracing->to_scene), .ray = path->ray.d, .normal = surface.normal,
                             .uv = surface.uv, .hit = true, .quality = t->tracing->quality,
                             .number_of_waves = w->globals.number_of_waves, .noise_generator = w->globals.noise_generator };
    uint32_t texture = m->texture;
    if (surface.back && (m->flags & MATERIAL_HAS_INTERIOR_TEXTURE))
        texture = m->interior_texture;
    if (surface.n_textures == 0)
        shade_texture(&s, texture, 1);
    for (uint32_t i = 0; i < surface.n_textures; i++)
        shade_texture(&s, surface.texture[i].texture != 0 ? surface.texture[i].texture : texture, surface.texture[i].weight);
    return t->tracing->has_media ? media_bodies(t, path, m, hit->t, s.sum) : s.sum;
}
