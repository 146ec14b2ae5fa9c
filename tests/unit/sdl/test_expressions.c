/* test_expressions.c - expressions have the values that povray computes (tests/vectors/expressions.csv). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "lib/csv.h"
#include "sdl/run.h"

/* 9 significant digits, or the 15 decimals that the file has. */
static bool agrees(double got, double want)
{
    return got == want || fabs(got - want) <= 1e-9 * fabs(want) + 1e-15 || (got != got && want != want);
}

static int wrong(const Csv *c, const char *got)
{
    print_message("line %d: %s is %s, povray says %s\n", c->line, c->field[1], got, c->field[2]);
    return 1;
}

static int check_numbers(const Csv *c, const Value *v, int terms)
{
    char text[256] = "";
    bool fine = v->kind == VALUE_NUMBER && v->terms <= terms;
    char *at = c->field[2];
    for (int i = 0; i < terms; i++) {
        double want = strtod(at, &at);
        fine = fine && agrees(v->v[i], want);
        snprintf(text + strlen(text), sizeof text - strlen(text), " %.15g", v->v[i]);
    }
    return fine ? 0 : wrong(c, text);
}

/* The statement that declares Value as the row says. */
static void statement(const Csv *c, char *text, size_t size)
{
    double seed = 0;
    int number = 0;
    const char *e = c->field[1], *kind = c->field[0];
    if (sscanf(e, "rand seed %lf number %d", &seed, &number) == 2)
        snprintf(text, size, "#declare Stream = seed(%.0f); #for (I, 1, %d) #declare Value = rand(Stream); #end", seed, number);
    else if (strcmp(kind, "float") == 0)
        snprintf(text, size, "#declare Value = (%s);", e);
    else if (strcmp(kind, "vector") == 0)
        snprintf(text, size, "#declare Value = <0, 0, 0> + %s;", e);
    else
        snprintf(text, size, "#declare Value = %s;", e);
}

/* NULL if the text fails. The value is good until run_end. */
static const Value *value_of(Run *r, const char *text)
{
    static const SdlHost host = { 0 };
    static const SdlOptions options = { .width = 8, .height = 8, .strict = true };
    memset(r, 0, sizeof *r);
    arena_init(&r->arena);
    r->diag = diag_new(&r->arena);
    diag_sink(r->diag, run_show, r);
    if (setjmp(*diag_landing(r->diag)) != 0)
        return NULL;
    r->parser = parser_new(&r->arena, r->diag, &host, &options, str_of("row"), str_of(text));
    r->parser->has_gamma = true;               /* srgb colours want a gamma before any block could give it */
    r->parser->gamma_mode = GAMMA_POWER;
    r->parser->gamma = 1;
    run_statements(r->parser);
    return symbol_value(symbol_intern(r->parser, "Value", 5));
}

static int check_row(const Csv *c)
{
    Run r;
    char text[4096], shown[1024];
    int bad;
    statement(c, text, sizeof text);
    const char *kind = c->field[0];
    const Value *v = value_of(&r, text);
    if (!v) {
        bad = wrong(c, r.messages);
    } else if (strcmp(kind, "string") == 0) {
        snprintf(shown, sizeof shown, "[%.*s]", STR_ARGS(value_string(v)));
        bad = strcmp(shown, c->field[2]) != 0 ? wrong(c, shown) : 0;
    } else {
        bad = check_numbers(c, v, strcmp(kind, "float") == 0 ? 1 : strcmp(kind, "vector") == 0 ? 3 : 5);
    }
    run_end(&r);
    return bad;
}

static void every_measured_expression_has_its_value(void **state)
{
    (void)state;
    static Csv c;
    int rows = 0, bad = 0;
    csv_open(&c, "tests/vectors/expressions.csv");
    while (csv_next(&c)) {
        bad += check_row(&c);
        rows++;
    }
    assert_true(rows >= 1500);
    assert_int_equal(bad, 0);
}

/* Read from the text, and replayed in a loop, where plain arithmetic takes a short way. */
static void loops_compute_the_same_bits_as_text(void **state)
{
    (void)state;
    static Csv c;
    csv_open(&c, "tests/vectors/expressions.csv");
    while (csv_next(&c)) {
        Run once, loop;
        char text[4096], looped[8192];
        statement(&c, text, sizeof text);
        snprintf(looped, sizeof looped, "#declare Value = 0; #for (Round_, 0, 0) %s #if (%s) #end #end", text,
                 strcmp(c.field[0], "float") == 0 && !strstr(text, "rand") ? c.field[1] : "1");
        const Value *a = value_of(&once, text), *b = value_of(&loop, looped);
        if (!b)
            print_message("%s: %s\n", looped, loop.messages);
        assert_non_null(a);
        assert_non_null(b);
        assert_int_equal(a->kind, b->kind);
        assert_int_equal(a->terms, b->terms);
        if (a->kind == VALUE_NUMBER)
            assert_memory_equal(a->v, b->v, sizeof a->v);
        run_end(&once);
        run_end(&loop);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_measured_expression_has_its_value),
        cmocka_unit_test(loops_compute_the_same_bits_as_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
