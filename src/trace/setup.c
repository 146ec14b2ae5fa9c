/* setup.c - what tracing needs to know of a World, worked out once per picture. */
#include "base/arena.h"
#include "trace/path.h"

/* ---- does anything map by uv? ---- */

static bool pigment_wants_uv(const Pigment *p);
static bool normal_wants_uv(const Normal *n);
static bool texture_wants_uv(const Texture *t);

static bool map_wants_uv(const BlendMap *map)
{
    for (uint32_t i = 0; i < map->n; i++)
        if ((map->kind == MAP_PIGMENT && pigment_wants_uv(map->entry[i].pigment)) ||
            (map->kind == MAP_NORMAL && normal_wants_uv(map->entry[i].normal)) ||
            (map->kind == MAP_TEXTURE && texture_wants_uv(map->entry[i].texture)))
            return true;
    return false;
}

static bool pigment_wants_uv(const Pigment *p)
{
    return p != NULL && (p->kind == PIGMENT_UV || map_wants_uv(&p->map));
}

static bool normal_wants_uv(const Normal *n)
{
    return n != NULL && (n->kind == NORMAL_UV || map_wants_uv(&n->map));
}

static bool texture_wants_uv(const Texture *t)
{
    for (; t != NULL; t = t->below)
        if (t->kind == TEXTURE_UV || pigment_wants_uv(t->pigment) || normal_wants_uv(t->normal) || map_wants_uv(&t->map))
            return true;
    return false;
}

static bool world_wants_uv(const World *w)
{
    for (uint32_t i = 0; i < w->n_materials; i++)
        if (w->material[i].flags & MATERIAL_UV)
            return true;
    for (uint32_t i = 1; i < w->n_textures; i++)
        if (texture_wants_uv(w->texture[i].texture))
            return true;
    return false;
}

/* ---- lights, fogs, rainbows ---- */

static uint32_t largest_area(const World *w)
{
    uint32_t most = 1;
    for (uint32_t i = 0; i < w->n_lights; i++) {
        const LightSource *def = w->light[i].def;
        if (def->area && (uint32_t)def->size1 * (uint32_t)def->size2 > most)
            most = (uint32_t)def->size1 * (uint32_t)def->size2;
    }
    return most;
}

static bool wants_stream(const World *w, const Tracing *tracing)
{
    for (uint32_t i = 0; i < w->n_lights; i++)
        if (w->light[i].def->area && w->light[i].def->jitter)
            return true;
    for (uint32_t i = 0; i < tracing->n_bows; i++)
        if (tracing->bow[i].jitter != 0)
            return true;
    return false;
}

static void prepare_air(Arena *arena, Tracing *tracing, const Scene *scene)
{
    const FogDef **fog = arena_array(arena, const FogDef *, scene->n_fog + 1);
    for (uint32_t i = 0; i < scene->n_fog; i++)
        if (scene->fog[i]->distance != 0)
            fog[tracing->n_fog++] = scene->fog[i];
    tracing->fog = fog;
    tracing->bow = arena_array(arena, Bow, scene->n_rainbow + 1);
    for (uint32_t i = 0; i < scene->n_rainbow; i++) {
        const RainbowDef *def = scene->rainbow[i];
        if (def->distance != 0 && def->width != 0 && (def->map.n > 0 || def->pigment != NULL))
            bow_prepare(&tracing->bow[tracing->n_bows++], def);
    }
}

/* POV: filter and transmit of a background count only if the picture has alpha; what is see-through without it is black. */
static Colour background_of(const World *w, bool alpha, bool legacy)
{
    Colour b = w->globals.background;
    if (!w->globals.has_background)
        return (Colour){ 0, 0, 0, 0, 1 };
    if (legacy)
        return (Colour){ b.r, b.g, b.b, 0, alpha ? 1 : 0 };
    if (alpha)
        return b;
    return (Colour){ b.r * (1 - b.t), b.g * (1 - b.t), b.b * (1 - b.t), 0, 0 };
}

const Tracing *tracing_new(Arena *arena, const World *w, int quality, bool alpha)
{
    Tracing *tracing = arena_new(arena, Tracing);
    tracing->world = w;
    tracing->quality = quality;
    tracing->alpha = alpha;
    tracing->legacy = w->globals.version < 370;
    tracing->background = background_of(w, alpha, tracing->legacy);
    tracing->wants_uv = world_wants_uv(w);
    tracing->to_scene = 1 / w->unit;
    tracing->adc_bailout = w->globals.adc_bailout;
    tracing->max_level = w->globals.max_trace_level < 1 ? 1 : w->globals.max_trace_level;
    tracing->n_area_samples = largest_area(w);
    prepare_air(arena, tracing, w->scene);
    if (wants_stream(w, tracing)) {
        tracing->stream = arena_array(arena, double, STREAM_SIZE);
        stream_fill(tracing->stream);
    }
    hue_fill(tracing->hue);
    return tracing;
}

Tracer *tracer_new(Arena *arena, const Tracing *tracing)
{
    Tracer *t = arena_new(arena, Tracer);
    t->tracing = tracing;
    t->world = tracing->world;
    t->last_blocker = arena_array(arena, uint32_t, t->world->n_lights + 1);
    t->area = arena_array(arena, AreaSample, tracing->n_area_samples);
    tracer_start_tile(t, 0);
    return t;
}

void tracer_start_tile(Tracer *t, uint32_t tile)
{
    streams_start(&t->chance, t->tracing->stream, tile);
}
