/* setup.c - what tracing needs to know of a World, worked out once per picture. */
#include "base/arena.h"
#include "math/chi_square.h"
#include "math/mersenne.h"
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

static void add_media_limit(Arena *arena, Tracing *tracing, const Media *m)
{
    if (m->method == 3 || m->samples_max <= m->samples_min || tracing_media_threshold(tracing, m) != NULL)
        return;
    uint32_t most = (uint32_t)m->samples_max + 1;
    double *threshold = arena_array(arena, double, most + 1);
    double unit = (double)m->variance / chi_square_quantile_pov(most - 2, (double)m->confidence);
    for (uint32_t n = 1; n <= most; n++)
        threshold[n] = unit * chi_square_quantile_pov(n, (double)m->confidence);
    tracing->media_limit[tracing->n_media_limits++] = (MediaLimit){ m, threshold };
}

static void prepare_media(Arena *arena, Tracing *tracing, const World *w)
{
    uint32_t n = w->scene->n_media;
    for (uint32_t i = 0; i < w->n_interiors; i++)
        n += w->interior[i].interior->n_media;
    tracing->media_limit = arena_array(arena, MediaLimit, n + 1);
    for (uint32_t i = 0; i < w->scene->n_media; i++)
        add_media_limit(arena, tracing, w->scene->media[i]);
    for (uint32_t i = 0; i < w->n_interiors; i++)
        for (uint32_t k = 0; k < w->interior[i].interior->n_media; k++)
            add_media_limit(arena, tracing, &w->interior[i].interior->media[k]);
}

const double *tracing_media_threshold(const Tracing *tracing, const Media *media)
{
    for (uint32_t i = 0; i < tracing->n_media_limits; i++)
        if (tracing->media_limit[i].media == media)
            return tracing->media_limit[i].threshold;
    return NULL;
}

static uint8_t lamp_of(const Light *light, uint32_t index, int quality)
{
    const LightSource *def = light->def;
    bool area = def->area && quality >= 5;
    int lamp = 0;
    lamp |= light_is_plain(light) ? LAMP_PLAIN : 0;
    lamp |= quality >= 4 && !(def->shadowless && light->projected_through == 0) ? LAMP_SHADED : 0;
    lamp |= area ? LAMP_AREA : 0;
    lamp |= area && def->area_illumination ? LAMP_AREA_LIGHT : 0;
    lamp |= def->shadowless ? 0 : LAMP_SHINES;
    lamp |= index < LIGHTS_REMEMBERED && !light->grouped ? LAMP_REMEMBERED : 0;
    return (uint8_t)lamp;
}

static void prepare_lamps(Arena *arena, Tracing *tracing, const World *w)
{
    tracing->lamp = arena_array(arena, uint8_t, w->n_lights + 1);
    for (uint32_t i = 0; i < w->n_lights; i++)
        tracing->lamp[i] = lamp_of(&w->light[i], i, tracing->quality);
}

static void prepare_light_lists(Arena *arena, Tracing *tracing, const World *w)
{
    uint32_t *global = arena_array(arena, uint32_t, w->n_global_lights + 1);
    for (uint32_t i = 0; i < w->n_global_lights; i++)
        global[i] = i;
    tracing->lit_by = arena_array(arena, LightList, w->n_materials + 1);
    for (uint32_t i = 0; i < w->n_materials; i++) {
        const Material *m = &w->material[i];
        const uint32_t *group = &w->group_light[m->first_group_light];
        uint32_t n_global = m->flags & MATERIAL_NO_GLOBAL_LIGHTS ? 0 : w->n_global_lights;
        const uint32_t *list = n_global == 0 ? group : global;
        if (n_global > 0 && m->n_group_lights > 0) {
            uint32_t *both = arena_array(arena, uint32_t, n_global + m->n_group_lights);
            memcpy(both, global, n_global * sizeof *both);
            memcpy(both + n_global, group, m->n_group_lights * sizeof *both);
            list = both;
        }
        tracing->lit_by[i] = (LightList){ list, n_global + m->n_group_lights };
    }
}

static void prepare_areas(Arena *arena, Tracing *tracing, const World *w)
{
    tracing->n_area_samples = 1;
    tracing->area_least = arena_array(arena, uint32_t, w->n_lights + 1);
    for (uint32_t i = 0; i < w->n_lights; i++) {
        const LightSource *def = w->light[i].def;
        if (!def->area)
            continue;
        uint32_t n = (uint32_t)def->size1 * (uint32_t)def->size2;
        tracing->n_area_samples = n > tracing->n_area_samples ? n : tracing->n_area_samples;
        tracing->area_least[i] = area_least_samples(def);
    }
}

static bool has_media(const World *w)
{
    for (uint32_t i = 0; i < w->n_interiors; i++)
        if (w->interior[i].interior->n_media > 0)
            return true;
    return false;
}

static bool interior_dims(const Interior *i)
{
    Rgb c = i->fade_colour;
    return i->caustics == 0 && i->fade_distance >= 0 && c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && rgb_max(c) <= 1;
}

static bool shadows_dim(const World *w, const Tracing *tracing)
{
    if (tracing->has_media || tracing->air_dims)
        return false;
    for (uint32_t i = 0; i < w->n_lights; i++)
        if (w->light[i].def->area && w->light[i].def->jitter)
            return false;
    for (uint32_t i = 0; i < w->n_interiors; i++)
        if (!interior_dims(w->interior[i].interior))
            return false;
    for (uint32_t i = 1; i < w->n_textures; i++)
        if (!w->texture[i].opaque && !texture_dims(w->texture[i].texture))
            return false;
    return true;
}

static bool wants_stream(const World *w, const Tracing *tracing)
{
    if (tracing->has_media || w->scene->n_media > 0)
        return true;
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
        b = (Colour){ 0, 0, 0, 0, 1 };
    if (legacy)
        return (Colour){ b.r, b.g, b.b, 0, alpha ? 1 : 0 };
    if (alpha)
        return b;
    return (Colour){ b.r * (1 - b.t), b.g * (1 - b.t), b.b * (1 - b.t), 0, 0 };
}

static const Coat *coats_new(Arena *arena, const Tracing *tracing, const World *w)
{
    Coat *coat = arena_array(arena, Coat, w->n_textures + 1);
    for (uint32_t i = 1; i < w->n_textures; i++)
        coat_prepare(&coat[i], tracing, w->texture[i].texture);
    return coat;
}

/* Of layers all of one colour each; the surface is not asked for its normal, nor which side of it is seen. */
static Pane pane_of(const Tracing *tracing, const World *w, const Material *m)
{
    Pane pane = { .passes = rgb_grey(1) };
    const Texture *top = tracing->coat[m->texture].leaf.top;
    if (top == NULL || (m->flags & (MATERIAL_HAS_INTERIOR_TEXTURE | MATERIAL_CUTAWAY)) || w->interior[m->interior].interior->caustics != 0)
        return pane;
    pane.even = tracing->ticket.adc_bailout <= 1;
    for (const Texture *layer = top; layer != NULL; layer = layer->below)
        pane.passes = rgb_mul(pane.passes, colour_transmittance(layer->pigment->colour));
    return pane;
}

static const Pane *panes_new(Arena *arena, const Tracing *tracing, const World *w)
{
    Pane *pane = arena_array(arena, Pane, w->n_materials + 1);
    for (uint32_t i = 0; i < w->n_materials; i++)
        pane[i] = pane_of(tracing, w, &w->material[i]);
    for (uint32_t i = 0; i < w->n_prims; i++)
        if (w->prim[i].ops->flags & SHAPE_HAS_TEXTURES)
            pane[w->prim[i].material].even = false;
    return pane;
}

const Tracing *tracing_new(Arena *arena, const World *w, int quality, bool alpha)
{
    Tracing *tracing = arena_new(arena, Tracing);
    tracing->world = w;
    tracing->quality = quality;
    tracing->alpha = alpha;
    tracing->legacy = w->globals.version < 370;
    tracing->background = background_of(w, alpha, tracing->legacy);
    for (int through = 0; through < 2; through++)
        tracing->backdrop[through] = backdrop_of(tracing->background, through == 1);
    tracing->plain_sky = w->scene->sky_sphere == NULL;
    for (int through = 0; tracing->plain_sky && through < 2; through++)
        tracing->sky[through] = sky_colour(tracing, vec3(0, 0, 1), through == 1);
    tracing->wants_uv = world_wants_uv(w);
    tracing->to_scene = 1 / w->unit;
    tracing->max_level = w->globals.max_trace_level < 1 ? 1 : w->globals.max_trace_level;
    tracing->ticket = (Ticket){ .adc_bailout = w->globals.adc_bailout, .max_level = tracing->max_level, .lamps = LAMPS_ALL };
    tracing->radiosity = w->globals.radiosity.on && quality >= 9;
    tracing->ambient_light = tracing->radiosity && !tracing->legacy ? rgb_grey(0) : w->globals.ambient_light;
    prepare_areas(arena, tracing, w);
    prepare_lamps(arena, tracing, w);
    prepare_light_lists(arena, tracing, w);
    tracing->has_media = quality >= 9 && has_media(w);
    prepare_air(arena, tracing, w->scene);
    tracing->air_dims = quality >= 9 && tracing->n_fog + w->scene->n_media > 0;
    tracing->has_air = quality >= 9 && tracing->n_fog + tracing->n_bows + w->scene->n_media > 0;
    prepare_media(arena, tracing, w);
    if (wants_stream(w, tracing)) {
        tracing->stream = arena_array(arena, double, STREAM_SIZE);
        mersenne_fill(tracing->stream, STREAM_SIZE);
    }
    tracing->shadows_dim = shadows_dim(w, tracing);
    tracing->coat = coats_new(arena, tracing, w);
    tracing->pane = panes_new(arena, tracing, w);
    hue_fill(tracing->hue);
    return tracing;
}

Tracer *tracer_new(Arena *arena, const Tracing *tracing, Radiosity *radiosity)
{
    Tracer *t = arena_new(arena, Tracer);
    t->tracing = tracing;
    t->world = tracing->world;
    t->last_blocker = arena_array(arena, uint32_t, t->world->n_lights + 1);
    nooks_start(arena, t);
    t->area = arena_array(arena, AreaSample, tracing->n_area_samples);
    t->lit = arena_array(arena, uint32_t, tracing->n_area_samples);
    t->light_span = arena_array(arena, LightSpan, t->world->n_lights + 1);
    t->media_span = arena_array(arena, MediaSpan, 2 * (size_t)t->world->n_lights + 1);
    t->gather = gather_new(arena, radiosity);
    t->eye = (Path){ .weight = 1, .ticket = &tracing->ticket, .skip = PRIM_NO_IMAGE, .alpha = tracing->alpha };
    tracer_start_tile(t, 0);
    return t;
}

void tracer_free(Tracer *t)
{
    gather_free(t->gather);
}

void tracer_start_tile(Tracer *t, uint32_t tile)
{
    streams_start(&t->chance, t->tracing->stream, tile);
}

bool tracer_took_chances(const Tracer *t)
{
    return t->chance.used;
}
