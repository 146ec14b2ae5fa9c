/* object.c - objects: shapes, CSG, identifiers, and the modifiers they have in common (01-language, section 24).
 *
 * A transform is composed at once into the places of all that the object carries so far. Places that are equal are the
 * same Affine, and one that began in this block is changed in place: an object costs one Affine, not one per word. */
#include <string.h>

#include "sdl/blocks.h"

static const char *const kind_word[] = {       /* of what csg() reads */
    [OBJECT_UNION] = "union", [OBJECT_MERGE] = "merge", [OBJECT_INTERSECTION] = "intersection",
    [OBJECT_DIFFERENCE] = "difference", [OBJECT_LIGHT_GROUP] = "light_group",
};

bool object_is_patch(const Object *o)
{
    if (o->kind == OBJECT_LIGHT)
        return o->light->looks_like == NULL;
    if (o->kind == OBJECT_SHAPE)
        return (o->ops->flags & SHAPE_PATCH) != 0 && !(o->flags & OBJECT_HAS_INSIDE);
    return (o->flags & OBJECT_HOLDS_PATCH) != 0;
}

void draft_holds(Parser *p, ObjectDraft *d, const Object *part)
{
    if (part->depth >= d->o.depth)
        d->o.depth = part->depth + 1;
    if (d->o.depth > MAX_OBJECT_DEPTH)
        parse_fail(p, "objects are nested more than %d deep", MAX_OBJECT_DEPTH);
}

/* ---- transforms ---- */

static const Affine *moved(Parser *p, const Affine *place, const Affine *move)
{
    Affine joined = place != NULL ? affine_then(*place, *move) : *move;
    return arena_copy(parse_arena(p), &joined, sizeof joined);
}

static const Object *const *moved_list(Parser *p, const Object *const *list, uint32_t n, const Affine *move)
{
    const Object **all = arena_array(parse_arena(p), const Object *, n);
    for (uint32_t i = 0; i < n; i++)
        all[i] = object_moved(p, list[i], move);
    return all;
}

void draft_move(Parser *p, ObjectDraft *d, const Affine *move)
{
    Object *o = &d->o;
    const Affine *old = o->place;
    if (old != NULL && old == d->own_place)
        *d->own_place = affine_then(*old, *move);
    else
        o->place = d->own_place = (Affine *)(uintptr_t)moved(p, old, move);
    if (o->texture != NULL && !(o->flags & OBJECT_UV_MAPPING))
        o->texture_place = o->texture_place == old ? o->place : moved(p, o->texture_place, move);
    ObjectMore *m = &d->more;
    if (m->interior_texture != NULL && !(o->flags & OBJECT_UV_MAPPING))
        m->interior_texture_place = m->interior_texture_place == old ? o->place : moved(p, m->interior_texture_place, move);
    if (m->interior != NULL)
        m->interior_place = m->interior_place == old ? o->place : moved(p, m->interior_place, move);
    if (m->n_clipped_by > 0)
        m->clipped_by = moved_list(p, m->clipped_by, m->n_clipped_by, move);
    if (m->n_bounded_by > 0)
        m->bounded_by = o->flags & OBJECT_BOUNDED_BY_CLIP ? m->clipped_by : moved_list(p, m->bounded_by, m->n_bounded_by, move);
}

/* In parts: of the whole the compiler would make a loop. */
void draft_new(ObjectDraft *d, Object o)
{
    d->o = o;
    d->more = (ObjectMore){ 0 };
    d->own_place = NULL;
}

void draft_begin(ObjectDraft *d, const Object *from)
{
    d->o = *from;
    d->more = *object_more(from);
    d->own_place = NULL;
}

const Object *object_moved(Parser *p, const Object *o, const Affine *move)
{
    ObjectDraft d;
    draft_begin(&d, o);
    draft_move(p, &d, move);
    return draft_close(p, &d);
}

/* What is moved already must not move with what is added now: the transforms so far go into the textures themselves. */
static void settle_texture(Parser *p, const Texture **texture, const Affine **place)
{
    if (*texture == NULL || *place == NULL)
        return;
    Moves moves;
    moves.move[0] = **place;
    moves.n = 1;
    *texture = texture_moved(p, *texture, &moves);
    *place = NULL;
}

static void settle_interior(Parser *p, ObjectMore *m)
{
    if (m->interior == NULL || m->interior_place == NULL)
        return;
    Moves moves;
    moves.move[0] = *m->interior_place;
    moves.n = 1;
    m->interior = interior_moved(p, m->interior, &moves);
    m->interior_place = NULL;
}

/* ---- clipped_by, bounded_by ---- */

typedef ARRAY(const Object *) Objects;

static void read_bounds(Parser *p, ObjectDraft *d, Objects *list, const char *word)
{
    const Object *part;
    Affine move;
    uint32_t first = list->n;
    while ((part = parse_object(p)) != NULL) {
        if (part->texture != NULL || object_is_patch(part))
            parse_fail(p, "Illegal texture or patch in clip, bound or object pattern.");
        draft_holds(p, d, part);
        array_push(parse_arena(p), list, part);
    }
    if (list->n == first)
        parse_expected(p, "object");
    while (parse_move(p, &move))
        for (uint32_t i = first; i < list->n; i++)
            list->data[i] = object_moved(p, list->data[i], &move);
    block_close(p, word);
}

static void add_bounds(Parser *p, ObjectDraft *d, const Object *const **to, uint32_t *n, const char *word)
{
    Objects list = { 0 };
    for (uint32_t i = 0; i < *n; i++)
        array_push(parse_arena(p), &list, (*to)[i]);
    read_bounds(p, d, &list, word);
    *to = list.data;
    *n = list.n;
}

static void link(ObjectDraft *d)
{
    if (d->more.n_clipped_by > 0)
        d->o.flags |= OBJECT_BOUNDED_BY_CLIP;
}

static void clipped_by(Parser *p, ObjectDraft *d)
{
    ObjectMore *m = &d->more;
    block_open(p, "clipped_by");
    if (parse_accept(p, KW_BOUNDED_BY)) {
        if (m->n_clipped_by > 0)
            parse_fail(p, "Cannot link bounds with previous clips.");
        m->clipped_by = m->bounded_by;
        m->n_clipped_by = m->n_bounded_by;
        link(d);
        block_close(p, "clipped_by");
        return;
    }
    if (d->o.flags & OBJECT_BOUNDED_BY_CLIP)
        parse_fail(p, "Cannot add clips after linking bounds and clips.");
    add_bounds(p, d, &m->clipped_by, &m->n_clipped_by, "clipped_by");
}

static void bounded_by(Parser *p, ObjectDraft *d)
{
    ObjectMore *m = &d->more;
    block_open(p, "bounded_by");
    if (parse_accept(p, KW_CLIPPED_BY)) {
        if (m->n_bounded_by > 0)
            parse_fail(p, "Cannot link clips with previous bounds.");
        m->bounded_by = m->clipped_by;
        m->n_bounded_by = m->n_clipped_by;
        link(d);
        block_close(p, "bounded_by");
        return;
    }
    if (d->o.flags & OBJECT_BOUNDED_BY_CLIP)
        parse_fail(p, "Cannot add bounds after linking bounds and clips.");
    add_bounds(p, d, &m->bounded_by, &m->n_bounded_by, "bounded_by");
}

/* ---- modifiers ---- */

static bool on(Parser *p)
{
    return (parse_at_number(p) ? parse_float(p) : 1) > 0;
}

static void set(Object *o, uint32_t flag, bool value)
{
    o->flags = value ? o->flags | flag : o->flags & ~flag;
}

static void flag_item(Parser *p, Object *o, uint32_t flag)
{
    parse_skip(p);
    set(o, flag, on(p));
}

static void add_outside(Parser *p, Object *o, const Texture *t)
{
    settle_texture(p, &o->texture, &o->texture_place);
    o->texture = texture_layered(p, o->texture, t);
}

static void add_inside(Parser *p, ObjectMore *m, const Texture *t)
{
    settle_texture(p, &m->interior_texture, &m->interior_texture_place);
    m->interior_texture = texture_layered(p, m->interior_texture, t);
}

static void add_material(Parser *p, ObjectDraft *d)
{
    const Material *m = material_block(p);
    if (m->texture != NULL)
        add_outside(p, &d->o, m->texture);
    if (m->interior_texture != NULL)
        add_inside(p, &d->more, m->interior_texture);
    if (m->interior != NULL) {
        d->more.interior = m->interior;
        d->more.interior_place = NULL;
    }
}

static bool texture_item(Parser *p, ObjectDraft *d, int keyword)
{
    Object *o = &d->o;
    switch (keyword) {
    case KW_TEXTURE: add_outside(p, o, parse_texture(p)); return true;
    case KW_INTERIOR_TEXTURE: add_inside(p, &d->more, parse_texture(p)); return true;
    case KW_PIGMENT: case KW_NORMAL: case KW_FINISH:
        settle_texture(p, &o->texture, &o->texture_place);
        o->texture = texture_part(p, o->texture != NULL ? o->texture : parse_blocks(p)->default_texture);
        return true;
    case KW_INTERIOR:
        parse_skip(p);
        settle_interior(p, &d->more);
        d->more.interior = interior_block(p, d->more.interior);
        return true;
    case KW_MATERIAL:
        parse_skip(p);
        add_material(p, d);
        return true;
    case KW_UV_MAPPING:
        parse_skip(p);
        if (o->texture != NULL)
            parse_fail(p, "uv_mapping must be specified before texture.");
        o->flags |= OBJECT_UV_MAPPING;
        return true;
    default: return false;
    }
}

static bool shape_flag(Parser *p, Object *o, int keyword)
{
    static const struct { int keyword; unsigned needs; uint32_t flag; bool off; } rows[] = {
        { KW_STURM, SHAPE_HAS_STURM, OBJECT_STURM, false },
        { KW_OPEN, SHAPE_HAS_OPEN, OBJECT_OPEN, false },
        { KW_HIERARCHY, SHAPE_HAS_HIERARCHY, OBJECT_NO_HIERARCHY, true },
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (rows[i].keyword == keyword) {
            bool fits = o->kind == OBJECT_SHAPE && (o->ops->flags & rows[i].needs) != 0;
            if (!fits && keyword == KW_OPEN)
                return false;
            if (!fits)
                parse_fail(p, "Keyword '%s' cannot be used with this object.", parse_word(keyword));
            if (keyword == KW_OPEN && (o->flags & OBJECT_OPEN))
                parse_mend(p, "A second 'open'");
            parse_skip(p);
            bool value = keyword == KW_OPEN || on(p);
            set(o, rows[i].flag, rows[i].off ? !value : value);
        }
    return true;
}

static void csg_flag(Parser *p, Object *o, int keyword)
{
    parse_skip(p);
    if (keyword == KW_SPLIT_UNION) {
        if (o->kind != OBJECT_UNION)
            parse_fail(p, "split_union found in non-union object.");
        set(o, OBJECT_NO_SPLIT_UNION, !(parse_float(p) > 0));
        return;
    }
    if (o->kind != OBJECT_INTERSECTION && o->kind != OBJECT_DIFFERENCE)
        parse_fail(p, "cutaway_textures can only be used with intersection and difference.");
    o->flags |= OBJECT_CUTAWAY_TEXTURES;
}

void importance_block(Parser *p)
{
    parse_skip(p);
    block_open(p, "radiosity");
    while (parse_accept(p, KW_IMPORTANCE)) {
        float importance = (float)parse_float(p);
        if (!(importance > 0 && importance <= 1))
            parse_fail(p, "Radiosity importance must be greater than 0.0 and at most 1.0.");
    }
    block_close(p, "radiosity");
}

static void invert(Parser *p, Object *o)
{
    if (object_is_patch(o) && o->kind == OBJECT_SHAPE)
        parse_warn(p, "Cannot invert a patch object.");
    o->flags ^= OBJECT_INVERSE;
}

static bool plain_modifier(Parser *p, ObjectDraft *d, int keyword)
{
    Object *o = &d->o;
    switch (keyword) {
    case KW_INVERSE: parse_skip(p); invert(p, o); return true;
    case KW_HOLLOW: flag_item(p, o, OBJECT_HOLLOW); o->flags |= OBJECT_HOLLOW_SET; return true;
    case KW_DOUBLE_ILLUMINATE: flag_item(p, o, OBJECT_DOUBLE_ILLUMINATE); return true;
    case KW_NO_SHADOW: parse_skip(p); o->flags |= OBJECT_NO_SHADOW; return true;
    case KW_NO_IMAGE: flag_item(p, o, OBJECT_NO_IMAGE); return true;
    case KW_NO_REFLECTION: flag_item(p, o, OBJECT_NO_REFLECTION); return true;
    case KW_NO_RADIOSITY: flag_item(p, o, OBJECT_NO_RADIOSITY); return true;
    case KW_STURM: case KW_OPEN: case KW_HIERARCHY: return shape_flag(p, o, keyword);
    case KW_SPLIT_UNION: case KW_CUTAWAY_TEXTURES: csg_flag(p, o, keyword); return true;
    case KW_PHOTONS: parse_skip(p); d->more.photons = photons_block(p, d->more.photons, false); return true;
    case KW_RADIOSITY: importance_block(p); return true;
    case KW_CLIPPED_BY: parse_skip(p); clipped_by(p, d); return true;
    case KW_BOUNDED_BY: parse_skip(p); bounded_by(p, d); return true;
    case KW_DTAG: parse_skip(p); (void)parse_string(p); return true;
    case KW_LIGHT_SOURCE: parse_fail(p, "Light source must be defined using new syntax.");
    case KW_GLOBAL_LIGHTS:
        if (o->kind != OBJECT_LIGHT_GROUP)
            return false;
        flag_item(p, o, OBJECT_GLOBAL_LIGHTS);
        return true;
    default: return false;
    }
}

static void check_normals(Parser *p, const Texture *t)
{
    for (; t != NULL; t = t->below)
        if (t->kind == TEXTURE_PLAIN && normal_is_unfinished(t->normal))
            parse_fail(p, "No normal type given.");
}

/* After the last modifier: what can only be checked or joined now. */
static void complete(Parser *p, ObjectDraft *d)
{
    if (d->more.interior_texture != NULL && d->o.texture == NULL)
        parse_fail(p, "Interior texture requires an exterior texture.");
    check_normals(p, d->o.texture);
    check_normals(p, d->more.interior_texture);
    for (const Texture *t = d->o.texture; t != NULL; t = t->below)
        if (t->kind == TEXTURE_PLAIN && (t->finish->has_ior || t->finish->has_caustics || t->finish->has_refraction)) {
            d->more.interior = interior_with_finish(p, d->more.interior, t->finish);
            break;
        }
}

/* A word of the shape itself: `threshold`, `inside_vector`. */
static bool own_item(Parser *p, Object *o, const ShapeOps *own, void *params)
{
    int keyword = parse_peek(p);
    if (own == NULL || own->item == NULL || !own->item(p, params))
        return false;
    if (keyword == KW_INSIDE_VECTOR)
        o->flags |= OBJECT_HAS_INSIDE;
    return true;
}

/* To the brace that closes `word`. own, params: the shape's own further items; NULL when it is a copy of an identifier. */
static void modifiers(Parser *p, ObjectDraft *d, const char *word, const ShapeOps *own, void *params)
{
    Object *o = &d->o;
    bool modified = false;                     /* the shape's own words come first, `open` among them */
    while (!parse_at_close(p)) {
        int keyword = parse_peek(p);
        Affine move;
        bool is_own = own_item(p, o, own, params);
        if (modified && (is_own || keyword == KW_OPEN))
            parse_mend(p, "A word of the shape itself behind its modifiers");
        if (is_own)
            continue;
        if (parse_move(p, &move)) {
            draft_move(p, d, &move);
        } else if (!(o->kind != OBJECT_LIGHT_GROUP && texture_item(p, d, keyword)) && !plain_modifier(p, d, keyword)) {
            if (!parse_at_colour(p))
                break;
            parse_warn(p, "Quick color belongs in texture. Color ignored.");
            (void)parse_colour(p);
        }
        modified |= keyword != KW_OPEN;
    }
    if (own != NULL && own->finish != NULL)
        own->finish(p, params);
    block_close(p, word);
    complete(p, d);
}

Object *draft_close(Parser *p, const ObjectDraft *d)
{
    Object *o = arena_copy(parse_arena(p), &d->o, sizeof d->o);
    if (memcmp(&d->more, object_more(o), sizeof d->more) != 0)
        o->more = arena_copy(parse_arena(p), &d->more, sizeof d->more);
    return o;
}

void object_modifiers(Parser *p, ObjectDraft *d, const char *word)
{
    modifiers(p, d, word, NULL, NULL);
}

/* `sphere { S ... }`: S may be any object. */
static Object *copy_with_modifiers(Parser *p, const Object *from, const char *word)
{
    ObjectDraft d;
    draft_begin(&d, from);
    modifiers(p, &d, word, NULL, NULL);
    return draft_close(p, &d);
}

/* ---- kinds ---- */

static Object *shape(Parser *p, const ShapeOps *ops)
{
    Loc loc = parse_loc(p);
    parse_skip(p);
    block_open(p, ops->keyword);
    const Object *known = parse_take_block(p, BLOCK_OBJECT);
    if (known != NULL)
        return copy_with_modifiers(p, known, ops->keyword);
    void *params = arena_alloc(parse_arena(p), ops->params_size);
    ObjectDraft d;
    draft_new(&d, (Object){ .kind = OBJECT_SHAPE, .loc = loc, .ops = ops, .params = params });
    ops->parse(p, params);
    modifiers(p, &d, ops->keyword, ops, params);
    return draft_close(p, &d);
}

static Object *csg(Parser *p, ObjectKind kind)
{
    Loc loc = parse_loc(p);
    parse_skip(p);
    block_open(p, kind_word[kind]);
    const Object *known = parse_take_block(p, BLOCK_OBJECT);
    if (known != NULL)
        return copy_with_modifiers(p, known, kind_word[kind]);
    Objects list = { 0 };
    const Object *child;
    bool patch = false;
    ObjectDraft d;
    draft_new(&d, (Object){ .kind = kind, .loc = loc });
    while ((child = parse_object(p)) != NULL) {
        array_push(parse_arena(p), &list, child);
        draft_holds(p, &d, child);
        patch |= child->kind == OBJECT_SHAPE && object_is_patch(child);
        if (object_is_patch(child))
            d.o.flags |= OBJECT_HOLDS_PATCH;
    }
    if (list.n < 2 && kind != OBJECT_LIGHT_GROUP)
        parse_warn(p, "Should have at least 2 objects in csg.");
    if (patch && (kind == OBJECT_INTERSECTION || kind == OBJECT_DIFFERENCE))
        parse_warn(p, "Patch objects not allowed in intersection.");
    d.o.child = list.data;
    d.o.n_child = list.n;
    modifiers(p, &d, kind_word[kind], NULL, NULL);
    return draft_close(p, &d);
}

static Object *object_block(Parser *p)
{
    parse_skip(p);
    block_open(p, "object");
    const Object *o = parse_object(p);
    if (o == NULL)
        parse_expected(p, "object");
    return copy_with_modifiers(p, o, "object");
}

/* *fresh: the result belongs to the caller alone; else it is an identifier's. */
static const Object *read_object(Parser *p, bool *fresh)
{
    int keyword = parse_peek(p);
    *fresh = true;
    switch (keyword) {
    case TOK_NAME: *fresh = false; return parse_take_block(p, BLOCK_OBJECT);
    case KW_OBJECT: return object_block(p);
    case KW_COMPOSITE: parse_warn(p, "Use union instead of composite."); return csg(p, OBJECT_UNION);
    case KW_UNION: return csg(p, OBJECT_UNION);
    case KW_MERGE: return csg(p, OBJECT_MERGE);
    case KW_INTERSECTION: return csg(p, OBJECT_INTERSECTION);
    case KW_DIFFERENCE: return csg(p, OBJECT_DIFFERENCE);
    case KW_LIGHT_GROUP: return csg(p, OBJECT_LIGHT_GROUP);
    case KW_LIGHT_SOURCE: return light_block(p);
    default: {
        const ShapeOps *ops = keyword > KW_NONE && keyword < N_KEYWORDS ? parse_blocks(p)->shape_of[keyword] : NULL;
        return ops != NULL ? shape(p, ops) : NULL;
    }
    }
}

const Object *parse_object(Parser *p)
{
    bool fresh;
    return read_object(p, &fresh);
}

const Object *object_value(Parser *p)
{
    bool fresh;
    const Object *o = read_object(p, &fresh);
    if (o == NULL || (o->flags & OBJECT_DECLARED))
        return o;
    Object *mine = fresh ? (Object *)(uintptr_t)o : arena_copy(parse_arena(p), o, sizeof *o);
    mine->flags |= OBJECT_DECLARED;
    return mine;
}

/* A whole statement of the scene: it takes the default texture in force at its end. */
bool scene_object(Parser *p)
{
    Blocks *b = parse_blocks(p);
    bool fresh;
    const Object *o = read_object(p, &fresh);
    if (o == NULL)
        return false;
    Object *mine = fresh ? (Object *)(uintptr_t)o : arena_copy(parse_arena(p), o, sizeof *o);
    mine->default_texture = b->default_texture;
    array_push(parse_arena(p), &b->object, mine);
    return true;
}

/* ---- photons ---- */

const PhotonsBlock *photons_block(Parser *p, const PhotonsBlock *base, bool light)
{
    PhotonsBlock f = base != NULL ? *base : (PhotonsBlock){ 0 };
    block_open(p, "photons");
    for (;;) {
        int keyword = parse_peek(p);
        if (keyword == KW_REFRACTION || keyword == KW_REFLECTION) {
            parse_skip(p);
            bool yes = parse_float(p) > 0;
            *(keyword == KW_REFRACTION ? &f.refraction_on : &f.reflection_on) = yes;
            *(keyword == KW_REFRACTION ? &f.refraction_off : &f.reflection_off) = !yes;
        } else if (light && keyword == KW_AREA_LIGHT) {
            parse_skip(p);
            f.area_light = true;
        } else if (!light && keyword == KW_TARGET) {
            parse_skip(p);
            f.target_spacing = parse_at_number(p) ? (float)parse_float(p) : 1;
            f.target = f.target_spacing > 0;
        } else if (!light && keyword == KW_PASS_THROUGH) {
            parse_skip(p);
            f.pass_through = on(p);
        } else if (!light && keyword == KW_COLLECT) {
            parse_skip(p);
            f.collect_off = !on(p);
        } else {
            break;
        }
    }
    if (f.pass_through && f.target && f.refraction_on) {
        parse_warn(p, "Cannot use pass_through with refraction & target. Turning off refraction.");
        f.refraction_on = false;
        f.refraction_off = true;
    }
    block_close(p, "photons");
    return arena_copy(parse_arena(p), &f, sizeof f);
}
