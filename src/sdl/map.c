/* map.c - color_map and its relatives, and the lists of checker, brick and the like.
 *
 * Keys stay in the order written: the search rule (07-textures, section 2) gives unsorted ones a meaning. */
#include "sdl/blocks.h"

#include <string.h>

enum { MAP_MAX = 256 };

static void append(Parser *p, Entries *e, MapEntry entry)
{
    if (e->n == MAP_MAX)
        parse_fail(p, "a map takes up to %d entries", MAP_MAX);
    array_push(parse_arena(p), e, entry);
}

/* What follows a key: a colour, or an expression that turns out to have five terms, or the second key of the old form
 * `[key, key color A color B]`. */
static void colour_entry(Parser *p, Entries *e)
{
    MapEntry entry = { .key = (float)parse_float(p) };
    parse_comma(p);
    if (parse_at_colour(p)) {
        entry.colour = parse_colour(p);
        append(p, e, entry);
        return;
    }
    double terms[5];
    int n = parse_terms(p, terms);
    if (n == 5) {
        entry.colour = (Colour){ (float)terms[0], (float)terms[1], (float)terms[2], (float)terms[3], (float)terms[4] };
        append(p, e, entry);
        return;
    }
    if (n != 1)
        parse_expected(p, "color");
    entry.colour = parse_colour(p);
    append(p, e, entry);
    parse_expect(p, KW_COLOR);
    entry.key = (float)terms[0];
    entry.colour = parse_colour(p);
    append(p, e, entry);
}

static BlendMap finished(const Entries *e, MapKind kind)
{
    return (BlendMap){ .kind = kind, .n = e->n, .entry = e->data };
}

BlendMap parse_colour_map(Parser *p)
{
    Entries e = { 0 };
    block_open(p, "color_map");
    const BlendMap *known = parse_take_block(p, BLOCK_COLOUR_MAP);
    if (known == NULL) {
        if (parse_peek(p) != TOK_LBRACKET)
            parse_fail(p, "Must have at least one color in color map.");
        while (parse_accept(p, TOK_LBRACKET)) {
            colour_entry(p, &e);
            parse_expect(p, TOK_RBRACKET);
        }
    }
    block_close(p, "color_map");
    return known != NULL ? *known : finished(&e, MAP_COLOUR);
}

static MapEntry map_item(Parser *p, MapKind kind, PatternUse use)
{
    const Texture *standard = parse_blocks(p)->default_texture;
    MapEntry entry = { 0 };
    switch (kind) {
    case MAP_PIGMENT: entry.pigment = pigment_body(p, use == USE_DENSITY ? &PIGMENT_EMPTY : standard->pigment, use); break;
    case MAP_NORMAL: entry.normal = normal_body(p, standard->normal); break;
    case MAP_TEXTURE: entry.texture = texture_body(p); break;
    case MAP_SLOPE: {
        Vec2 v = parse_vec2(p);
        entry.slope.height = (float)v.u;
        entry.slope.slope = (float)v.v;
        break;
    }
    default: entry.colour = parse_colour(p); break;
    }
    return entry;
}

static BlockKind block_of(MapKind kind, PatternUse use)
{
    switch (kind) {
    case MAP_PIGMENT: return use == USE_DENSITY ? BLOCK_DENSITY_MAP : BLOCK_PIGMENT_MAP;
    case MAP_NORMAL: return BLOCK_NORMAL_MAP;
    case MAP_TEXTURE: return BLOCK_TEXTURE_MAP;
    case MAP_SLOPE: return BLOCK_SLOPE_MAP;
    default: return BLOCK_COLOUR_MAP;
    }
}

/* The items of a map that an identifier holds. */
static void add_depths(Parser *p, const BlendMap *m)
{
    for (uint32_t i = 0; i < m->n; i++) {
        const MapEntry *e = &m->entry[i];
        if (m->kind == MAP_PIGMENT)
            pattern_depth_add(p, pattern_depth(e->pigment->pattern));
        else if (m->kind == MAP_NORMAL)
            pattern_depth_add(p, pattern_depth(e->normal->pattern));
        else if (m->kind == MAP_TEXTURE)
            pattern_depth_add(p, texture_depth(e->texture));
    }
}

BlendMap parse_map(Parser *p, MapKind kind, PatternUse use, bool weights)
{
    Entries e = { 0 };
    block_open(p, "map");
    const BlendMap *known = parse_take_block(p, block_of(kind, use));
    if (known == NULL) {
        if (parse_peek_block(p) != BLOCK_NONE)
            parse_fail(p, "Wrong identifier type");
        if (parse_peek(p) != TOK_LBRACKET)
            parse_expected(p, "[");
        while (parse_accept(p, TOK_LBRACKET)) {
            float key = weights && !parse_at_number(p) ? 1.0f : (float)parse_float(p);
            parse_comma(p);
            MapEntry entry = map_item(p, kind, use);
            entry.key = key;
            append(p, &e, entry);
            parse_expect(p, TOK_RBRACKET);
        }
    }
    block_close(p, "map");
    if (known != NULL)
        add_depths(p, known);
    return known != NULL ? *known : finished(&e, kind);
}

/* What stands for an item that the author left out. */
static MapEntry missing(Parser *p, const PatternOps *ops, MapKind kind, PatternUse use, uint32_t i)
{
    const Texture *standard = parse_blocks(p)->default_texture;
    MapEntry entry = { 0 };
    switch (kind) {
    case MAP_PIGMENT: entry.pigment = use == USE_DENSITY ? &PIGMENT_EMPTY : standard->pigment; break;
    case MAP_NORMAL: entry.normal = standard->normal != NULL ? standard->normal : &NORMAL_EMPTY; break;
    case MAP_TEXTURE: entry.texture = standard; break;
    default:
        if (i < ops->n_default_map)
            entry.colour = ops->default_map[i].colour;
        break;
    }
    return entry;
}

static int keyword_of(PatternUse use)
{
    return use == USE_NORMAL ? KW_NORMAL : use == USE_TEXTURE ? KW_TEXTURE : use == USE_DENSITY ? KW_DENSITY : KW_PIGMENT;
}

BlendMap parse_pattern_list(Parser *p, const PatternOps *ops, PatternUse use)
{
    Entries e = { 0 };
    int keyword = keyword_of(use);
    MapKind kind = use == USE_NORMAL ? MAP_NORMAL : use == USE_TEXTURE ? MAP_TEXTURE
                 : parse_peek(p) == keyword ? MAP_PIGMENT : MAP_COLOUR;
    if (use == USE_NORMAL && parse_peek(p) != keyword)
        return (BlendMap){ 0 };                /* the pattern itself is the bump */
    uint32_t n_items = (uint32_t)ops->n_items;
    while (e.n < n_items) {
        MapEntry entry;
        if (kind == MAP_COLOUR) {
            if (!parse_at_number(p))
                break;
            entry = (MapEntry){ .colour = parse_colour(p) };
        } else {
            if (!parse_accept(p, keyword))
                break;
            block_open(p, kind == MAP_NORMAL ? "normal" : kind == MAP_TEXTURE ? "texture" : "pigment");
            entry = map_item(p, kind, use);
            block_close(p, kind == MAP_NORMAL ? "normal" : kind == MAP_TEXTURE ? "texture" : "pigment");
        }
        entry.key = (float)e.n;
        append(p, &e, entry);
        parse_comma(p);                        /* POV: also after the last */
    }
    while (e.n < n_items) {
        MapEntry entry = missing(p, ops, kind, use, e.n);
        entry.key = (float)e.n;
        append(p, &e, entry);
    }
    return finished(&e, kind);
}
