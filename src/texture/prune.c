/* prune.c - textures without what cannot show: maps whose entries are all alike, layers under an opaque one.
 *
 * Scenes are full of them: macros write colour maps from parameters that turn out equal, and includes lay glass over paint.
 * The result gives the same colours to the bit; what needs no change is not copied. */
#include <string.h>

#include "base/arena.h"
#include "texture/texture.h"

static const Pigment *prune_pigment(Arena *a, const Pigment *pigment);

static bool same_colour(Colour a, Colour b)
{
    return a.r == b.r && a.g == b.g && a.b == b.b && a.f == b.f && a.t == b.t;
}

/* The colour that a pigment has everywhere. A blend of c and c is c + t (c - c): c itself. */
static bool one_colour(const Pigment *p, Colour *out)
{
    if (p->quick != NULL)
        return false;
    if (p->kind == PIGMENT_PLAIN) {
        *out = p->colour;
        return true;
    }
    if (p->kind != PIGMENT_PATTERN || p->map.n == 0)
        return false;
    for (uint32_t i = 0; i < p->map.n; i++) {
        Colour c;
        if (p->map.kind == MAP_COLOUR)
            c = p->map.entry[i].colour;
        else if (!one_colour(p->map.entry[i].pigment, &c))
            return false;
        if (!isfinite(c.r + c.g + c.b + c.f + c.t) || (i > 0 && !same_colour(c, *out)))
            return false;
        *out = c;
    }
    return true;
}

static BlendMap prune_pigments(Arena *a, const BlendMap *map)
{
    MapEntry *entry = NULL;
    for (uint32_t i = 0; i < map->n; i++) {
        const Pigment *pruned = prune_pigment(a, map->entry[i].pigment);
        if (pruned == map->entry[i].pigment)
            continue;
        if (entry == NULL)
            entry = arena_copy(a, map->entry, map->n * sizeof *entry);
        entry[i].pigment = pruned;
    }
    return (BlendMap){ map->kind, map->n, entry != NULL ? entry : map->entry };
}

static const Pigment *prune_pigment(Arena *a, const Pigment *pigment)
{
    Colour c;
    if (pigment->kind == PIGMENT_PLAIN)
        return pigment;
    if (one_colour(pigment, &c)) {
        Pigment *plain = arena_new(a, Pigment);
        *plain = (Pigment){ .kind = PIGMENT_PLAIN, .colour = c };
        return plain;
    }
    if (pigment->map.kind != MAP_PIGMENT)
        return pigment;
    BlendMap map = prune_pigments(a, &pigment->map);
    if (map.entry == pigment->map.entry)
        return pigment;
    Pigment *copy = arena_copy(a, pigment, sizeof *pigment);
    copy->map = map;
    return copy;
}

static const Texture *prune_layers(Arena *a, const Texture *layer)
{
    const Pigment *pigment = prune_pigment(a, layer->pigment);
    const Texture *below = NULL;
    if (layer->below != NULL && !pigment_is_opaque(pigment))
        below = prune_layers(a, layer->below);
    if (pigment == layer->pigment && below == layer->below)
        return layer;
    Texture *copy = arena_copy(a, layer, sizeof *layer);
    copy->pigment = pigment;
    copy->below = below;
    return copy;
}

const Texture *texture_prune(Arena *a, const Texture *texture)
{
    if (texture->kind == TEXTURE_PLAIN)
        return prune_layers(a, texture);
    MapEntry *entry = NULL;
    for (uint32_t i = 0; i < texture->map.n; i++) {
        const Texture *pruned = texture_prune(a, texture->map.entry[i].texture);
        if (pruned == texture->map.entry[i].texture)
            continue;
        if (entry == NULL)
            entry = arena_copy(a, texture->map.entry, texture->map.n * sizeof *entry);
        entry[i].texture = pruned;
    }
    if (entry == NULL)
        return texture;
    Texture *copy = arena_copy(a, texture, sizeof *texture);
    copy->map.entry = entry;
    return copy;
}
