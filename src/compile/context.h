/* context.h - what the files of this room share: the World in the making, and what an object inherits. */
#ifndef COMPILE_CONTEXT_H
#define COMPILE_CONTEXT_H

#include "base/array.h"
#include "world/build.h"

typedef struct Compile Compile;

/* Items are prim indices or ~node indices, as in World.csg_child. */
typedef ARRAY(uint32_t) Items;

/* Open addressing over indices of an array that its user keeps: 0 = free, otherwise index + 1. */
typedef struct Table {
    uint32_t *slot;
    uint32_t n, capacity;                      /* capacity is a power of two */
} Table;

/* What comes from the objects around: the place and whatever a child takes when it says nothing itself. */
typedef struct Inherited {
    const Affine *place;                       /* the space in which the object's own place ends, to the scene; not NULL */
    const Texture *default_texture;
    uint32_t texture, interior_texture;        /* World.texture; 0 = none yet */
    uint32_t interior;                         /* World.interior; 0 = none yet */
    uint32_t prim_flags;
    uint32_t inversions;                       /* how often turned inside out */
    uint32_t first_group_light, n_group_lights;
    bool uv, hollow, cutaway, double_illuminate, no_global_lights;
    bool in_csg;
    bool may_repeat;                           /* below something declared */
    bool lights_known;                         /* light_group: its own lights are in the World already */
} Inherited;

typedef struct Screen {                        /* projected_through: compiled when all else is */
    const Object *object;
    Affine place;
    uint32_t light;
    bool grouped;
} Screen;

typedef struct SharedPrim {                    /* what one build_prim call said, in the shape's own space */
    const void *data;
    Affine place;
    Bounds local;
} SharedPrim;

typedef struct Shared {                        /* a shape compiled for all its copies */
    const void *params;
    const ShapeOps *ops;
    uint32_t flags;
    bool own;                                  /* depends on the copy after all: compiled each time */
    bool opaque, no_inside;
    uint32_t first, n;                         /* in Compile.shared_prim */
} Shared;

enum { RECENT_PLACES = 256 };                  /* shapes in the scene's own space have few: one for each unit */

struct Compile {
    World *w;
    Arena *arena;                              /* where the World's arrays stand */
    Diag *diag;
    bool geometry_only;                        /* queries: no textures, materials, lights */
    double unit;
    Affine to_world;                           /* scale by unit */
    const Affine *identity;                    /* of prims */
    const Affine *recent_place[RECENT_PLACES]; /* by the hash of the matrix; the newest stays */
    const Affine *last_place;                  /* NULL, or the one that was kept or found last */

    ARRAY(Prim) prim;
    ARRAY(Bounds) box;
    ARRAY(CsgNode) csg;
    Items csg_child, body;
    ARRAY(Material) material;
    ARRAY(PlacedTexture) texture;
    ARRAY(PlacedInterior) interior;
    ARRAY(Light) global_light;
    ARRAY(Light) group_light;
    Items group_list;                          /* indices in group_light */
    ARRAY(Screen) screen;
    ARRAY(Shared) shared;
    ARRAY(SharedPrim) shared_prim;
    Table materials, textures, shares, pruned;
    ARRAY(const Texture *) pruned_key;
    ARRAY(const Texture *) pruned_value;

    /* The shape being compiled. */
    const Inherited *from;
    const Affine *shape_place;                 /* its own space to the world */
    Affine scaled_place, scaled_from;          /* of build_place: the last result, and what it was made from */
    double scaled_by;
    uint32_t shape_material, shape_flags;
    bool recording, asked_own, all_opaque, no_inside;  /* recording: build_prim writes shared_prim */
};

/* The slot for a key with this hash: `same` says whether the entry at an index is the key. Grows the table before it is
 * three quarters full; `hash_at` gives an entry's hash again. */
typedef bool TableSame(const Compile *c, uint32_t index, const void *key);
typedef uint32_t TableHash(const Compile *c, uint32_t index);
uint32_t *table_find(Compile *c, Table *t, uint32_t hash, const void *key, TableSame *same, TableHash *hash_at);
uint32_t hash_bytes(const void *data, size_t n);

/* compile.c */
/* A World of one object's geometry, for queries; what it needs stands in `arena`. Returns its item or NO_ITEM. */
uint32_t compile_object(World *w, Arena *arena, const Registry *registry, Diag *diag, const Object *o);

/* flatten.c */
enum { NO_ITEM = 0x7fffffff };
void flatten_top(Compile *c, const Object *o, const Inherited *from);              /* a statement of the scene */
uint32_t flatten_item(Compile *c, const Object *o, const Inherited *from);         /* as one item; NO_ITEM: gives no hits */
uint32_t flatten_whole(Compile *c, const Object *o, const Inherited *from);        /* the same, outermost: put in POV's order */

/* csg.c */
typedef struct Reach {                         /* outside `box` a point is outside the item; co: inside it */
    Bounds box;
    bool co;
} Reach;
Reach item_reach(const Compile *c, uint32_t item);
Bounds item_hull(const Compile *c, uint32_t item);                 /* holds every hit */
bool item_holds(const Compile *c, uint32_t item, uint32_t body, Bounds hull);      /* surely all of the body, whose hull that is, is inside the item */
uint32_t csg_node(Compile *c, CsgOp op, uint32_t flags, const Items *children, uint32_t first_prim);
void csg_reverse(Compile *c, uint32_t first_prim, uint32_t first_node);
void csg_finish(Compile *c);

/* textures.c */
uint32_t texture_placed(Compile *c, const Texture *t, const Affine *own, const Affine *around);
uint32_t interior_placed(Compile *c, const Interior *interior, const Affine *own, const Affine *around, bool hollow);
uint32_t material_index(Compile *c, const Material *m);
bool textures_opaque(const Compile *c, const Material *m);
unsigned textures_features(const Compile *c);

/* lights.c */
void light_add(Compile *c, const Object *o, const Inherited *from, bool grouped);
void light_group(Compile *c, const Object *group, Inherited *members);
void lights_end(Compile *c);                   /* gives them to the World, with what they shine through */

/* `own` (NULL: identity), then `around`: one of the two where that is enough, else joined in *room. */
static inline const Affine *place_within(const Affine *own, const Affine *around, Affine *room)
{
    if (own == NULL || own->identity)
        return around;
    if (around->identity)
        return own;
    *room = affine_then(*own, *around);
    return room;
}

static inline bool is_node(uint32_t item)
{
    return (item & 0x80000000u) != 0;
}

#endif
