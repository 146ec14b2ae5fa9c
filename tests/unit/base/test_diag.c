/* test_diag.c - messages have their place, their line and a caret; a failure lands where it was told to. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#undef fail                                    /* cmocka's; ours is a function */

#include "base/diag.h"

static char seen[65536];
static int n_seen;

static void note(void *user, const DiagMessage *m)
{
    (void)user;
    snprintf(seen, sizeof seen, "%.*s", STR_ARGS(m->text));
    n_seen++;
}

static Diag *start(Arena *a)
{
    arena_init(a);
    Diag *d = diag_new(a);
    diag_sink(d, note, NULL);
    n_seen = 0;
    seen[0] = 0;
    return d;
}

static void a_failure_shows_its_line_and_lands(void **state)
{
    (void)state;
    Arena a;
    Diag *d = start(&a);
    uint16_t source = diag_source(d, str_of("a.pov"), str_of("first\r\nsecond line\n\rthird\rfourth"));
    static const char *const expected[] = {
        "a.pov:1:2: error: wrong 1\n  first\n   ^", "a.pov:2:8: error: wrong 2\n  second line\n         ^",
        "a.pov:3:5: error: wrong 3\n  third\n      ^", "a.pov:4:1: error: wrong 4\n  fourth\n  ^",
    };
    static const uint16_t columns[] = { 2, 8, 5, 1 };
    for (volatile int i = 3; i >= 0; i--) {    /* backwards too: the look-up of lines starts anew */
        if (setjmp(*diag_landing(d)) == 0) {
            fail(d, (Loc){ .line = (uint32_t)i + 1, .source = source, .column = columns[i] }, "wrong %d", i + 1);
        }
        assert_string_equal(seen, expected[i]);
    }
    assert_int_equal(diag_exit_code(d), 1);
    if (setjmp(*diag_landing(d)) == 0)
        fail_io(d, (Loc){ 0 }, "no disc");
    assert_string_equal(seen, "error: no disc");
    assert_int_equal(diag_exit_code(d), 3);
    assert_int_equal(diag_count(d), 5);
    arena_free(&a);
}

static void strange_bytes_and_endless_lines_are_shown_safely(void **state)
{
    (void)state;
    Arena a;
    Diag *d = start(&a);
    static char text[100001];
    memset(text, 'x', 100000);
    memcpy(text, "\x1b[31m\t\xc3\xa9", 8);
    uint16_t source = diag_source(d, str_of("a"), str_of(text));
    warn(d, (Loc){ .line = 1, .source = source, .column = 1 }, "start");
    for (const char *c = seen; *c; c++)
        assert_true(*c == '\n' || (*c >= ' ' && *c < 127));
    assert_true(strlen(seen) < 400);
    warn(d, (Loc){ .line = 1, .source = source, .column = UINT16_MAX }, "far");
    assert_true(strlen(seen) < 500 && strchr(seen, '^'));
    warn(d, (Loc){ .line = 77, .source = source, .column = 5 }, "beyond");
    warn(d, (Loc){ .line = 1, .source = 999, .column = 5 }, "nowhere");
    assert_non_null(strstr(seen, "warning: nowhere"));
    arena_free(&a);
}

static void floods_of_warnings_are_stopped_and_errors_are_not(void **state)
{
    (void)state;
    Arena a;
    Diag *d = start(&a);
    for (int i = 0; i < 100000; i++)
        warn(d, (Loc){ 0 }, "again");
    assert_string_equal(seen, "warning: further warnings are not shown");
    assert_true(n_seen < 2000 && a.used < 1 << 20);
    if (setjmp(*diag_landing(d)) == 0)
        fail(d, (Loc){ 0 }, "the end");
    assert_string_equal(seen, "error: the end");
    assert_string_equal(diag_message(d, diag_count(d) - 1)->text.data, "error: the end");
    arena_free(&a);
}

static void what_is_said_once_is_said_once(void **state)
{
    (void)state;
    Arena a;
    Diag *d = start(&a);
    for (int i = 0; i < 10; i++)
        warn_once(d, (Loc){ .line = (uint32_t)i }, "number %d", i / 5);
    assert_int_equal(n_seen, 2);
    say(d, DIAG_DEBUG, str_of("text as it is\n"));
    assert_string_equal(seen, "text as it is\n");
    arena_free(&a);
}

static void no_room(void *user)
{
    fail(user, (Loc){ 0 }, "no room");         /* which needs room as well */
}

static void a_failure_without_room_for_its_message_still_lands(void **state)
{
    (void)state;
    Arena a;
    Diag *d = start(&a);
    a.out_of_memory = no_room;
    a.user = d;
    a.limit = a.used + 64;
    volatile bool landed = true;
    if (setjmp(*diag_landing(d)) == 0) {
        arena_alloc(&a, 1000);
        landed = false;
    }
    assert_true(landed);
    assert_int_equal(diag_exit_code(d), 1);
    arena_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_failure_shows_its_line_and_lands),
        cmocka_unit_test(strange_bytes_and_endless_lines_are_shown_safely),
        cmocka_unit_test(floods_of_warnings_are_stopped_and_errors_are_not),
        cmocka_unit_test(what_is_said_once_is_said_once),
        cmocka_unit_test(a_failure_without_room_for_its_message_still_lands),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
