/* compile.c - Scene to World: chooses the scale, flattens the objects, builds the accelerator. See compile.h. */
#include "compile/compile.h"

#include <string.h>

#include "accel/accel.h"
#include "compile/context.h"

/* ---- tables ---- */

/* The multiplication carries up, the shift brings it down again. */
static inline uint64_t hash_word(uint64_t h, uint64_t word)
{
    h = (h ^ word) * 0x9e3779b97f4a7c15u;
    return h ^ h >> 29;
}

uint32_t hash_bytes(const void *data, size_t n)
{
    const char *p = data;
    uint64_t h = n, word;
    size_t i = 0;
    for (; i + sizeof word <= n; i += sizeof word) {
        memcpy(&word, p + i, sizeof word);
        h = hash_word(h, word);
    }
    if (i < n) {
        word = 0;
        memcpy(&word, p + i, n - i);
        h = hash_word(h, word);
    }
    h *= 0xbf58476d1ce4e5b9u;
    return (uint32_t)(h >> 32);
}

static void table_grow(Compile *c, Table *t, TableHash *hash_at)
{
    uint32_t capacity = t->capacity ? t->capacity * 2 : 64;
    uint32_t *slot = arena_array(c->arena, uint32_t, capacity);
    for (uint32_t i = 0; i < t->capacity; i++) {
        if (t->slot[i] == 0)
            continue;
        uint32_t at = hash_at(c, t->slot[i] - 1) & (capacity - 1);
        while (slot[at] != 0)
            at = (at + 1) & (capacity - 1);
        slot[at] = t->slot[i];
    }
    t->slot = slot;
    t->capacity = capacity;
}

/* Counts a free slot as taken: the caller fills it. */
uint32_t *table_find(Compile *c, Table *t, uint32_t hash, const void *key, TableSame *same, TableHash *hash_at)
{
    if (4 * (t->n + 1) > 3 * t->capacity)
        table_grow(c, t, hash_at);
    uint32_t at = hash & (t->capacity - 1);
    while (t->slot[at] != 0 && !same(c, t->slot[at] - 1, key))
        at = (at + 1) & (t->capacity - 1);
    if (t->slot[at] == 0)
        t->n++;
    return &t->slot[at];
}

/* ---- the scale ---- */

typedef struct Survey {                        /* of the scene before it is compiled */
    double size;                               /* largest finite coordinate */
    uint32_t n_shapes;
} Survey;

static void survey_box(Survey *s, Bounds box)
{
    if (bounds_is_finite(box) && !bounds_is_empty(box))
        s->size = fmax(s->size, fmax(max_abs(box.lo), max_abs(box.hi)));
}

static void survey_object(Survey *s, const Object *o, const Affine *around)
{
    if (o == NULL)
        return;
    Affine room;
    const Affine *place = place_within(o->place, around, &room);
    if (o->kind == OBJECT_SHAPE) {
        s->n_shapes += s->n_shapes < UINT32_MAX;
        if (o->ops->extent != NULL)
            survey_box(s, o->ops->extent(o->params, place));
    }
    if (o->kind == OBJECT_LIGHT && o->light->looks_like != NULL)
        survey_object(s, o->light->looks_like, place);
    for (uint32_t i = 0; i < o->n_child; i++)
        survey_object(s, o->child[i], place);
}

/* ---- begin and end ---- */

static void begin(Compile *c, World *w, Arena *arena, const Registry *registry, const AccelOps *accel, Diag *diag, double unit)
{
    memset(c, 0, sizeof *c);
    c->w = w;
    c->arena = arena;
    c->diag = diag;
    c->unit = unit;
    c->to_world = affine_scale(vec3(unit, unit, unit));
    w->registry = registry;
    w->accel_ops = accel;
    w->unit = unit;
    static const Interior nothing = { .ior = 1, .dispersion = 1, .old_refraction = 1, .dispersion_samples = 7 };
    Affine none = affine_identity();
    c->identity = arena_copy(c->arena, &none, sizeof none);
    array_push(c->arena, &c->csg, (CsgNode){ 0 });
    array_push(c->arena, &c->texture, (PlacedTexture){ 0 });
    array_push(c->arena, &c->interior, (PlacedInterior){ .interior = &nothing });
    array_push(c->arena, &c->interior, (PlacedInterior){ .interior = &nothing, .hollow = true });
    array_push(c->arena, &c->material, (Material){ 0 });
}

/* Prims that can be met, by box or (unbounded) always. */
static void build_accelerator(Compile *c)
{
    World *w = c->w;
    uint32_t n = 0;
    Bounds all = bounds_empty();
    Items unbounded = { 0 };
    w->accel_prim = arena_array(c->arena, uint32_t, w->n_prims);
    for (uint32_t i = 0; i < w->n_prims; i++) {
        if ((w->prim[i].flags & PRIM_HELPER) || bounds_is_empty(w->box[i]))
            continue;
        if (bounds_is_finite(w->box[i])) {
            all = bounds_union(all, w->box[i]);
            w->accel_prim[n++] = i;
        } else
            array_push(c->arena, &unbounded, i);
    }
    w->bounds = all;
    w->n_accel_prims = n;
    w->unbounded = unbounded.data;
    w->n_unbounded = unbounded.n;
    if (n == 0)
        return;
    Bounds *box = w->box;
    if (n < w->n_prims) {
        box = arena_array(c->arena, Bounds, n);
        for (uint32_t i = 0; i < n; i++)
            box[i] = w->box[w->accel_prim[i]];
    }
    w->accel = w->accel_ops->build(c->arena, box, n);
}

#define TAKE(field, count, array) (w->field = c->array.data, w->count = c->array.n)

static void end(Compile *c)
{
    World *w = c->w;
    if (!c->geometry_only)
        lights_end(c);
    csg_finish(c);
    TAKE(prim, n_prims, prim);
    w->box = c->box.data;
    TAKE(csg, n_csg, csg);
    TAKE(csg_child, n_csg_children, csg_child);
    TAKE(body, n_bodies, body);
    TAKE(material, n_materials, material);
    TAKE(texture, n_textures, texture);
    TAKE(interior, n_interiors, interior);
    for (uint32_t i = 0; i < w->n_prims; i++) {
        if (w->prim[i].ops->flags & SHAPE_FIRST_HITS)
            w->features |= WORLD_HAS_FIRST_HITS;
        if (w->prim[i].flags & (PRIM_NO_SHADOW | PRIM_NO_IMAGE | PRIM_NO_REFLECTION | PRIM_NO_RADIOSITY))
            w->features |= WORLD_HAS_FLAGS;
    }
    if (w->n_csg > 1)
        w->features |= WORLD_HAS_CSG;
    if (!c->geometry_only)
        w->features |= textures_features(c);
    build_accelerator(c);
}

/* Arrays of about the right size at once; what grows later grows by doubling. */
static void reserve(Compile *c, uint32_t n)
{
    n += 16;
    c->prim.data = arena_array(c->arena, Prim, c->prim.capacity = n);
    c->box.data = arena_array(c->arena, Bounds, c->box.capacity = n);
}

void compile_world(World *w, const Scene *scene, const Registry *registry, const char *accel, Diag *diag)
{
    const AccelOps *ops = accel_find(accel);
    if (ops == NULL)
        fail(diag, (Loc){ 0 }, "there is no accelerator '%s'; bvh and list are known", accel);
    Survey survey = { .size = scene->has_camera ? max_abs(scene->camera.location) : 0 };
    Affine none = affine_identity();
    for (uint32_t i = 0; i < scene->n_objects; i++)
        survey_object(&survey, scene->object[i], &none);

    Compile compile, *c = &compile;
    begin(c, w, &w->arena, registry, ops, diag, 1 / build_unit(survey.size));
    reserve(c, survey.n_shapes);
    w->scene = scene;
    w->camera = scene->camera;
    w->globals = scene->globals;
    if (scene->n_fog > 0)
        w->features |= WORLD_HAS_FOG;
    for (uint32_t i = 0; i < scene->n_objects; i++) {
        const Object *o = scene->object[i];
        Inherited from = { .place = &none, .default_texture = o->default_texture ? o->default_texture : scene->default_texture };
        flatten_top(c, o, &from);
    }
    end(c);
}

uint32_t compile_object(World *w, Arena *arena, const Registry *registry, Diag *diag, const Object *o)
{
    Affine none = affine_identity();
    Survey survey = { 0 };
    survey_object(&survey, o, &none);
    Compile compile, *c = &compile;
    begin(c, w, arena, registry, accel_find(NULL), diag, 1 / build_unit(survey.size));
    c->geometry_only = true;
    Inherited from = { .place = &none };
    uint32_t item = flatten_whole(c, o, &from);
    end(c);
    return item;
}
