/* texture.h - what an author says of surfaces: pigments, normals, finishes, textures, and the patterns under them.
 *
 * Plain data, immutable once built, shared freely. The texture room evaluates these structs directly; compile only
 * prunes them. Points given to a texture are in scene units (World.unit undone), so lengths here are as written. */
#ifndef SCENE_TEXTURE_H
#define SCENE_TEXTURE_H

#include <stdint.h>

#include "base/diag.h"
#include "math/affine.h"
#include "math/colour.h"

typedef struct PatternOps PatternOps;
typedef struct ImageMap ImageMap;              /* scene/image_map.h: pixels with their mapping */
typedef struct Function Function;              /* func/func.h */
typedef struct Pigment Pigment;
typedef struct Normal Normal;
typedef struct Texture Texture;
typedef struct Object Object;

typedef struct Turbulence {
    Vec3 amount;
    int octaves;                               /* 1..10 */
    float omega, lambda;
} Turbulence;

typedef enum WarpKind {
    WARP_TRANSFORM, WARP_TURBULENCE, WARP_REPEAT, WARP_BLACK_HOLE, WARP_PLANAR, WARP_CYLINDRICAL, WARP_SPHERICAL,
    WARP_TOROIDAL, WARP_CUBIC
} WarpKind;

typedef struct Warp {
    WarpKind kind;
    union {
        Affine transform;                      /* the point goes through its inverse */
        Turbulence turbulence;
        struct { int axis; float width; Vec3 flip, offset; } repeat;    /* flip: components 1 or -1 factors, see 07 section 3 */
        struct { Vec3 centre, repeat, jitter; double radius, strength, falloff; bool repeats, jitters, inverse; int type; } hole;
        struct { Vec3 orientation; double dist_exp, major_radius, distance; } mapped;   /* planar ... toroidal */
    };
} Warp;

/* The chain of 07 section 3, front first: the point runs through warp[0], warp[1]..., then the turbulence record. */
typedef struct WarpChain {
    const Warp *warp;
    uint32_t n;
    bool has_turbulence;
    Turbulence turbulence;
} WarpChain;

typedef enum Wave { WAVE_RAMP, WAVE_TRIANGLE, WAVE_SINE, WAVE_SCALLOP, WAVE_CUBIC, WAVE_POLY } Wave;

typedef struct Pattern {
    const PatternOps *ops;                     /* NULL: no pattern */
    const void *params;                        /* the row's own, params_size bytes */
    WarpChain chain;
    Wave wave;
    float frequency, phase, wave_exponent;
    uint8_t noise_generator;                   /* 1..3, resolved from the scene's */
    bool scene_noise;                          /* no noise_generator was written */
    uint16_t depth;                            /* of patterns inside, through maps, lists and functions; limited by the parser */
} Pattern;

typedef enum MapKind { MAP_NONE, MAP_COLOUR, MAP_PIGMENT, MAP_NORMAL, MAP_TEXTURE, MAP_SLOPE } MapKind;

typedef struct MapEntry {
    float key;                                 /* in written order, never sorted; for average: the weight */
    union {
        Colour colour;
        const Pigment *pigment;
        const Normal *normal;
        const Texture *texture;
        struct { float height, slope; } slope;
    };
} MapEntry;

typedef struct BlendMap {
    MapKind kind;
    uint32_t n;
    const MapEntry *entry;
} BlendMap;

typedef enum PigmentKind {
    PIGMENT_PLAIN,                             /* colour */
    PIGMENT_PATTERN,                           /* pattern, map of colours or pigments (list patterns: keys 0,1,2...) */
    PIGMENT_AVERAGE,                           /* chain of pattern, map with weights */
    PIGMENT_IMAGE,                             /* chain of pattern, image */
    PIGMENT_UV                                 /* map.entry[0].pigment evaluated at (u,v,0) */
} PigmentKind;

struct Pigment {
    PigmentKind kind;
    bool untyped;                              /* neither colour nor pattern yet: black, but what is said waits for a pattern */
    Colour colour;
    const Colour *quick;                       /* NULL: no quick_color */
    const Pattern *pattern;                    /* NULL for a plain colour; the chain alone counts for average and image */
    BlendMap map;
    const ImageMap *image;
};

typedef enum NormalKind {
    NORMAL_PATTERN,                            /* pattern with amount, perhaps slope_map, normal_map or a list of normals */
    NORMAL_AVERAGE, NORMAL_BUMP_MAP, NORMAL_UV,
    NORMAL_FACETS
} NormalKind;

struct Normal {
    NormalKind kind;
    bool no_bump_scale;
    float amount;                              /* bump_size; default 0.5 */
    float accuracy;                            /* default 0.02 */
    const Pattern *pattern;                    /* never NULL; ops may be (average, bump_map, facets, uv) */
    BlendMap map;
    const ImageMap *image;
    double facets_size, facets_coords, facets_metric;
};

enum {                                         /* Finish.traits: what is asked at every hit */
    FINISH_LIT = 1,                            /* some light of lights comes back */
    FINISH_GLOSSY = 2,                         /* in highlights */
    FINISH_BRILLIANT = 4,                      /* brilliance is not 1 */
    FINISH_GRAINY = 8,
    FINISH_FILM = 16,                          /* irid */
    FINISH_MIRRORS = 32
};

typedef struct Finish {
    Rgb ambient, emission;
    float diffuse, diffuse_back, brilliance, crand;
    float phong, phong_size, specular, roughness, metallic;
    float irid, irid_thickness, irid_turbulence;
    Rgb reflection_min, reflection_max;
    float reflection_falloff, reflection_exponent, reflection_metallic;
    bool reflection_fresnel, conserve_energy;
    bool has_subsurface;
    uint8_t traits;                            /* by finish_settle, of what stands here */
    Rgb subsurface_translucency, subsurface_anisotropy;
    bool has_ior, has_caustics, has_refraction;        /* old syntax: moved to the interior by the object parser */
    float ior, caustics, refraction;
    bool diffuse_albedo, phong_albedo, specular_albedo;         /* parser's memory; applied when the block ends */
} Finish;

typedef enum TextureKind {
    TEXTURE_PLAIN,                             /* pigment, normal, finish */
    TEXTURE_PATTERN,                           /* pattern, map of textures (texture_map or a list) */
    TEXTURE_AVERAGE, TEXTURE_MATERIAL_MAP, TEXTURE_TILES, TEXTURE_UV
} TextureKind;

/* One layer. The top layer comes first; `below` is the one written before it. Only plain layers have a `below`. */
struct Texture {
    TextureKind kind;
    const Pigment *pigment;
    const Normal *normal;                      /* may be NULL */
    const Finish *finish;
    bool no_bump_scale;
    const Pattern *pattern;                    /* NULL when plain; chain alone for average, material_map, tiles, uv */
    BlendMap map;
    const ImageMap *image;                     /* material_map */
    const Texture *below;
};

/* One of a long list, such as a mesh with a texture for each of its triangles: most differ in their colour alone. */
typedef struct ListedTexture {
    const Texture *texture;
    bool coloured;                             /* its top layer is of this colour instead */
    Colour colour;
} ListedTexture;

#endif
