/* colour.c - colours, in all the ways they can be written (01-language, section 5). */
#include <math.h>

#include "sdl/parser.h"

bool kind_starts_colour(const Parser *p)
{
    switch (p->token.kind) {
    case KW_COLOR: case KW_RGB: case KW_RGBF: case KW_RGBT: case KW_RGBFT: case KW_SRGB: case KW_SRGBF: case KW_SRGBT:
    case KW_SRGBFT: case KW_RED: case KW_GREEN: case KW_BLUE: case KW_FILTER: case KW_TRANSMIT: case KW_GRAY: case KW_ALPHA:
        return true;
    case TOK_NAME:
        return p->value && p->value->kind == VALUE_NUMBER && p->value->terms == 5;
    default:
        return false;
    }
}

/* POV: in single precision throughout. */
static double srgb_decoded(Parser *p, double v)
{
    float c = (float)v;
    if (p->gamma_mode == GAMMA_SRGB)
        return (double)c;
    float linear = c < 0.04045f ? c / 12.92f : powf((c + 0.055f) / 1.055f, 2.4f);
    return (double)(p->gamma_mode == GAMMA_POWER && p->gamma != 1 ? powf(linear, 1 / (float)p->gamma) : linear);
}

static void srgb(Parser *p, Num *n, Loc loc)
{
    if (!p->has_gamma)
        fail(p->diag, loc, "Cannot parse sRGB colors before assumed_gamma has been set.");
    for (int i = 0; i < 3; i++)
        n->v[i] = srgb_decoded(p, n->v[i]);
}

/* After rgb, rgbf...: one full expression. */
static void keyword_colour(Parser *p, int keyword, Loc loc, Num *out)
{
    bool is_srgb = keyword == KW_SRGB || keyword == KW_SRGBF || keyword == KW_SRGBT || keyword == KW_SRGBFT;
    bool transmit = keyword == KW_RGBT || keyword == KW_SRGBT;
    int wanted = keyword == KW_RGB || keyword == KW_SRGB ? 3 : keyword == KW_RGBFT || keyword == KW_SRGBFT ? 5 : 4;
    Num n;
    expr_full(p, &n);
    if (n.terms > wanted)
        warn(p->diag, loc, "Suspicious expression after %s.", token_keyword_text(keyword));
    num_promote(&n, wanted);
    for (int i = n.terms; i < 5; i++)
        n.v[i] = 0;
    if (transmit) {
        n.v[4] = n.v[3];
        n.v[3] = 0;
    }
    if (is_srgb)
        srgb(p, &n, loc);
    *out = n;
    out->terms = 5;
}

/* red f, green f...: one component, later ones winning. False if none comes. */
static bool component(Parser *p, Num *out)
{
    int i;
    switch (parse_peek(p)) {
    case KW_RED: i = 0; break;
    case KW_GREEN: i = 1; break;
    case KW_BLUE: i = 2; break;
    case KW_FILTER: i = 3; break;
    case KW_ALPHA:
        parse_warn(p, "Keyword ALPHA discontinued. Use FILTER instead.");
        i = 3;
        break;
    case KW_TRANSMIT: i = 4; break;
    default: return false;
    }
    parse_skip(p);
    out->v[i] = expr_float(p);
    return true;
}

/* rgb_only: an expression without a colour word is promoted to three terms, not five. */
void colour_parse(Parser *p, Num *out, bool rgb_only)
{
    *out = (Num){ { 0 }, 5 };
    bool was = p->suspended;
    parse_accept(p, KW_COLOR);
    Loc loc = parse_loc(p);
    int kind = parse_peek(p);
    switch (kind) {
    case KW_RGB: case KW_RGBF: case KW_RGBT: case KW_RGBFT: case KW_SRGB: case KW_SRGBF: case KW_SRGBT: case KW_SRGBFT:
        parse_skip(p);
        keyword_colour(p, kind, loc, out);
        break;
    case KW_RED: case KW_GREEN: case KW_BLUE: case KW_FILTER: case KW_TRANSMIT: case KW_ALPHA:
        break;
    default:
        if (!parse_at_number(p))
            break;
        expr_full(p, out);
        num_promote(out, rgb_only && out->terms < 3 ? 3 : rgb_only ? out->terms : 5);
        for (int i = out->terms; i < 5; i++)
            out->v[i] = 0;
        out->terms = 5;
    }
    while (component(p, out))
        ;
    for (int i = 0; i < 5; i++)
        out->v[i] = (double)(float)out->v[i];
    p->suspended = was;
}

Colour parse_colour(Parser *p)
{
    Num n;
    colour_parse(p, &n, false);
    return (Colour){ (float)n.v[0], (float)n.v[1], (float)n.v[2], (float)n.v[3], (float)n.v[4] };
}

Rgb parse_rgb(Parser *p)
{
    Num n;
    colour_parse(p, &n, true);
    if (n.v[3] != 0 || n.v[4] != 0)
        parse_warn(p, "Expected pure RGB color expression, unexpected %s component will have no effect.",
                   n.v[4] == 0 ? "filter" : n.v[3] == 0 ? "transmit" : "filter and transmit");
    return rgb((float)n.v[0], (float)n.v[1], (float)n.v[2]);
}
