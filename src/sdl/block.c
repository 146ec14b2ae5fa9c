/* block.c - what all block grammars need: braces, transforms, keyword rows, and blocks as values of identifiers. */
#include "sdl/blocks.h"

#include <string.h>

#include "sdl/parser.h"

Blocks *parse_blocks(const Parser *p)
{
    return p->blocks;
}

const char *parse_word(int keyword)
{
    static const struct { const char *word; int keyword; } words[] = {
#define KEYWORD(word, kw) { #word, kw },
#include "sdl/keyword.def"
#undef KEYWORD
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (words[i].keyword == keyword)
            return words[i].word;
    return "?";
}

static int keyword_of(Parser *p, const char *word)
{
    return symbol_intern(p, word, strlen(word))->keyword;
}

Blocks *blocks_new(Parser *p, Scene *scene)
{
    const Registry *registry = p->host->registry;
    Blocks *b = arena_new(p->arena, Blocks);
    b->scene = scene;
    for (const ShapeOps *const *s = registry->shape; *s != NULL; s++)
        b->shape_of[keyword_of(p, (*s)->keyword)] = *s;
    for (const PatternOps *const *o = registry->pattern; *o != NULL; o++)
        b->pattern_of[keyword_of(p, (*o)->keyword)] = *o;
    Texture *t = arena_new(p->arena, Texture);
    *t = (Texture){ .kind = TEXTURE_PLAIN, .pigment = &PIGMENT_EMPTY, .finish = &FINISH_DEFAULT };
    b->default_texture = t;
    b->default_camera = camera_default();
    return b;
}

void map_misplaced(Parser *p, int keyword)
{
    const char *where = keyword == KW_NORMAL_MAP || keyword == KW_SLOPE_MAP || keyword == KW_BUMP_SIZE
                            || keyword == KW_NO_BUMP_SCALE ? "normal"
                      : keyword == KW_TEXTURE_MAP ? "texture" : keyword == KW_DENSITY_MAP ? "density" : "pigment";
    parse_fail(p, "Keyword '%s' can only be used in a %s statement.", parse_word(keyword), where);
}

bool parse_at_float(Parser *p)
{
    int kind = parse_peek(p);
    if (kind == TOK_LESS || !parse_at_number(p) || parse_at_colour(p))
        return false;
    const Value *v = p->value;
    if (kind == TOK_NAME)
        return v != NULL && (v->kind == VALUE_NUMBER ? v->terms == 1 : v->kind == VALUE_FUNCTION);
    const char *group = kind < N_KEYWORDS ? keyword_group(kind) : NULL;
    return group == NULL || strcmp(group, "vector function") != 0;
}

/* ---- transforms ---- */

static Vec3 scale_factors(Parser *p)
{
    Vec3 v = parse_vec3(p);
    for (int axis = 0; axis < 3; axis++)
        if (vec3_at(v, axis) == 0) {
            parse_warn(p, "Illegal Value: Scale %c by 0.0. Changed to 1.0.", "XYZ"[axis]);
            vec3_set(&v, axis, 1);
        }
    return v;
}

static Affine matrix(Parser *p)
{
    double rows[12];
    Reader *r = cursor_top(p);
    if (p->have || !r->is_file || !literal_numbers(&r->lexer, 12, rows)) {
        parse_expect(p, TOK_LESS);
        for (int i = 0; i < 12; i++)
            rows[i] = i == 0 ? parse_float(p) : parse_next_float(p);
        parse_expect(p, TOK_GREATER);
    }
    for (int column = 0; column < 3; column++)
        if (rows[column] == 0 && rows[3 + column] == 0 && rows[6 + column] == 0)
            parse_warn(p, "Illegal matrix column: Scale by 0.0. Changed to 1.0.");
    return affine_matrix(rows);
}

static Affine transform(Parser *p)
{
    Affine all = affine_identity(), move;
    const Affine *known = parse_take_block(p, BLOCK_TRANSFORM);
    if (known != NULL)
        return *known;
    bool inverse = false;
    block_open(p, "transform");
    for (;;) {
        if (parse_accept(p, KW_INVERSE))
            inverse = true;
        else if ((known = parse_take_block(p, BLOCK_TRANSFORM)) != NULL)
            all = affine_then(all, *known);
        else if (parse_move(p, &move))
            all = affine_then(all, move);
        else
            break;
    }
    block_close(p, "transform");
    return inverse ? affine_inverse(all) : all;
}

bool parse_move(Parser *p, Affine *move)
{
    switch (parse_peek(p)) {
    case KW_TRANSLATE: parse_skip(p); *move = affine_translate(parse_vec3(p)); return true;
    case KW_ROTATE: parse_skip(p); *move = affine_rotate(parse_vec3(p)); return true;
    case KW_SCALE: parse_skip(p); *move = affine_scale(scale_factors(p)); return true;
    case KW_MATRIX: parse_skip(p); *move = matrix(p); return true;
    case KW_TRANSFORM: parse_skip(p); *move = transform(p); return true;
    default: return false;
    }
}

bool parse_transform(Parser *p, Affine *composed)
{
    Affine move;
    if (!parse_move(p, &move))
        return false;
    *composed = affine_then(*composed, move);
    return true;
}

/* ---- values of identifiers ---- */

static const void *texture_value(Parser *p)
{
    const Texture *t = parse_texture(p);
    while (parse_peek_raw(p) == KW_TEXTURE)
        t = texture_layered(p, t, parse_texture(p));
    return t;
}

static const void *density_value(Parser *p)
{
    return density_block(p);
}

static const void *pigment_value(Parser *p)
{
    return parse_pigment(p);
}

static const void *normal_value(Parser *p)
{
    return parse_normal(p);
}

static const void *finish_value(Parser *p)
{
    parse_skip(p);
    return finish_block(p, parse_blocks(p)->default_texture->finish);
}

static const void *material_value(Parser *p)
{
    parse_skip(p);
    return material_block(p);
}

static const void *interior_value(Parser *p)
{
    return parse_interior(p);
}

static const void *media_value(Parser *p)
{
    parse_skip(p);
    return media_block(p);
}

static const void *map_value(Parser *p)
{
    int keyword = parse_peek(p);
    parse_skip(p);
    BlendMap map;
    switch (keyword) {
    case KW_PIGMENT_MAP: map = parse_map(p, MAP_PIGMENT, USE_PIGMENT, true); break;
    case KW_DENSITY_MAP: map = parse_map(p, MAP_PIGMENT, USE_DENSITY, true); break;
    case KW_NORMAL_MAP: map = parse_map(p, MAP_NORMAL, USE_NORMAL, true); break;
    case KW_SLOPE_MAP: map = parse_map(p, MAP_SLOPE, USE_NORMAL, false); break;
    case KW_TEXTURE_MAP: map = parse_map(p, MAP_TEXTURE, USE_TEXTURE, true); break;
    default: map = parse_colour_map(p); break;
    }
    return arena_copy(parse_arena(p), &map, sizeof map);
}

static const void *transform_value(Parser *p)
{
    Affine move;
    parse_move(p, &move);
    return arena_copy(parse_arena(p), &move, sizeof move);
}

static const void *camera_value(Parser *p)
{
    parse_skip(p);
    CameraDef c = camera_block(p);
    return arena_copy(parse_arena(p), &c, sizeof c);
}

static const void *fog_value(Parser *p)
{
    parse_skip(p);
    return fog_block(p);
}

static const void *rainbow_value(Parser *p)
{
    parse_skip(p);
    return rainbow_block(p);
}

static const void *sky_sphere_value(Parser *p)
{
    parse_skip(p);
    return sky_sphere_block(p);
}

static const struct {
    int keyword;
    BlockKind kind;
    const void *(*value)(Parser *p);           /* at the keyword */
} values[] = {
    { KW_PIGMENT, BLOCK_PIGMENT, pigment_value },
    { KW_NORMAL, BLOCK_NORMAL, normal_value },
    { KW_FINISH, BLOCK_FINISH, finish_value },
    { KW_TEXTURE, BLOCK_TEXTURE, texture_value },
    { KW_INTERIOR_TEXTURE, BLOCK_TEXTURE, texture_value },
    { KW_MATERIAL, BLOCK_MATERIAL, material_value },
    { KW_INTERIOR, BLOCK_INTERIOR, interior_value },
    { KW_MEDIA, BLOCK_MEDIA, media_value },
    { KW_DENSITY, BLOCK_DENSITY, density_value },
    { KW_COLOR_MAP, BLOCK_COLOUR_MAP, map_value },
    { KW_PIGMENT_MAP, BLOCK_PIGMENT_MAP, map_value },
    { KW_NORMAL_MAP, BLOCK_NORMAL_MAP, map_value },
    { KW_SLOPE_MAP, BLOCK_SLOPE_MAP, map_value },
    { KW_TEXTURE_MAP, BLOCK_TEXTURE_MAP, map_value },
    { KW_DENSITY_MAP, BLOCK_DENSITY_MAP, map_value },
    { KW_TRANSFORM, BLOCK_TRANSFORM, transform_value },
    { KW_CAMERA, BLOCK_CAMERA, camera_value },
    { KW_FOG, BLOCK_FOG, fog_value },
    { KW_RAINBOW, BLOCK_RAINBOW, rainbow_value },
    { KW_SKY_SPHERE, BLOCK_SKY_SPHERE, sky_sphere_value },
};

const void *block_parse(Parser *p, BlockKind *kind)
{
    int keyword = parse_peek(p);
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        if (values[i].keyword == keyword) {
            *kind = values[i].kind;
            return values[i].value(p);
        }
    const Object *o = keyword == TOK_NAME ? NULL : object_value(p);
    *kind = o != NULL ? BLOCK_OBJECT : BLOCK_NONE;
    return o;
}
