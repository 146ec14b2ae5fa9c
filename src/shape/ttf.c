/* ttf.c - see ttf.h. */
#include "shape/ttf.h"

#ifdef HAVE_FREETYPE
#include <string.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_FONT_FORMATS_H
#include FT_MODULE_H
#include FT_OUTLINE_H
#include FT_TRUETYPE_TABLES_H
#include FT_TRUETYPE_TAGS_H

#include "base/array.h"
#include "base/library.h"

#define FUNCTIONS(each)                                                                                                \
    each(FT_New_Library) each(FT_Add_Default_Modules) each(FT_New_Memory_Face) each(FT_Get_Font_Format)                \
    each(FT_Get_CMap_Format) each(FT_Set_Charmap) each(FT_Get_Char_Index) each(FT_Get_Kerning) each(FT_Load_Sfnt_Table)         \
    each(FT_Get_Sfnt_Table) each(FT_Load_Glyph) each(FT_Outline_Decompose)

typedef struct Library { FUNCTIONS(LIBRARY_FIELD) } Library;

/* ---- memory ---- */

/* Fit for anything. */
static void *take(FT_Memory memory, long n)
{
    return arena_alloc(memory->user, ((size_t)n + 15) & ~(size_t)15);
}

static void leave(FT_Memory memory, void *block)
{
    (void)memory, (void)block;
}

static void *resize(FT_Memory memory, long n, long to, void *block)
{
    void *new = take(memory, to);
    memcpy(new, block, (size_t)(n < to ? n : to));
    return new;
}

/* ---- opening ---- */

/* POV: tables of characters by platform; the encoding is not looked at; formats 0, 4 and 6. */
static bool choose_encoding(const Library *lib, FT_Face face, unsigned flags)
{
    static const int order[2][3] = { { 1, 3, 0 }, { 0, 3, 1 } };
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < face->num_charmaps; i++) {
            FT_CharMap map = face->charmaps[i];
            long format = lib->FT_Get_CMap_Format(map);
            if (map->platform_id == order[flags & TTF_UNICODE_FIRST][k] && (format == 0 || format == 4 || format == 6))
                return lib->FT_Set_Charmap(face, map) == 0;
        }
    return false;
}

bool ttf_open(Ttf *t, Arena *arena, Str bytes, uint32_t index, unsigned flags, const char **error)
{
    static const char *const names[] = { FUNCTIONS(LIBRARY_NAME) };
    Library *lib = arena_new(arena, Library);
    if (!library_load(LIBRARY_FREETYPE, names, sizeof names / sizeof *names, lib)) {
        *error = "FreeType, which reads fonts, is not installed";
        return false;
    }
    FT_Memory memory = arena_copy(arena, &(struct FT_MemoryRec_){ arena, take, leave, resize }, sizeof *memory);
    FT_Library library;
    FT_Face face;
    *error = "it is not a TrueType font";
    if (lib->FT_New_Library(memory, &library) != 0)
        return false;
    lib->FT_Add_Default_Modules(library);
    if (lib->FT_New_Memory_Face(library, (const FT_Byte *)bytes.data, (FT_Long)bytes.n, (FT_Long)index, &face) != 0 ||
        !FT_IS_SCALABLE(face))
        return false;
    if (strcmp(lib->FT_Get_Font_Format(face), "TrueType") != 0) {
        *error = "its outlines are not TrueType's";
        return false;
    }
    if (!choose_encoding(lib, face, flags)) {
        *error = "none of its character tables is of a known kind";
        return false;
    }
    *t = (Ttf){ arena, lib, face, 1.0 / (face->units_per_EM > 0 ? face->units_per_EM : 1000) };
    return true;
}

uint32_t ttf_glyph_of(const Ttf *t, uint32_t character)
{
    const Library *lib = t->library;
    uint32_t glyph = lib->FT_Get_Char_Index(t->face, character);
    if (glyph == 0 && character < 256)         /* fonts of symbols stand there */
        glyph = lib->FT_Get_Char_Index(t->face, character + 0xf000);
    return glyph;
}

double ttf_kern(const Ttf *t, uint32_t left, uint32_t right)
{
    const Library *lib = t->library;
    FT_Vector k;
    return lib->FT_Get_Kerning(t->face, left, right, FT_KERNING_UNSCALED, &k) == 0 ? t->em * (double)k.x : 0;
}

/* ---- outlines ---- */

typedef struct Outline {
    Arena *arena;
    double unit;
    Vec2 at;
    ARRAY(CurvePiece) pieces;
} Outline;

/* Twice the size, so that points halfway between two others are whole numbers too. */
enum { DOUBLED = 1 };

static Vec2 point(const Outline *o, const FT_Vector *p)
{
    return (Vec2){ o->unit * (double)p->x, o->unit * (double)p->y };
}

static int add_piece(Outline *o, Vec2 p1, Vec2 p2, int degree)
{
    Vec2 p[3] = { o->at, p1, p2 };
    array_push(o->arena, &o->pieces, curve_piece(p, degree));
    o->at = degree == 1 ? p1 : p2;
    return 0;
}

static int move_to(const FT_Vector *to, void *outline)
{
    Outline *o = outline;
    o->at = point(o, to);
    return 0;
}

static int line_to(const FT_Vector *to, void *outline)
{
    Vec2 p = point(outline, to), at = ((Outline *)outline)->at;
    return p.u == at.u && p.v == at.v ? 0 : add_piece(outline, p, p, 1);
}

static int conic_to(const FT_Vector *control, const FT_Vector *to, void *outline)
{
    return add_piece(outline, point(outline, control), point(outline, to), 2);
}

static int cubic_to(const FT_Vector *a, const FT_Vector *b, const FT_Vector *to, void *outline)
{
    (void)a, (void)b, (void)to, (void)outline;
    return 1;                                  /* PostScript's: TrueType has none */
}

/* ---- what FreeType keeps to itself ---- */

/* A number of two bytes; 0 beyond the table's end. */
static int word_at(const Ttf *t, FT_ULong table, FT_ULong at)
{
    const Library *lib = t->library;
    FT_Byte bytes[2];
    FT_ULong n = sizeof bytes;
    return lib->FT_Load_Sfnt_Table(t->face, table, (FT_Long)at, bytes, &n) == 0 ? (int16_t)(bytes[0] << 8 | bytes[1]) : 0;
}

static FT_ULong unsigned_at(const Ttf *t, FT_ULong table, FT_ULong at)
{
    return (FT_ULong)word_at(t, table, at) & 0xffff;
}

static int bearing(const Ttf *t, FT_ULong glyph)
{
    const Library *lib = t->library;
    const TT_HoriHeader *header = lib->FT_Get_Sfnt_Table(t->face, FT_SFNT_HHEA);
    FT_ULong n = header != NULL ? header->number_Of_HMetrics : 0;
    return word_at(t, TTAG_hmtx, glyph < n ? 4 * glyph + 2 : 4 * n + 2 * (glyph - n));
}

/* The box that the glyph's header states. */
static FT_BBox stated_box(const Ttf *t, FT_ULong glyph)
{
    const Library *lib = t->library;
    const TT_Header *head = lib->FT_Get_Sfnt_Table(t->face, FT_SFNT_HEAD);
    bool wide = head != NULL && head->Index_To_Loc_Format != 0;
    FT_ULong at = wide ? unsigned_at(t, TTAG_loca, 4 * glyph) << 16 | unsigned_at(t, TTAG_loca, 4 * glyph + 2)
                       : 2 * unsigned_at(t, TTAG_loca, 2 * glyph);
    return (FT_BBox){ word_at(t, TTAG_glyf, at + 2), word_at(t, TTAG_glyf, at + 4),
                      word_at(t, TTAG_glyf, at + 6), word_at(t, TTAG_glyf, at + 8) };
}

/* POV: where the glyph begins is what its header says; a box there that is too small for the outline is widened. */
TtfGlyph ttf_glyph(const Ttf *t, uint32_t glyph)
{
    static const FT_Outline_Funcs draw = { move_to, line_to, conic_to, cubic_to, DOUBLED, 0 };
    const Library *lib = t->library;
    FT_Face face = t->face;
    Outline o = { .arena = t->arena, .unit = t->em / (1 << DOUBLED) };
    TtfGlyph g = { 0 };
    if (lib->FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE | FT_LOAD_NO_BITMAP) != 0 || face->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
        return g;
    FT_BBox box = stated_box(t, glyph);
    g.advance = t->em * (double)face->glyph->metrics.horiAdvance;
    g.bearing = t->em * bearing(t, glyph);
    if (face->glyph->outline.n_points == 0)
        return g;
    g.lo = (Vec2){ t->em * (double)box.xMin, t->em * (double)box.yMin };
    g.hi = (Vec2){ t->em * (double)box.xMax, t->em * (double)box.yMax };
    if (lib->FT_Outline_Decompose(&face->glyph->outline, &draw, &o) == 0) {
        g.outline = (Curve){ .piece = o.pieces.data, .n = o.pieces.n };
        curve_sort(t->arena, &g.outline);
    }
    for (uint32_t i = 0; i < g.outline.n; i++) {
        const CurvePiece *c = &g.outline.piece[i];
        g.lo = (Vec2){ fmin(g.lo.u, c->lo.u), fmin(g.lo.v, c->lo.v) };
        g.hi = (Vec2){ fmax(g.hi.u, c->hi.u), fmax(g.hi.v, c->hi.v) };
    }
    return g;
}
#else
bool ttf_open(Ttf *t, Arena *arena, Str bytes, uint32_t index, unsigned flags, const char **error)
{
    (void)t, (void)arena, (void)bytes, (void)index, (void)flags;
    *error = "this build has no FreeType and cannot read fonts";
    return false;
}

uint32_t ttf_glyph_of(const Ttf *t, uint32_t character)
{
    (void)t, (void)character;
    return 0;
}

TtfGlyph ttf_glyph(const Ttf *t, uint32_t glyph)
{
    (void)t, (void)glyph;
    return (TtfGlyph){ 0 };
}

double ttf_kern(const Ttf *t, uint32_t left, uint32_t right)
{
    (void)t, (void)left, (void)right;
    return 0;
}
#endif
