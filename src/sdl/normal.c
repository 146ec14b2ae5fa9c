/* normal.c - normal { ... }: bumps. A body starts from the default texture's normal or an identifier's. */
#include "sdl/blocks.h"

static const Pattern PATTERN_PLAIN = { .frequency = 1, .wave_exponent = 1 };
const Normal NORMAL_EMPTY = { .kind = NORMAL_PATTERN, .accuracy = 0.02f, .pattern = &PATTERN_PLAIN };

static void choose(Parser *p, Normal *n, PatternDraft *d, const PatternOps *ops)
{
    n->kind = NORMAL_PATTERN;
    pattern_choose(p, d, ops);
    if (ops->flags & PATTERN_LIST) {
        n->map = parse_pattern_list(p, ops, USE_NORMAL);
        pattern_list_end(p, ops);
    } else if (n->map.kind == MAP_NORMAL && d->list) {
        n->map = (BlendMap){ 0 };
    }
    d->list = (ops->flags & PATTERN_LIST) != 0;
}

static void choose_kind(Parser *p, Normal *n, PatternDraft *d)
{
    int keyword = parse_peek(p);
    switch (keyword) {
    case KW_BUMP_MAP:
        parse_skip(p);
        n->kind = NORMAL_BUMP_MAP;
        n->image = image_block(p, IMAGE_BUMP, &n->amount);
        return;
    case KW_AVERAGE:
        parse_skip(p);
        n->kind = NORMAL_AVERAGE;
        return;
    case KW_FACETS:
        parse_skip(p);
        n->kind = NORMAL_FACETS;
        n->facets_size = 0.1;
        n->facets_coords = 0;
        n->facets_metric = 2;
        return;
    default: {
        const PatternOps *ops = pattern_row(p, keyword);
        if (ops == NULL)
            return;                            /* `#default { normal { bump_size 2 } }`; checked when an object uses it */
        parse_skip(p);
        choose(p, n, d, ops);
    }
    }
}

static bool facets_item(Parser *p, Normal *n, int keyword)
{
    double *to = keyword == KW_COORDS ? &n->facets_coords : keyword == KW_SIZE ? &n->facets_size
               : keyword == KW_METRIC ? &n->facets_metric : NULL;
    if (to == NULL)
        return false;
    parse_skip(p);
    *to = parse_float(p);
    return true;
}

static bool modifier(Parser *p, Normal *n, PatternDraft *d)
{
    int keyword = parse_peek(p);
    bool list = d->pattern.ops != NULL && (d->pattern.ops->flags & PATTERN_LIST) != 0;
    if (n->kind == NORMAL_FACETS && facets_item(p, n, keyword))
        return true;
    switch (keyword) {
    case KW_BUMP_SIZE: parse_skip(p); n->amount = (float)parse_float(p); return true;
    case KW_ACCURACY: parse_skip(p); n->accuracy = (float)parse_float(p); return true;
    case KW_NO_BUMP_SCALE: parse_skip(p); n->no_bump_scale = true; return true;
    case KW_SLOPE_MAP: case KW_NORMAL_MAP:
        if (n->kind == NORMAL_BUMP_MAP || list || (n->kind == NORMAL_AVERAGE && keyword == KW_SLOPE_MAP))
            parse_fail(p, "Keyword '%s' cannot be used with this normal type.", parse_word(keyword));
        parse_skip(p);
        n->map = parse_map(p, keyword == KW_SLOPE_MAP ? MAP_SLOPE : MAP_NORMAL, USE_NORMAL, n->kind == NORMAL_AVERAGE);
        return true;
    case KW_COLOR_MAP: case KW_PIGMENT_MAP: case KW_TEXTURE_MAP: case KW_DENSITY_MAP: case KW_QUICK_COLOR:
        map_misplaced(p, keyword);
    default: return pattern_modifier(p, d);
    }
}

static const Normal *body(Parser *p, const Normal *base)
{
    const Normal *known = parse_take_block(p, BLOCK_NORMAL);
    if (known != NULL)
        base = known;
    Normal n = base != NULL ? *base : NORMAL_EMPTY;
    if (base == NULL)
        n.amount = 0.5f;
    if (parse_accept(p, KW_UV_MAPPING)) {
        while (parse_accept(p, KW_UV_MAPPING))
            ;
        MapEntry *inner = arena_new(parse_arena(p), MapEntry);
        inner->normal = normal_body(p, base);
        n.kind = NORMAL_UV;
        n.pattern = pattern_plain(p);
        n.map = (BlendMap){ MAP_NORMAL, 1, inner };
        if (parse_at_number(p)) {              /* POV: an amount the inner pattern has no place for, and what follows, counts for little */
            Normal rest = n;
            PatternDraft d;
            pattern_begin(&d, n.pattern);
            parse_float(p);
            while (modifier(p, &rest, &d))
                ;
            n.no_bump_scale |= rest.no_bump_scale;
        }
        return arena_copy(parse_arena(p), &n, sizeof n);
    }
    PatternDraft d;
    pattern_begin(&d, n.pattern);
    choose_kind(p, &n, &d);
    n.amount = (float)parse_optional_float(p, n.amount);
    while (modifier(p, &n, &d))
        ;
    if (n.kind == NORMAL_AVERAGE && n.map.n == 0)
        parse_fail(p, "Average must have map.");
    n.pattern = pattern_close(p, &d);
    return arena_copy(parse_arena(p), &n, sizeof n);
}

const Normal *normal_body(Parser *p, const Normal *base)
{
    unsigned outer = pattern_depth_begin(p);
    const Normal *n = body(p, base);
    pattern_depth_end(p, outer, pattern_depth(n->pattern));
    return n;
}

const Normal *normal_old_item(Parser *p, const Normal *base)
{
    Normal n = base != NULL ? *base : NORMAL_EMPTY;
    PatternDraft d;
    pattern_begin(&d, n.pattern);
    if (!pattern_modifier(p, &d)) {
        if (base == NULL)
            n.amount = 0.5f;
        choose_kind(p, &n, &d);
        n.amount = (float)parse_optional_float(p, n.amount);
    }
    n.pattern = pattern_close(p, &d);
    return arena_copy(parse_arena(p), &n, sizeof n);
}

const Normal *parse_normal(Parser *p)
{
    parse_expect(p, KW_NORMAL);
    block_open(p, "normal");
    const Normal *n = normal_body(p, parse_blocks(p)->default_texture->normal);
    block_close(p, "normal");
    return n;
}

bool normal_is_unfinished(const Normal *n)
{
    return n != NULL && n != &NORMAL_EMPTY && n->kind == NORMAL_PATTERN && n->pattern->ops == NULL;
}

const Normal *normal_moved(Parser *p, const Normal *normal, const Moves *moves)
{
    if (normal->kind == NORMAL_UV)
        return normal;
    Normal *n = arena_copy(parse_arena(p), normal, sizeof *normal);
    n->pattern = pattern_moved(p, normal->pattern, moves);
    return n;
}
