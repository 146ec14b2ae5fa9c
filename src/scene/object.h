/* object.h - things in the scene, as a tree of immutable nodes.
 *
 * `object { Chair ... }` copies one node and shares the rest. A transform is composed into the node's own place and
 * into the places of what the node carries: each *_place holds the transforms written since that thing was attached
 * (so `texture { T } rotate y*30` turns T, and `rotate y*30 texture { T }` does not). compile composes parents' places
 * into them on the way down. */
#ifndef SCENE_OBJECT_H
#define SCENE_OBJECT_H

#include "scene/interior.h"
#include "scene/light.h"

typedef struct ShapeOps ShapeOps;

typedef enum ObjectKind {
    OBJECT_SHAPE, OBJECT_UNION, OBJECT_MERGE, OBJECT_INTERSECTION, OBJECT_DIFFERENCE, OBJECT_LIGHT, OBJECT_LIGHT_GROUP
} ObjectKind;

enum {
    OBJECT_INVERSE = 1 << 0,
    OBJECT_HOLLOW = 1 << 1, OBJECT_HOLLOW_SET = 1 << 2,        /* _SET: the author said so, parents do not override */
    OBJECT_NO_SHADOW = 1 << 3, OBJECT_NO_IMAGE = 1 << 4, OBJECT_NO_REFLECTION = 1 << 5, OBJECT_NO_RADIOSITY = 1 << 6,
    OBJECT_DOUBLE_ILLUMINATE = 1 << 7,
    OBJECT_STURM = 1 << 8, OBJECT_OPEN = 1 << 9, OBJECT_NO_HIERARCHY = 1 << 10,
    OBJECT_CUTAWAY_TEXTURES = 1 << 11, OBJECT_NO_SPLIT_UNION = 1 << 12,
    OBJECT_UV_MAPPING = 1 << 13,
    OBJECT_GLOBAL_LIGHTS = 1 << 14,            /* light_group: members also see the global lights */
    OBJECT_BOUNDED_BY_CLIP = 1 << 15,          /* bounded_by { clipped_by }: both lists are the same */
    OBJECT_HAS_INSIDE = 1 << 16,               /* a mesh with inside_vector: no patch */
    OBJECT_HOLDS_PATCH = 1 << 17,              /* CSG: some child, at any depth, is a patch */
    OBJECT_DECLARED = 1 << 18                  /* has been an identifier: it and its copies may stand in many places */
};

typedef struct PhotonsBlock {
    bool target, refraction_on, refraction_off, reflection_on, reflection_off, collect_off, pass_through, area_light;
    float target_spacing;
} PhotonsBlock;

/* What most objects do without. */
typedef struct ObjectMore {
    const Texture *interior_texture;           /* NULL: none */
    const Affine *interior_texture_place;
    const Interior *interior;                  /* NULL: the parent's, or an empty one */
    const Affine *interior_place;              /* for media densities */
    const Object *const *clipped_by, *const *bounded_by;       /* already carry every transform written after them */
    uint32_t n_clipped_by, n_bounded_by;
    const PhotonsBlock *photons;
} ObjectMore;

/* Scenes have hundreds of thousands of them. */
struct Object {
    ObjectKind kind;
    uint32_t flags;
    Loc loc;
    const ShapeOps *ops;                       /* SHAPE: the row ... */
    union {
        const void *params;                    /* ... and what it parsed */
        const LightSource *light;              /* LIGHT */
        const Object *const *child;            /* CSG kinds and groups; n_child is 0 for all others */
    };
    uint32_t n_child;
    uint32_t depth;                            /* of the tree below, clips and the like included; limited by the parser */
    const Affine *place;                       /* every transform written in the block; here and below NULL is identity */
    const Texture *texture;                    /* top layer first; NULL: inherited, then the default texture */
    const Affine *texture_place;               /* often the same pointer as place */
    const Texture *default_texture;            /* in force when the outermost statement ended */
    const ObjectMore *more;                    /* NULL: nothing of it */
};

static inline const ObjectMore *object_more(const Object *o)
{
    static const ObjectMore nothing = { 0 };
    return o->more != NULL ? o->more : &nothing;
}

#endif
