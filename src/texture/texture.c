/* texture.c - a texture at a point as weighted stacks of plain layers.
 *
 * Every map, list, tile and average only chooses textures and weighs them; weights multiply on the way down, and the chains
 * passed are linked on the C stack for the normals of the leaves. */
#include "texture/texture.h"

#include "image/image.h"
#include "pattern/pattern.h"
#include "scene/image_map.h"
#include "texture/map.h"
#include "texture/sample.h"

typedef struct Walk {
    const TextureContext *at;
    TextureVisit *visit;
    void *user;
} Walk;

static void resolve(const Walk *w, const Texture *t, const Affine *place, Vec3 p, double weight, const TextureFrame *outer);

static void patterned(const Walk *w, const Texture *t, Vec3 q, double weight, const TextureFrame *frame)
{
    MapSpot spot = map_find(t->map.entry, t->map.n, pattern_value(t->pattern, q, w->at));
    resolve(w, spot.to->texture, NULL, q, weight * spot.t, frame);
    if (spot.from != NULL)
        resolve(w, spot.from->texture, NULL, q, weight * (1 - spot.t), frame);
}

static void average(const Walk *w, const Texture *t, Vec3 q, double weight, const TextureFrame *frame)
{
    double total = map_total(&t->map);
    for (uint32_t i = 0; i < t->map.n; i++)
        resolve(w, t->map.entry[i].texture, NULL, q, total != 0 ? weight * (double)t->map.entry[i].key / total : weight, frame);
}

/* POV: an index equal to the number of textures, like any other beyond, gives the last; larger ones start again. */
static const Texture *by_material_map(const Texture *t, Vec3 q)
{
    ImageSpot spot;
    int n = (int)t->map.n, index = image_spot(t->image, q, &spot) ? image_spot_index(t->image, spot) : 0;
    if (index > n)
        index %= n;
    return t->map.entry[index < n ? index : n - 1].texture;
}

/* POV: the reverse of a checker: the first texture where the checker is 1. */
static const Texture *by_tiles(const Texture *t, Vec3 q)
{
    double sum = floor(q.x + 1e-10) + floor(q.y + 1e-10) + floor(q.z + 1e-10);
    return t->map.entry[fmod(sum, 2) == 0 && t->map.n > 1 ? 1 : 0].texture;
}

/* place: still to be passed by normals; p has passed it. */
static void resolve(const Walk *w, const Texture *t, const Affine *place, Vec3 p, double weight, const TextureFrame *outer)
{
    if (weight == 0)
        return;
    if (t->kind == TEXTURE_PLAIN) {
        TextureLeaf leaf = { .top = t, .p = p, .weight = (float)weight, .place = place, .frame = outer };
        w->visit(w->user, &leaf);
        return;
    }
    if (t->kind == TEXTURE_UV) {
        resolve(w, t->map.entry[0].texture, NULL, vec3(w->at->uv.u, w->at->uv.v, 0), weight, outer);
        return;
    }
    TextureFrame frame = { t->pattern, place, t->no_bump_scale || (outer != NULL && outer->no_bump_scale), outer };
    Vec3 q = t->pattern != NULL ? pattern_point(t->pattern, p) : p;
    switch (t->kind) {
    case TEXTURE_AVERAGE:
        average(w, t, q, weight, &frame);
        break;
    case TEXTURE_MATERIAL_MAP:
        resolve(w, by_material_map(t, q), NULL, q, weight, &frame);
        break;
    case TEXTURE_TILES:
        resolve(w, by_tiles(t, q), NULL, q, weight, &frame);
        break;
    default:
        patterned(w, t, q, weight, &frame);
        break;
    }
}

void texture_resolve(const PlacedTexture *placed, Vec3 p, const TextureContext *at, TextureVisit *visit, void *user)
{
    const Affine *place = placed->place;
    if (place != NULL && place->identity)
        place = NULL;
    Walk w = { at, visit, user };
    resolve(&w, placed->texture, place, place != NULL ? affine_point_back(place, p) : p, 1, NULL);
}

Colour texture_layer_colour(const TextureLeaf *leaf, const Texture *layer, const TextureContext *at, bool *found)
{
    return pigment_colour(layer->pigment, leaf->p, at, found);
}

bool texture_is_opaque(const Texture *texture)
{
    if (texture->kind == TEXTURE_PLAIN) {
        for (const Texture *layer = texture; layer != NULL; layer = layer->below)
            if (pigment_is_opaque(layer->pigment))
                return true;
        return false;
    }
    for (uint32_t i = 0; i < texture->map.n; i++)
        if (!texture_is_opaque(texture->map.entry[i].texture))
            return false;
    return true;
}
