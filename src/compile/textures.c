/* textures.c - textures, interiors and materials by index, each once.
 *
 * A texture that looks the same everywhere loses its place: a thousand copies of a red thing share one entry. */
#include <string.h>

#include "compile/context.h"
#include "texture/texture.h"

/* ---- places ---- */

static const Affine *place_of(Compile *c, const Affine *own, const Affine *around)
{
    Affine room;
    const Affine *place = place_within(own, around, &room);
    return place->identity ? NULL : arena_copy(c->arena, place, sizeof *place);
}

/* ---- textures ---- */

typedef struct TextureKey {
    const Texture *texture;
    const Affine *place;
} TextureKey;

static uint32_t texture_hash_of(const Texture *t, const Affine *place)
{
    uint32_t h = hash_bytes(&t, sizeof t);
    return place == NULL ? h : h * 31 + hash_bytes(place->m, sizeof place->m);
}

static uint32_t texture_hash(const Compile *c, uint32_t i)
{
    return texture_hash_of(c->texture.data[i].texture, c->texture.data[i].place);
}

static bool texture_same(const Compile *c, uint32_t i, const void *key)
{
    const PlacedTexture *t = &c->texture.data[i];
    const TextureKey *k = key;
    if (t->texture != k->texture || (t->place == NULL) != (k->place == NULL))
        return false;
    return k->place == NULL || (memcmp(t->place->m, k->place->m, sizeof k->place->m) == 0 &&
                                memcmp(t->place->inv, k->place->inv, sizeof k->place->inv) == 0);
}

static uint32_t pruned_hash(const Compile *c, uint32_t i)
{
    return hash_bytes(&c->pruned_key.data[i], sizeof(const Texture *));
}

static bool pruned_same(const Compile *c, uint32_t i, const void *key)
{
    return c->pruned_key.data[i] == *(const Texture *const *)key;
}

/* The texture without what cannot show; the same for every mention of it. */
static const Texture *pruned(Compile *c, const Texture *t)
{
    if (t->kind == TEXTURE_PLAIN && t->below == NULL && t->normal == NULL && t->pigment->kind == PIGMENT_PLAIN)
        return t;                              /* nothing to take away */
    uint32_t *slot = table_find(c, &c->pruned, hash_bytes(&t, sizeof t), &t, pruned_same, pruned_hash);
    if (*slot == 0) {
        array_push(c->arena, &c->pruned_key, t);
        array_push(c->arena, &c->pruned_value, texture_prune(c->arena, t));
        *slot = c->pruned_key.n;
    }
    return c->pruned_value.data[*slot - 1];
}

uint32_t texture_placed(Compile *c, const Texture *t, const Affine *own, const Affine *around)
{
    t = pruned(c, t);
    Affine room;
    const Affine *place = texture_is_flat(t) ? NULL : place_within(own, around, &room);
    TextureKey key = { t, place != NULL && place->identity ? NULL : place };
    uint32_t *slot = table_find(c, &c->textures, texture_hash_of(key.texture, key.place), &key, texture_same, texture_hash);
    if (*slot == 0) {
        const Affine *kept = key.place == NULL ? NULL : arena_copy(c->arena, key.place, sizeof *key.place);
        array_push(c->arena, &c->texture, (PlacedTexture){ .texture = t, .place = kept, .opaque = texture_is_opaque(t) });
        *slot = c->texture.n;
    }
    return *slot - 1;
}

/* ---- interiors and materials ---- */

/* Always a new entry: its index is the identity of a body. Without media the place does not matter. */
uint32_t interior_placed(Compile *c, const Interior *interior, const Affine *own, const Affine *around, bool hollow)
{
    const Affine *place = interior->n_media > 0 ? place_of(c, own, around) : NULL;
    array_push(c->arena, &c->interior, (PlacedInterior){ .interior = interior, .place = place, .hollow = hollow });
    return c->interior.n - 1;
}

static uint32_t material_hash(const Compile *c, uint32_t i)
{
    return hash_bytes(&c->material.data[i], sizeof(Material));
}

static bool material_same(const Compile *c, uint32_t i, const void *key)
{
    return memcmp(&c->material.data[i], key, sizeof(Material)) == 0;
}

uint32_t material_index(Compile *c, const Material *m)
{
    uint32_t *slot = table_find(c, &c->materials, hash_bytes(m, sizeof *m), m, material_same, material_hash);
    if (*slot == 0) {
        array_push(c->arena, &c->material, *m);
        *slot = c->material.n;
    }
    return *slot - 1;
}

bool textures_opaque(const Compile *c, const Material *m)
{
    return (m->texture == 0 || c->texture.data[m->texture].opaque) &&
           (m->interior_texture == 0 || c->texture.data[m->interior_texture].opaque);
}

/* ---- what the scene has ---- */

static bool texture_reflects(const Texture *t)
{
    for (; t != NULL; t = t->below) {
        const Finish *f = t->finish;
        if (f != NULL && (!rgb_is_zero(f->reflection_min) || !rgb_is_zero(f->reflection_max)))
            return true;
        if (t->map.kind == MAP_TEXTURE)
            for (uint32_t i = 0; i < t->map.n; i++)
                if (texture_reflects(t->map.entry[i].texture))
                    return true;
    }
    return false;
}

unsigned textures_features(const Compile *c)
{
    unsigned features = 0;
    for (uint32_t i = 1; i < c->texture.n; i++) {
        features |= c->texture.data[i].opaque ? 0 : WORLD_HAS_TRANSPARENT;
        features |= texture_reflects(c->texture.data[i].texture) ? WORLD_HAS_REFLECTION : 0;
    }
    return features;
}
