/* test_feed.c - a long file read through a window is the same scene, with the same messages, as its text in one piece. */
#include <fcntl.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <unistd.h>

#include "sdl/parsed.h"                        /* before cmocka, which has a macro called fail */

#include <cmocka.h>

enum { MOST = 1 << 23, LEAST_WINDOW = 80000, N_LONG = 6 };            /* a line as far as columns count, and room for a token */

typedef struct Writer {
    char *text;
    size_t n;
    uint32_t state;
} Writer;

static unsigned chance(Writer *w, unsigned of)
{
    w->state = w->state * 1664525u + 1013904223u;
    return (w->state >> 8) % of;
}

static void put(Writer *w, const char *text)
{
    size_t n = strlen(text);
    memcpy(w->text + w->n, text, n);
    w->n += n;
}

static void put_many(Writer *w, unsigned n, const char *text)
{
    while (n-- > 0)
        put(w, text);
}

static void put_sphere(Writer *w)
{
    char text[200];
    snprintf(text, sizeof text, "sphere { <%d.%u, %u.0000%u, -.%u>, 0.%05u pigment { rgb <0.%u, 1, 0> } }", (int)chance(w, 9) - 4,
             chance(w, 100000), chance(w, 10), chance(w, 9999), chance(w, 999), 1 + chance(w, 9999), chance(w, 99));
    put(w, text);
}

static void put_piece(Writer *w)
{
    static const char *const ends[] = { "\n", "\r\n", "\r", "\n\n\n", " ", "\n\r" };
    switch (chance(w, 120)) {
    case 0: put(w, "/* over /* some */\r\n lines */"); break;
    case 1: put(w, "// to the end of the line\n"); break;
    case 2: put(w, "#for (I, 1, 3) sphere { I, 1 } #end"); break;
    case 3: put(w, "#macro M(A) sphere { A, 2 } #warning \"in M\" #end M(<1, 2, 3>) M(4)"); break;
    case 4: put(w, "#if (0) sphere { nothing } #else sphere { 5, 5 } #end"); break;
    case 5: put(w, "#declare S = \"some\\ntext\" #warning concat(S, \" of a string\")"); break;
    case 6: put(w, "#declare T = texture { pigment { rgb 1 } } /* and */ texture { pigment { rgbt 1 } } sphere { 0, 1 texture { T } }"); break;
    case 7: put(w, "mesh2 { vertex_vectors { 3, <0,0,0>, <1,0,0>, <0,1,0> } face_indices { 1, <0,1,2> } }"); break;
    case 8: put(w, "box { 0, 1 scale <1, 0, 1> }"); break;             /* warns */
    case 9: put(w, "#while (0) it @ is ~ skipped #end"); break;
    default: put_sphere(w);
    }
    put(w, ends[chance(w, 6)]);
}

/* Long things, each over several windows or the end of one. */
static void put_long(Writer *w, int kind)
{
    switch (kind) {
    case 0: put(w, "//"); put_many(w, 20000, " comment"); break;
    case 1: put(w, "/*"); put_many(w, 20000, "comment\r\n"); put(w, "*/"); break;
    case 2: put_many(w, 150000, " "); break;
    case 3: put_many(w, 60000, "\r\n"); break;
    case 4: put(w, "#macro Long(A) #warning \"in Long\""); put_many(w, 9000, " sphere { A, 1 }\n"); put(w, "#end Long(7)"); break;
    case 5: put(w, "#if (1)"); put_many(w, 9000, " sphere { 1, 1 }"); put(w, "#else"); put_many(w, 9000, " sphere { x }"); put(w, "#end"); break;
    }
    put(w, "\n");
}

static void assert_same(const Parsed *a, const Parsed *b)
{
    assert_int_equal(a->failed, b->failed);
    assert_int_equal(diag_count(a->diag), diag_count(b->diag));
    for (uint32_t i = 0; i < diag_count(a->diag); i++) {
        Str x = diag_message(a->diag, i)->text, y = diag_message(b->diag, i)->text;
        assert_int_equal(x.n, y.n);
        assert_memory_equal(x.data, y.data, x.n);
    }
    assert_int_equal(a->scene.n_objects, b->scene.n_objects);
    for (uint32_t i = 0; i < a->scene.n_objects; i++) {
        const Object *x = a->scene.object[i], *y = b->scene.object[i];
        assert_memory_equal(&x->loc, &y->loc, sizeof x->loc);
        assert_ptr_equal(x->ops, y->ops);
        if (strcmp(x->ops->keyword, "sphere") == 0)
            assert_memory_equal(x->params, y->params, x->ops->params_size);
    }
}

static void any_window_reads_the_same(const char *path, const Writer *w)
{
    Parsed *whole = parsed_from(path, w->text, NULL, false);
    for (size_t capacity = LEAST_WINDOW; capacity < w->n; capacity = capacity * 3 / 2 + 1) {
        FileFeed feed = { .fd = open(path, O_RDONLY), .data = malloc(capacity + 1), .capacity = capacity, .size = w->n };
        file_feed_seek(&feed, 0);
        Parsed *fed = parsed_from(path, feed.data, &feed, false);
        assert_same(whole, fed);
        parsed_free(fed);
        file_feed_close(&feed);
        free(feed.data);
    }
    parsed_free(whole);
}

static void windows_change_nothing(void **state)
{
    (void)state;
    static const char *const last[] = { "", "sphere { 0, oops }", "sphere { 0, 1", "/* not closed", "#if (1) sphere { 0, 1 }",
                                        "#declare S = \"not closed", "} @", "sphere { 0, 1 } \r\n \n  \n\n" };
    char path[] = "/tmp/whit-feed-XXXXXX";
    int fd = mkstemp(path);
    assert_true(fd >= 0);
    Writer w = { .text = malloc(MOST) };
    for (uint32_t i = 0; i < sizeof last / sizeof *last; i++) {
        w.n = 0;
        w.state = i;
        put(&w, "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n");
        for (int kind = 0; kind < N_LONG; kind++) {
            for (int k = 0; k < 1500; k++)
                put_piece(&w);
            put_long(&w, kind);
        }
        if (i == 7)
            put_many(&w, 100000, " \n");
        put(&w, last[i]);
        w.text[w.n] = 0;
        assert_int_equal(ftruncate(fd, 0), 0);
        assert_int_equal(pwrite(fd, w.text, w.n, 0), (ssize_t)w.n);
        any_window_reads_the_same(path, &w);
    }
    close(fd);
    unlink(path);
    free(w.text);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(windows_change_nothing) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
