/* text.c - text { ttf "file" | internal n, "string", thickness, offset }: letters as plates from z = 0 to the thickness.
 *
 * One em is 1 and each letter that has ink is a prim; equal letters of a text share an outline. Parts: pieces of the
 * outline, then the front and the back (08-shapes, section 20). */
#include "base/file.h"
#include "math/bernstein.h"
#include "sdl/parse.h"
#include "shape/shape.h"
#include "shape/ttf.h"

#ifdef HAVE_FONTCONFIG
#include <fontconfig/fontconfig.h>

#include "base/library.h"
#endif

typedef struct { const Curve *outline; Vec2 at, lo, hi; } Letter;      /* outline: NULL for blanks; the box that the font states */
typedef struct { const Letter *letter; uint32_t n; double thickness; } Params;
typedef struct { Curve outline; double thickness, slack; } Glyph;

/* ---- fonts ---- */

static Str file_named(Parser *p, const char *name)
{
    static const char *const none[] = { NULL };
    Str bytes;
    return parse_find_file(p, str_of(name), none, parse_loc(p), &bytes) ? bytes : parse_read_file(p, str_of(name), parse_loc(p));
}

#ifdef HAVE_FONTCONFIG
/* Windows' short names say the weight and the slant in their last letters. */
static const struct { const char *stem, *family; } families[] = {
    { "arial", "Arial" }, { "times", "Times New Roman" }, { "cour", "Courier New" }, { "verdana", "Verdana" },
    { "georgia", "Georgia" }, { "comic", "Comic Sans MS" }, { "impact", "Impact" }, { "tahoma", "Tahoma" },
    { "trebuc", "Trebuchet MS" }, { "calibri", "Calibri" }, { "cambria", "Cambria" },
};

static Str stem_of(Str name)
{
    Str s = file_base_name(name);
    for (uint32_t i = s.n; i-- > 1;)
        if (s.data[i] == '.') {
            s.n = i;
            break;
        }
    return s;
}

#define FUNCTIONS(each)                                                                                                \
    each(FcInitLoadConfigAndFonts) each(FcConfigSubstitute) each(FcDefaultSubstitute) each(FcFontMatch) each(FcConfigDestroy)   \
    each(FcPatternCreate) each(FcPatternAddInteger) each(FcPatternAddString) each(FcPatternGetInteger)                 \
    each(FcPatternGetString) each(FcPatternDestroy)

typedef struct Fontconfig { FUNCTIONS(LIBRARY_FIELD) } Fontconfig;

/* Family, weight and slant that a file name means. */
static FcPattern *wanted(const Fontconfig *fc, Arena *a, Str name)
{
    static const char *const styles[] = { "", "bd", "i", "bi", "b", "z" };
    Str stem = stem_of(name);
    FcPattern *pattern = fc->FcPatternCreate();
    const char *family = str_c(a, stem);
    for (size_t f = 0; f < sizeof families / sizeof *families; f++)
        for (size_t k = 0; k < sizeof styles / sizeof *styles; k++) {
            Str whole = str_concat(a, str_of(families[f].stem), str_of(styles[k]));
            if (!str_equal_nocase(whole, stem))
                continue;
            family = families[f].family;
            if (k == 1 || k >= 3)
                fc->FcPatternAddInteger(pattern, FC_WEIGHT, FC_WEIGHT_BOLD);
            if (k == 2 || k == 3 || k == 5)
                fc->FcPatternAddInteger(pattern, FC_SLANT, FC_SLANT_ITALIC);
        }
    fc->FcPatternAddString(pattern, FC_FAMILY, (const FcChar8 *)family);
    fc->FcPatternAddString(pattern, FC_FONTFORMAT, (const FcChar8 *)"TrueType");
    return pattern;
}

/* The nearest TrueType font of the system. Strings are copied to `a`. */
static bool substitute(Arena *a, Str name, Str *path, Str *family, uint32_t *index)
{
    static const char *const names[] = { FUNCTIONS(LIBRARY_NAME) };
    Fontconfig loaded, *const fc = &loaded;
    if (!library_load(LIBRARY_FONTCONFIG, names, sizeof names / sizeof *names, fc))
        return false;
    FcConfig *config = fc->FcInitLoadConfigAndFonts();
    if (config == NULL)
        return false;
    FcPattern *pattern = wanted(fc, a, name);
    fc->FcConfigSubstitute(config, pattern, FcMatchPattern);
    fc->FcDefaultSubstitute(pattern);
    FcResult result;
    FcPattern *match = fc->FcFontMatch(config, pattern, &result);
    FcChar8 *file = NULL, *format = NULL, *full = NULL;
    int number = 0;
    bool found = match != NULL && fc->FcPatternGetString(match, FC_FILE, 0, &file) == FcResultMatch &&
                 fc->FcPatternGetString(match, FC_FONTFORMAT, 0, &format) == FcResultMatch &&
                 str_is(str_of("TrueType"), (const char *)format);
    if (found) {
        fc->FcPatternGetInteger(match, FC_INDEX, 0, &number);
        fc->FcPatternGetString(match, FC_FULLNAME, 0, &full);
        *path = str_copy(a, str_of((const char *)file));
        *family = str_copy(a, str_of(full != NULL ? (const char *)full : (const char *)file));
        *index = (uint32_t)number & 0xffff;
    }
    if (match != NULL)
        fc->FcPatternDestroy(match);
    fc->FcPatternDestroy(pattern);
    fc->FcConfigDestroy(config);
    return found;
}
#endif

static Str font_bytes(Parser *p, Str name, uint32_t *index)
{
    static const char *const extensions[] = { ".ttf", ".TTF", ".ttc", NULL };
    Str bytes;
    *index = 0;
    if (parse_find_file(p, name, extensions, parse_loc(p), &bytes))
        return bytes;
#ifdef HAVE_FONTCONFIG
    Str path, family;
    if (!parse_is_strict(p) && substitute(parse_arena(p), name, &path, &family, index) &&
        file_read(parse_arena(p), NULL, path, &bytes) == FILE_OK) {
        parse_warn(p, "there is no font '%.*s': %.*s (%.*s) is used", STR_ARGS(name), STR_ARGS(family), STR_ARGS(path));
        return bytes;
    }
#endif
    return parse_read_file(p, name, parse_loc(p));         /* tells that it is missing */
}

static Ttf parse_font(Parser *p)
{
    static const char *const internal[] = { "povlogo.ttf", "timrom.ttf", "cyrvetic.ttf", "crystal.ttf" };
    Str bytes, name;
    uint32_t index = 0;
    if (parse_accept(p, KW_INTERNAL)) {
        int n = parse_int(p);
        name = str_of(internal[n >= 1 && n <= 3 ? n : 0]);
        bytes = file_named(p, internal[n >= 1 && n <= 3 ? n : 0]);
    } else {
        parse_expect(p, KW_TTF);
        name = parse_file_name(p);
        bytes = font_bytes(p, name, &index);
    }
    Ttf t;
    const char *error;
    unsigned flags = parse_charset_is_ascii(p) ? 0 : TTF_UNICODE_FIRST;
    void **open = parse_kept(p, bytes.data, index << 1 | flags);
    if (*open != NULL)
        return *(const Ttf *)*open;
    if (!ttf_open(&t, parse_arena(p), bytes, index, flags, &error))
        parse_fail(p, "the font '%.*s' cannot be used: %s", STR_ARGS(name), error);
    *open = arena_copy(parse_arena(p), &t, sizeof t);
    return t;
}

/* ---- layout ---- */

static uint32_t next_character(Str s, uint32_t *i)
{
    uint32_t c = (unsigned char)s.data[(*i)++];
    uint32_t more = c >= 0xf0 ? 3 : c >= 0xe0 ? 2 : c >= 0xc0 ? 1 : 0;
    if (more == 0)
        return c;
    c &= 0x3fu >> more;
    for (; more > 0 && *i < s.n && ((unsigned char)s.data[*i] & 0xc0) == 0x80; more--)
        c = c << 6 | ((unsigned char)s.data[(*i)++] & 0x3f);
    return c;
}

typedef struct { uint32_t index; TtfGlyph glyph; Curve *outline; } Seen;

/* Glyphs already loaded, by an open hash table. */
static const Seen *glyph_of(const Ttf *t, Seen *table, uint32_t mask, uint32_t index)
{
    uint32_t slot = (index * 2654435761u) & mask;
    while (table[slot].outline != NULL && table[slot].index != index)
        slot = (slot + 1) & mask;
    Seen *s = &table[slot];
    if (s->outline == NULL) {
        s->index = index;
        s->glyph = ttf_glyph(t, index);
        s->outline = arena_new(t->arena, Curve);
        *s->outline = s->glyph.outline;
    }
    return s;
}

static void lay_out(Parser *p, const Ttf *t, Str text, Vec3 offset, Params *out)
{
    Arena *a = parse_arena(p);
    uint32_t mask = 15, previous = 0, n = 0;
    while (mask < 2 * text.n)
        mask = 2 * mask + 1;
    Seen *table = arena_array(a, Seen, mask + 1);
    Letter *letter = arena_array(a, Letter, text.n);
    Vec2 pen = { 0, 0 };
    for (uint32_t i = 0; i < text.n;) {
        bool first = i == 0;
        uint32_t c = next_character(text, &i);
        const Seen *s = glyph_of(t, table, mask, ttf_glyph_of(t, c));
        double advance = s->glyph.advance, bearing = s->glyph.bearing, kern = first ? 0 : ttf_kern(t, previous, s->index);
        Vec2 at = { -s->glyph.lo.u, pen.v };
        if (first) {                           /* its ink begins at 0 */
            pen.u = advance - bearing;
        } else {
            at.u += pen.u + bearing + kern;
            pen.u += advance + kern;
        }
        bool blank = c == ' ' || s->outline->n == 0;       /* only the extent knows of it */
        letter[n++] = blank ? (Letter){ .at = at } : (Letter){ s->outline, at, s->glyph.lo, s->glyph.hi };
        pen = (Vec2){ pen.u + offset.x, pen.v + offset.y };
        previous = s->index;
    }
    out->letter = letter;
    out->n = n;
}

static void parse(Parser *p, void *params)
{
    Params *t = params;
    Ttf font = parse_font(p);
    parse_comma(p);
    Str text = parse_string(p);
    t->thickness = parse_next_float(p);
    Vec3 offset = parse_next_vec3(p);
    parse_stray_comma(p);
    lay_out(p, &font, text, offset, t);
}

/* ---- compiling ---- */

/* POV: the whole text is turned a little, which keeps rays from running along its sides. */
static Affine tilt(void)
{
    return affine_rotate(vec3(0.001, 0.001, 0.001));
}

static Affine letter_place(const Letter *l)
{
    return affine_then(affine_translate(vec3(l->at.u, l->at.v, 0)), tilt());
}

static Bounds box_of(const Curve *c, double thickness)
{
    Vec2 lo = { INFINITY, INFINITY }, hi = { -INFINITY, -INFINITY };
    for (uint32_t i = 0; i < c->n; i++) {
        lo = (Vec2){ fmin(lo.u, c->piece[i].lo.u), fmin(lo.v, c->piece[i].lo.v) };
        hi = (Vec2){ fmax(hi.u, c->piece[i].hi.u), fmax(hi.v, c->piece[i].hi.v) };
    }
    return (Bounds){ vec3(lo.u, lo.v, fmin(0, thickness)), vec3(hi.u, hi.v, fmax(0, thickness)) };
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *t = params;
    for (uint32_t i = 0; i < t->n; i++) {
        if (t->letter[i].outline == NULL)
            continue;
        Bounds box = box_of(t->letter[i].outline, t->thickness);
        Glyph *out = build_data(b, sizeof *out);
        *out = (Glyph){ .outline = *t->letter[i].outline, .thickness = t->thickness };
        out->slack = 4 * DBL_EPSILON * fabs(t->thickness);
        Affine place = affine_then(letter_place(&t->letter[i]), b->place);
        build_prim(b, out, &place, shape_padded(box));
    }
}

/* ---- tracing ---- */

static void side_hits(const Glyph *g, uint32_t part, Vec3 o, Vec3 d, double shift, HitSink *sink)
{
    const CurvePiece *c = &g->outline.piece[part];
    double f[4], root[4], len2 = d.x * d.x + d.y * d.y;
    for (int i = 0; i <= c->degree; i++)
        f[i] = (c->p[i].u - o.x) * d.y - (c->p[i].v - o.y) * d.x;
    int n = bernstein_roots(f, c->degree, root);
    for (int i = 0; i < n; i++) {
        Vec2 q = curve_at(c, root[i]);
        double t = ((q.u - o.x) * d.x + (q.v - o.y) * d.y) / len2, z = o.z + t * d.z;
        if (-g->slack <= z && z <= g->thickness + g->slack)
            hit_add_uv(sink, shift + t, part, root[i], 0);
    }
}

/* A limit of the ray counted from `shift`, moved up or down by more than the rounding of sums with it. */
static double from_nearest(double t, double shift, double side)
{
    return t - shift + side * 4 * DBL_EPSILON * (fabs(t) + fabs(shift));
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Glyph *g = shape;
    double shift = shape_nearest_t(ray);
    Vec3 o = ray_at(ray, shift), d = ray->d;
    for (uint32_t i = 0; i < 2 && d.z != 0; i++) {
        double t = ((i ? g->thickness : 0) - o.z) / d.z, at = shift + t;
        if (at > sink->t_min && at <= sink->limit && curve_inside(&g->outline, o.x + t * d.x, o.y + t * d.y))
            hit_offer(sink, at, g->outline.n + i, 0, 0);
    }
    if (d.x == 0 && d.y == 0)
        return;
    /* Over the thickness, as far as hits count, the ray stays in this box. */
    Vec2 lo = { -INFINITY, -INFINITY }, hi = { INFINITY, INFINITY };
    double room = 1e-9 * (1 + fabs(g->thickness));
    if (fabs(d.z) > 1e-6 * (fabs(d.x) + fabs(d.y))) {
        double za = -o.z / d.z, zb = (g->thickness - o.z) / d.z;
        double t0 = greater(lesser(za, zb), from_nearest(sink->t_min, shift, -1));
        double t1 = lesser(greater(za, zb), from_nearest(sink->limit, shift, 1));
        double xa = o.x + t0 * d.x, xb = o.x + t1 * d.x, ya = o.y + t0 * d.y, yb = o.y + t1 * d.y;
        lo = (Vec2){ lesser(xa, xb) - room, lesser(ya, yb) - room };
        hi = (Vec2){ greater(xa, xb) + room, greater(ya, yb) + room };
    }
    const CurveRows *rows = &g->outline.rows;
    uint32_t row = curve_row(rows, lo.v);
    bool one = row == curve_row(rows, hi.v);   /* as most often; several rows name their pieces several times */
    for (uint32_t k = one ? rows->first[row] : 0, end = one ? rows->first[row + 1] : g->outline.n; k < end; k++) {
        uint32_t i = one ? rows->piece[k] : k;
        const CurvePiece *c = &g->outline.piece[i];
        if (c->lo.u <= hi.u && c->hi.u >= lo.u && c->lo.v <= hi.v && c->hi.v >= lo.v)
            side_hits(g, i, o, d, shift, sink);
    }
}

static bool inside(const void *shape, Vec3 p)
{
    const Glyph *g = shape;
    return 0 <= p.z && p.z <= g->thickness && curve_inside(&g->outline, p.x, p.y);
}

/* POV: the sides' normals point into the letter. */
static void surface(const void *shape, const Hit *hit, Surface *out)
{
    const Glyph *g = shape;
    if (hit->part >= g->outline.n) {
        bool back = hit->part > g->outline.n;
        out->p.z = back ? g->thickness : 0;
        out->normal = vec3(0, 0, back ? 1 : -1);
        return;
    }
    Vec2 d = curve_slope(&g->outline.piece[hit->part], hit->u);
    out->normal = d.u == 0 && d.v == 0 ? vec3(0, 1, 0) : vec3(d.v, -d.u, 0);
}

/* POV: a little thicker than it is; the box of all letters is turned, not each. */
static Bounds extent(const void *params, const Affine *place)
{
    const Params *t = params;
    Bounds all = bounds_empty();
    Affine turned = tilt();
    for (uint32_t i = 0; i < t->n; i++) {
        const Letter *l = &t->letter[i];
        all = bounds_include(all, vec3(l->at.u + l->lo.u, l->at.v + l->lo.v, fmin(0, t->thickness) - 1e-6));
        all = bounds_include(all, vec3(l->at.u + l->hi.u, l->at.v + l->hi.v, fmax(0, t->thickness) + 1e-6));
    }
    all = bounds_transformed(all, &turned);
    return bounds_transformed(all, place);
}

const ShapeOps shape_text = {
    .keyword = "text", .params_size = sizeof(Params), .flags = SHAPE_SHARED, .parse = parse, .compile = compile, .hits = hits,
    .inside = inside, .surface = surface, .extent = extent,
};
