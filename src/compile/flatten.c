/* flatten.c - objects to prims: walks the tree with the composed place, texture, interior and flags in hand.
 *
 * What stands outermost is dissolved where POV-Ray dissolves it (08-shapes, section 10.6); the rest becomes one item, a prim
 * or a CSG node. Also here: what a shape may call while it is compiled (world/build.h). */
#include <string.h>

#include "compile/context.h"

/* ---- world/build.h ---- */

double build_unit(double size)
{
    const uint64_t exponent = (uint64_t)0x7ff << 52;
    uint64_t bits;
    memcpy(&bits, &size, sizeof bits);
    bits &= exponent;                          /* without its digits it is a power of two, mostly */
    if (bits == exponent || size == 0)
        return 1;
    if (bits == 0) {
        int power;
        frexp(size, &power);
        return ldexp(1, power - 1);
    }
    memcpy(&size, &bits, sizeof size);
    return size;
}

void *build_data(ShapeBuild *b, size_t bytes)
{
    return arena_alloc(b->arena, bytes);
}

static bool same_place(const Affine *a, const Affine *b)
{
    return memcmp(a->m, b->m, sizeof a->m) == 0 && memcmp(a->inv, b->inv, sizeof a->inv) == 0;
}

/* Most shapes of a scene stand in its own space and have its own unit: they all ask for the same. */
Affine build_place(const ShapeBuild *b, double s)
{
    Compile *c = b->compile;
    if (s == 1)
        return b->place;
    if (b->place.identity)
        return affine_scale(vec3(s, s, s));
    if (s != c->scaled_by || !same_place(&b->place, &c->scaled_from)) {
        c->scaled_by = s;
        c->scaled_from = b->place;
        c->scaled_place = affine_then(affine_scale(vec3(s, s, s)), b->place);
    }
    return c->scaled_place;
}

Affine build_own_place(ShapeBuild *b)
{
    Compile *c = b->compile;
    c->asked_own = true;
    return *c->shape_place;
}

uint32_t build_texture(ShapeBuild *b, const Texture *texture, const Affine *place)
{
    Compile *c = b->compile;
    if (texture == NULL || c->geometry_only)
        return 0;
    const Object *o = b->object;
    Affine own = affine_then(affine_of(place), affine_of(o->place));
    uint32_t index = texture_placed(c, texture, &own, c->from->place);
    if (c->texture.data[index].place != NULL)
        c->asked_own = true;                   /* stands elsewhere for every copy */
    c->all_opaque &= c->texture.data[index].opaque;
    return index;
}

static double largest_finite(Vec3 v)
{
    double most = 0;
    for (int axis = 0; axis < 3; axis++)
        most = isfinite(vec3_at(v, axis)) ? greater(most, fabs(vec3_at(v, axis))) : most;
    return most;
}

/* Room for the rounding of hits and for the tolerances of inside tests, in proportion to the coordinates. What is unbounded has
 * points as far away as the World goes, about 1. */
static Bounds padded(Bounds b)
{
    static const double room = 0x1p-30;
    if (bounds_is_finite(b))
        return bounds_grown(b, room * greater(max_abs(b.lo), max_abs(b.hi)));
    if (isnan(b.lo.x + b.lo.y + b.lo.z) || isnan(b.hi.x + b.hi.y + b.hi.z))
        return bounds_everything();
    return bounds_grown(b, room * greater(greater(largest_finite(b.lo), largest_finite(b.hi)), 1));
}

static const Affine *kept_place(Compile *c, const Affine *place)
{
    if (place->identity)
        return c->identity;
    if (c->last_place != NULL && same_place(c->last_place, place))
        return c->last_place;
    const Affine **recent = &c->recent_place[hash_bytes(place->m, sizeof place->m) % RECENT_PLACES];
    if (*recent == NULL || !same_place(*recent, place))
        *recent = arena_copy(c->arena, place, sizeof *place);
    c->last_place = *recent;
    return *recent;
}

static void prim_add(Compile *c, const ShapeOps *ops, const void *data, const Affine *place, Bounds local)
{
    Bounds box = bounds_transformed(local, place);
    array_push(c->arena, &c->prim, (Prim){ .ops = ops, .data = data, .place = kept_place(c, place),
                                           .material = c->shape_material, .flags = c->shape_flags });
    array_push(c->arena, &c->box, bounds_is_empty(box) ? bounds_empty() : padded(box));
}

void build_prim(ShapeBuild *b, const void *data, const Affine *place, Bounds local)
{
    Compile *c = b->compile;
    if (c->recording)
        array_push(c->arena, &c->shared_prim, (SharedPrim){ .data = data, .place = affine_of(place), .local = local });
    else
        prim_add(c, b->object->ops, data, place, local);
}

/* ---- shapes ---- */

static uint32_t shared_hash_of(const ShapeOps *ops, const void *params, uint32_t flags)
{
    uintptr_t key[3] = { (uintptr_t)ops, (uintptr_t)params, flags };
    return hash_bytes(key, sizeof key);
}

static uint32_t shared_hash(const Compile *c, uint32_t i)
{
    const Shared *s = &c->shared.data[i];
    return shared_hash_of(s->ops, s->params, s->flags);
}

static bool shared_same(const Compile *c, uint32_t i, const void *key)
{
    const Shared *s = &c->shared.data[i], *k = key;
    return s->ops == k->ops && s->params == k->params && s->flags == k->flags;
}

/* In its own space. */
static void shape_record(Compile *c, ShapeBuild *b, const Object *o, Shared *s)
{
    s->first = c->shared_prim.n;
    c->recording = true;
    o->ops->compile(b, o->params);
    c->recording = false;
    s->n = c->shared_prim.n - s->first;
    s->own = c->asked_own;
    s->opaque = c->all_opaque;
    s->no_inside = b->no_inside;
}

/* Compiles the shape once for all its copies, unless it has to be done for each copy. */
static const Shared *shape_shared(Compile *c, ShapeBuild *b, const Object *o)
{
    Shared key = { .ops = o->ops, .params = o->params, .flags = o->flags & (OBJECT_STURM | OBJECT_OPEN | OBJECT_NO_HIERARCHY) };
    uint32_t *slot = table_find(c, &c->shares, shared_hash_of(key.ops, key.params, key.flags), &key, shared_same, shared_hash);
    if (*slot != 0 && !c->shared.data[*slot - 1].own)
        return &c->shared.data[*slot - 1];
    shape_record(c, b, o, &key);
    if (*slot == 0) {
        array_push(c->arena, &c->shared, key);
        *slot = c->shared.n;
    } else
        c->shared.data[*slot - 1] = key;
    return &c->shared.data[*slot - 1];
}

/* place: the shape's own space to the scene. */
static void shape_compile(Compile *c, const Object *o, const Inherited *from, const Affine *place)
{
    bool shareable = (o->ops->flags & SHAPE_SHARED) != 0;
    bool shared = shareable && (from->may_repeat || (o->flags & OBJECT_DECLARED));         /* else there are no copies */
    Affine in_world;
    c->from = from;
    c->shape_place = place_within(place, &c->to_world, &in_world);
    c->asked_own = false;
    c->all_opaque = true;
    c->no_inside = false;
    ShapeBuild b;                              /* one by one: it would be cleared first, which takes as long as all of this */
    b.arena = c->arena;
    b.object = o;
    b.accel = c->w->accel_ops;
    b.place = shared ? *c->identity : *c->shape_place;
    b.unit = shareable ? 1 : c->unit;
    b.diag = c->diag;
    b.no_inside = false;
    b.compile = c;
    if (!shared) {
        o->ops->compile(&b, o->params);
        c->no_inside = b.no_inside;
        return;
    }
    const Shared *s = shape_shared(c, &b, o);
    c->all_opaque = s->opaque;
    c->no_inside = s->no_inside;
    for (uint32_t i = 0; i < s->n; i++) {
        const SharedPrim *p = &c->shared_prim.data[s->first + i];
        Affine room;
        prim_add(c, o->ops, p->data, place_within(&p->place, c->shape_place, &room), p->local);
    }
}

/* ---- what an object takes from those around it ---- */

/* POV: a union all of whose children, lights aside, are no_shadow is no_shadow itself. */
static bool casts_no_shadow(const Object *o)
{
    if ((o->flags & OBJECT_NO_SHADOW) || o->kind == OBJECT_LIGHT)
        return true;
    if (o->kind != OBJECT_UNION)
        return false;
    bool all = o->n_child > 0;
    for (uint32_t i = 0; i < o->n_child; i++)
        all = all && casts_no_shadow(o->child[i]);
    return all;
}

static uint32_t flags_of(const Object *o)
{
    return (casts_no_shadow(o) ? PRIM_NO_SHADOW : 0) | (o->flags & OBJECT_NO_IMAGE ? PRIM_NO_IMAGE : 0) |
           (o->flags & OBJECT_NO_REFLECTION ? PRIM_NO_REFLECTION : 0) |
           (o->flags & OBJECT_NO_RADIOSITY ? PRIM_NO_RADIOSITY : 0);
}

/* What o and its children live with. Its place is o's own space, and may stand in *room. */
static Inherited inherit(Compile *c, const Object *o, const Inherited *from, Affine *room)
{
    Inherited in = *from;
    in.place = place_within(o->place, from->place, room);
    in.lights_known = false;
    in.may_repeat |= (o->flags & OBJECT_DECLARED) != 0;
    in.inversions += (o->flags & OBJECT_INVERSE) != 0;
    in.hollow = o->flags & OBJECT_HOLLOW_SET ? (o->flags & OBJECT_HOLLOW) != 0 : from->hollow;
    in.double_illuminate |= (o->flags & OBJECT_DOUBLE_ILLUMINATE) != 0;
    in.uv = (o->flags & OBJECT_UV_MAPPING) || (from->uv && o->texture == NULL);
    if (o->kind == OBJECT_INTERSECTION || o->kind == OBJECT_DIFFERENCE)
        in.cutaway |= (o->flags & OBJECT_CUTAWAY_TEXTURES) != 0;
    if (c->geometry_only)
        return in;
    if (o->texture != NULL)
        in.texture = texture_placed(c, o->texture, o->texture_place, from->place);
    const ObjectMore *more = object_more(o);
    if (more->interior_texture != NULL)
        in.interior_texture = texture_placed(c, more->interior_texture, more->interior_texture_place, from->place);
    if (more->interior != NULL)
        in.interior = interior_placed(c, more->interior, more->interior_place, from->place, in.hollow);
    return in;
}

/* Without `interior` of their own, all leaves of one outermost object share an empty one (08-shapes, section 10.7). */
static void share_interior(Compile *c, Inherited *in)
{
    if (!c->geometry_only && in->interior == 0)
        in->interior = interior_placed(c, c->interior.data[0].interior, NULL, in->place, in->hollow);
}

static uint32_t shape_material(Compile *c, const Inherited *in, const Inherited *from)
{
    Material m = { .texture = in->texture, .interior_texture = in->interior_texture, .interior = in->interior,
                   .first_group_light = in->first_group_light, .n_group_lights = in->n_group_lights };
    Affine none = affine_identity();
    if (m.texture == 0 && in->cutaway)
        m.flags |= MATERIAL_CUTAWAY;
    else if (m.texture == 0 && in->default_texture != NULL)
        m.texture = texture_placed(c, in->default_texture, NULL, &none);
    m.flags |= (in->uv ? MATERIAL_UV : 0) | (in->double_illuminate ? MATERIAL_DOUBLE_ILLUMINATE : 0) |
               (in->no_global_lights ? MATERIAL_NO_GLOBAL_LIGHTS : 0) |
               (in->interior_texture ? MATERIAL_HAS_INTERIOR_TEXTURE : 0);
    if (from->interior == 0 && m.interior == 0 && !textures_opaque(c, &m))
        m.interior = interior_placed(c, c->interior.data[0].interior, NULL, &none, in->hollow);
    if (m.interior == 0)
        m.interior = in->hollow;               /* opaque and empty: nobody asks which body it is */
    else
        c->interior.data[m.interior].hollow = in->hollow;      /* POV: the last leaf decides for all that share it */
    return material_index(c, &m);
}

/* Writes the prims of a shape; returns how many. */
static uint32_t shape_prims(Compile *c, const Object *o, const Inherited *from)
{
    uint32_t first = c->prim.n;
    Affine room;
    Inherited in = inherit(c, o, from, &room);
    bool patch = ((o->ops->flags & SHAPE_PATCH) && !(o->flags & OBJECT_HAS_INSIDE)) || o->ops->inside == NULL;
    c->shape_flags = in.prim_flags | (in.inversions % 2 && o->ops->inside != NULL ? PRIM_INVERSE : 0) | (patch ? PRIM_PATCH : 0) |
                     ((o->ops->flags & SHAPE_CONVEX) && !(o->flags & OBJECT_OPEN) ? PRIM_CONVEX : 0);
    c->shape_material = c->geometry_only ? 0 : shape_material(c, &in, from);
    Material m = c->material.data[c->shape_material];
    bool opaque = !c->geometry_only && textures_opaque(c, &m) && !(m.flags & MATERIAL_CUTAWAY);
    shape_compile(c, o, from, in.place);
    for (uint32_t i = first; i < c->prim.n; i++) {
        Prim *prim = &c->prim.data[i];
        if (opaque && c->all_opaque)
            prim->flags |= PRIM_OPAQUE;
        if ((o->ops->flags & SHAPE_FLAT) && prim->place->identity && !(prim->flags & PRIM_INVERSE) && !(m.flags & MATERIAL_CUTAWAY))
            prim->flags |= PRIM_FACE;
        if (c->no_inside)
            prim->flags |= PRIM_PATCH;         /* POV: `inverse` turns its normals still */
    }
    if (!c->all_opaque && m.interior < 2) {    /* it has see-through parts after all: a body of its own */
        Affine none = affine_identity();
        m.interior = interior_placed(c, c->interior.data[0].interior, NULL, &none, in.hollow);
        uint32_t material = material_index(c, &m);
        for (uint32_t i = first; i < c->prim.n; i++)
            c->prim.data[i].material = material;
    }
    return c->prim.n - first;
}

/* ---- set operations ---- */

/* POV: which kinds of CSG heed the flags of their children (08-shapes, section 10.4); no_shadow counts outermost only. */
static uint32_t heeded_flags(const Object *child, const Object *parent)
{
    uint32_t flags = flags_of(child) & ~(uint32_t)PRIM_NO_SHADOW;
    if (parent->kind == OBJECT_INTERSECTION || parent->kind == OBJECT_DIFFERENCE)
        return 0;
    if (parent->kind == OBJECT_UNION && (flags & PRIM_NO_IMAGE))
        flags = (flags & ~(uint32_t)PRIM_NO_IMAGE) | PRIM_NO_IMAGE_LATER;
    return flags;
}

/* Turned inside out k times: union, intersection, merge, intersection, merge... (08-shapes, section 10.3). */
static CsgOp operation(const Object *o, uint32_t inversions, uint32_t *flags)
{
    bool any = o->kind == OBJECT_UNION || o->kind == OBJECT_MERGE;
    CsgOp op = any == (inversions % 2 == 0) ? CSG_ANY : CSG_ALL;
    if (op == CSG_ANY && !(o->kind == OBJECT_UNION && inversions == 0))
        *flags |= CSG_MERGE;
    if (o->kind == OBJECT_DIFFERENCE)
        *flags |= CSG_DIFFERENCE;
    return op;
}

static uint32_t set_operation(Compile *c, const Object *o, const Inherited *from)
{
    uint32_t first_prim = c->prim.n, flags = 0;
    Affine room;
    Inherited in = inherit(c, o, from, &room);
    share_interior(c, &in);
    in.in_csg = true;
    if (in.cutaway)
        flags |= CSG_CUTAWAY;
    CsgOp op = operation(o, in.inversions, &flags);
    Items items = { 0 };
    bool first = true;
    for (uint32_t i = 0; i < o->n_child; i++) {
        Inherited child = in;
        child.prim_flags |= heeded_flags(o->child[i], o);
        if (o->kind == OBJECT_DIFFERENCE && !first)
            child.inversions++;
        uint32_t item = flatten_item(c, o->child[i], &child);
        if (item != NO_ITEM) {
            array_push(c->arena, &items, item);
            first = false;
        }
    }
    if (items.n == 0 && o->n_child > 0)
        return NO_ITEM;                        /* lights only */
    uint32_t node = csg_node(c, op, flags, &items, first_prim);
    c->csg.data[~node].interior = in.interior;
    return node;
}

/* A shape as one item: its only prim, or a union of its several prims. */
static uint32_t shape_item(Compile *c, const Object *o, const Inherited *from)
{
    uint32_t first = c->prim.n, n = shape_prims(c, o, from);
    if (n == 1)
        return first;
    bool inverse = n > 0 && (c->prim.data[first].flags & PRIM_INVERSE);
    Items items = { 0 };
    for (uint32_t i = 0; i < n; i++)
        array_push(c->arena, &items, first + i);
    uint32_t node = csg_node(c, inverse ? CSG_ALL : CSG_ANY, 0, &items, first);
    if (n > 0)
        c->csg.data[~node].interior = c->material.data[c->prim.data[first].material].interior;
    return node;
}

/* Clip and bound objects are asked, never seen. They already carry the transforms written after them, so they stand in the
 * space around o. */
static void helpers(Compile *c, const Object *const *list, uint32_t n, const Inherited *from, Items *out)
{
    Inherited helper = { .place = from->place, .prim_flags = PRIM_HELPER, .may_repeat = true };
    bool geometry_only = c->geometry_only;
    c->geometry_only = true;
    for (uint32_t i = 0; i < n; i++) {
        uint32_t item = flatten_item(c, list[i], &helper);
        if (item != NO_ITEM)
            array_push(c->arena, out, item);
    }
    c->geometry_only = geometry_only;
}

static uint32_t over_body(Compile *c, uint32_t flag, const Items *items, uint32_t first_prim)
{
    uint32_t body = items->data[0], node = csg_node(c, CSG_ALL, flag, items, first_prim);
    c->csg.data[~node].interior = is_node(body) ? c->csg.data[~body].interior
                                                : c->material.data[c->prim.data[body].material].interior;
    return node;
}

static uint32_t clipped(Compile *c, const Object *o, const Inherited *from, uint32_t body, uint32_t first_prim)
{
    Items items = { 0 };
    array_push(c->arena, &items, body);
    helpers(c, object_more(o)->clipped_by, object_more(o)->n_clipped_by, from, &items);
    return over_body(c, CSG_CLIP, &items, first_prim);
}

/* Bounds that hold the whole body change nothing and are dropped. POV: an outermost shape keeps only the box of its bounds,
 * children of CSG and CSG itself keep the objects; rays that miss them miss the body (08-shapes, section 5.1). */
static uint32_t bounded(Compile *c, const Object *o, const Inherited *from, uint32_t body, uint32_t first_prim)
{
    const ObjectMore *more = object_more(o);
    bool by_clip = (o->flags & OBJECT_BOUNDED_BY_CLIP) != 0;
    bool only_box = !from->in_csg && o->kind == OBJECT_SHAPE && !(o->ops->flags & SHAPE_BOUND_STAYS);
    Bounds hull = item_hull(c, body), box = bounds_everything();
    Items bounds = { 0 }, items = { 0 };
    helpers(c, by_clip ? more->clipped_by : more->bounded_by, by_clip ? more->n_clipped_by : more->n_bounded_by, from, &bounds);
    array_push(c->arena, &items, body);
    for (uint32_t i = 0; i < bounds.n; i++) {
        Reach r = item_reach(c, bounds.data[i]);
        if (only_box && !r.co)
            box = bounds_intersection(box, r.box);
        else if (!only_box && !item_holds(c, bounds.data[i], body, hull))
            array_push(c->arena, &items, bounds.data[i]);
    }
    bool cuts = only_box ? !(bounds_contain(box, hull.lo) && bounds_contain(box, hull.hi)) : items.n > 1;
    if (!cuts || bounds_is_empty(hull))
        return body;
    uint32_t node = over_body(c, CSG_BOUND, &items, first_prim);
    c->csg.data[~node].box = box;
    for (uint32_t i = first_prim; i < c->prim.n; i++)
        if (!(c->prim.data[i].flags & PRIM_HELPER))
            c->prim.data[i].flags |= PRIM_BOUNDED;
    return node;
}

uint32_t flatten_item(Compile *c, const Object *o, const Inherited *from)
{
    uint32_t first_prim = c->prim.n, item;
    if (o->kind == OBJECT_LIGHT) {
        if (!c->geometry_only && !from->lights_known)
            light_add(c, o, from, false);
        if (o->light->looks_like == NULL)
            return NO_ITEM;
        Affine room;
        Inherited in = inherit(c, o, from, &room);
        in.prim_flags |= PRIM_NO_SHADOW;
        return flatten_item(c, o->light->looks_like, &in);
    }
    item = o->kind == OBJECT_SHAPE ? shape_item(c, o, from) : set_operation(c, o, from);
    if (item == NO_ITEM)
        return item;
    const ObjectMore *more = object_more(o);
    if (more->n_clipped_by > 0 && !(o->kind == OBJECT_SHAPE && (o->ops->flags & SHAPE_IGNORES_CLIP)))
        item = clipped(c, o, from, item, first_prim);
    if (more->n_bounded_by > 0 || (o->flags & OBJECT_BOUNDED_BY_CLIP))
        item = bounded(c, o, from, item, first_prim);
    return item;
}

/* POV: among equal hits of one CSG the last child wins, so its prims go first. */
uint32_t flatten_whole(Compile *c, const Object *o, const Inherited *from)
{
    uint32_t first_prim = c->prim.n, first_node = c->csg.n;
    uint32_t item = flatten_item(c, o, from);
    if (item == NO_ITEM || !is_node(item))
        return item;
    csg_reverse(c, first_prim, first_node);
    return item;
}

/* ---- the outermost level ---- */

/* Is there, around every point inside the item, a leaf of it that the accelerator knows by its box? */
static bool found_by_box(const Compile *c, uint32_t item)
{
    if (!is_node(item)) {
        Reach r = item_reach(c, item);
        return !r.co && bounds_is_finite(r.box) && !(c->prim.data[item].flags & PRIM_HELPER);
    }
    const CsgNode *node = &c->csg.data[~item];
    uint32_t n = node->flags & CSG_BOUND ? 1 : node->n;
    bool every = node->op == CSG_ANY;
    for (uint32_t i = 0; i < n; i++)
        if (found_by_box(c, c->csg_child.data[node->first + i]) != every)
            return !every;
    return every;
}

static void body_add(Compile *c, uint32_t item)
{
    bool patch = !is_node(item) && (c->prim.data[item].flags & PRIM_PATCH);
    bool cut = is_node(item) && (c->csg.data[~item].flags & (CSG_CLIP | CSG_BOUND));   /* asked without it */
    if (!patch && (cut || !found_by_box(c, item)))
        array_push(c->arena, &c->body, item);
}

static bool is_cut(const Object *o)
{
    const ObjectMore *more = object_more(o);
    return more->n_clipped_by > 0 || more->n_bounded_by > 0 || (o->flags & OBJECT_BOUNDED_BY_CLIP);
}

static bool dissolves(const Object *o, const Inherited *from)
{
    return o->kind == OBJECT_LIGHT_GROUP ||
           (o->kind == OBJECT_UNION && !is_cut(o) &&
            !(o->flags & (OBJECT_NO_SPLIT_UNION | OBJECT_INVERSE)) && from->inversions == 0);
}

static void dissolve(Compile *c, const Object *o, const Inherited *from)
{
    Affine room;
    Inherited in = inherit(c, o, from, &room);
    in.prim_flags |= flags_of(o);
    if (o->kind == OBJECT_LIGHT_GROUP && !c->geometry_only)
        light_group(c, o, &in);
    else
        share_interior(c, &in);
    for (uint32_t i = 0; i < o->n_child; i++)
        flatten_top(c, o->child[i], &in);
}

void flatten_top(Compile *c, const Object *o, const Inherited *from)
{
    if (dissolves(o, from)) {
        dissolve(c, o, from);
        return;
    }
    Inherited in = *from;
    in.prim_flags |= flags_of(o);
    if (o->kind == OBJECT_SHAPE && !is_cut(o)) {
        uint32_t first = c->prim.n, n = shape_prims(c, o, &in);
        for (uint32_t i = 0; i < n; i++)
            body_add(c, first + i);
        return;
    }
    uint32_t item = flatten_whole(c, o, &in);
    if (item != NO_ITEM)
        body_add(c, item);
}
