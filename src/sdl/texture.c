/* texture.c - texture { ... }: plain layers, patterned textures, and how they are combined (07-textures, section 1). */
#include "sdl/blocks.h"

#include <string.h>

#include "sdl/parser.h"

/* Plain single layers by their parts; the newest stays. */
static const Texture *keep(Parser *p, const Texture *t)
{
    if (t->kind != TEXTURE_PLAIN || t->below != NULL || t->no_bump_scale)
        return arena_copy(parse_arena(p), t, sizeof *t);
    uint64_t h = ((uint64_t)(uintptr_t)t->pigment ^ (uint64_t)(uintptr_t)t->normal << 7 ^ (uint64_t)(uintptr_t)t->finish << 13);
    h = (h * 0x9e3779b97f4a7c15u >> 32) % TEXTURE_CACHE;
    Blocks *b = parse_blocks(p);
    const Texture **slot = &b->texture_cache[h];
    if (*slot != NULL && (*slot)->pigment == t->pigment && (*slot)->normal == t->normal && (*slot)->finish == t->finish)
        return *slot;
    if (b->n_free_textures == 0) {
        b->free_texture = arena_array(parse_arena(p), Texture, PIECE);
        b->n_free_textures = PIECE;
    }
    Texture *kept = &b->free_texture[--b->n_free_textures];
    *kept = *t;
    *slot = kept;
    return kept;
}

static Texture moved_layer(Parser *p, const Texture *from, const Moves *moves)
{
    Texture t = *from;
    if (t.kind == TEXTURE_PLAIN) {
        t.pigment = pigment_moved(p, t.pigment, moves);
        if (t.normal != NULL)
            t.normal = normal_moved(p, t.normal, moves);
    } else if (t.kind != TEXTURE_UV) {
        t.pattern = pattern_moved(p, t.pattern, moves);
    }
    if (t.below != NULL)
        t.below = texture_moved(p, t.below, moves);
    return t;
}

const Texture *texture_moved(Parser *p, const Texture *texture, const Moves *moves)
{
    if (texture == NULL || moves->n == 0)
        return texture;
    Texture t = moved_layer(p, texture, moves);
    if (memcmp(&t, texture, sizeof t) == 0)
        return texture;                        /* plain colours do not move */
    return keep(p, &t);
}

static void to_transmit(Colour *c)
{
    c->t += c->f;
    c->f = 0;
}

/* POV: up to version 3.1, filter in all but the lowest layer was transmit; also in the pigments of maps. */
static const Pigment *filter_to_transmit(Parser *p, const Pigment *from)
{
    Pigment *g = arena_copy(parse_arena(p), from, sizeof *from);
    to_transmit(&g->colour);
    if (g->map.n > 0) {
        MapEntry *entry = arena_copy(parse_arena(p), g->map.entry, g->map.n * sizeof *entry);
        for (uint32_t i = 0; i < g->map.n; i++) {
            if (g->map.kind == MAP_COLOUR)
                to_transmit(&entry[i].colour);
            else
                entry[i].pigment = filter_to_transmit(p, entry[i].pigment);
        }
        g->map.entry = entry;
    }
    return g;
}

static unsigned count_layers(const Texture *t)
{
    unsigned n = 0;
    for (; t != NULL; t = t->below)
        n++;
    return n;
}

const Texture *texture_layered(Parser *p, const Texture *below, const Texture *above)
{
    if (below == NULL)
        return above;
    if (count_layers(below) + count_layers(above) > MAX_LAYERS)
        parse_fail(p, "a texture has at most %d layers", MAX_LAYERS);
    if (below->kind != TEXTURE_PLAIN)
        parse_fail(p, "Cannot layer over a patterned texture.");
    if (above->kind != TEXTURE_PLAIN)
        parse_fail(p, "Cannot layer a patterned texture over another.");
    Texture *t = arena_copy(parse_arena(p), above, sizeof *above);
    if (parse_version(p) <= 310)
        t->pigment = filter_to_transmit(p, t->pigment);
    t->below = above->below != NULL ? texture_layered(p, below, above->below) : below;
    return t;
}

const Texture *texture_with(Parser *p, const Texture *from, const Pigment *pigment, const Normal *normal, const Finish *finish)
{
    Texture t = *from;
    t.pigment = pigment;
    t.normal = normal;
    t.finish = finish;
    return keep(p, &t);
}

/* NULL where a texture on top of this one cannot be told from its characters. */
static Lexer *lexer_for_literals(Parser *p, const Texture *top)
{
    Reader *r = cursor_top(p);
    return !p->have && r->is_file && top->kind == TEXTURE_PLAIN && top->pigment->quick == NULL ? &r->lexer : NULL;
}

/* The commonest texture of all, straight from the characters: `pigment { rgb <1,0,0> }`, or `texture { pigment {...} }` around
 * it. `keyword` has been taken. Nothing is taken if anything else stands there. */
static const Pigment *literal(Parser *p, const Texture *top, int keyword)
{
    Lexer *l = lexer_for_literals(p, top);
    Colour c;
    if (l == NULL || keyword == KW_FINISH || keyword == KW_NORMAL)
        return NULL;
    return (keyword == KW_TEXTURE ? literal_texture_body(l, &c) : literal_pigment(l, &c)) ? pigment_of_colour(p, c) : NULL;
}

const Texture *texture_part(Parser *p, const Texture *top)
{
    if (top->kind != TEXTURE_PLAIN)
        parse_fail(p, "Cannot layer over a patterned texture.");
    const Pigment *pigment = top->pigment;
    const Normal *normal = top->normal;
    const Finish *finish = top->finish;
    int keyword = parse_peek(p);
    parse_skip(p);
    const Pigment *known = literal(p, top, keyword);
    if (known != NULL) {
        pigment = known;
    } else if (keyword == KW_FINISH) {
        finish = finish_block(p, finish);
    } else {
        block_open(p, keyword == KW_PIGMENT ? "pigment" : "normal");
        if (keyword == KW_PIGMENT)
            pigment = pigment_body(p, pigment, USE_PIGMENT);
        else
            normal = normal_body(p, normal);
        block_close(p, keyword == KW_PIGMENT ? "pigment" : "normal");
    }
    return texture_with(p, top, pigment, normal, finish);
}

/* ---- plain: parts and transforms in any order ---- */

static const Texture *flush(Parser *p, const Texture *t, Moves *moves)
{
    t = texture_moved(p, t, moves);
    moves->n = 0;
    return t;
}

static bool take_move(Parser *p, const Texture **t, Moves *moves)
{
    if (moves->n == sizeof moves->move / sizeof *moves->move)
        *t = flush(p, *t, moves);
    if (!parse_move(p, &moves->move[moves->n]))
        return false;
    moves->n++;
    return true;
}

/* A part of a texture as an identifier standing alone: `texture { MyPigment MyFinish }`. */
static const Texture *bare_part(Parser *p, const Texture *t)
{
    switch (parse_peek_block(p)) {
    case BLOCK_PIGMENT: return texture_with(p, t, parse_take_block(p, BLOCK_PIGMENT), t->normal, t->finish);
    case BLOCK_NORMAL: return texture_with(p, t, t->pigment, parse_take_block(p, BLOCK_NORMAL), t->finish);
    case BLOCK_FINISH: return texture_with(p, t, t->pigment, t->normal, parse_take_block(p, BLOCK_FINISH));
    default: return NULL;
    }
}

static const Texture *no_bump_scale(Parser *p, const Texture *from)
{
    Texture t = *from;
    t.no_bump_scale = true;
    return keep(p, &t);
}

/* Reads what there is of parts and transforms; says whether there was any. */
static bool plain_items(Parser *p, const Texture **t)
{
    Moves moves;
    moves.n = 0;
    bool any = false;
    for (;; any = true) {
        int keyword = parse_peek(p);
        const Texture *changed;
        if (keyword == KW_PIGMENT || keyword == KW_NORMAL || keyword == KW_FINISH) {
            *t = flush(p, *t, &moves);
            *t = texture_part(p, *t);
        } else if (keyword == TOK_NAME && (*t)->kind == TEXTURE_PLAIN && (changed = bare_part(p, *t)) != NULL) {
            *t = flush(p, changed, &moves);
        } else if (keyword == KW_NO_BUMP_SCALE) {
            parse_skip(p);
            *t = no_bump_scale(p, *t);
        } else if (!take_move(p, t, &moves)) {
            *t = flush(p, *t, &moves);
            changed = old_texture_item(p, *t);
            if (changed == NULL)
                return any;
            *t = changed;
        }
    }
}

/* ---- patterned ---- */

static void texture_items(Parser *p, Texture *t, PatternDraft *d)
{
    for (;;) {
        int keyword = parse_peek(p);
        switch (keyword) {
        case KW_TEXTURE_MAP:
            if (t->kind != TEXTURE_AVERAGE && (d->pattern.ops == NULL || (d->pattern.ops->flags & PATTERN_LIST)))
                parse_fail(p, "Cannot use texture_map with this pattern type.");
            parse_skip(p);
            t->map = parse_map(p, MAP_TEXTURE, USE_TEXTURE, t->kind == TEXTURE_AVERAGE);
            break;
        case KW_COLOR_MAP: case KW_PIGMENT_MAP: case KW_NORMAL_MAP: case KW_SLOPE_MAP: case KW_DENSITY_MAP:
        case KW_QUICK_COLOR: case KW_BUMP_SIZE:
            map_misplaced(p, keyword);
        case KW_NO_BUMP_SCALE:
            parse_skip(p);
            t->no_bump_scale = true;
            break;
        default:
            if (!pattern_modifier(p, d))
                return;
        }
    }
}

static const Texture *close_patterned(Parser *p, Texture *t, PatternDraft *d)
{
    texture_items(p, t, d);
    if (t->map.n == 0)
        parse_fail(p, "Patterned texture must have texture_map.");
    t->pattern = pattern_close(p, d);
    if (t->pattern == NULL)
        t->pattern = pattern_plain(p);
    return arena_copy(parse_arena(p), t, sizeof *t);
}

/* `texture {...} texture {...}`: as many layers. */
static const Texture *layers(Parser *p)
{
    const Texture *t = NULL;
    while (parse_peek(p) == KW_TEXTURE)
        t = texture_layered(p, t, parse_texture(p));
    return t;
}

static void tiles(Parser *p, Texture *t)
{
    MapEntry *tile = arena_array(parse_arena(p), MapEntry, 2);
    block_open(p, "tiles");
    tile[0].texture = layers(p);
    if (!parse_accept(p, KW_TILE2))
        parse_expected(p, "tile2");
    tile[1].key = 1;
    tile[1].texture = layers(p);
    if (tile[0].texture == NULL || tile[1].texture == NULL)
        parse_expected(p, "texture");
    block_close(p, "tiles");
    t->map = (BlendMap){ MAP_TEXTURE, 2, tile };
}

static void material_map(Parser *p, Texture *t)
{
    Entries list = { 0 };
    block_open(p, "material_map");
    t->image = image_items(p, IMAGE_INDEX, NULL);
    while (parse_peek(p) == KW_TEXTURE) {
        array_push(parse_arena(p), &list, (MapEntry){ .key = (float)list.n, .texture = parse_texture(p) });
        parse_comma(p);
    }
    if (list.n == 0)
        parse_expected(p, "texture");
    block_close(p, "material_map");
    t->map = (BlendMap){ MAP_TEXTURE, list.n, list.data };
}

/* NULL if the next token begins no patterned texture. */
static const Texture *patterned(Parser *p)
{
    const Texture *standard = parse_blocks(p)->default_texture;
    Texture t = { .kind = TEXTURE_PATTERN, .pigment = standard->pigment, .finish = standard->finish };
    PatternDraft d;
    int keyword = parse_peek(p);
    const PatternOps *ops = NULL;
    pattern_begin(&d, NULL);
    switch (keyword) {
    case KW_TILES: parse_skip(p); t.kind = TEXTURE_TILES; tiles(p, &t); break;
    case KW_MATERIAL_MAP: parse_skip(p); t.kind = TEXTURE_MATERIAL_MAP; material_map(p, &t); break;
    case KW_AVERAGE: parse_skip(p); t.kind = TEXTURE_AVERAGE; break;
    case KW_UV_MAPPING: {
        while (parse_accept(p, KW_UV_MAPPING))
            ;
        MapEntry *inner = arena_new(parse_arena(p), MapEntry);
        inner->texture = texture_body(p);
        t.kind = TEXTURE_UV;
        t.pattern = pattern_plain(p);
        t.map = (BlendMap){ MAP_TEXTURE, 1, inner };
        return arena_copy(parse_arena(p), &t, sizeof t);
    }
    default:
        ops = pattern_row(p, keyword);
        if (ops == NULL)
            return NULL;
        parse_skip(p);
        pattern_choose(p, &d, ops);
        if (ops->flags & PATTERN_LIST) {
            t.map = parse_pattern_list(p, ops, USE_TEXTURE);
            pattern_list_end(p, ops);
        }
    }
    return close_patterned(p, &t, &d);
}

/* A patterned identifier takes only transforms and no_bump_scale. */
static const Texture *patterned_items(Parser *p, const Texture *t)
{
    Moves moves;
    moves.n = 0;
    for (;;) {
        if (parse_accept(p, KW_NO_BUMP_SCALE))
            t = no_bump_scale(p, t);
        else if (!take_move(p, &t, &moves))
            return flush(p, t, &moves);
    }
}

static const Texture *body(Parser *p)
{
    const Texture *t = parse_take_block(p, BLOCK_TEXTURE);
    if (t != NULL && t->kind != TEXTURE_PLAIN)
        return patterned_items(p, t);
    if (t != NULL) {
        plain_items(p, &t);
        return t;
    }
    t = parse_blocks(p)->default_texture;
    if (plain_items(p, &t))
        return t;
    const Texture *other = patterned(p);
    return other != NULL ? other : t;
}

unsigned texture_depth(const Texture *t)
{
    unsigned depth = 0;
    for (; t != NULL; t = t->below) {
        unsigned of_layer = pattern_depth(t->pattern), of_normal = t->normal != NULL ? pattern_depth(t->normal->pattern) : 0;
        if (t->kind == TEXTURE_PLAIN)
            of_layer = pattern_depth(t->pigment->pattern) > of_normal ? pattern_depth(t->pigment->pattern) : of_normal;
        depth = of_layer > depth ? of_layer : depth;
    }
    return depth;
}

const Texture *texture_body(Parser *p)
{
    unsigned outer = pattern_depth_begin(p);
    const Texture *t = body(p);
    pattern_depth_end(p, outer, texture_depth(t));
    return t;
}

const Texture *parse_texture(Parser *p)
{
    if (!parse_accept(p, KW_TEXTURE))
        parse_expect(p, KW_INTERIOR_TEXTURE);
    const Texture *standard = parse_blocks(p)->default_texture;
    const Pigment *known = literal(p, standard, KW_TEXTURE);
    if (known != NULL)
        return texture_with(p, standard, known, standard->normal, standard->finish);
    block_open(p, "texture");
    const Texture *t = texture_body(p);
    block_close(p, "texture");
    return t;
}

/* A list of 800,000 takes 25 MB so, as textures and pigments it took 120. */
ListedTexture parse_listed_texture(Parser *p)
{
    ListedTexture t = { .texture = parse_blocks(p)->default_texture };
    Lexer *l = lexer_for_literals(p, t.texture);
    t.coloured = l != NULL && literal_texture(l, &t.colour);
    if (t.coloured)
        return t;
    t.texture = parse_take_block(p, BLOCK_TEXTURE);
    if (t.texture == NULL && parse_peek(p) != KW_TEXTURE)
        parse_expected(p, "texture");
    if (t.texture == NULL)
        t.texture = parse_texture(p);
    return t;
}

bool parse_part_item(Parser *p, const Texture **texture, Affine *place)
{
    int keyword = parse_peek(p);
    if (keyword == KW_TEXTURE) {
        *texture = texture_layered(p, *texture, parse_texture(p));
    } else if (keyword == KW_PIGMENT || keyword == KW_NORMAL || keyword == KW_FINISH) {
        *texture = texture_part(p, *texture != NULL ? *texture : parse_blocks(p)->default_texture);
    } else {
        Moves moves = { .n = 1 };
        if (!parse_move(p, &moves.move[0]))
            return false;
        *place = affine_then(*place, moves.move[0]);
        if (*texture != NULL)
            *texture = texture_moved(p, *texture, &moves);
    }
    return true;
}
