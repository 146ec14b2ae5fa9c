/* query.c - trace(), inside(), min_extent and max_extent, asked while the scene is still being read.
 *
 * Each object that is asked becomes a small World of its own, kept for the next question: scenes ask the same object a
 * hundred thousand times. Objects are immutable, so their address is their name. */
#include <string.h>

#include "compile/compile.h"
#include "compile/context.h"
#include "world/prim.h"

typedef struct Entry {
    const Object *object;
    World *world;
    uint32_t item;                             /* the whole object; NO_ITEM: nothing to hit */
} Entry;

struct Query {
    Arena *arena;
    const Registry *registry;
    Diag *diag;
    Entry *last;                               /* most questions are about the object of the one before */
    Entry *slot;                               /* open addressing by address; capacity is a power of two */
    uint32_t n, capacity;
};

Query *query_new(Arena *arena, const Registry *registry, Diag *diag)
{
    Query *q = arena_new(arena, Query);
    *q = (Query){ .arena = arena, .registry = registry, .diag = diag };
    return q;
}

static Entry *find(const Query *q, const Object *o)
{
    uint32_t at = hash_bytes(&o, sizeof o) & (q->capacity - 1);
    while (q->slot[at].object != NULL && q->slot[at].object != o)
        at = (at + 1) & (q->capacity - 1);
    return &q->slot[at];
}

static void grow(Query *q)
{
    Query bigger = *q;
    bigger.capacity = q->capacity ? q->capacity * 2 : 32;
    bigger.slot = arena_array(q->arena, Entry, bigger.capacity);
    for (uint32_t i = 0; i < q->capacity; i++)
        if (q->slot[i].object != NULL)
            *find(&bigger, q->slot[i].object) = q->slot[i];
    *q = bigger;
}

static const Entry *entry_of(Query *q, const Object *o)
{
    if (q->last != NULL && q->last->object == o)
        return q->last;
    if (2 * (q->n + 1) > q->capacity)
        grow(q);
    Entry *e = find(q, o);
    if (e->object == NULL) {
        e->world = arena_new(q->arena, World);
        e->item = compile_object(e->world, q->arena, q->registry, q->diag, o);
        e->object = o;
        q->n++;
    }
    q->last = e;
    return e;
}

/* POV: drops hits nearer than 1e-4. Here as near as arithmetic can tell, so that rays from a found point go on. */
static double nearest_depth(const World *w, Vec3 from)
{
    double size = max_abs(from);
    if (bounds_is_finite(w->bounds) && !bounds_is_empty(w->bounds))
        size = fmax(size, fmax(max_abs(w->bounds.lo), max_abs(w->bounds.hi)));
    return 0x1p-36 * size;
}

bool query_trace(void *query, const Object *o, Vec3 from, Vec3 direction, Vec3 *point, Vec3 *normal)
{
    const Entry *e = entry_of(query, o);
    const World *w = e->world;
    Ray ray = { scaled(from, w->unit), normalized(direction), 0, INFINITY };
    ray.t_min = nearest_depth(w, ray.o);
    Hit hit;
    if (!vec3_finite(ray.o) || !vec3_finite(ray.d) || length2(ray.d) == 0 || !world_nearest(w, &ray, 0, &hit))
        return false;
    Surface s;
    world_surface(w, &ray, &hit, false, &s);
    *point = scaled(s.p, 1 / w->unit);
    *normal = s.back ? negated(s.normal) : s.normal;
    return true;
}

bool query_inside(void *query, const Object *o, Vec3 p)
{
    const Entry *e = entry_of(query, o);
    return e->item != NO_ITEM && item_inside(e->world, e->item, scaled(p, e->world->unit));
}

const World *query_world(void *query, const Object *o, uint32_t *item)
{
    const Entry *e = entry_of(query, o);
    *item = e->item;
    return e->item != NO_ITEM ? e->world : NULL;
}

/* ---- extents ---- */

/* POV: boxes are a corner and lengths in single precision, and end at 1e10 (08-shapes, section 4.1). */
static const double FAR = 1e10;

static Bounds as_stored(Bounds b)
{
    Bounds out;
    for (int axis = 0; axis < 3; axis++) {
        double lo = fmax(-FAR, fmin(FAR, vec3_at(b.lo, axis))), hi = fmax(-FAR, fmin(FAR, vec3_at(b.hi, axis)));
        float corner = (float)lo, length_ = (float)(hi - lo);
        vec3_set(&out.lo, axis, (double)corner);
        vec3_set(&out.hi, axis, (double)(corner + length_));
    }
    return out;
}

static double volume(Bounds b)
{
    Vec3 d = sub(b.hi, b.lo);
    return d.x * d.y * d.z;
}

static bool is_far(Bounds b)
{
    Vec3 d = sub(b.hi, b.lo);
    return d.x > 1e6 || d.y > 1e6 || d.z > 1e6;
}

static Bounds all_space(void)
{
    return (Bounds){ { -FAR, -FAR, -FAR }, { FAR, FAR, FAR } };
}

static Bounds extent_of(Query *q, const Object *o);

static bool is_bare_light(const Object *o)
{
    return o->kind == OBJECT_LIGHT && o->light->looks_like == NULL;
}

/* POV: only boxes of what is not inverted cut; a plane cuts when its normal lies along an axis. Shapes that are unbounded alone
 * are asked for the box they are traced with. */
static Bounds extent_in_all(Query *q, const Object *o)
{
    Bounds b = extent_of(q, o);
    if (o->kind != OBJECT_SHAPE || !is_far(b))
        return b;
    const Entry *e = entry_of(q, o);
    const World *w = e->world;
    if (e->item == NO_ITEM || is_node(e->item))
        return b;
    Bounds box = { scaled(w->box[e->item].lo, 1 / w->unit), scaled(w->box[e->item].hi, 1 / w->unit) };
    return bounds_intersection(b, box);
}

static Bounds extent_of_intersection(Query *q, const Object *o)
{
    Bounds all = all_space();
    for (uint32_t i = 0; i < o->n_child; i++) {
        const Object *child = o->child[i];
        bool inverted = ((child->flags & OBJECT_INVERSE) != 0) != (o->kind == OBJECT_DIFFERENCE && i > 0);
        if (!inverted && !is_bare_light(child))
            all = bounds_intersection(all, extent_in_all(q, child));
    }
    return bounds_is_empty(all) || is_far(all) ? all_space() : all;
}

static Bounds extent_of_union(Query *q, const Object *o)
{
    Bounds all = bounds_empty();
    for (uint32_t i = 0; i < o->n_child; i++)
        all = bounds_union(all, extent_of(q, o->child[i]));
    return all;
}

static Bounds cut_by(Query *q, Bounds b, const Object *const *list, uint32_t n)
{
    Bounds cut = all_space();
    for (uint32_t i = 0; i < n; i++)
        if (!(list[i]->flags & OBJECT_INVERSE))
            cut = bounds_intersection(cut, extent_in_all(q, list[i]));
    return n > 0 && !bounds_is_empty(cut) && volume(cut) < volume(b) ? cut : b;
}

/* In the space around o. POV: each CSG hulls the boxes of its children and is hulled again when it is moved. */
static Bounds extent_of(Query *q, const Object *o)
{
    Affine place = affine_of(o->place);
    Bounds b;
    switch (o->kind) {
    case OBJECT_SHAPE:
        b = o->ops->extent != NULL ? o->ops->extent(o->params, &place) : bounds_everything();
        break;
    case OBJECT_LIGHT:
        b = bounds_transformed(is_bare_light(o) ? all_space() : extent_of(q, o->light->looks_like), &place);
        break;
    case OBJECT_INTERSECTION: case OBJECT_DIFFERENCE:
        b = bounds_transformed(extent_of_intersection(q, o), &place);
        break;
    default:
        b = bounds_transformed(extent_of_union(q, o), &place);
    }
    b = as_stored(b);
    const ObjectMore *more = object_more(o);
    b = cut_by(q, b, more->bounded_by, more->n_bounded_by);
    return cut_by(q, b, more->clipped_by, more->n_clipped_by);
}

Bounds query_extent(void *query, const Object *o)
{
    return extent_of(query, o);
}
