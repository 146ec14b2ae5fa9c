/* world.h - what a ray needs: flat arrays, only what this scene uses. Written once by compile, then const.
 *
 * World space is scene space times `unit`, a power of two that brings the scene near size 1. All lengths in the World
 * are in world space, except inside textures (see texture.h). */
#ifndef WORLD_WORLD_H
#define WORLD_WORLD_H

#include "math/bounds.h"
#include "scene/ops.h"
#include "world/ray.h"

/* An acceleration structure over n boxes; it knows nothing of what is in them. */
typedef bool AccelVisit(void *user, uint32_t item, double *t_max);     /* may lower *t_max; true stops the walk */
typedef struct AccelOps {
    const char *name;
    void *(*build)(Arena *a, const Bounds *boxes, uint32_t n);
    /* Offers every item whose box the ray may meet within (t_min, *t_max], in any order, possibly twice. */
    bool (*walk)(const void *accel, const Ray *ray, double *t_max, AccelVisit *visit, void *user);
    /* Offers every item whose box may contain p. */
    bool (*around)(const void *accel, Vec3 p, AccelVisit *visit, void *user);
    /* Offers every item whose box may meet a straight line from o to a point of `to`. */
    bool (*between)(const void *accel, Vec3 o, Bounds to, AccelVisit *visit, void *user);
} AccelOps;

enum {                                         /* Prim.flags */
    PRIM_NO_SHADOW = 1, PRIM_NO_IMAGE = 2, PRIM_NO_REFLECTION = 4, PRIM_NO_RADIOSITY = 8,
    PRIM_INVERSE = 16,                         /* normals flip, inside is negated */
    PRIM_PATCH = 32,                           /* never inside, also inverted */
    PRIM_HELPER = 64,                          /* clip or bound shape: inside tests only, not in the accelerator */
    PRIM_NO_IMAGE_LATER = 128,                 /* POV: no_image on a child of an unsplit union: the camera's own rays see it */
    PRIM_OPAQUE = 256,                         /* all textures it may show, interior_texture too, are opaque: shadow rays may stop */
    PRIM_BOXED = 512,                          /* unbounded, but for a bound: hits outside its box do not count */
    PRIM_BOUNDED = 1024,                       /* below a BOUND node */
    PRIM_CONVEX = 2048,                        /* and closed: a line through its inside meets its surface on both sides */
    PRIM_FACE = 4096                           /* flat, in the world's space, not inverted, and no cutaway */
};

typedef struct Prim {
    const ShapeOps *ops;
    const void *data;
    const Affine *place;                       /* its space to the world; never NULL */
    uint32_t material;
    uint32_t csg;                              /* CsgNode this prim is a child of; 0 = none */
    uint32_t flags;
} Prim;

typedef enum CsgOp { CSG_ANY, CSG_ALL } CsgOp;         /* union and merge; intersection and difference */
enum { CSG_MERGE = 1, CSG_CLIP = 2, CSG_INVERSE = 4, CSG_CUTAWAY = 8, CSG_DIFFERENCE = 16, CSG_BOUND = 32 };

/* A set operation. Its children are items [first, first + n) of csg_child; item = prim index, or ~node. A hit on a child of
 * an ALL node counts if every other child contains the point; of a MERGE node if no other child does; of a CLIP node
 * (one body and its clipping helpers) if every helper does; of a BOUND node (one body and its bounds) if the ray meets every
 * bound. Then the parent is asked likewise. The first child stays first; the order of the others means nothing. */
typedef struct CsgNode {
    uint32_t parent;                           /* 0 = none */
    uint32_t first, n;
    uint32_t n_listed;                         /* children asked one by one; the rest stand in accel */
    uint32_t first_prim, n_prims;              /* all the leaves below, helpers too */
    uint32_t interior;                         /* of the whole: in World.interior */
    CsgOp op;
    uint32_t flags;
    Bounds box;                                /* world; a point outside is outside, for INVERSE: inside; for BOUND: see prim.c */
    const void *accel;                         /* item i is child first + n_listed + i; NULL when there are few */
} CsgNode;

/* A child as its siblings' hits ask it. It answers if it does not let them count: in an ANY node where it contains the point, in an
 * ALL node where it does not. A prim that is never inside has an empty box. */
typedef struct CsgPart {
    Bounds box;                                /* wider than the child: of a point outside the answer is known */
    uint32_t item;                             /* as in csg_child */
    bool far_answer;                           /* outside the box */
    bool near_answer;                          /* inside the box: it answers if `inside` says this, or for a node item_inside */
    bool (*inside)(const void *shape, Vec3 p); /* of a prim */
    const void *data;
    const Affine *place;                       /* NULL: the identity */
} CsgPart;

typedef struct PlacedTexture {
    const Texture *texture;                    /* top layer */
    const Affine *place;                       /* scene space: the point goes through its inverse first; NULL: identity */
    bool opaque;                               /* never lets light through, no alpha: shadow rays may stop */
} PlacedTexture;

typedef struct PlacedInterior {
    const Interior *interior;                  /* never NULL; the index of this entry is the identity of the body */
    const Affine *place;                       /* for densities, as above; NULL: identity */
    bool hollow;
} PlacedInterior;

enum { MATERIAL_UV = 1, MATERIAL_DOUBLE_ILLUMINATE = 2, MATERIAL_NO_GLOBAL_LIGHTS = 4, MATERIAL_HAS_INTERIOR_TEXTURE = 8,
       MATERIAL_CUTAWAY = 16 };

typedef struct Material {
    uint32_t texture, interior_texture;        /* in World.texture; texture 0 is "none" */
    uint32_t interior;                         /* in World.interior */
    uint32_t flags;
    uint32_t first_group_light, n_group_lights;        /* in World.group_light */
} Material;

typedef struct Light {
    const LightSource *def;
    Vec3 location, point_at, axis;             /* world; axis = unit(point_at - location) */
    Vec3 axis1, axis2;                         /* area light, world */
    Rgb colour;
    double fade_distance;                      /* world */
    double radius, falloff;                    /* spot: cosines; cylinder: world lengths */
    uint32_t projected_through;                /* CSG item + 1; 0 = none */
    bool grouped;                              /* lights only its group */
} Light;

enum {                                         /* World.features */
    WORLD_HAS_CSG = 1, WORLD_HAS_TRANSPARENT = 2, WORLD_HAS_REFLECTION = 4, WORLD_HAS_FLAGS = 8, WORLD_HAS_FOG = 16,
    WORLD_HAS_FIRST_HITS = 32                  /* of shapes that tell only some of their hits */
};

struct World {
    Arena arena;
    const Registry *registry;
    double unit;                               /* world = scene * unit */
    unsigned features;
    Prim *prim;                 uint32_t n_prims;              /* in scene order: the tie break of equal hits */
    Bounds *box;                                               /* of each prim, world, cut by its CSG ancestors */
    CsgNode *csg;               uint32_t n_csg;                /* csg[0] unused */
    uint32_t *csg_child;        uint32_t n_csg_children;
    CsgPart *csg_part;                                         /* of each csg_child */
    /* Top-level items that the accelerator does not find around a point: unbounded, inverted or clipped ones. */
    uint32_t *body;             uint32_t n_bodies;
    Material *material;         uint32_t n_materials;
    PlacedTexture *texture;     uint32_t n_textures;           /* texture[0]: none */
    PlacedInterior *interior;   uint32_t n_interiors;          /* interior[0]: the default */
    Light *light;               uint32_t n_lights;             /* global lights first, then grouped ones */
    uint32_t n_global_lights;
    uint32_t *group_light;      uint32_t n_group_lights;
    CameraDef camera;                                          /* scene space; camera.c multiplies by unit */
    Globals globals;
    const Scene *scene;                                        /* fog, rainbow, sky_sphere: plain data, in scene units */
    const AccelOps *accel_ops;
    const void *accel;                                         /* over bounded prims: item i is prim accel_prim[i] */
    uint32_t *accel_prim;       uint32_t n_accel_prims;
    uint32_t *unbounded;        uint32_t n_unbounded;          /* prims tested for every ray */
    Bounds bounds;                                             /* of all bounded prims */
};

#endif
