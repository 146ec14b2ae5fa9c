/* ttf.h - TrueType fonts: outlines, advances and kerning, read as the reference reads them (08-shapes, section 20).
 *
 * Bytes come from anywhere: every read is checked, what lies outside the file reads as 0, and loops are bounded by it. */
#ifndef SHAPE_TTF_H
#define SHAPE_TTF_H

#include "base/str.h"
#include "shape/curve.h"

typedef struct TtfTable { uint32_t at, n; } TtfTable;

typedef struct Ttf {
    Str bytes;
    TtfTable cmap, glyf, head, loca, hhea, hmtx, maxp, kern;
    double em;                                 /* 1 / units per em */
    uint32_t n_glyphs, n_metrics;
    bool long_loca;
    TtfTable encoding;                         /* the subtable of cmap in use */
} Ttf;

typedef struct TtfGlyph {
    Curve outline;                             /* in ems; n = 0 for blanks */
    Vec2 lo, hi;                               /* its box, in ems */
    uint32_t metrics;                          /* the glyph whose advance, bearing and kerning are meant */
} TtfGlyph;

enum { TTF_UNICODE_FIRST = 1 };                /* flags of ttf_open */

/* `index`: which font of a collection. False: `error` says why. */
bool ttf_open(Ttf *t, Str bytes, uint32_t index, unsigned flags, const char **error);
uint32_t ttf_glyph_of(const Ttf *t, uint32_t character);   /* 0: none */
TtfGlyph ttf_glyph(const Ttf *t, Arena *arena, uint32_t glyph);
double ttf_advance(const Ttf *t, uint32_t glyph);          /* in ems, as all lengths */
double ttf_bearing(const Ttf *t, uint32_t glyph);

typedef struct TtfKern { double along, across; } TtfKern;
TtfKern ttf_kern(const Ttf *t, uint32_t left, uint32_t right);

#endif
