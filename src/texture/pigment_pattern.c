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

static double value(const void *params, const PatternPoint *at)
{
    Colour c = pigment_colour(((const Params *)params)->pigment, at->p, at->context, NULL);
    return 0.297 * (double)c.r + 0.589 * (double)c.g + 0.114 * (double)c.b;
}

const PatternOps pattern_pigment_pattern = {
    .keyword = "pigment_pattern", .params_size = sizeof(Params), .parse = parse, .value = value,
};
