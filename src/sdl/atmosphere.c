/* atmosphere.c - background, fog, rainbow and sky_sphere (01-language, section 32). */
#include "sdl/blocks.h"

void background_block(Parser *p)
{
    Globals *g = &parse_blocks(p)->scene->globals;
    block_open(p, "background");
    g->background = parse_colour(p);
    g->has_background = true;
    block_close(p, "background");
}

/* ---- fog ---- */

static bool fog_item(Parser *p, FogDef *f)
{
    int keyword = parse_peek(p);
    Affine move;
    switch (keyword) {
    case KW_DISTANCE: parse_skip(p); f->distance = parse_float(p); return true;
    case KW_FOG_TYPE:
        parse_skip(p);
        f->type = parse_int(p);
        if (f->type != 1 && f->type != 2)
            parse_warn(p, "There is no fog_type %d: use 1 (constant) or 2 (ground fog).", f->type);
        return true;
    case KW_FOG_ALT: parse_skip(p); f->altitude = parse_float(p); return true;
    case KW_FOG_OFFSET: parse_skip(p); f->offset = parse_float(p); return true;
    case KW_TURB_DEPTH: parse_skip(p); f->turb_depth = parse_float(p); return true;
    case KW_UP: parse_skip(p); f->up = normalized(parse_vec3(p)); return true;
    case KW_TURBULENCE: case KW_OCTAVES: case KW_OMEGA: case KW_LAMBDA:
        parse_skip(p);
        f->has_turbulence = true;
        return parse_turbulence_item(p, keyword, &f->turbulence);
    case KW_TRANSLATE:
        parse_warn(p, "A fog can not be translated.");
        (void)parse_move(p, &move);
        return true;
    default:
        if (parse_at_colour(p)) {
            f->colour = parse_colour(p);
            return true;
        }
        if (parse_move(p, &move)) {
            f->up = normalized(affine_vector(&move, f->up));
            return true;
        }
        if (parse_at_float(p)) {
            parse_warn(p, "Should use distance keyword.");
            f->distance = parse_float(p);
            return true;
        }
        return false;
    }
}

const FogDef *fog_block(Parser *p)
{
    block_open(p, "fog");
    const FogDef *known = parse_take_block(p, BLOCK_FOG);
    FogDef f = { .type = 1, .turb_depth = 0.5, .turbulence = TURBULENCE_DEFAULT, .up = { 0, 1, 0 } };
    if (known != NULL)
        f = *known;
    while (fog_item(p, &f))
        parse_stray_comma(p);
    block_close(p, "fog");
    return arena_copy(parse_arena(p), &f, sizeof f);
}

/* ---- rainbow ---- */

typedef struct Bow {
    RainbowDef r;
    bool has_arc, has_falloff, has_direction;
} Bow;

static double degrees(Parser *p, const char *word)
{
    double a = fabs(parse_float(p));
    if (a > 360)
        parse_fail(p, "Illegal %s angle in rainbow (Use value from 0 to 360 degrees).", word);
    return a;
}

static bool rainbow_item(Parser *p, Bow *b)
{
    RainbowDef *r = &b->r;
    switch (parse_peek(p)) {
    case KW_ANGLE: parse_skip(p); r->angle = parse_float(p); return true;
    case KW_WIDTH: parse_skip(p); r->width = parse_float(p); return true;
    case KW_DISTANCE: parse_skip(p); r->distance = parse_float(p); return true;
    case KW_JITTER: parse_skip(p); r->jitter = parse_float(p); return true;
    case KW_DIRECTION: parse_skip(p); r->direction = parse_vec3(p); b->has_direction = true; return true;
    case KW_UP: parse_skip(p); r->up = parse_vec3(p); return true;
    case KW_ARC_ANGLE: parse_skip(p); r->arc_angle = degrees(p, "arc"); b->has_arc = true; return true;
    case KW_FALLOFF_ANGLE: parse_skip(p); r->falloff_angle = degrees(p, "falloff"); b->has_falloff = true; return true;
    case KW_COLOR_MAP: parse_skip(p); r->map = parse_colour_map(p); return true;
    default: return false;
    }
}

static void check_rainbow(Parser *p, Bow *b)
{
    RainbowDef *r = &b->r;
    if (length2(r->direction) == 0)
        parse_fail(p, "Rainbow's direction vector is zero.");
    if (length2(r->up) == 0)
        parse_fail(p, "Rainbow's up vector is zero.");
    r->antisolar = normalized(r->direction);
    Vec3 right = cross(normalized(r->up), r->antisolar);
    if (max_abs(right) <= 1e-10)
        parse_fail(p, "Rainbow's up and direction vector are co-linear.");
    r->up = normalized(cross(r->antisolar, right));
    if (!b->has_arc)
        r->arc_angle = r->falloff_angle = 360; /* POV: a falloff_angle alone does nothing visible */
    else if (!b->has_falloff)
        r->falloff_angle = r->arc_angle;
    if (r->arc_angle < r->falloff_angle)
        parse_fail(p, "Arc angle is smaller than falloff angle in rainbow.");
}

const RainbowDef *rainbow_block(Parser *p)
{
    block_open(p, "rainbow");
    const RainbowDef *known = parse_take_block(p, BLOCK_RAINBOW);
    Bow b = { .r = { .distance = 1e7, .up = { 0, 1, 0 } } };
    if (known != NULL) {
        b.r = *known;
        b.has_arc = b.has_falloff = known->arc_angle < 360;
    }
    while (rainbow_item(p, &b))
        ;
    block_close(p, "rainbow");
    check_rainbow(p, &b);
    return arena_copy(parse_arena(p), &b.r, sizeof b.r);
}

/* ---- sky_sphere ---- */

typedef ARRAY(const Pigment *) Pigments;

const SkySphere *sky_sphere_block(Parser *p)
{
    Pigments list = { 0 };
    Affine move;
    SkySphere s = { .emission = { 1, 1, 1 }, .place = affine_identity() };
    block_open(p, "sky_sphere");
    const SkySphere *known = parse_take_block(p, BLOCK_SKY_SPHERE);
    if (known != NULL) {
        s = *known;
        for (uint32_t i = 0; i < known->n; i++)
            array_push(parse_arena(p), &list, known->pigment[i]);
    }
    for (;;) {
        if (parse_accept(p, KW_PIGMENT)) {
            block_open(p, "pigment");
            const Pigment *pigment = pigment_body(p, &PIGMENT_EMPTY, USE_PIGMENT);
            block_close(p, "pigment");
            array_push(parse_arena(p), &list, pigment);
        } else if (parse_accept(p, KW_EMISSION)) {
            s.emission = parse_rgb(p);
        } else if (parse_move(p, &move)) {
            s.place = affine_then(s.place, move);
        } else {
            break;
        }
    }
    block_close(p, "sky_sphere");
    if (list.n == 0)
        parse_fail(p, "Empty sky_sphere statement.");
    s.pigment = list.data;
    s.n = list.n;
    return arena_copy(parse_arena(p), &s, sizeof s);
}
