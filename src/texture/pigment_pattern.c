/* pigment_pattern.c - the grey of a pigment as a pattern. */
#include "sdl/parse.h"
#include "texture/texture.h"

typedef struct Params {
    const Pigment *pigment;
} Params;

static void parse(Parser *p, void *params)
{
    parse_open(p);
    ((Params *)params)->pigment = parse_pigment_body(p);
    parse_close(p);
}

static double grey(Colour c)
{
    return 0.297 * (double)c.r + 0.589 * (double)c.g + 0.114 * (double)c.b;
}

static double value(const void *params, const PatternPoint *at)
{
    return grey(pigment_colour(((const Params *)params)->pigment, at->p, at->context, NULL));
}

static void values(const void *params, const Pattern *pattern, const Vec3 *p, double *out, int n)
{
    Colour c[PATTERN_MANY];
    (void)pattern;
    pigment_colours(((const Params *)params)->pigment, p, c, n);
    for (int i = 0; i < n; i++)
        out[i] = grey(c[i]);
}

const PatternOps pattern_pigment_pattern = {
    .keyword = "pigment_pattern", .params_size = sizeof(Params), .parse = parse, .value = value, .values = values,
};
