/* image_pattern.c - the grey, or the transparency, of an image as a pattern (07-textures, section 6.6). */
#include "image/image.h"
#include "sdl/parse.h"
#include "texture/sample.h"

typedef struct Params {
    const ImageMap *map;
} Params;

static void parse(Parser *p, void *params)
{
    ((Params *)params)->map = parse_image_pattern(p);
}

/* POV: use_alpha gives what passes, 0 where the image is opaque, and red where a file has no alpha. */
static double value(const void *params, const PatternPoint *at)
{
    const ImageMap *map = ((const Params *)params)->map;
    ImageSpot spot;
    if (!image_spot(map, at->p, &spot))
        return 0;
    Colour c = image_sample(map, spot);
    double v = !map->use_alpha ? 0.297 * (double)c.r + 0.589 * (double)c.g + 0.114 * (double)c.b
             : map->image->has_alpha ? (double)c.t : (double)c.r;
    return fmax(0, fmin(1, v));
}

const PatternOps pattern_image_pattern = {
    .keyword = "image_pattern", .params_size = sizeof(Params), .flags = PATTERN_NO_WAVE, .parse = parse, .value = value,
};
