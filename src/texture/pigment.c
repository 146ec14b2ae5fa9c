/* pigment.c - the colour of a pigment at a point (07-textures, section 4), and whether it ever lets light through. */
#include <string.h>

#include "image/image.h"
#include "pattern/pattern.h"
#include "scene/image_map.h"
#include "texture/map.h"
#include "texture/sample.h"
#include "texture/texture.h"

/* Kept apart, so that the plain ways need not make room for what the others do. */
#define ALONE __attribute__((noinline))

/* POV: below this, filter and transmit count as none. */
static const float CLEAR = 1e-10f;

static const MapEntry grey_map[] = { { .key = 0, .colour = { 0, 0, 0, 0, 0 } }, { .key = 1, .colour = { 1, 1, 1, 0, 0 } } };

/* That of a pattern without a map too. */
static inline BlendMap map_of(const Pigment *pigment)
{
    if (pigment->map.n > 0)
        return pigment->map;
    const PatternOps *ops = pigment->pattern->ops;
    if (ops->default_map != NULL)
        return (BlendMap){ MAP_COLOUR, ops->n_default_map, ops->default_map };
    return (BlendMap){ MAP_COLOUR, 2, grey_map };
}

/* POV: an image with `once` in a map counts as clear, not as missing. */
static Colour entry_colour(const BlendMap *map, const MapEntry *entry, Vec3 p, const TextureContext *at)
{
    return map->kind == MAP_COLOUR ? entry->colour : pigment_colour(entry->pigment, p, at, NULL);
}

ALONE static Colour in_pigment_map(const BlendMap *map, double v, const PatternPoint *at)
{
    MapSpot spot = map_find(map->entry, map->n, v);
    Colour to = pigment_colour(spot.to->pigment, at->p, at->context, NULL);
    if (spot.from == NULL)
        return to;
    return colour_lerp(pigment_colour(spot.from->pigment, at->p, at->context, NULL), to, (float)spot.t);
}

Colour pigment_patterned(const Pigment *pigment, const Vec3 *p, const TextureContext *at)
{
    PatternPoint point;
    point.pattern = pigment->pattern;
    point.context = at;
    pattern_place(pigment->pattern, p, &point.p);
    double v = pattern_value(&point);
    BlendMap map = map_of(pigment);
    if (map.kind != MAP_COLOUR)
        return in_pigment_map(&pigment->map, v, &point);
    MapSpot spot = map_find(map.entry, map.n, v);
    return spot.from == NULL ? spot.to->colour : colour_lerp(spot.from->colour, spot.to->colour, (float)spot.t);
}

ALONE static Colour average(const Pigment *pigment, const Vec3 *p, const TextureContext *at)
{
    Vec3 q = pigment->pattern != NULL ? pattern_point(pigment->pattern, *p) : *p;
    Colour sum = { 0 };
    for (uint32_t i = 0; i < pigment->map.n; i++) {
        const MapEntry *e = &pigment->map.entry[i];
        sum = colour_add(sum, colour_scaled(entry_colour(&pigment->map, e, q, at), e->key));
    }
    double total = map_total(&pigment->map);
    return total != 0 ? colour_scaled(sum, (float)(1 / total)) : sum;
}

ALONE static Colour image(const Pigment *pigment, const Vec3 *p, bool *found)
{
    ImageSpot spot;
    Vec3 q = pigment->pattern != NULL ? pattern_point(pigment->pattern, *p) : *p;
    if (image_spot(pigment->image, q, &spot))
        return image_sample(pigment->image, spot);
    if (found != NULL)
        *found = false;
    return (Colour){ 1, 1, 1, 0, 1 };
}

static const TextureContext nowhere = { .quality = 9 };

Colour pigment_colour_at(const Pigment *pigment, const Vec3 *p, const TextureContext *at, bool *found)
{
    if (at == NULL)
        at = &nowhere;
    if (pigment->quick != NULL && at->quality <= 5)
        return *pigment->quick;
    switch (pigment->kind) {
    case PIGMENT_PLAIN: return pigment->colour;
    case PIGMENT_PATTERN: return pigment_patterned(pigment, p, at);
    case PIGMENT_AVERAGE: return average(pigment, p, at);
    case PIGMENT_IMAGE: return image(pigment, p, found);
    case PIGMENT_UV: return pigment_colour(pigment->map.entry[0].pigment, vec3(at->uv.u, at->uv.v, 0), at, found);
    }
    return pigment->colour;
}

/* ---- many points ---- */

enum { DEEPEST_OF_MANY = 16 };                 /* patterns within patterns: each takes some kilobytes of stack here */

/* The two ends of all spots of a pigment map; the points that ask for the same entry go together. */
static void ends_of(const MapSpot *spot, const Vec3 *p, Colour *from, Colour *to, int n)
{
    struct { const MapEntry *entry; Vec3 p; Colour *into; } ask[2 * PATTERN_MANY];
    int left = 0;
    for (int i = 0; i < n; i++) {
        ask[left].entry = spot[i].to;
        ask[left].p = p[i];
        ask[left++].into = &to[i];
        if (spot[i].from == NULL)
            continue;
        ask[left].entry = spot[i].from;
        ask[left].p = p[i];
        ask[left++].into = &from[i];
    }
    while (left > 0) {
        const MapEntry *entry = ask[0].entry;
        Vec3 at[PATTERN_MANY];
        Colour colour[PATTERN_MANY], *into[PATTERN_MANY];
        int some = 0, others = 0;
        for (int k = 0; k < left; k++) {
            if (ask[k].entry == entry) {
                at[some] = ask[k].p;
                into[some++] = ask[k].into;
            } else {
                ask[others++] = ask[k];
            }
        }
        pigment_colours(entry->pigment, at, colour, some);
        for (int k = 0; k < some; k++)
            *into[k] = colour[k];
        left = others;
    }
}

static void patterned_many(const Pigment *pigment, const Vec3 *p, Colour *out, int n)
{
    Vec3 q[PATTERN_MANY];
    double v[PATTERN_MANY];
    MapSpot spot[PATTERN_MANY];
    Colour from[PATTERN_MANY];
    memcpy(q, p, (size_t)n * sizeof *q);
    pattern_points(pigment->pattern, q, n);
    pattern_values(pigment->pattern, q, v, n);
    BlendMap map = map_of(pigment);
    for (int i = 0; i < n; i++)
        spot[i] = map_find(map.entry, map.n, v[i]);
    if (map.kind == MAP_COLOUR) {
        for (int i = 0; i < n; i++) {
            out[i] = spot[i].to->colour;
            from[i] = spot[i].from != NULL ? spot[i].from->colour : out[i];
        }
    } else {
        ends_of(spot, q, from, out, n);
    }
    for (int i = 0; i < n; i++)
        if (spot[i].from != NULL)
            out[i] = colour_lerp(from[i], out[i], (float)spot[i].t);
}

void pigment_colours(const Pigment *pigment, const Vec3 *p, Colour *out, int n)
{
    if (n > 1 && pigment->kind == PIGMENT_PATTERN && pigment->pattern->depth <= DEEPEST_OF_MANY) {
        patterned_many(pigment, p, out, n);
        return;
    }
    for (int i = 0; i < n; i++)
        out[i] = pigment_colour(pigment, p[i], &nowhere, NULL);
}

static bool clear(Colour c)
{
    return fabsf(c.f) > CLEAR || fabsf(c.t) > CLEAR;
}

static bool map_is_opaque(const BlendMap *map)
{
    for (uint32_t i = 0; i < map->n; i++)
        if (map->kind == MAP_COLOUR ? clear(map->entry[i].colour) : !pigment_is_opaque(map->entry[i].pigment))
            return false;
    return true;
}

bool pigment_is_opaque(const Pigment *pigment)
{
    if (pigment->quick != NULL && clear(*pigment->quick))
        return false;
    switch (pigment->kind) {
    case PIGMENT_PLAIN: return !clear(pigment->colour);
    case PIGMENT_IMAGE: return !pigment->image->has_transparency;
    case PIGMENT_PATTERN: {
        BlendMap map = map_of(pigment);
        return map_is_opaque(&map);
    }
    default: return map_is_opaque(&pigment->map);
    }
}

static bool dims(Colour c)
{
    return c.f >= 0 && c.t >= 0 && c.f + c.t <= 1 && c.r >= 0 && c.g >= 0 && c.b >= 0 && rgb_max(rgb_of(c)) <= 1;
}

bool pigment_dims(const Pigment *pigment)
{
    if (pigment->quick != NULL && !dims(*pigment->quick))
        return false;
    if (pigment->kind == PIGMENT_PLAIN)
        return dims(pigment->colour);
    if (pigment->kind != PIGMENT_PATTERN && pigment->kind != PIGMENT_UV)
        return pigment_is_opaque(pigment);
    BlendMap map = pigment->kind == PIGMENT_PATTERN ? map_of(pigment) : pigment->map;
    for (uint32_t i = 0; i < map.n; i++)
        if (map.kind == MAP_COLOUR ? !dims(map.entry[i].colour) : !pigment_dims(map.entry[i].pigment))
            return false;
    return true;
}
