/* test_patterns.c - every pattern and warp against the measured numbers, asked as scenes ask: by function { pattern { ... } } and
 * function { pigment { ... } }. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "lib/csv.h"
#include "whit.h"

enum { MAX_VALUES = 16384, MAX_TEXT = 4 << 20 };

typedef struct Scene {                         /* a text that prints values, and the values it printed */
    char *text;
    size_t n;
    double value[MAX_VALUES];
    int n_values;
    char error[1024];
} Scene;

__attribute__((format(printf, 2, 3))) static void put(Scene *s, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    s->n += (size_t)vsnprintf(s->text + s->n, MAX_TEXT - s->n, format, args);
    va_end(args);
    assert_true(s->n < MAX_TEXT);
}

static Scene *scene_new(void)
{
    Scene *s = calloc(1, sizeof *s);
    s->text = malloc(MAX_TEXT);
    put(s, "#version 3.7; global_settings { assumed_gamma 1 }\n");
    return s;
}

static void show(void *user, const WhitMessage *m)
{
    Scene *s = user;
    if (m->kind == WHIT_DEBUG)
        for (const char *at = m->text; *at != 0 && s->n_values < MAX_VALUES;) {
            char *end;
            double v = strtod(at, &end);
            if (end == at)
                break;
            s->value[s->n_values++] = v;
            at = end;
        }
    else if (m->kind == WHIT_ERROR)
        snprintf(s->error, sizeof s->error, "%s", m->text);
}

static void run(Scene *s, int expected)
{
    WhitOptions options = { .library_path = (const char *const[]){ "tests/vectors/inputs" }, .n_library_paths = 1 };
    Whit *w = whit_new(&options);
    whit_show(w, show, s);
    whit_load_text(w, "patterns.pov", s->text, s->n);
    whit_free(w);
    if (s->n_values != expected)
        fail_msg("%d values, not %d: %s", s->n_values, expected, s->error);
}

static void scene_free(Scene *s)
{
    free(s->text);
    free(s);
}

static double tolerance(const Csv *c)
{
    if (strcmp(c->field[1], "pigment") == 0)
        return 2e-6;                           /* colours are single precision */
    bool single = strcmp(c->field[0], "image_pattern") == 0 || strcmp(c->field[0], "pigment_pattern") == 0;
    return strstr(c->field[2], "interpolate") != NULL ? 1e-6 : single ? 1e-7 : 2e-9;
}

static void every_measured_pattern_is_met(void **state)
{
    (void)state;
    Scene *s = scene_new();
    Csv c;
    int n = 0, f = 0, bad = 0;
    char last[CSV_MAX_FIELDS * 200] = "";
    for (csv_open(&c, "tests/vectors/patterns.csv"); csv_next(&c); n++) {
        bool pigment = strcmp(c.field[1], "pigment") == 0;
        if (strcmp(last, c.field[2]) != 0)
            put(s, "#declare F%d = function { %s { %s } }\n", ++f, c.field[1], c.field[2]);
        snprintf(last, sizeof last, "%s", c.field[2]);
        put(s, "#debug concat(str(F%d(%s,%s,%s)%s,0,13),\"\\n\")\n", f, c.field[4], c.field[5], c.field[6], pigment ? ".red" : "");
    }
    run(s, n);
    n = 0;
    for (csv_open(&c, "tests/vectors/patterns.csv"); csv_next(&c); n++)
        if (!(fabs(s->value[n] - csv_number(&c, 7)) <= tolerance(&c))) {
            print_error("line %d: %s at %s %s %s is %.10f, not %s\n", c.line, c.field[2], c.field[4], c.field[5], c.field[6],
                        s->value[n], c.field[7]);
            bad++;
        }
    assert_int_equal(bad, 0);
    scene_free(s);
}

static void every_measured_warp_is_met(void **state)
{
    (void)state;
    Scene *s = scene_new();
    Csv c;
    int n = 0, f = 0, bad = 0;
    char last[4000] = "";
    for (csv_open(&c, "tests/vectors/warps.csv"); csv_next(&c); n++) {
        if (strcmp(last, c.field[0]) != 0) {
            f++;
            for (const char *axis = "xyz"; *axis != 0; axis++)
                put(s, "#declare F%d%c = function { pattern { function { 0.5+%c/1000 } frequency 0 %s } }\n", f, *axis, *axis,
                    c.field[0]);
        }
        snprintf(last, sizeof last, "%s", c.field[0]);
        for (const char *axis = "xyz"; *axis != 0; axis++)
            put(s, "#debug concat(str((F%d%c(%s,%s,%s)-0.5)*1000,0,12),\"\\n\")\n", f, *axis, c.field[1], c.field[2], c.field[3]);
    }
    run(s, 3 * n);
    n = 0;
    for (csv_open(&c, "tests/vectors/warps.csv"); csv_next(&c); n++)
        for (int axis = 0; axis < 3; axis++)
            if (!(fabs(s->value[3 * n + axis] - csv_number(&c, 4 + axis)) <= 2e-9)) {
                print_error("line %d: %s: coordinate %d is %.10f\n", c.line, c.field[0], axis, s->value[3 * n + axis]);
                bad++;
            }
    assert_int_equal(bad, 0);
    scene_free(s);
}

/* All the steps of z^2 + c, and what the interior types 1, 4 and 6 make of them. */
static void captured(double re, double im, int steps, double out[3])
{
    double a = re, b = im, least = a * a + b * b;
    for (int i = 0; i < steps; i++) {
        double next = a * a - b * b + re;
        b = a * b + a * b + im;
        a = next;
        least = fmin(least, a * a + b * b);
    }
    out[0] = sqrt(least);
    out[1] = a * a;
    out[2] = a * a + b * b;
}

static void whole_turns_of_an_orbit_may_be_left_out(void **state)
{
    (void)state;
    static const double c[][2] = {             /* periods 1, 1, 2, 3, 4, 5 */
        { 0, 0 }, { 0.1, -0.2 }, { -1.02, 0.03 }, { -0.13, 0.74 }, { -1.31, 0.01 }, { -0.505, 0.563 },
    };
    static const int steps[] = { 1, 2, 501, 502, 503, 504 }, type[3] = { 1, 4, 6 };
    enum { N = sizeof c / sizeof *c, M = sizeof steps / sizeof *steps };
    Scene *s = scene_new();
    for (int i = 0; i < N * M * 3; i++) {
        put(s, "#declare F%d = function { pattern { mandel %d interior %d, 1 frequency 0 } }\n", i, steps[i / 3 % M], type[i % 3]);
        put(s, "#debug concat(str(F%d(%g,%g,0),0,13),\"\\n\")\n", i, c[i / 3 / M][0], c[i / 3 / M][1]);
    }
    run(s, N * M * 3);
    for (int i = 0; i < N * M; i++) {
        double expected[3];
        captured(c[i / M][0], c[i / M][1], steps[i % M], expected);
        for (int t = 0; t < 3; t++)
            assert_float_equal(s->value[3 * i + t], expected[t], 1e-12);
    }
    scene_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_measured_pattern_is_met), cmocka_unit_test(every_measured_warp_is_met),
        cmocka_unit_test(whole_turns_of_an_orbit_may_be_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
