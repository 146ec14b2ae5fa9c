/* ttf.h - TrueType fonts by FreeType: outlines, advances and kerning, in ems, as the reference reads them (08-shapes, section 20).
 *
 * All that FreeType allocates lies in the arena, so a font needs no closing, also where an error jumps out. */
#ifndef SHAPE_TTF_H
#define SHAPE_TTF_H

#include "base/str.h"
#include "shape/curve.h"

typedef struct Ttf {
    Arena *arena;
    const void *library;                       /* what is called of FreeType */
    void *face;                                /* FT_Face */
    double em;                                 /* 1 / units per em */
} Ttf;

typedef struct TtfGlyph {
    Curve outline;                             /* n = 0 for blanks */
    Vec2 lo, hi;                               /* its box */
    double advance, bearing;
} TtfGlyph;

enum { TTF_UNICODE_FIRST = 1 };                /* flags of ttf_open */

/* `index`: which font of a collection. `bytes` must live as long as the arena. False: `error` says why. */
bool ttf_open(Ttf *t, Arena *arena, Str bytes, uint32_t index, unsigned flags, const char **error);
uint32_t ttf_glyph_of(const Ttf *t, uint32_t character);   /* 0: none */
TtfGlyph ttf_glyph(const Ttf *t, uint32_t glyph);
double ttf_kern(const Ttf *t, uint32_t left, uint32_t right);          /* what is added between them */

#endif
