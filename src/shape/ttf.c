/* ttf.c - see ttf.h. After the TrueType part of the OpenType specification. */
#include "shape/ttf.h"

#include "base/array.h"

enum { MOST_DEPTH = 6, MOST_POINTS = 1 << 16 };

/* ---- bytes ---- */

static uint32_t u8(const Ttf *t, uint64_t at)
{
    return at < t->bytes.n ? (unsigned char)t->bytes.data[at] : 0;
}

static uint32_t u16(const Ttf *t, uint64_t at) { return u8(t, at) << 8 | u8(t, at + 1); }
static int32_t i16(const Ttf *t, uint64_t at) { return (int16_t)u16(t, at); }
static uint32_t u32(const Ttf *t, uint64_t at) { return u16(t, at) << 16 | u16(t, at + 2); }

static bool tagged(const Ttf *t, uint64_t at, const char *tag)
{
    for (uint32_t i = 0; i < 4; i++)
        if (u8(t, at + i) != (unsigned char)tag[i])
            return false;
    return true;
}

/* ---- opening ---- */

/* POV: subtables by platform; the encoding is not looked at; formats 0, 4 and 6. */
static void choose_encoding(Ttf *t, unsigned flags)
{
    static const uint32_t order[2][3] = { { 1, 3, 0 }, { 0, 3, 1 } };
    uint32_t n = u16(t, t->cmap.at + 2);
    for (int k = 0; k < 3 && t->encoding.at == 0; k++)
        for (uint32_t i = 0; i < n && i < 64 && t->encoding.at == 0; i++) {
            uint64_t record = t->cmap.at + 4 + 8 * (uint64_t)i, at = (uint64_t)t->cmap.at + u32(t, record + 4);
            uint32_t format = u16(t, at);
            if (u16(t, record) == order[flags & TTF_UNICODE_FIRST][k] && at < t->bytes.n &&
                (format == 0 || format == 4 || format == 6))
                t->encoding = (TtfTable){ (uint32_t)at, u16(t, at + 2) };
        }
}

bool ttf_open(Ttf *t, Str bytes, uint32_t index, unsigned flags, const char **error)
{
    *t = (Ttf){ .bytes = bytes };
    struct { const char *tag; TtfTable *table; } wanted[] = {
        { "cmap", &t->cmap }, { "glyf", &t->glyf }, { "head", &t->head }, { "loca", &t->loca }, { "hhea", &t->hhea },
        { "hmtx", &t->hmtx }, { "maxp", &t->maxp }, { "kern", &t->kern },
    };
    enum { N_WANTED = sizeof wanted / sizeof *wanted };
    uint32_t start = 0;
    if (tagged(t, 0, "ttcf"))
        start = u32(t, 12 + 4 * (uint64_t)(index < u32(t, 8) ? index : 0));
    if (u32(t, start) != 0x00010000 && !tagged(t, start, "true")) {
        *error = tagged(t, start, "OTTO") ? "its outlines are PostScript's, not TrueType's" : "it is not a TrueType font";
        return false;
    }
    uint32_t n = u16(t, start + 4);
    for (uint32_t i = 0; i < n && i < 64; i++) {
        uint64_t record = start + 12 + 16 * (uint64_t)i;
        for (int k = 0; k < N_WANTED; k++)
            if (tagged(t, record, wanted[k].tag) && u32(t, record + 8) < bytes.n)
                *wanted[k].table = (TtfTable){ u32(t, record + 8), u32(t, record + 12) };
    }
    for (int k = 0; k < N_WANTED - 1; k++)     /* kern may be missing */
        if (wanted[k].table->at == 0) {
            *error = "it lacks a table that every TrueType font has";
            return false;
        }
    uint32_t units = u16(t, t->head.at + 18);
    t->em = 1.0 / (units > 0 ? units : 1000);
    t->long_loca = u16(t, t->head.at + 50) != 0;
    t->n_glyphs = u16(t, t->maxp.at + 4);
    t->n_metrics = u16(t, t->hhea.at + 34);
    choose_encoding(t, flags);
    if (t->encoding.at == 0) {
        *error = "none of its character tables is of a known kind";
        return false;
    }
    return true;
}

/* ---- characters ---- */

/* Segments: ends, a pad, starts, deltas, offsets of ranges, each an array. */
static uint32_t from_segments(const Ttf *t, uint32_t c)
{
    uint64_t at = t->encoding.at;
    uint32_t n = u16(t, at + 6) / 2;
    for (uint32_t i = 0; i < n; i++) {
        uint64_t end = at + 14 + 2 * i, start = end + 2 + 2 * n, delta = start + 2 * n, range = delta + 2 * n;
        if (c > u16(t, end))
            continue;
        if (c < u16(t, start))
            return 0;
        uint32_t offset = u16(t, range), glyph = c;
        if (offset != 0) {
            glyph = u16(t, range + offset + 2 * (uint64_t)(c - u16(t, start)));
            if (glyph == 0)
                return 0;
        }
        return (glyph + u16(t, delta)) & 0xffff;
    }
    return 0;
}

uint32_t ttf_glyph_of(const Ttf *t, uint32_t character)
{
    uint64_t at = t->encoding.at;
    uint32_t glyph = 0, first;
    switch (u16(t, at)) {
    case 0:
        glyph = character < 256 ? u8(t, at + 6 + character) : 0;
        break;
    case 4:
        glyph = character < 0x10000 ? from_segments(t, character) : 0;
        if (glyph == 0 && character < 256)     /* fonts of symbols stand there */
            glyph = from_segments(t, character + 0xf000);
        break;
    case 6:
        first = u16(t, at + 6);
        glyph = character >= first && character - first < u16(t, at + 8) ? u16(t, at + 10 + 2 * (uint64_t)(character - first)) : 0;
        break;
    }
    return glyph < t->n_glyphs ? glyph : 0;
}

/* ---- metrics ---- */

double ttf_advance(const Ttf *t, uint32_t glyph)
{
    if (t->n_metrics == 0)
        return 0;
    return t->em * u16(t, t->hmtx.at + 4 * (uint64_t)(glyph < t->n_metrics ? glyph : t->n_metrics - 1));
}

double ttf_bearing(const Ttf *t, uint32_t glyph)
{
    uint64_t at = glyph < t->n_metrics ? 4 * (uint64_t)glyph + 2 : 4 * (uint64_t)t->n_metrics + 2 * (uint64_t)(glyph - t->n_metrics);
    return t->em * i16(t, t->hmtx.at + at);
}

/* POV: the flags of the first subtable serve all, and it must be a horizontal one. Pairs need not be in order: the search
 * ends at the first whose left glyph is larger. */
TtfKern ttf_kern(const Ttf *t, uint32_t left, uint32_t right)
{
    TtfKern k = { 0, 0 };
    double least_along = -1, least_across = -1;
    if (t->kern.at == 0)
        return k;
    uint32_t n = u16(t, t->kern.at + 2), flags = u16(t, t->kern.at + 8) & 0xff, wanted = left << 16 | right;
    if (!(flags & 1))
        return k;
    uint64_t at = t->kern.at + 4;
    for (uint32_t i = 0; i < n && at < t->bytes.n; i++, at += u16(t, at + 2) > 6 ? u16(t, at + 2) : 6) {
        if (u16(t, at + 4) >> 8 != 0)          /* format 0 alone: pairs in order */
            continue;
        uint32_t pair = 0, n_pairs = u16(t, at + 6), lefts = 0;
        while (pair < n_pairs && u32(t, at + 14 + 6 * (uint64_t)pair) != wanted && (lefts = u16(t, at + 14 + 6 * (uint64_t)pair)) <= left)
            pair++;
        if (pair == n_pairs || lefts > left)
            continue;
        double value = t->em * i16(t, at + 18 + 6 * (uint64_t)pair);
        double *sum = flags & 4 ? &k.across : &k.along, *least = flags & 4 ? &least_across : &least_along;
        if (flags & 2)
            *least = value;
        else
            *sum = flags & 8 ? value : *sum + value;
    }
    k.along = k.along > least_along ? k.along : least_along;
    k.across = k.across > least_across ? k.across : least_across;
    return k;
}

/* ---- outlines ---- */

typedef struct { Vec2 p; bool on; } Point;
typedef ARRAY(CurvePiece) Pieces;

typedef struct {
    const Ttf *t;
    Arena *arena;
    Pieces pieces;
    uint32_t metrics, points;                  /* points: used so far */
} Outline;

/* x' = m[0] x + m[1] y + m[2], y' = m[3] x + m[4] y + m[5] */
typedef struct { double m[6]; } Map;

static Vec2 mapped(const Map *m, Vec2 p)
{
    return (Vec2){ m->m[0] * p.u + m->m[1] * p.v + m->m[2], m->m[3] * p.u + m->m[4] * p.v + m->m[5] };
}

static Vec2 between(Vec2 a, Vec2 b)
{
    return (Vec2){ 0.5 * (a.u + b.u), 0.5 * (a.v + b.v) };
}

static void add_piece(Outline *o, Vec2 a, const Vec2 *control, Vec2 b)
{
    Vec2 p[3] = { a, control != NULL ? *control : b, b };
    array_push(o->arena, &o->pieces, curve_piece(p, control != NULL ? 2 : 1));
}

/* A closed contour; between two points off the curve lies one on it. */
static void add_contour(Outline *o, const Point *p, uint32_t n)
{
    if (n < 2)
        return;
    Vec2 start = p[0].on ? p[0].p : p[n - 1].on ? p[n - 1].p : between(p[0].p, p[n - 1].p), at = start;
    const Vec2 *control = NULL;
    for (uint32_t i = p[0].on; i < n; i++) {
        if (p[i].on) {
            add_piece(o, at, control, p[i].p);
            at = p[i].p;
            control = NULL;
        } else {
            if (control != NULL) {
                Vec2 middle = between(*control, p[i].p);
                add_piece(o, at, control, middle);
                at = middle;
            }
            control = &p[i].p;
        }
    }
    if (control != NULL || at.u != start.u || at.v != start.v)
        add_piece(o, at, control, start);
}

static uint32_t read_flags(const Ttf *t, uint64_t at, uint32_t n, uint8_t *flag)
{
    uint64_t begun = at;
    for (uint32_t i = 0; i < n;) {
        uint8_t f = (uint8_t)u8(t, at++);
        uint32_t times = f & 8 ? 1 + u8(t, at++) : 1;
        for (; times > 0 && i < n; times--)
            flag[i++] = f;
    }
    return (uint32_t)(at - begun);
}

/* One coordinate of all points: bytes, words or "the same". */
static uint64_t read_coordinates(const Ttf *t, uint64_t at, uint32_t n, const uint8_t *flag, bool y, double *out)
{
    uint8_t byte = y ? 4 : 2, same = y ? 32 : 16;
    int32_t value = 0;
    for (uint32_t i = 0; i < n; i++) {
        if (flag[i] & byte) {
            int32_t d = (int32_t)u8(t, at++);
            value += flag[i] & same ? d : -d;
        } else if (!(flag[i] & same)) {
            value += i16(t, at);
            at += 2;
        }
        out[i] = t->em * value;
    }
    return at;
}

static void add_simple(Outline *o, uint64_t at, uint32_t n_contours, const Map *map)
{
    const Ttf *t = o->t;
    uint64_t ends = at + 10, after = ends + 2 * (uint64_t)n_contours;
    uint32_t n = n_contours > 0 ? u16(t, after - 2) + 1 : 0;
    if (after + n / 16 > t->bytes.n || o->points + n > MOST_POINTS)
        return;
    o->points += n;
    after += 2 + u16(t, after);                /* over the instructions */
    uint8_t *flag = arena_array(o->arena, uint8_t, n);
    double *x = arena_array(o->arena, double, n), *y = arena_array(o->arena, double, n);
    Point *p = arena_array(o->arena, Point, n);
    after += read_flags(t, after, n, flag);
    after = read_coordinates(t, after, n, flag, false, x);
    read_coordinates(t, after, n, flag, true, y);
    for (uint32_t i = 0; i < n; i++)
        p[i] = (Point){ mapped(map, (Vec2){ x[i], y[i] }), flag[i] & 1 };
    uint32_t first = 0;
    for (uint32_t c = 0; c < n_contours; c++) {
        uint32_t last = u16(t, ends + 2 * (uint64_t)c);
        if (last >= n || last < first)
            return;
        add_contour(o, p + first, last - first + 1);
        first = last + 1;
    }
}

static void add_glyph(Outline *o, uint32_t glyph, const Map *map, int depth);

static double f2dot14(const Ttf *t, uint64_t at) { return i16(t, at) / 16384.0; }

static void add_composite(Outline *o, uint64_t at, const Map *map, int depth)
{
    enum { WORDS = 1, OFFSETS = 2, SCALE = 8, MORE = 32, TWO_SCALES = 64, MATRIX = 128, USE_METRICS = 512 };
    const Ttf *t = o->t;
    at += 10;
    for (uint32_t flags = MORE, count = 0; (flags & MORE) && count < 256 && at < t->bytes.n; count++) {
        flags = u16(t, at);
        uint32_t part = u16(t, at + 2);
        double x = flags & WORDS ? i16(t, at + 4) : (int8_t)u8(t, at + 4), y = flags & WORDS ? i16(t, at + 6) : (int8_t)u8(t, at + 5);
        at += flags & WORDS ? 8 : 6;
        double xx = 1, xy = 0, yx = 0, yy = 1;
        if (flags & SCALE) {
            xx = yy = f2dot14(t, at);
            at += 2;
        } else if (flags & TWO_SCALES) {
            xx = f2dot14(t, at);
            yy = f2dot14(t, at + 2);
            at += 4;
        } else if (flags & MATRIX) {           /* POV: the second number belongs to x */
            xx = f2dot14(t, at);
            xy = f2dot14(t, at + 2);
            yx = f2dot14(t, at + 4);
            yy = f2dot14(t, at + 6);
            at += 8;
        }
        if (!(flags & OFFSETS))                /* POV: parts placed by matching points are left out */
            continue;
        Vec2 shift = { x * t->em, y * t->em }, moved = mapped(map, shift);
        Map inner = { { map->m[0] * xx + map->m[1] * yx, map->m[0] * xy + map->m[1] * yy, moved.u,
                        map->m[3] * xx + map->m[4] * yx, map->m[3] * xy + map->m[4] * yy, moved.v } };
        uint32_t own = o->metrics;
        add_glyph(o, part, &inner, depth + 1);
        if (!(flags & USE_METRICS))
            o->metrics = own;
    }
}

static uint64_t glyph_at(const Ttf *t, uint32_t glyph, uint64_t *n)
{
    uint64_t entry = t->loca.at + (uint64_t)glyph * (t->long_loca ? 4 : 2);
    uint64_t a = t->long_loca ? u32(t, entry) : 2 * u16(t, entry), b = t->long_loca ? u32(t, entry + 4) : 2 * u16(t, entry + 2);
    *n = b > a ? b - a : 0;
    return t->glyf.at + a;
}

static void add_glyph(Outline *o, uint32_t glyph, const Map *map, int depth)
{
    uint64_t n, at = glyph_at(o->t, glyph, &n);
    o->metrics = glyph;
    if (n < 10 || glyph >= o->t->n_glyphs || depth > MOST_DEPTH || ++o->points > MOST_POINTS)
        return;                                /* parts of parts of parts must end some time */
    int32_t contours = i16(o->t, at);
    if (contours >= 0)
        add_simple(o, at, (uint32_t)contours, map);
    else
        add_composite(o, at, map, depth);
}

/* POV: headers that are too small are widened by the points of simple glyphs. */
TtfGlyph ttf_glyph(const Ttf *t, Arena *arena, uint32_t glyph)
{
    static const Map as_it_is = { { 1, 0, 0, 0, 1, 0 } };
    Outline o = { .t = t, .arena = arena };
    uint64_t n, at = glyph_at(t, glyph, &n);
    add_glyph(&o, glyph, &as_it_is, 0);
    TtfGlyph g = { .outline = { o.pieces.data, o.pieces.n }, .metrics = o.metrics };
    if (n >= 10) {
        g.lo = (Vec2){ t->em * i16(t, at + 2), t->em * i16(t, at + 4) };
        g.hi = (Vec2){ t->em * i16(t, at + 6), t->em * i16(t, at + 8) };
        for (uint32_t i = 0; i < g.outline.n && i16(t, at) >= 0; i++) {
            const CurvePiece *c = &g.outline.piece[i];
            g.lo = (Vec2){ fmin(g.lo.u, c->lo.u), fmin(g.lo.v, c->lo.v) };
            g.hi = (Vec2){ fmax(g.hi.u, c->hi.u), fmax(g.hi.v, c->hi.v) };
        }
    }
    return g;
}
