/* pigment.c - pigment { ... } and density { ... }: colours over space.
 *
 * A body starts from a pigment (the default's, or that of an identifier) and changes it: `pigment { P1 gradient x }`
 * keeps P1's map and warps. One-colour pigments are looked up among the last ones made, so that equal ones are one. */
#include "sdl/blocks.h"

#include <string.h>

const Pigment PIGMENT_EMPTY = { .kind = PIGMENT_PLAIN, .untyped = true };

static const MapEntry grey[] = { { .key = 0, .colour = { 0 } }, { .key = 1, .colour = { 1, 1, 1, 0, 0 } } };

static bool is_default_map(const BlendMap *m, const PatternOps *ops)
{
    return m->n == 0 || m->entry == grey || (ops != NULL && m->entry == ops->default_map);
}

static void set_default_map(Pigment *g, const PatternDraft *d)
{
    const PatternOps *ops = d->pattern.ops;
    bool own = ops->default_map != NULL && !d->exponent;       /* mandel with an exponent is grey */
    g->map = own ? (BlendMap){ MAP_COLOUR, ops->n_default_map, ops->default_map } : (BlendMap){ MAP_COLOUR, 2, grey };
}

static bool is_list(const PatternDraft *d)
{
    return d->pattern.ops != NULL && (d->pattern.ops->flags & PATTERN_LIST) != 0;
}

static void choose(Parser *p, Pigment *g, PatternDraft *d, const PatternOps *ops, PatternUse use)
{
    if (ops->flags & PATTERN_NORMAL_ONLY)
        parse_fail(p, "Keyword '%s' can only be used in a normal statement.", ops->keyword);
    bool waiting = g->untyped && g->map.n > 0;
    bool fresh = !waiting && (g->kind != PIGMENT_PATTERN || is_default_map(&g->map, d->pattern.ops));
    g->kind = PIGMENT_PATTERN;
    pattern_choose(p, d, ops);
    if (ops->flags & PATTERN_LIST) {
        g->map = parse_pattern_list(p, ops, use);
        pattern_list_end(p, ops);
    } else if (fresh) {
        g->map = (BlendMap){ 0 };
    }
}

/* The colour or pattern, when one is written. */
static bool choose_kind(Parser *p, Pigment *g, PatternDraft *d, PatternUse use)
{
    if (parse_at_colour(p)) {
        g->kind = PIGMENT_PLAIN;
        g->colour = parse_colour(p);
        return true;
    }
    int keyword = parse_peek(p);
    switch (keyword) {
    case KW_IMAGE_MAP:
        parse_skip(p);
        g->kind = PIGMENT_IMAGE;
        g->image = image_block(p, IMAGE_COLOUR, NULL);
        return true;
    case KW_AVERAGE:
        parse_skip(p);
        g->kind = PIGMENT_AVERAGE;
        return true;
    default: {
        const PatternOps *ops = pattern_row(p, keyword);
        if (ops == NULL)
            return false;
        parse_skip(p);
        choose(p, g, d, ops, use);
        return true;
    }
    }
}

static void refuse_map(Parser *p, const Pigment *g, const PatternDraft *d, int keyword)
{
    if ((g->kind == PIGMENT_PLAIN && !g->untyped) || g->kind == PIGMENT_IMAGE || is_list(d) || (g->kind == PIGMENT_AVERAGE && keyword == KW_COLOR_MAP))
        parse_fail(p, "Cannot use %s with this pattern type.", parse_word(keyword));
}

static bool modifier(Parser *p, Pigment *g, PatternDraft *d, PatternUse use)
{
    int keyword = parse_peek(p);
    Colour c;
    switch (keyword) {
    case KW_COLOR_MAP:
        refuse_map(p, g, d, keyword);
        parse_skip(p);
        g->map = parse_colour_map(p);
        return true;
    case KW_PIGMENT_MAP: case KW_DENSITY_MAP:
        if ((keyword == KW_PIGMENT_MAP) != (use == USE_PIGMENT))
            map_misplaced(p, keyword);
        refuse_map(p, g, d, keyword);
        parse_skip(p);
        g->map = parse_map(p, MAP_PIGMENT, use, g->kind == PIGMENT_AVERAGE);
        return true;
    case KW_NORMAL_MAP: case KW_SLOPE_MAP: case KW_TEXTURE_MAP: case KW_BUMP_SIZE: case KW_NO_BUMP_SCALE:
        map_misplaced(p, keyword);
    case KW_QUICK_COLOR:
        if (use != USE_PIGMENT)
            map_misplaced(p, keyword);
        parse_skip(p);
        c = parse_colour(p);
        g->quick = arena_copy(parse_arena(p), &c, sizeof c);
        return true;
    default: return pattern_modifier(p, d);
    }
}

static bool same_colour(const Pigment *a, const Pigment *b)
{
    return memcmp(&a->colour, &b->colour, sizeof a->colour) == 0;
}

/* One-colour pigments by their bits; the newest stays. */
static const Pigment *plain_pigment(Parser *p, const Pigment *g)
{
    Blocks *b = parse_blocks(p);
    uint32_t bits[5], h = 0;
    memcpy(bits, &g->colour, sizeof bits);
    for (int i = 0; i < 5; i++)
        h = (h ^ bits[i]) * 0x9e3779b1u;
    h = (h >> 16) % TEXTURE_CACHE;
    if (b->pigment_cache[h] != NULL && same_colour(b->pigment_cache[h], g))
        return b->pigment_cache[h];
    if (b->n_free_pigments == 0) {
        b->free_pigment = arena_array(parse_arena(p), Pigment, PIECE);
        b->n_free_pigments = PIECE;
    }
    Pigment *kept = &b->free_pigment[--b->n_free_pigments];
    *kept = *g;
    b->pigment_cache[h] = kept;
    return kept;
}

const Pigment *pigment_of_colour(Parser *p, Colour c)
{
    Pigment g = { .kind = PIGMENT_PLAIN, .colour = c };
    return plain_pigment(p, &g);
}

static const Pigment *close_body(Parser *p, Pigment *g, PatternDraft *d, const Pigment *base)
{
    if (g->untyped && g->kind == PIGMENT_PLAIN) {
        g->pattern = pattern_close(p, d);
        return memcmp(g, base, sizeof *g) == 0 ? base : arena_copy(parse_arena(p), g, sizeof *g);
    }
    if (g->kind == PIGMENT_PLAIN) {
        *g = (Pigment){ .kind = PIGMENT_PLAIN, .colour = g->colour, .quick = g->quick };
        if (g->quick == NULL)
            return plain_pigment(p, g);
        return arena_copy(parse_arena(p), g, sizeof *g);
    }
    if (g->kind == PIGMENT_AVERAGE && g->map.n == 0)
        parse_fail(p, "Average must have map.");
    if (g->kind == PIGMENT_PATTERN && (g->map.n == 0 || (d->exponent && is_default_map(&g->map, d->pattern.ops))))
        set_default_map(g, d);
    g->pattern = pattern_close(p, d);
    if (g->pattern == NULL)
        g->pattern = pattern_plain(p);
    if (memcmp(g, base, sizeof *g) == 0)
        return base;
    return arena_copy(parse_arena(p), g, sizeof *g);
}

static const Pigment *body(Parser *p, const Pigment *base, PatternUse use)
{
    const Pigment *known = parse_take_block(p, use == USE_DENSITY ? BLOCK_DENSITY : BLOCK_PIGMENT);
    if (known != NULL)
        base = known;
    if (parse_accept(p, KW_UV_MAPPING)) {
        while (parse_accept(p, KW_UV_MAPPING))
            ;
        MapEntry *inner = arena_new(parse_arena(p), MapEntry);
        inner->pigment = pigment_body(p, base, use);
        Pigment *uv = arena_new(parse_arena(p), Pigment);
        *uv = (Pigment){ .kind = PIGMENT_UV, .pattern = pattern_plain(p), .map = { MAP_PIGMENT, 1, inner } };
        return uv;
    }
    Pigment g = *base;
    PatternDraft d;
    pattern_begin(&d, base->pattern);
    if (choose_kind(p, &g, &d, use))
        g.untyped = false;
    else if (known == NULL)
        parse_warn(p, "Pigment type unspecified or not 1st item.");
    while (modifier(p, &g, &d, use))
        ;
    return close_body(p, &g, &d, base);
}

const Pigment *pigment_body(Parser *p, const Pigment *base, PatternUse use)
{
    unsigned outer = pattern_depth_begin(p);
    const Pigment *g = body(p, base, use);
    pattern_depth_end(p, outer, pattern_depth(g->pattern));
    return g;
}

const Pigment *pigment_old_item(Parser *p, const Pigment *base)
{
    Pigment g = *base;
    PatternDraft d;
    pattern_begin(&d, base->pattern);
    if (choose_kind(p, &g, &d, USE_PIGMENT)) {
        g.untyped = false;
        d.pattern.wave = WAVE_RAMP;
    } else if (!modifier(p, &g, &d, USE_PIGMENT))
        return NULL;
    return close_body(p, &g, &d, base);
}

const Pigment *parse_pigment(Parser *p)
{
    parse_expect(p, KW_PIGMENT);
    block_open(p, "pigment");
    const Pigment *g = parse_pigment_body(p);
    block_close(p, "pigment");
    return g;
}

const Pigment *parse_pigment_body(Parser *p)
{
    return pigment_body(p, parse_blocks(p)->default_texture->pigment, USE_PIGMENT);
}

const Pigment *pigment_moved(Parser *p, const Pigment *pigment, const Moves *moves)
{
    if (pigment->pattern == NULL)
        return pigment;
    Pigment *g = arena_copy(parse_arena(p), pigment, sizeof *pigment);
    if (g->kind == PIGMENT_UV)
        return pigment;                        /* the point is (u,v,0) whatever stands around */
    g->pattern = pattern_moved(p, pigment->pattern, moves);
    return g;
}
