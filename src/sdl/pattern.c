/* pattern.c - the "where" of pigments, normals and textures: pattern keyword, transforms, warps, waves.
 *
 * The chain of warps and transforms runs front to back (07-textures, section 3), and each new one goes to the front.
 * A draft keeps the few written last; they are joined to the shared rest when the pattern closes. */
#include "sdl/blocks.h"

#include <string.h>

const Turbulence TURBULENCE_DEFAULT = { .octaves = 6, .omega = 0.5f, .lambda = 2 };

unsigned pattern_depth_begin(Parser *p)
{
    Blocks *b = parse_blocks(p);
    unsigned outer = b->pattern_depth;
    b->pattern_depth = 0;
    return outer;
}

void pattern_depth_end(Parser *p, unsigned outer, unsigned depth)
{
    parse_blocks(p)->pattern_depth = depth > outer ? depth : outer;
}

void pattern_depth_add(Parser *p, unsigned depth)
{
    Blocks *b = parse_blocks(p);
    if (depth > b->pattern_depth)
        b->pattern_depth = depth;
}

/* The depth of a pattern closed now. */
static uint16_t depth_here(Parser *p)
{
    unsigned depth = parse_blocks(p)->pattern_depth + 1;
    if (depth > MAX_PATTERN_DEPTH)
        parse_fail(p, "patterns are nested more than %d deep", MAX_PATTERN_DEPTH);
    return (uint16_t)depth;
}

void pattern_begin(PatternDraft *d, const Pattern *base)
{
    if (base != NULL)
        d->pattern = *base;
    else
        d->pattern = (Pattern){ .frequency = 1, .wave_exponent = 1 };
    d->base = base;
    d->changed = false;
    d->own_params = false;
    d->n = 0;
    d->exponent = false;
    d->list = base != NULL && base->ops != NULL && (base->ops->flags & PATTERN_LIST) != 0;
}

static void flush(Arena *a, PatternDraft *d)
{
    WarpChain *c = &d->pattern.chain;
    if (d->n == 0)
        return;
    Warp *warp = arena_array(a, Warp, c->n + d->n);
    for (uint32_t i = 0; i < d->n; i++)
        warp[i] = d->warp[d->n - 1 - i];
    if (c->n > 0)
        memcpy(warp + d->n, c->warp, c->n * sizeof *warp);
    c->warp = warp;
    c->n += d->n;
    d->n = 0;
}

static Warp *push(Arena *a, PatternDraft *d)
{
    if (d->n == sizeof d->warp / sizeof *d->warp)
        flush(a, d);
    d->changed = true;
    return &d->warp[d->n++];
}

static void push_move(Arena *a, PatternDraft *d, const Affine *move)
{
    WarpChain *c = &d->pattern.chain;
    d->changed = true;
    if (d->n > 0 && d->warp[d->n - 1].kind == WARP_TRANSFORM) {
        Warp *last = &d->warp[d->n - 1];
        last->transform = affine_then(last->transform, *move);
    } else if (d->n == 0 && c->n > 0 && c->warp[0].kind == WARP_TRANSFORM) {
        Affine joined = affine_then(c->warp[0].transform, *move);
        c->warp++;
        c->n--;
        *push(a, d) = (Warp){ .kind = WARP_TRANSFORM, .transform = joined };
    } else {
        *push(a, d) = (Warp){ .kind = WARP_TRANSFORM, .transform = *move };
    }
}

void pattern_choose(Parser *p, PatternDraft *d, const PatternOps *ops)
{
    void *params = arena_alloc(parse_arena(p), ops->params_size);
    if (strcmp(ops->keyword, "function") == 0 || strcmp(ops->keyword, "object") == 0)
        pattern_depth_add(p, parse_blocks(p)->function_depth);     /* it may reach any function so far */
    if (ops->parse != NULL)
        ops->parse(p, params);
    d->pattern.ops = ops;
    d->pattern.params = params;
    if (ops->default_wave != WAVE_RAMP)
        d->pattern.wave = ops->default_wave;
    if (ops->flags & PATTERN_NO_WAVE)
        d->pattern.frequency = 0;              /* POV: an earlier pattern's frequency otherwise stays */
    d->own_params = true;
    d->changed = true;
}

static Turbulence *turbulence(PatternDraft *d)
{
    WarpChain *c = &d->pattern.chain;
    d->changed = true;
    if (!c->has_turbulence) {
        c->has_turbulence = true;
        c->turbulence = TURBULENCE_DEFAULT;
    }
    return &c->turbulence;
}

int parse_octaves(Parser *p)
{
    int octaves = parse_int(p);
    return octaves < 1 ? 1 : octaves > 10 ? 10 : octaves;
}

/* turbulence, octaves, omega, lambda: in patterns, in warp { turbulence } and in fog. */
bool parse_turbulence_item(Parser *p, int keyword, Turbulence *t)
{
    switch (keyword) {
    case KW_TURBULENCE: t->amount = parse_vec3(p); return true;
    case KW_OCTAVES: t->octaves = parse_octaves(p); return true;
    case KW_OMEGA: t->omega = (float)parse_float(p); return true;
    case KW_LAMBDA: t->lambda = (float)parse_float(p); return true;
    default: return false;
    }
}

static bool choose_wave(Parser *p, PatternDraft *d, Wave wave)
{
    d->pattern.wave = wave;
    if (wave == WAVE_POLY)
        d->pattern.wave_exponent = (float)(parse_at_number(p) ? parse_float(p) : 1.0);
    d->changed = true;
    return true;
}

/* Words that belong to certain patterns: what to say when they stand in another. */
static const struct { int keyword; const char *what; } belongs[] = {
    { KW_AGATE_TURB, "cannot be used with non-agate" },
    { KW_BRICK_SIZE, "cannot be used with non-brick" },
    { KW_MORTAR, "cannot be used with non-brick" },
    { KW_CONTROL0, "cannot be used with this pattern" },
    { KW_CONTROL1, "cannot be used with this pattern" },
    { KW_SOLID, "can only be used in a crackle statement" },
    { KW_METRIC, "can only be used in a facets or crackle statement" },
    { KW_FORM, "can only be used in a crackle or pavement statement" },
    { KW_OFFSET, "can only be used in a crackle statement" },
    { KW_COORDS, "can only be used in a facets statement" },
    { KW_SIZE, "can only be used in a facets statement" },
    { KW_EXPONENT, "can only be used in a mandel or julia statement" },
    { KW_EXTERIOR, "can only be used in a mandel, julia, magnet or pavement statement" },
    { KW_INTERIOR, "can only be used in a mandel, julia, magnet or pavement statement" },
    { KW_INTERPOLATE, "can only be used in a density_file statement" },
    { KW_NUMBER_OF_SIDES, "can only be used in a pavement statement" },
    { KW_NUMBER_OF_TILES, "can only be used in a pavement statement" },
    { KW_PATTERN, "can only be used in a pavement statement" },
};

static const char *belongs_to(int keyword)
{
    for (size_t i = 0; i < sizeof belongs / sizeof *belongs; i++)
        if (belongs[i].keyword == keyword)
            return belongs[i].what;
    return NULL;
}

static bool pattern_item(Parser *p, PatternDraft *d, int keyword)
{
    const PatternOps *ops = d->pattern.ops;
    const char *what = belongs_to(keyword);
    if (what == NULL)
        return false;
    if (ops != NULL && ops->item != NULL) {
        if (!d->own_params) {
            d->pattern.params = arena_copy(parse_arena(p), d->pattern.params, ops->params_size);
            d->own_params = true;
        }
        d->changed = true;
        if (keyword == KW_EXPONENT)
            d->exponent = true;
        if (ops->item(p, (void *)(uintptr_t)d->pattern.params))
            return true;
    }
    parse_fail(p, "Keyword '%s' %s.", parse_word(keyword), what);
}

bool pattern_modifier(Parser *p, PatternDraft *d)
{
    int keyword = parse_peek(p);
    if (keyword >= N_KEYWORDS)                 /* mostly the brace */
        return false;
    Affine move;
    switch (keyword) {
    case KW_TRANSLATE: case KW_ROTATE: case KW_SCALE: case KW_MATRIX: case KW_TRANSFORM:
        parse_move(p, &move);
        push_move(parse_arena(p), d, &move);
        return true;
    case KW_WARP: {
        Warp warp = parse_warp(p);
        *push(parse_arena(p), d) = warp;
        return true;
    }
    case KW_TURBULENCE: case KW_OCTAVES: case KW_OMEGA: case KW_LAMBDA:
        parse_skip(p);
        return parse_turbulence_item(p, keyword, turbulence(d));
    case KW_FREQUENCY:
        parse_skip(p);
        d->pattern.frequency = (float)parse_float(p);
        d->changed = true;
        return true;
    case KW_PHASE:
        parse_skip(p);
        d->pattern.phase = (float)parse_float(p);
        d->changed = true;
        return true;
    case KW_NOISE_GENERATOR: {
        parse_skip(p);
        int n = parse_int(p);
        if (n < 0 || n > 3)
            parse_fail(p, "Value for noise_generator must be 0, 1, 2, or 3.");
        if (!d->pattern.scene_noise)
            n |= d->pattern.noise_generator;   /* POV: 1 and then 2 make 3 */
        d->pattern.noise_generator = (uint8_t)n;
        d->pattern.scene_noise = n == 0;
        d->changed = true;
        return true;
    }
    case KW_RAMP_WAVE: parse_skip(p); return choose_wave(p, d, WAVE_RAMP);
    case KW_TRIANGLE_WAVE: parse_skip(p); return choose_wave(p, d, WAVE_TRIANGLE);
    case KW_SINE_WAVE: parse_skip(p); return choose_wave(p, d, WAVE_SINE);
    case KW_SCALLOP_WAVE: parse_skip(p); return choose_wave(p, d, WAVE_SCALLOP);
    case KW_CUBIC_WAVE: parse_skip(p); return choose_wave(p, d, WAVE_CUBIC);
    case KW_POLY_WAVE: parse_skip(p); return choose_wave(p, d, WAVE_POLY);
    default: return pattern_item(p, d, keyword);
    }
}

/* Patterns without a noise_generator of their own follow the scene's, which may be written after them. */
static const Pattern *keep(Parser *p, const Pattern *from)
{
    Pattern *pattern = arena_copy(parse_arena(p), from, sizeof *from);
    if (pattern->noise_generator == 0)
        pattern->scene_noise = true;
    if (pattern->scene_noise) {
        Blocks *b = parse_blocks(p);
        pattern->noise_generator = (uint8_t)b->scene->globals.noise_generator;
        array_push(parse_arena(p), &b->scene_noise, pattern);
    }
    return pattern;
}

const Pattern *pattern_close(Parser *p, PatternDraft *d)
{
    if (!d->changed)
        return d->base;
    const PatternOps *ops = d->pattern.ops;
    if (d->own_params && ops != NULL && ops->finish != NULL)
        ops->finish(p, d->pattern.params);
    flush(parse_arena(p), d);
    if (d->pattern.depth > 1)
        pattern_depth_add(p, d->pattern.depth - 1u);
    d->pattern.depth = depth_here(p);
    return keep(p, &d->pattern);
}

const Pattern *pattern_plain(Parser *p)
{
    Pattern plain = { .frequency = 1, .wave_exponent = 1, .noise_generator = 2, .depth = depth_here(p) };
    return arena_copy(parse_arena(p), &plain, sizeof plain);
}

const Pattern *pattern_moved(Parser *p, const Pattern *pattern, const Moves *moves)
{
    PatternDraft d;
    pattern_begin(&d, pattern);
    for (unsigned i = 0; i < moves->n; i++)
        push_move(parse_arena(p), &d, &moves->move[i]);
    flush(parse_arena(p), &d);
    return keep(p, &d.pattern);
}

/* `object { O list }`: the list stands inside the braces that the row's parse has opened. */
void pattern_list_end(Parser *p, const PatternOps *ops)
{
    if (strcmp(ops->keyword, "object") == 0)
        block_close(p, "object");
}

const PatternOps *pattern_row(Parser *p, int keyword)
{
    return keyword > KW_NONE && keyword < N_KEYWORDS ? parse_blocks(p)->pattern_of[keyword] : NULL;
}
