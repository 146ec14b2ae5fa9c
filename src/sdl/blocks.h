/* blocks.h - what the block grammars share: the state of a scene being read, and drafts of things still open.
 *
 * A draft is a mutable copy on the stack; closing it puts an immutable struct into the scene arena. What a block does
 * not change it shares with what it began from, and equal one-colour textures are one: files with a texture for each of
 * a million triangles are common. */
#ifndef SDL_BLOCKS_H
#define SDL_BLOCKS_H

#include "base/array.h"
#include "sdl/block.h"
#include "sdl/host.h"

enum {
    MAX_OBJECT_DEPTH = 1000, MAX_PATTERN_DEPTH = 250, MAX_LAYERS = 250,        /* what is walked by recursion has a limit */
    MAX_MEDIA = 250
};

enum { TEXTURE_CACHE = 1024, FINISH_CACHE = 64, PIECE = 64 };      /* entries; the first two powers of two */

typedef struct Material {
    const Texture *texture, *interior_texture;
    const Interior *interior;
} Material;

struct ImageSeen;                              /* image.c */

typedef struct Blocks {
    Scene *scene;
    const Texture *default_texture;
    CameraDef default_camera;
    bool has_noise_generator;                  /* written: #version no longer changes it */
    const ShapeOps *shape_of[N_KEYWORDS];
    const PatternOps *pattern_of[N_KEYWORDS];
    ARRAY(const Object *) object;
    ARRAY(const FogDef *) fog;
    ARRAY(const RainbowDef *) rainbow;
    ARRAY(const Media *) media;
    ARRAY(Pattern *) scene_noise;              /* to be told the noise generator that the scene ends with */
    struct ImageSeen *images;
    unsigned pattern_depth;                    /* the deepest pattern met inside what is being read */
    unsigned function_depth;                   /* ... inside any user function so far */
    Pigment *free_pigment;                     /* plain pigments and textures are cut from pieces of many: ... */
    Texture *free_texture;
    uint32_t n_free_pigments, n_free_textures; /* ... the arena would round each up */
    const Pigment *pigment_cache[TEXTURE_CACHE];           /* plain colours, by their bits */
    const Texture *texture_cache[TEXTURE_CACHE];           /* plain textures, by their parts */
    const Finish *finish_cache[FINISH_CACHE];
} Blocks;

/* block.c */
Blocks *blocks_new(Parser *p, Scene *scene);
Blocks *parse_blocks(const Parser *p);
const char *parse_word(int keyword);           /* its spelling */
_Noreturn void map_misplaced(Parser *p, int keyword);      /* a map or the like in a block of another kind */
bool parse_move(Parser *p, Affine *move);      /* one translate, rotate, scale, matrix or transform; not composed */

/* Transforms in the order written. They are applied one by one, so rounding is as if nothing had been put off. */
typedef struct Moves {
    Affine move[4];
    unsigned n;
} Moves;

/* pattern.c: the part of a pigment, normal or texture that says where. */
typedef struct PatternDraft {
    Pattern pattern;
    const Pattern *base;
    bool changed;                              /* since begun: `base` can no longer be shared */
    bool own_params;                           /* pattern.params is this draft's own */
    bool exponent, list;                       /* `exponent` was written; it began as a list pattern */
    uint32_t n;
    Warp warp[3];                              /* written last, in order of writing; they go in front of pattern.chain */
} PatternDraft;

typedef enum PatternUse { USE_PIGMENT, USE_NORMAL, USE_TEXTURE, USE_DENSITY } PatternUse;

extern const Turbulence TURBULENCE_DEFAULT;

/* Around a body that may hold patterns; `depth` is that of what it became. The evaluator recurses, so there is a limit. */
unsigned pattern_depth_begin(Parser *p);
void pattern_depth_end(Parser *p, unsigned outer, unsigned depth);
void pattern_depth_add(Parser *p, unsigned depth);         /* something of this depth is used in the body */
static inline unsigned pattern_depth(const Pattern *pattern) { return pattern != NULL ? pattern->depth : 0; }

const PatternOps *pattern_row(Parser *p, int keyword);     /* NULL: no pattern */
void pattern_begin(PatternDraft *d, const Pattern *base);  /* base may be NULL */
void pattern_choose(Parser *p, PatternDraft *d, const PatternOps *ops);    /* after its keyword */
void pattern_list_end(Parser *p, const PatternOps *ops);   /* after its list */
bool pattern_modifier(Parser *p, PatternDraft *d);         /* one modifier, if the next token begins one */
const Pattern *pattern_close(Parser *p, PatternDraft *d);  /* NULL if it began from NULL and nothing was said */
const Pattern *pattern_plain(Parser *p);       /* an empty one around what has been read in this body: of uv_mapping */
const Pattern *pattern_moved(Parser *p, const Pattern *pattern, const Moves *moves);
bool parse_turbulence_item(Parser *p, int keyword, Turbulence *t);         /* after turbulence, octaves, omega, lambda */
Warp parse_warp(Parser *p);                    /* at `warp` */

/* map.c: after the keyword. */
typedef ARRAY(MapEntry) Entries;

BlendMap parse_colour_map(Parser *p);
BlendMap parse_map(Parser *p, MapKind kind, PatternUse use, bool weights);
BlendMap parse_pattern_list(Parser *p, const PatternOps *ops, PatternUse use);

/* pigment.c, normal.c, finish.c, texture.c. A body goes on to the brace or bracket that ends it, which stays. */
extern const Pigment PIGMENT_EMPTY;            /* black, no pattern: where densities and sky_spheres begin */
extern const Normal NORMAL_EMPTY;              /* flat */
extern const Finish FINISH_DEFAULT;
void finish_settle(Finish *f);                 /* after every change */

const Pigment *pigment_body(Parser *p, const Pigment *base, PatternUse use);       /* of a pigment or a density */
const Pigment *pigment_of_colour(Parser *p, Colour c);
const Normal *normal_body(Parser *p, const Normal *base);  /* base may be NULL */
bool normal_is_unfinished(const Normal *n);    /* no pattern was ever written */
const Finish *finish_block(Parser *p, const Finish *base); /* at the brace */
const Finish *finish_items(Parser *p, const Finish *base); /* those that come next; NULL: none */
const Texture *texture_body(Parser *p);
unsigned texture_depth(const Texture *t);      /* of the patterns in its layers */
const Texture *texture_part(Parser *p, const Texture *top);        /* at pigment, normal or finish: top with that changed */
const Texture *texture_layered(Parser *p, const Texture *below, const Texture *above);     /* below may be NULL */
const Texture *texture_with(Parser *p, const Texture *from, const Pigment *pigment, const Normal *normal, const Finish *finish);
const Pigment *pigment_moved(Parser *p, const Pigment *pigment, const Moves *moves);
const Normal *normal_moved(Parser *p, const Normal *normal, const Moves *moves);
const Texture *texture_moved(Parser *p, const Texture *texture, const Moves *moves);       /* all layers */

/* One item of a texture before version 3.0, which had no blocks for its parts; NULL: none comes next. The last two read one item of
 * theirs (old_texture.c). */
const Texture *old_texture_item(Parser *p, const Texture *t);
const Pigment *pigment_old_item(Parser *p, const Pigment *base);
const Normal *normal_old_item(Parser *p, const Normal *base);          /* base may be NULL */

/* interior.c: at the brace. */
const Interior *interior_block(Parser *p, const Interior *base);   /* base may be NULL */
const Media *media_block(Parser *p);
const Material *material_block(Parser *p);
const Pigment *density_block(Parser *p);       /* at `density` */
const Interior *interior_moved(Parser *p, const Interior *interior, const Moves *moves);
const Interior *interior_with_finish(Parser *p, const Interior *base, const Finish *f);

/* object.c, light.c */
typedef struct ObjectDraft {
    Object o;
    ObjectMore more;                           /* o.more, once it is closed */
    Affine *own_place;                         /* o.place, if it was made in this block and may be changed in place */
} ObjectDraft;

void draft_new(ObjectDraft *d, Object o);      /* from what it is, nothing more */
void draft_begin(ObjectDraft *d, const Object *from);
void draft_move(Parser *p, ObjectDraft *d, const Affine *move);    /* everything that the object carries so far */
Object *draft_close(Parser *p, const ObjectDraft *d);
void object_modifiers(Parser *p, ObjectDraft *d, const char *word);        /* to the brace that closes `word` */
const Object *object_moved(Parser *p, const Object *o, const Affine *move);
bool object_is_patch(const Object *o);         /* has no inside */
const Object *object_value(Parser *p);         /* to be declared; NULL if the next token starts no object */
void draft_holds(Parser *p, ObjectDraft *d, const Object *part);   /* the depth grows with it */
bool scene_object(Parser *p);                  /* a statement of the scene, if the next token begins an object */
Object *light_block(Parser *p);                /* at `light_source` */
const PhotonsBlock *photons_block(Parser *p, const PhotonsBlock *base, bool light);        /* at the brace */
void importance_block(Parser *p);              /* at `radiosity`, of objects and #default: read and checked, but not heeded */

/* camera.c, global.c, atmosphere.c: at the brace. */
CameraDef camera_default(void);
CameraDef camera_block(Parser *p);
void globals_init(Parser *p, Globals *g);
void globals_block(Parser *p);
bool globals_old_item(Parser *p);              /* max_trace_level, max_intersections at scene level */
void background_block(Parser *p);
const FogDef *fog_block(Parser *p);
const RainbowDef *rainbow_block(Parser *p);
const SkySphere *sky_sphere_block(Parser *p);

/* image.c */
typedef enum ImageUse { IMAGE_COLOUR, IMAGE_BUMP, IMAGE_VALUE, IMAGE_INDEX } ImageUse;     /* ... of material_map */

/* The file and its modifiers; `amount` takes bump_size. image_block with braces. */
const ImageMap *image_items(Parser *p, ImageUse use, float *amount);
const ImageMap *image_block(Parser *p, ImageUse use, float *amount);

#endif
