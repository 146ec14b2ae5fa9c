/* test_ttf.c - a font made by hand, byte by byte, and the same with its bytes spoiled. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#undef fail

#include <math.h>
#include <string.h>

#include "shape/ttf.h"

enum { ROOM = 4096, N_TABLES = 8 };

typedef struct { uint8_t data[ROOM]; uint32_t n; } Bytes;

static void put(Bytes *b, uint32_t bytes, uint32_t value)
{
    for (uint32_t i = bytes; i-- > 0;)
        b->data[b->n++] = (uint8_t)(value >> (8 * i));
}

static void put_words(Bytes *b, const int *words, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        put(b, 2, (uint32_t)words[i]);
}

#define WORDS(b, ...) put_words(b, (const int[]){ __VA_ARGS__ }, sizeof((const int[]){ __VA_ARGS__ }) / sizeof(int))

/* Glyph 0: nothing; 1: a square of 400 from (100, 0); 2: a round one, all points off the curve; 3: glyph 1 moved and halved, with
 * its metrics. 1000 units per em. */
static uint32_t glyph_start[5];

static void put_square(Bytes *b, int on)
{
    WORDS(b, 1, 100, 0, 500, 400, 3, 0);       /* contours, box, last point, instructions */
    for (int i = 0; i < 4; i++)
        put(b, 1, (uint32_t)on);               /* flags: two words each */
    WORDS(b, 100, 0, 400, 0, 0, 400, 0, -400);
}

static void put_glyphs(Bytes *b)
{
    uint32_t start = b->n;
    for (uint32_t g = 0; g <= 4; g++) {
        glyph_start[g] = b->n - start;
        if (g == 1)
            put_square(b, 1);
        if (g == 2)
            put_square(b, 0);
        if (g == 3)
            WORDS(b, -1, 100, 200, 300, 400, 0x0001 | 0x0002 | 0x0008 | 0x0200, 1, 50, 200, 0x2000);
    }
}

static void put_table(Bytes *b, int table, int format)
{
    switch (table) {
    case 0:                                    /* cmap */
        WORDS(b, 0, 1, 3, 1, 0, 12);
        if (format == 4)                       /* A to C are 1 to 3, nothing at 0xffff */
            WORDS(b, 4, 32, 0, 4, 4, 1, 0, 'C', 0xffff, 0, 'A', 0xffff, 1 - 'A', 1, 0, 0);
        else if (format == 6)
            WORDS(b, 6, 16, 0, 'A', 3, 1, 2, 3);
        else {
            WORDS(b, 0, 262, 0);
            for (int c = 0; c < 256; c++)
                put(b, 1, c >= 'A' && c <= 'C' ? (uint32_t)(c - 'A' + 1) : 0);
        }
        break;
    case 1: put_glyphs(b); break;
    case 2:                                    /* head */
        for (int i = 0; i < 27; i++)
            put(b, 2, i == 9 ? 1000 : i == 25 ? 1 : 0);
        break;
    case 3:                                    /* hhea */
        for (int i = 0; i < 18; i++)
            put(b, 2, i == 17 ? 3 : 0);
        break;
    case 4: WORDS(b, 500, 0, 600, 100, 620, 90, 95); break;    /* hmtx: three pairs, one bearing */
    case 5: WORDS(b, 0, 1, 2, 14 + 3 * 6 + 6, 1, 3, 0, 0, 0, 1, 1, -30, 1, 2, 40, 2, 1, 50); break;    /* kern */
    case 6:                                    /* loca */
        for (int g = 0; g <= 4; g++)
            put(b, 4, glyph_start[g]);
        break;
    case 7: WORDS(b, 1, 0, 4); break;          /* maxp */
    }
}

static void make_font(Bytes *b, int format)
{
    static const char *const tags[N_TABLES] = { "cmap", "glyf", "head", "hhea", "hmtx", "kern", "loca", "maxp" };
    memset(b, 0, sizeof *b);
    put(b, 4, 0x00010000);
    WORDS(b, N_TABLES, 0, 0, 0);
    uint32_t record = b->n;
    b->n += 16 * N_TABLES;
    for (int k = 0; k < N_TABLES; k++) {
        uint32_t start = b->n;
        put_table(b, k, format);
        uint32_t end = b->n;
        b->n = record + 16 * (uint32_t)k;
        for (int i = 0; i < 4; i++)
            put(b, 1, (uint8_t)tags[k][i]);
        put(b, 4, 0);
        put(b, 4, start);
        put(b, 4, end - start);
        b->n = (end + 3) & ~3u;
    }
}

static Str view(const Bytes *b) { return (Str){ (const char *)b->data, b->n }; }

static bool near(double a, double b) { return fabs(a - b) < 1e-12; }

static bool open_made(Ttf *t, Arena *a, const Bytes *b, unsigned flags, const char **error)
{
    return ttf_open(t, a, view(b), 0, flags, error);
}

static void characters_find_their_glyphs_in_every_format(void **state)
{
    (void)state;
    static const int formats[] = { 0, 4, 6 };
    for (int i = 0; i < 3; i++) {
        Bytes b;
        Ttf t;
        const char *error;
        Arena a;
        arena_init(&a);
        make_font(&b, formats[i]);
        assert_true(open_made(&t, &a, &b, 0, &error));
        for (uint32_t c = 0; c < 70000; c++)
            assert_int_equal(ttf_glyph_of(&t, c), c >= 'A' && c <= 'C' ? c - 'A' + 1 : 0);
        arena_free(&a);
    }
}

static void outlines_and_metrics_are_those_of_the_tables(void **state)
{
    (void)state;
    Bytes b;
    Ttf t;
    const char *error;
    Arena a;
    arena_init(&a);
    make_font(&b, 4);
    assert_true(open_made(&t, &a, &b, 0, &error));
    TtfGlyph none = ttf_glyph(&t, 0), square = ttf_glyph(&t, 1), round = ttf_glyph(&t, 2), half = ttf_glyph(&t, 3);
    assert_int_equal(none.outline.n, 0);
    assert_int_equal(square.outline.n, 4);
    assert_int_equal(square.outline.piece[0].degree, 1);
    assert_true(near(square.lo.u, 0.1) && near(square.hi.v, 0.4));
    assert_true(curve_inside(&square.outline, 0.12, 0.02) && !curve_inside(&square.outline, 0.05, 0.02));
    assert_int_equal(round.outline.n, 4);
    assert_int_equal(round.outline.piece[0].degree, 2);
    assert_true(curve_inside(&round.outline, 0.3, 0.2) && !curve_inside(&round.outline, 0.12, 0.02));
    assert_int_equal(half.outline.n, 4);
    assert_true(near(half.outline.piece[0].p[0].u, 0.1) && near(half.outline.piece[0].p[0].v, 0.2));
    assert_true(near(square.advance, 0.6) && near(half.advance, 0.6));     /* glyph 3 has the metrics of glyph 1 */
    assert_true(near(square.bearing, 0.1) && near(half.bearing, 0.095));
    assert_true(near(ttf_kern(&t, 1, 1), -0.03) && near(ttf_kern(&t, 2, 1), 0.05) && near(ttf_kern(&t, 2, 2), 0));
    arena_free(&a);
}

static void what_is_no_font_is_refused_with_a_reason(void **state)
{
    (void)state;
    Bytes b;
    Ttf t;
    const char *error = NULL;
    Arena a;
    arena_init(&a);
    assert_false(ttf_open(&t, &a, (Str){ "", 0 }, 0, 0, &error));
    assert_string_equal(error, "it is not a TrueType font");
    make_font(&b, 4);
    memcpy(b.data + 12, "xxxx", 4);            /* no cmap */
    assert_false(open_made(&t, &a, &b, 0, &error));
    assert_string_equal(error, "none of its character tables is of a known kind");
    make_font(&b, 0);
    b.data[12 + 16 * N_TABLES + 12 + 1] = 2;   /* format 2 */
    assert_false(open_made(&t, &a, &b, 0, &error));
    assert_string_equal(error, "none of its character tables is of a known kind");
    arena_free(&a);
}

/* Whatever the bytes say, reading ends and is of a size that they can justify. */
static void spoiled_fonts_are_survived(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int turn = 0; turn < 5000; turn++) {
        Bytes b;
        Ttf t;
        const char *error;
        make_font(&b, (const int[]){ 0, 4, 6 }[turn % 3]);
        for (int k = turn % 7; k >= 0; k--) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            b.data[(random >> 33) % b.n] = (uint8_t)(random >> 20);
        }
        Str bytes = view(&b);
        if (turn % 5 == 0)
            bytes.n = (uint32_t)(random >> 40) % b.n;
        Arena a;
        arena_init(&a);
        bool opened = ttf_open(&t, &a, bytes, (uint32_t)turn % 2, turn % 4 ? 0 : TTF_UNICODE_FIRST, &error);
        for (uint32_t c = 'A'; opened && c <= 'D'; c++) {
            TtfGlyph g = ttf_glyph(&t, ttf_glyph_of(&t, c));
            for (uint32_t i = 0; i < g.outline.n; i++)
                assert_true(isfinite(g.outline.piece[i].p[0].u) && isfinite(g.outline.piece[i].p[0].v));
            assert_true(isfinite(g.advance + g.bearing + ttf_kern(&t, 1, 1)));
        }
        assert_true(a.used < 64u << 20);
        arena_free(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(characters_find_their_glyphs_in_every_format),
        cmocka_unit_test(outlines_and_metrics_are_those_of_the_tables),
        cmocka_unit_test(what_is_no_font_is_refused_with_a_reason),
        cmocka_unit_test(spoiled_fonts_are_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
