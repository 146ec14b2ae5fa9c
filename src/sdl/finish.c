/* finish.c - finish { ... }: what light does at a surface (01-language, section 30; defaults 07-textures, section 9).
 *
 * Albedo factors wait for the closing brace: they use the brilliance, phong_size and roughness in force there. */
#include "sdl/blocks.h"

#include <math.h>
#include <string.h>

const Finish FINISH_DEFAULT = {
    .ambient = { 0.1f, 0.1f, 0.1f }, .diffuse = 0.6f, .brilliance = 1, .phong_size = 40, .roughness = 0.05f,
    .reflection_falloff = 1, .reflection_exponent = 1, .traits = FINISH_LIT
};

void finish_settle(Finish *f)
{
    bool glossy = f->phong > 0 || f->specular > 0;
    bool lit = f->diffuse != 0 || f->diffuse_back != 0 || f->phong != 0 || f->specular != 0;
    bool mirrors = !rgb_is_zero(f->reflection_max) || !rgb_is_zero(f->reflection_min);
    f->traits = (uint8_t)((lit ? FINISH_LIT : 0) | (glossy ? FINISH_GLOSSY : 0) | (f->brilliance != 1 ? FINISH_BRILLIANT : 0) |
                          (f->crand > 0 ? FINISH_GRAINY : 0) | (f->irid > 0 ? FINISH_FILM : 0) | (mirrors ? FINISH_MIRRORS : 0));
}

static float number(Parser *p)
{
    return (float)parse_float(p);
}

static void reflection_block(Parser *p, Finish *f)
{
    f->reflection_min = f->reflection_max = parse_rgb(p);
    parse_comma(p);
    bool two = parse_at_number(p);
    if (two)
        f->reflection_max = parse_rgb(p);
    bool fresnel = false;                      /* POV: what an earlier reflection said of fresnel, falloff and the rest stays */
    for (;;) {
        switch (parse_peek(p)) {
        case KW_FRESNEL: {
            parse_skip(p);
            double on = parse_at_float(p) ? parse_float(p) : 1;
            if (on != 0 && on != 1)
                parse_fail(p, "fresnel must be true or false");
            f->reflection_fresnel = fresnel = on == 1;
            break;
        }
        case KW_FALLOFF: parse_skip(p); f->reflection_falloff = number(p); break;
        case KW_EXPONENT: parse_skip(p); f->reflection_exponent = number(p); break;
        case KW_METALLIC:
            parse_skip(p);
            f->reflection_metallic = parse_at_float(p) ? number(p) : 1;
            break;
        default:
            if (fresnel && !two)
                f->reflection_min = rgb(0, 0, 0);
            block_close(p, "reflection");
            return;
        }
    }
}

static void irid(Parser *p, Finish *f)
{
    block_open(p, "irid");
    f->irid = number(p);
    for (;;) {
        if (parse_accept(p, KW_THICKNESS))
            f->irid_thickness = number(p);
        else if (parse_accept(p, KW_TURBULENCE))
            f->irid_turbulence = number(p);
        else
            break;
    }
    block_close(p, "irid");
}

static void subsurface(Parser *p, Finish *f)
{
    block_open(p, "subsurface");
    f->has_subsurface = true;
    for (;;) {
        if (parse_accept(p, KW_TRANSLUCENCY))
            f->subsurface_translucency = parse_rgb(p);
        else if (parse_accept(p, KW_ANISOTROPY))
            f->subsurface_anisotropy = parse_rgb(p);
        else
            break;
    }
    block_close(p, "subsurface");
    parse_blocks(p)->scene->unmodelled |= SCENE_HAS_SUBSURFACE;
}

static void old_item(Parser *p, bool *has, float *to, const char *word)
{
    parse_warn(p, "'%s' in a finish is old: moved to the interior.", word);
    *to = number(p);
    *has = true;
}

static bool item(Parser *p, Finish *f)
{
    int keyword = parse_peek(p);
    switch (keyword) {
    case KW_AMBIENT: parse_skip(p); f->ambient = parse_rgb(p); break;
    case KW_EMISSION: parse_skip(p); f->emission = parse_rgb(p); break;
    case KW_DIFFUSE:
        parse_skip(p);
        f->diffuse_albedo = parse_accept(p, KW_ALBEDO);
        f->diffuse = number(p);
        f->diffuse_back = (float)parse_optional_float(p, 0);   /* without one, an earlier one is gone */
        break;
    case KW_BRILLIANCE: parse_skip(p); f->brilliance = number(p); break;
    case KW_PHONG: parse_skip(p); f->phong_albedo = parse_accept(p, KW_ALBEDO); f->phong = number(p); break;
    case KW_PHONG_SIZE: parse_skip(p); f->phong_size = number(p); break;
    case KW_SPECULAR: parse_skip(p); f->specular_albedo = parse_accept(p, KW_ALBEDO); f->specular = number(p); break;
    case KW_ROUGHNESS:
        parse_skip(p);
        f->roughness = number(p);
        if (f->roughness == 0)
            parse_warn(p, "Zero roughness used.");
        break;
    case KW_METALLIC: parse_skip(p); f->metallic = parse_at_float(p) ? number(p) : 1; break;
    case KW_CRAND: parse_skip(p); f->crand = number(p); break;
    case KW_CONSERVE_ENERGY: parse_skip(p); f->conserve_energy = parse_optional_bool(p, true); break;
    case KW_REFLECTION:
        parse_skip(p);
        if (parse_accept(p, TOK_OPEN)) {
            reflection_block(p, f);
        } else {
            f->reflection_min = f->reflection_max = parse_rgb(p);
            f->reflection_falloff = 1;
            f->reflection_fresnel = false;
        }
        break;
    case KW_REFLECTION_EXPONENT: parse_skip(p); f->reflection_exponent = number(p); break;
    case KW_IRID: parse_skip(p); irid(p, f); break;
    case KW_SUBSURFACE: parse_skip(p); subsurface(p, f); break;
    case KW_IOR: parse_skip(p); old_item(p, &f->has_ior, &f->ior, "ior"); break;
    case KW_CAUSTICS: parse_skip(p); old_item(p, &f->has_caustics, &f->caustics, "caustics"); break;
    case KW_REFRACTION: parse_skip(p); old_item(p, &f->has_refraction, &f->refraction, "refraction"); break;
    default: return false;
    }
    return true;
}

/* The factors that turn an albedo into an amount. The marks go: a copy of this finish is not scaled again. */
static void apply_albedo(Finish *f)
{
    if (f->diffuse_albedo) {
        float k = (f->brilliance + 1) / 2;
        f->diffuse *= k;
        f->diffuse_back *= k;
    }
    if (f->phong_albedo)
        f->phong *= (f->phong_size + 1) / 2;
    if (f->specular_albedo) {
        double r = f->roughness != 0 ? 1.0 / f->roughness : 0;
        f->specular *= (float)((r + 2) / (4 * (2 - pow(2, -r / 2))));
    }
    f->diffuse_albedo = f->phong_albedo = f->specular_albedo = false;
}

static uint32_t hash_of(const Finish *f)
{
    uint32_t word[sizeof *f / sizeof(uint32_t)], h = 0;
    memcpy(word, f, sizeof word);
    for (size_t i = 0; i < sizeof word / sizeof *word; i++)
        h = (h ^ word[i]) * 0x9e3779b1u;
    return h >> 16;
}

/* NULL if there are none. */
const Finish *finish_items(Parser *p, const Finish *base)
{
    Finish f = *base;
    bool changed = false;
    while (item(p, &f))
        changed = true;
    if (!changed)
        return NULL;
    apply_albedo(&f);
    finish_settle(&f);
    Blocks *b = parse_blocks(p);
    uint32_t h = hash_of(&f) % FINISH_CACHE;
    if (b->finish_cache[h] == NULL || memcmp(b->finish_cache[h], &f, sizeof f) != 0)
        b->finish_cache[h] = arena_copy(parse_arena(p), &f, sizeof f);
    return b->finish_cache[h];
}

const Finish *finish_block(Parser *p, const Finish *base)
{
    block_open(p, "finish");
    const Finish *known = parse_take_block(p, BLOCK_FINISH);
    if (known != NULL)
        base = known;
    const Finish *changed = finish_items(p, base);
    block_close(p, "finish");
    return changed != NULL ? changed : base;
}
