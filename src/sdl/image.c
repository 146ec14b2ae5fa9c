/* image.c - images in scenes: image_map, bump_map, image_pattern, material_map, and those of height fields.
 *
 * The same file read for the same use is read once. */
#include "scene/image_map.h"

#include "func/func.h"
#include "image/image.h"
#include "sdl/blocks.h"
#include "sdl/parser.h"

struct ImageSeen {
    Str name;
    ImageReading how;
    const Image *image;
    struct ImageSeen *next;
};

static ImageFormat type_word(int keyword)
{
    switch (keyword) {
    case KW_PNG: return IMAGE_PNG;
    case KW_JPEG: return IMAGE_JPEG;
    case KW_GIF: return IMAGE_GIF;
    case KW_TIFF: return IMAGE_TIFF;
    case KW_TGA: return IMAGE_TGA;
    case KW_PPM: return IMAGE_PPM;
    case KW_PGM: return IMAGE_PGM;
    case KW_BMP: return IMAGE_BMP;
    case KW_HDR: return IMAGE_HDR;
    case KW_IFF: return IMAGE_IFF;
    case KW_POT: return IMAGE_POT;
    case KW_EXR: return IMAGE_EXR;
    default: return IMAGE_BY_CONTENT;
    }
}

static Transfer working_space(const Globals *g)
{
    switch (g->has_assumed_gamma ? g->assumed_gamma : GAMMA_POWER) {
    case GAMMA_SRGB: return (Transfer){ TRANSFER_SRGB, 0 };
    default: return (Transfer){ TRANSFER_POWER, g->has_assumed_gamma ? g->assumed_gamma_value : 1 };
    }
}

static bool same_reading(const ImageReading *a, const ImageReading *b)
{
    return a->colour == b->colour && a->has_gamma == b->has_gamma && a->version == b->version
        && a->has_assumed_gamma == b->has_assumed_gamma && a->working.kind == b->working.kind
        && a->working.exponent == b->working.exponent && a->gamma.kind == b->gamma.kind && a->gamma.exponent == b->gamma.exponent;
}

static const Image *read_file(Parser *p, Str name, Loc loc, ImageFormat format, const ImageReading *how)
{
    Blocks *b = parse_blocks(p);
    for (const struct ImageSeen *s = b->images; s != NULL; s = s->next)
        if (str_equal(s->name, name) && same_reading(&s->how, how))
            return s->image;
    char error[IMAGE_ERROR];
    Str bytes = parse_read_file(p, name, loc);
    const Image *image = image_read(p->arena, bytes, format, how, error);
    if (image == NULL)
        fail(p->diag, loc, "Cannot read the image '%.*s': %s", STR_ARGS(name), error);
    struct ImageSeen *seen = arena_new(p->arena, struct ImageSeen);
    *seen = (struct ImageSeen){ .name = str_copy(p->arena, name), .how = *how, .image = image, .next = b->images };
    b->images = seen;
    return image;
}

/* ---- function W, H { ... } ---- */

static uint16_t sample(double v)
{
    double code = trunc(65535 * v);
    return code >= 65535 ? 65535 : code > 0 ? (uint16_t)code : 0;
}

static int side(Parser *p)
{
    double n = parse_float(p);
    if (!(n >= 1 && n <= IMAGE_MAX_SIDE))
        parse_fail(p, "Illegal image size: %g. A side has 1 to %d pixels.", n, IMAGE_MAX_SIDE);
    return (int)n;
}

static const Image *function_image(Parser *p)
{
    static const char *const parameters[] = { "x", "y", "z" };
    parse_expect(p, KW_FUNCTION);
    int w = side(p);
    parse_comma(p);
    int h = side(p);
    const Function *f = parse_function(p, parameters, 3);
    bool colour = func_terms(f) > 1;
    int channels = colour ? 4 : 1;
    uint16_t *samples = arena_array(p->arena, uint16_t, (size_t)w * (size_t)h * (size_t)channels);
    uint16_t *out = samples;
    double *row = arena_array(p->arena, double, 4 * (size_t)w);
    const double *const arguments[] = { row, row + w, row + 2 * w };
    double *value = row + 3 * w, (*colours)[5] = colour ? arena_alloc_array(p->arena, (size_t)w, sizeof *colours) : NULL;
    for (int x = 0; x < w; x++)
        row[x] = w > 1 ? (double)x / (w - 1) : 0;
    for (int y = 0; y < h; y++) {
        for (int x = 0; x < w; x++)
            row[w + x] = h > 1 ? (double)y / (h - 1) : 0;
        if (colour)
            func_eval_vector(f, arguments, colours, (uint32_t)w);
        else
            func_eval(f, arguments, value, (uint32_t)w);
        for (int x = 0; x < w; x++) {
            if (!colour) {
                *out++ = sample(value[x]);
                continue;
            }
            const double *v = colours[x];
            *out++ = sample(v[0]);
            *out++ = sample(v[1]);
            *out++ = sample(v[2]);
            *out++ = sample(1 - v[4]);
        }
    }
    return image_of_samples(p->arena, w, h, channels, samples);
}

/* ---- the image itself ---- */

static void read_gamma(Parser *p, ImageReading *how)
{
    how->has_gamma = true;
    if (parse_accept(p, KW_SRGB)) {
        how->gamma = (Transfer){ TRANSFER_SRGB, 0 };
        return;
    }
    double g = parse_float(p);
    if (!(g > 0))
        parse_fail(p, "Invalid gamma value: it must be positive.");
    how->gamma = (Transfer){ TRANSFER_POWER, g };
}

static void read_image(Parser *p, ImageUse use, bool gradient, ImageMap *map)
{
    const Globals *g = &parse_blocks(p)->scene->globals;
    ImageReading how = {
        .colour = use == IMAGE_COLOUR, .has_assumed_gamma = g->has_assumed_gamma, .working = working_space(g),
        .version = p->version_given ? p->version : 362,
    };
    if (gradient && parse_at_number(p) && !parse_at_colour(p))
        (void)parse_vec3(p);                   /* POV: old scenes give a gradient vector here, which means nothing now */
    if (parse_peek(p) == KW_FUNCTION) {
        map->image = function_image(p);
        return;
    }
    int keyword = parse_peek(p);
    ImageFormat format = type_word(keyword);
    if (format != IMAGE_BY_CONTENT)
        parse_skip(p);
    else if (keyword == KW_SYS)
        parse_fail(p, "There is no image type 'sys' here.");
    Loc loc = parse_loc(p);
    if (!kind_starts_string(p))
        parse_expected(p, "map file spec");
    Str name = parse_file_name(p);
    if (format == IMAGE_BY_CONTENT && (format = image_format_of(name)) == IMAGE_BY_CONTENT)
        parse_fail(p, "Could not determine valid image file type from extension.");
    for (;;) {
        if (parse_accept(p, KW_GAMMA))
            read_gamma(p, &how);
        else if (parse_accept(p, KW_PREMULTIPLIED))
            map->premultiplied = parse_optional_bool(p, true);
        else
            break;
    }
    map->image = read_file(p, name, loc, format, &how);
}

/* ---- its modifiers ---- */

static int map_type(Parser *p, ImageUse use)
{
    int type = parse_int(p);
    bool known = type == 0 || type == 1 || type == 2 || type == 5;
    if (!known && use == IMAGE_COLOUR)
        parse_fail(p, "Invalid map_type value.");
    return known ? type : 0;
}

static int interpolate(Parser *p, ImageUse use)
{
    int type = parse_int(p);
    bool known = type == 0 || (type >= 2 && type <= 4);
    if (!known && use == IMAGE_COLOUR)
        parse_fail(p, "Invalid interpolate value.");
    if (type == 0 && use == IMAGE_COLOUR)
        parse_mend(p, "No interpolation is what an image_map has without the word");
    return known ? type : 0;
}

static float *palette_values(Parser *p, const Image *im, const float *already, bool filter)
{
    float *v = arena_array(p->arena, float, 256);
    for (uint32_t i = 0; i < 256; i++)
        v[i] = already != NULL ? already[i] : i >= im->n_palette ? 0 : filter ? im->entry[i].f : im->entry[i].t;
    return v;
}

/* filter and transmit of an image_map: `all f`, or `index, f` for palettes (07-textures, section 6.5). */
static void transparency(Parser *p, ImageMap *map, bool filter)
{
    const Image *im = map->image;
    map->has_transparency = true;
    if (parse_accept(p, KW_ALL)) {
        float value = (float)parse_next_float(p);
        if (!im->indexed) {
            *(filter ? &map->filter_all : &map->transmit_all) = value;
            return;
        }
        float *v = palette_values(p, im, NULL, filter);
        for (int i = 0; i < 256; i++)
            v[i] = value;
        *(filter ? &map->palette_filter : &map->palette_transmit) = v;
        return;
    }
    int index = parse_int(p);
    float value = (float)parse_next_float(p);
    const char *word = filter ? "filter" : "transmit";
    if (!im->indexed)
        parse_fail(p, "Keyword '%s' cannot be used with non color-mapped image.", word);
    if (index < 0 || (uint32_t)index >= im->n_palette)
        parse_fail(p, "%s: the image has no palette entry %d.", word, index);
    const float **to = filter ? &map->palette_filter : &map->palette_transmit;
    float *v = palette_values(p, im, *to, filter);
    v[index] = value;
    *to = v;
}

static Vec2 repeats(Parser *p)
{
    Vec2 v = parse_vec2(p);
    if (!(v.u > 0 && v.v > 0))
        parse_fail(p, "Zero or Negative Image Repeat Vector.");
    return v;
}

static bool item(Parser *p, ImageUse use, ImageMap *map, float *amount)
{
    switch (parse_peek(p)) {
    case KW_ONCE: parse_skip(p); map->once = true; return true;
    case KW_MAP_TYPE: parse_skip(p); map->map_type = map_type(p, use); return true;
    case KW_INTERPOLATE: parse_skip(p); map->interpolate = interpolate(p, use); return true;
    case KW_REPEAT: parse_skip(p); map->repeat = repeats(p); return true;
    case KW_OFFSET: parse_skip(p); map->offset = parse_vec2(p); return true;
    case KW_USE_COLOR:
        if (use == IMAGE_INDEX)
            return false;
        parse_skip(p);
        map->use_index = map->use_alpha = false;
        return true;
    case KW_USE_INDEX:
        if (use == IMAGE_INDEX)
            return false;
        parse_skip(p);
        map->use_index = true;
        return true;
    case KW_USE_ALPHA:
        if (use != IMAGE_VALUE)
            return false;
        parse_skip(p);
        map->use_alpha = true;
        return true;
    case KW_BUMP_SIZE:
        if (use != IMAGE_BUMP)
            return false;
        parse_skip(p);
        *amount = (float)parse_float(p);
        return true;
    case KW_FILTER: case KW_TRANSMIT: case KW_ALPHA: {
        bool filter = parse_peek(p) != KW_TRANSMIT;
        if (use != IMAGE_COLOUR)
            return false;
        parse_skip(p);
        transparency(p, map, filter);
        return true;
    }
    default: return false;
    }
}

const ImageMap *image_items(Parser *p, ImageUse use, float *amount)
{
    ImageMap *map = arena_new(p->arena, ImageMap);
    map->repeat = (Vec2){ 1, 1 };
    read_image(p, use, true, map);
    parse_stray_comma(p);
    while (item(p, use, map, amount))
        parse_stray_comma(p);
    map->has_transparency |= map->once || map->image->translucent;
    return map;
}

const ImageMap *image_block(Parser *p, ImageUse use, float *amount)
{
    block_open(p, use == IMAGE_BUMP ? "bump_map" : use == IMAGE_VALUE ? "image_pattern" : "image_map");
    const ImageMap *map = image_items(p, use, amount);
    block_close(p, use == IMAGE_BUMP ? "bump_map" : use == IMAGE_VALUE ? "image_pattern" : "image_map");
    return map;
}

const ImageMap *parse_image_pattern(Parser *p)
{
    return image_block(p, IMAGE_VALUE, NULL);
}

const ImageMap *parse_image(Parser *p)
{
    ImageMap *map = arena_new(p->arena, ImageMap);
    map->repeat = (Vec2){ 1, 1 };
    read_image(p, IMAGE_VALUE, false, map);
    return map;
}
