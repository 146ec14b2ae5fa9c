/* texture.h - colours and normals of surfaces, straight from the structs of scene/texture.h.
 *
 * A texture at a point is a few plain layer stacks with weights ("leaves"): maps, lists, tiles and averages only choose and weigh. The
 * shader shades each leaf and blends the shaded colours. */
#ifndef TEXTURE_TEXTURE_H
#define TEXTURE_TEXTURE_H

#include "pattern/context.h"
#include "world/world.h"

/* p in the space the pigment was written in. `found` (may be NULL) is set to false where an image with `once` has nothing:
 * the colour is then rgb 1, transmit 1. By pointer, since a copy just stored would be waited for. */
Colour pigment_colour_at(const Pigment *pigment, const Vec3 *p, const TextureContext *at, bool *found);

static inline Colour pigment_colour(const Pigment *pigment, Vec3 p, const TextureContext *at, bool *found)
{
    return pigment_colour_at(pigment, &p, at, found);
}

/* The same for n <= PATTERN_MANY points where there is no surface, as functions ask them. Same bits. */
void pigment_colours(const Pigment *pigment, const Vec3 *p, Colour *out, int n);

/* The same of PIGMENT_PATTERN alone, without the quick colour. */
Colour pigment_patterned(const Pigment *pigment, const Vec3 *p, const TextureContext *at);

/* n perturbed; its length says nothing unless the caller normalises. */
Vec3 normal_perturb(const Normal *normal, Vec3 p, Vec3 n, const TextureContext *at);

/* The chain of a patterned texture around a leaf; it carries normals in and out (07, section 5.1). */
typedef struct TextureFrame {
    const Pattern *pattern;                    /* its chain counts */
    const Affine *place;                       /* before the chain; NULL: none */
    bool no_bump_scale;
    const struct TextureFrame *outer;
} TextureFrame;

typedef struct TextureLeaf {
    const Texture *top;                        /* plain; the layers are top, top->below, ... */
    Vec3 p;                                    /* where the layers are asked */
    float weight;                              /* all weights of a texture sum to 1 (unless an author's averages do not) */
    const Affine *place;                       /* carries normals of the layers, before their own chains; NULL: none */
    const TextureFrame *frame;                 /* innermost first */
    bool keep_length;                          /* no_bump_scale of a texture above */
} TextureLeaf;

/* Called once or more; the leaf lives until it returns. */
typedef void TextureVisit(void *user, const TextureLeaf *leaf);

void texture_resolve_map(const PlacedTexture *placed, const Vec3 *p, const TextureContext *at, TextureVisit *visit, void *user);

/* p: scene space, or (u,v,0) for an object with uv_mapping. Leaves of weight 0 are not visited. */
static inline void texture_resolve(const PlacedTexture *placed, Vec3 p, const TextureContext *at, TextureVisit *visit, void *user)
{
    if (placed->place != NULL)
        p = affine_point_back(placed->place, p);
    if (placed->texture->kind == TEXTURE_PLAIN) {
        TextureLeaf leaf = { placed->texture, p, 1, placed->place, NULL, false };
        visit(user, &leaf);
    } else {
        texture_resolve_map(placed, &p, at, visit, user);
    }
}

/* Of one layer of a leaf. The normal: n is the unit surface normal facing the ray; the result may point away from the viewer, and
 * is of unit length but for textures with no_bump_scale round the leaf; at->normal is set to what slope and aoi of the layer's pigment see, so ask for the normal first. A layer without a
 * normal, or quality below 8, gives n. */
Vec3 texture_layer_bumps(const TextureLeaf *leaf, const Texture *layer, Vec3 n, TextureContext *at);   /* of one that has a normal */
static inline Vec3 texture_layer_normal(const TextureLeaf *leaf, const Texture *layer, Vec3 n, TextureContext *at)
{
    return layer->normal == NULL || at->quality < 8 ? n : texture_layer_bumps(leaf, layer, n, at);
}

static inline Colour texture_layer_colour(const TextureLeaf *leaf, const Texture *layer, const TextureContext *at, bool *found)
{
    const Pigment *pigment = layer->pigment;
    if (pigment->quick == NULL && pigment->kind == PIGMENT_PLAIN)      /* most are of these two kinds */
        return pigment->colour;
    if (pigment->quick == NULL && pigment->kind == PIGMENT_PATTERN)
        return pigment_patterned(pigment, &leaf->p, at);
    return pigment_colour(pigment, leaf->p, at, found);
}

/* Is the texture the same everywhere, so that nobody need ask where? One leaf then says all of it. */
bool texture_is_flat(const Texture *texture);

/* Can light pass? (07, section 4). A texture is opaque if no way through its maps lets light through every layer. */
bool pigment_is_opaque(const Pigment *pigment);
bool texture_is_opaque(const Texture *texture);

/* Is what passes sure never to be more than what comes, but for roundings? */
bool pigment_dims(const Pigment *pigment);
bool texture_dims(const Texture *texture);

/* The factor of iridescence (04, section 5.7) on a light's contribution; p: where the layer is asked. */
Rgb finish_iridescence(const Finish *finish, Vec3 p, double cos_light, double cos_ray, Rgb wavelength, const TextureContext *at);

/* F of 04 section 5.6 for a cosine, and the tint of metallic highlights and reflections. */
double finish_metallic_fresnel(double cosine);

/* The same texture, cheaper: maps of one colour folded, layers under an opaque one dropped. Itself if there is nothing to do. */
const Texture *texture_prune(Arena *a, const Texture *texture);

#endif
