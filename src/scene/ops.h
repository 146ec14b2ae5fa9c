/* ops.h - the form of the tables: what a shape and a pattern must be able to do. The rows stand in registry.c. */
#ifndef SCENE_OPS_H
#define SCENE_OPS_H

#include "math/bounds.h"
#include "scene/scene.h"

typedef struct Parser Parser;                  /* sdl/parse.h */
typedef struct ShapeBuild ShapeBuild;          /* world/build.h */
typedef struct Ray Ray;                        /* world/ray.h */
typedef struct Fan Fan;                        /* world/fan.h */
typedef struct FanHits FanHits;
typedef struct Vec3s Vec3s;
typedef struct Solid Solid;                    /* world/glance.h */
typedef struct Hit Hit;
typedef struct HitSink HitSink;
typedef struct Surface Surface;

enum {
    SHAPE_PATCH = 1,                           /* has no inside (08-shapes 10.2) */
    SHAPE_HAS_OPEN = 2, SHAPE_HAS_STURM = 4, SHAPE_HAS_HIERARCHY = 8,  /* accepts that modifier; see Object.flags */
    SHAPE_HAS_UV = 16,                         /* surface fills uv */
    SHAPE_NO_BOX_IN_CSG = 32,                  /* its inside reaches beyond its box (height_field, disc) */
    /* Its data are the same for every copy: compile looks only at params and the object's flags, not at the place, and gets
     * the identity for one. Copies then share what build_data gave (mesh, blob, height_field, text...). */
    SHAPE_SHARED = 64,
    SHAPE_NORMAL_STAYS = 128,                  /* POV: `inverse` does not turn its normal (quadric, julia_fractal) */
    SHAPE_IGNORES_CLIP = 256,                  /* POV: clipped_by does nothing to its hits (bicubic_patch) */
    SHAPE_CONVEX = 512,                        /* its inside is convex: a bound that holds a box's corners holds the box */
    SHAPE_FLAT = 2048,                         /* its normals are few, so that a branch on one is foreseen */
    SHAPE_SMOOTH = 4096,                       /* surface may give a geometric normal besides the normal */
    SHAPE_FIRST_HITS = 8192,                   /* may tell only some of its hits, those that a ray from its origin finds first */
    SHAPE_HAS_TEXTURES = 16384,                /* surface may list textures of its own */
    SHAPE_BOUND_STAYS = 1024                   /* POV: an outermost bounded_by cuts exactly, not by its box (poly, quadric, text) */
};

struct ShapeOps {
    const char *keyword;
    size_t params_size;
    unsigned flags;
    /* After the keyword and '{' (and after no identifier: `sphere { S ... }` is a copy). Stops at the first token that
     * is not the shape's own. */
    void (*parse)(Parser *p, void *params);
    /* Optional. Offered each further item of the block before the common modifiers: reads it if it is the shape's own
     * (`water_level`, `smooth`, `threshold`...) and says so. */
    bool (*item)(Parser *p, void *params);
    /* Optional: called at the closing brace, to check and to finish. */
    void (*finish)(Parser *p, void *params);
    void (*compile)(ShapeBuild *b, const void *params);        /* writes prims and their constants into the World */
    /* Reports every root with t in (ray->t_min, ray->t_max], in any order, by hit_add. t is a function of shape and
     * ray alone: t_max may skip work, never enter arithmetic. The ray is in the prim's local space, d not of unit length. */
    void (*hits)(const void *shape, const Ray *ray, HitSink *sink);
    /* Optional, for shapes of at most two roots: those that `hits` finds for the rays of a fan, by the very same arithmetic. */
    void (*fan_hits)(const void *shape, const Fan *fan, FanHits *out);
    /* Optional. Bit i: point i is inside, just as `inside` says it. */
    uint32_t (*fan_inside)(const void *shape, const Vec3s *p);
    /* Optional: bounds the shape's solid within a box, all in the shape's space, where it has no finite box of its own: a cone
     * between two planes. */
    Bounds (*within)(const void *shape, Bounds box);
    /* Optional: the shape is the half space normal . p <= distance, the normal of unit length: several may have a box. */
    void (*half_space)(const void *shape, Vec3 *normal, double *distance);
    /* Optional: the shape is this convex solid, but for margins of 2^-30 of its size; false: it is not. */
    bool (*solid)(const void *shape, Solid *out);
    /* Optional: the largest n . p of its points, n of any length; closer than its box. */
    double (*reach)(const void *shape, Vec3 n);
    bool (*inside)(const void *shape, Vec3 p);                 /* NULL: never inside */
    void (*surface)(const void *shape, const Hit *hit, Surface *out);  /* for the winner only; see Surface */
    /* The box that min_extent and max_extent report (08-shapes 4.1), in the space `place` takes the shape's own to: some
     * shapes swallow transforms, others hull the corners of a box in a frame of their own (2.2). Unbounded sides are
     * INFINITY (the caller turns them into POV-Ray's 1e10). It must hold the shape: the scale of the World is chosen by it. */
    Bounds (*extent)(const void *params, const Affine *place);
};

/* Where a pattern is asked. Only `p` is always there. */
typedef struct PatternPoint {
    Vec3 p;                                    /* after the chain, turbulence included (marble, wood: excluded) */
    const Pattern *pattern;                    /* frequency, phase, turbulence record, noise generator */
    const struct TextureContext *context;      /* pattern/context.h: ray, normals for slope and aoi; NULL without a hit */
} PatternPoint;

enum { PATTERN_MANY = 32 };

enum {
    PATTERN_LIST = 1,                          /* takes a list of items (checker, brick...): n_items of them */
    PATTERN_NO_WAVE = 2,                       /* value is a whole number or an index: wave, frequency, phase do not apply */
    PATTERN_OWN_TURBULENCE = 4,                /* marble, wood: the turbulence record is used inside the formula */
    PATTERN_OWN_NORMAL = 8,                    /* bumps, dents...: `bump` perturbs normals directly (07 section 5.2) */
    PATTERN_NORMAL_ONLY = 16                   /* facets */
};

struct PatternOps {
    const char *keyword;
    size_t params_size;
    unsigned flags;
    int n_items;                               /* LIST: how many */
    const MapEntry *default_map;               /* NULL: black to white */
    uint32_t n_default_map;
    Wave default_wave;
    void (*parse)(Parser *p, void *params);    /* after the keyword: `gradient V`, `spiral1 n`; may be NULL */
    bool (*item)(Parser *p, void *params);     /* optional: later items of the block, as for shapes (`metric`, `mortar`) */
    void (*finish)(Parser *p, const void *params);     /* optional: checks them when the block ends */
    double (*value)(const void *params, const PatternPoint *at);       /* before frequency, phase and wave */
    /* Optional: the same for n <= PATTERN_MANY points without a context. */
    void (*values)(const void *params, const Pattern *pattern, const Vec3 *p, double *out, int n);
    Vec3 (*bump)(const void *params, const PatternPoint *at, Vec3 normal, double amount);      /* OWN_NORMAL */
};

typedef struct Registry {
    const ShapeOps *const *shape;              /* ended by NULL */
    const PatternOps *const *pattern;
} Registry;

#endif
