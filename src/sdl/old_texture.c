/* old_texture.c - textures as they were written before version 3.0: colours, patterns, bumps and finishes directly in
 * texture { ... }, without blocks of their own.
 *
 * Each item changes the texture as far as it has come. Transforms move all of it; turbulence belongs to the colours, frequency
 * and phase to the bumps if there are any; wood and marble go up in a ramp (measured on the reference). */
#include "sdl/blocks.h"

enum { OLD_TEXTURES_END = 300 };

static bool is_bumps(int keyword)
{
    return keyword == KW_BUMPS || keyword == KW_DENTS || keyword == KW_RIPPLES || keyword == KW_WAVES || keyword == KW_WRINKLES ||
           keyword == KW_BUMP_MAP;
}

/* A lone number: how grainy the colours are. */
static const Finish *grain(Parser *p, const Finish *from)
{
    Finish *f = arena_copy(parse_arena(p), from, sizeof *from);
    f->crand = (float)parse_float(p);
    finish_settle(f);
    return f;
}

const Texture *old_texture_item(Parser *p, const Texture *t)
{
    if (parse_version(p) >= OLD_TEXTURES_END || t->kind != TEXTURE_PLAIN)
        return NULL;
    int keyword = parse_peek(p);
    bool of_bumps = is_bumps(keyword) || ((keyword == KW_FREQUENCY || keyword == KW_PHASE) && t->normal != NULL);
    const Normal *normal = of_bumps ? normal_old_item(p, t->normal) : NULL;
    if (normal != NULL)
        return texture_with(p, t, t->pigment, normal, t->finish);
    const Finish *finish = finish_items(p, t->finish);
    if (finish != NULL)
        return texture_with(p, t, t->pigment, t->normal, finish);
    if (keyword == TOK_NUMBER)
        return texture_with(p, t, t->pigment, t->normal, grain(p, t->finish));
    const Pigment *pigment = pigment_old_item(p, t->pigment);
    return pigment != NULL ? texture_with(p, t, pigment, t->normal, t->finish) : NULL;
}
