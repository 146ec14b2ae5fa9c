/* texture.c - a texture at a point as weighted stacks of plain layers.
 *
 * Every map, list, tile and average only chooses textures and weighs them; weights multiply on the way down, and the chains
 * passed are linked for the normals of the leaves.
 *
 * POV: a chain once passed stays in force for the textures evaluated after it at this point, siblings too: the normals of the
 * second texture of a blend go through the transforms of patterns inside the first. So frames are pushed and never popped. */
#include "texture/texture.h"

#include "image/image.h"
#include "pattern/pattern.h"
#include "scene/image_map.h"
#include "texture/map.h"
#include "texture/sample.h"

enum { FRAMES_KEPT = 48 };

typedef struct Walk {
    const TextureContext *at;
    TextureVisit *visit;
    void *user;
    const TextureFrame *top;                   /* innermost frame so far */
    uint32_t n_frames;
    TextureFrame frame[FRAMES_KEPT];
} Walk;

static void resolve(Walk *w, const Texture *t, const Affine *place, Vec3 p, double weight, bool keep_length);

static void patterned(Walk *w, const Texture *t, Vec3 q, double weight, bool keep_length)
{
    MapSpot spot = map_find(t->map.entry, t->map.n, pattern_value_at(t->pattern, q, w->at));
    resolve(w, spot.to->texture, NULL, q, weight * spot.t, keep_length);
    if (spot.from != NULL)
        resolve(w, spot.from->texture, NULL, q, weight * (1 - spot.t), keep_length);
}

static void average(Walk *w, const Texture *t, Vec3 q, double weight, bool keep_length)
{
    double total = map_total(&t->map);
    for (uint32_t i = 0; i < t->map.n; i++)
        resolve(w, t->map.entry[i].texture, NULL, q, total != 0 ? weight * (double)t->map.entry[i].key / total : weight, keep_length);
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

/* A pattern, its chain in force. */
static void resolve_pattern(Walk *w, const Texture *t, Vec3 p, double weight, bool keep_length)
{
    Vec3 q = t->pattern != NULL ? pattern_point(t->pattern, p) : p;
    switch (t->kind) {
    case TEXTURE_AVERAGE:
        average(w, t, q, weight, keep_length);
        break;
    case TEXTURE_MATERIAL_MAP:
        resolve(w, by_material_map(t, q), NULL, q, weight, false);     /* POV: does not hand no_bump_scale down */
        break;
    case TEXTURE_UV:                           /* the point forgets the chain, normals do not */
        resolve(w, t->map.entry[0].texture, NULL, vec3(w->at->uv.u, w->at->uv.v, 0), weight, keep_length);
        break;
    case TEXTURE_TILES:
        resolve(w, by_tiles(t, q), NULL, q, weight, keep_length);
        break;
    default:
        patterned(w, t, q, weight, keep_length);
        break;
    }
}

/* place: still to be passed by normals; p has passed it. keep_length: no_bump_scale from above. */
static void resolve(Walk *w, const Texture *t, const Affine *place, Vec3 p, double weight, bool keep_length)
{
    if (weight == 0)
        return;
    if (t->kind == TEXTURE_PLAIN) {
        TextureLeaf leaf = { t, p, (float)weight, place, w->top, keep_length };
        w->visit(w->user, &leaf);
        return;
    }
    keep_length |= t->no_bump_scale;
    TextureFrame frame = { t->pattern, place, keep_length, w->top };
    bool kept = w->n_frames < FRAMES_KEPT;
    TextureFrame *pushed = kept ? &w->frame[w->n_frames++] : &frame;
    *pushed = frame;
    w->top = pushed;
    resolve_pattern(w, t, p, weight, keep_length);
    if (!kept)
        w->top = frame.outer;
}

/* p went through the place already. */
void texture_resolve_map(const PlacedTexture *placed, const Vec3 *p, const TextureContext *at, TextureVisit *visit, void *user)
{
    Walk w;                                    /* only the frames in use are written */
    w.at = at;
    w.visit = visit;
    w.user = user;
    w.top = NULL;
    w.n_frames = 0;
    resolve(&w, placed->texture, placed->place, *p, 1, false);
}

bool texture_is_flat(const Texture *texture)
{
    for (const Texture *layer = texture; layer != NULL; layer = layer->below) {
        if (layer->kind != TEXTURE_PLAIN || layer->normal != NULL || layer->finish->irid > 0)
            return false;
        if (layer->pigment->kind != PIGMENT_PLAIN || layer->pigment->quick != NULL)
            return false;
    }
    return true;
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

/* Blends of what dims dim as well; averages may have weights of any sign. */
bool texture_dims(const Texture *texture)
{
    if (texture->kind == TEXTURE_PLAIN) {
        for (const Texture *layer = texture; layer != NULL; layer = layer->below)
            if (!pigment_dims(layer->pigment))
                return false;
        return true;
    }
    for (uint32_t i = 0; i < texture->map.n; i++)
        if (!texture_dims(texture->map.entry[i].texture))
            return false;
    return texture->kind != TEXTURE_AVERAGE;
}
