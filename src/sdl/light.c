/* light.c - light_source { ... } (01-language, section 22).
 *
 * The light keeps its points in its own space and moves by Object.place. What is written after a transform was meant in
 * the space reached by then, so it is carried back through the place of that moment. */
#include "sdl/blocks.h"

static Vec3 own_point(const ObjectDraft *d, Vec3 v)
{
    return d->o.place != NULL ? affine_point_back(d->o.place, v) : v;
}

static Vec3 own_vector(const ObjectDraft *d, Vec3 v)
{
    return d->o.place != NULL ? affine_vector_back(d->o.place, v) : v;
}

static void choose_kind(Parser *p, LightSource *l, LightKind kind)
{
    parse_skip(p);
    l->kind = kind;
    l->tightness = 0;
    if (kind == LIGHT_SPOT) {
        l->radius = 30;
        l->falloff = 45;
    } else {
        l->radius = 0.75;
        l->falloff = 1;
        l->parallel = true;
    }
}

static void need_direction(Parser *p, bool has, int keyword)
{
    if (!has)
        parse_fail(p, "Keyword '%s' cannot be used with standard light source.", parse_word(keyword));
    parse_skip(p);
}

static void area_light(Parser *p, const ObjectDraft *d, LightSource *l)
{
    parse_skip(p);
    l->area = true;
    l->axis1 = own_vector(d, parse_vec3(p));
    l->axis2 = own_vector(d, parse_next_vec3(p));
    parse_comma(p);
    l->size1 = parse_int(p);
    parse_comma(p);
    l->size2 = parse_int(p);
    if (l->size1 == 0 || l->size2 == 0)
        parse_fail(p, "Area size must be greater than zero.");
}

/* An object that belongs to the light, between the braces of looks_like or projected_through. */
static ObjectDraft attached(Parser *p, const Object *already, const char *word)
{
    parse_skip(p);
    if (already != NULL)
        parse_fail(p, "Only one %s allowed per light_source.", word);
    block_open(p, word);
    const Object *o = parse_object(p);
    if (o == NULL)
        parse_expected(p, "object");
    ObjectDraft d;
    draft_begin(&d, o);
    object_modifiers(p, &d, word);
    return d;
}

static void looks_like(Parser *p, ObjectDraft *light, LightSource *l)
{
    ObjectDraft d = attached(p, l->looks_like, "looks_like");
    Affine move = affine_translate(l->location);
    if (light->o.place != NULL) {
        move = affine_then(affine_translate(affine_point(light->o.place, l->location)), affine_inverse(*light->o.place));
    }
    draft_move(p, &d, &move);
    d.o.flags |= OBJECT_NO_SHADOW;
    draft_holds(p, light, &d.o);
    l->looks_like = draft_close(p, &d);
}

static void projected_through(Parser *p, ObjectDraft *light, LightSource *l)
{
    ObjectDraft d = attached(p, l->projected_through, "projected_through");
    if (d.o.texture != NULL || d.more.interior_texture != NULL)
        parse_warn(p, "Projected through objects can not have a texture.");
    if (d.more.interior != NULL)
        parse_warn(p, "Projected through objects can not have an interior.");
    d.o.texture = d.more.interior_texture = NULL;
    d.more.interior = NULL;
    if (light->o.place != NULL) {
        Affine back = affine_inverse(*light->o.place);
        draft_move(p, &d, &back);
    }
    draft_holds(p, light, &d.o);
    l->projected_through = draft_close(p, &d);
}

static void area_flag(Parser *p, LightSource *l, int keyword)
{
    parse_skip(p);
    if (!l->area)
        parse_warn(p, "'%s' has no effect on a light without area_light.", parse_word(keyword));
}

static bool area_item(Parser *p, ObjectDraft *d, LightSource *l, int keyword)
{
    switch (keyword) {
    case KW_AREA_LIGHT: area_light(p, d, l); return true;
    case KW_ADAPTIVE: parse_skip(p); l->adaptive = parse_int(p); return true;
    case KW_JITTER: area_flag(p, l, keyword); l->jitter = true; return true;
    case KW_CIRCULAR:
        if (l->area && (l->size1 <= 1 || l->size2 <= 1))
            parse_fail(p, "Circular area light must have more than 1 point per axis");
        area_flag(p, l, keyword);
        l->circular = true;
        return true;
    case KW_ORIENT:
        if (l->area && !l->circular)
            parse_warn(p, "Orient should only be used with circular area lights. This area light will be circular.");
        area_flag(p, l, keyword);
        l->orient = l->circular = true;
        return true;
    case KW_AREA_ILLUMINATION:
        area_flag(p, l, keyword);
        l->area_illumination = !parse_at_number(p) || parse_float(p) > 0;
        return true;
    default: return false;
    }
}

/* copied: the light began as a copy of another, and may be given another colour. */
static bool item(Parser *p, ObjectDraft *d, LightSource *l, bool copied)
{
    int keyword = parse_peek(p);
    Affine move;
    bool cone = l->kind != LIGHT_POINT;
    switch (keyword) {
    case KW_COLOR: case KW_RGB: case KW_RGBF: case KW_RGBT: case KW_RGBFT: case KW_RED: case KW_GREEN: case KW_BLUE:
    case KW_SRGB: case KW_SRGBF: case KW_SRGBT: case KW_SRGBFT:
        if (!copied)
            parse_mend(p, "A light's color belongs behind its location");
        l->colour = parse_rgb(p);
        return true;
    case KW_COLOR_MAP: {
        parse_skip(p);
        BlendMap map = parse_colour_map(p);
        l->colour_map = arena_copy(parse_arena(p), &map, sizeof map);
        return true;
    }
    case KW_SPOTLIGHT: choose_kind(p, l, LIGHT_SPOT); return true;
    case KW_CYLINDER: choose_kind(p, l, LIGHT_CYLINDER); return true;
    case KW_PARALLEL: parse_skip(p); l->parallel = true; return true;
    case KW_SHADOWLESS: parse_skip(p); l->shadowless = true; return true;
    case KW_POINT_AT:
        need_direction(p, cone || l->parallel, keyword);
        l->point_at = own_point(d, parse_vec3(p));
        return true;
    case KW_RADIUS: need_direction(p, cone, keyword); l->radius = parse_float(p); return true;
    case KW_FALLOFF: need_direction(p, cone, keyword); l->falloff = parse_float(p); return true;
    case KW_TIGHTNESS: need_direction(p, cone, keyword); l->tightness = parse_float(p); return true;
    case KW_FADE_DISTANCE: parse_skip(p); l->fade_distance = parse_float(p); return true;
    case KW_FADE_POWER: parse_skip(p); l->fade_power = parse_float(p); return true;
    case KW_MEDIA_ATTENUATION:
        parse_skip(p);
        l->media_attenuation = !parse_at_number(p) || parse_float(p) > 0;
        return true;
    case KW_MEDIA_INTERACTION:
        parse_skip(p);
        l->media_interaction = !parse_at_number(p) || parse_float(p) > 0;
        return true;
    case KW_LOOKS_LIKE: looks_like(p, d, l); return true;
    case KW_PROJECTED_THROUGH: projected_through(p, d, l); return true;
    case KW_PHOTONS: parse_skip(p); d->more.photons = photons_block(p, d->more.photons, true); return true;
    default:
        if (area_item(p, d, l, keyword))
            return true;
        if (!parse_move(p, &move))
            return false;
        draft_move(p, d, &move);
        return true;
    }
}

Object *light_block(Parser *p)
{
    ObjectDraft d;
    draft_new(&d, (Object){ .kind = OBJECT_LIGHT, .loc = parse_loc(p) });
    LightSource *l = arena_new(parse_arena(p), LightSource);
    *l = (LightSource){ .point_at = { 0, 0, 1 }, .media_interaction = true, .adaptive = 100, .loc = d.o.loc };
    parse_expect(p, KW_LIGHT_SOURCE);
    block_open(p, "light_source");
    const Object *known = parse_take_block(p, BLOCK_OBJECT);
    if (known != NULL && known->kind != OBJECT_LIGHT)
        parse_fail(p, "the identifier in light_source { } is not a light source");
    if (known != NULL) {
        draft_begin(&d, known);
        *l = *known->light;
    } else {
        l->location = parse_vec3(p);
        parse_comma(p);
        if (parse_at_number(p))
            l->colour = parse_rgb(p);
    }
    d.o.light = l;
    while (item(p, &d, l, known != NULL))
        ;
    block_close(p, "light_source");
    return draft_close(p, &d);
}
