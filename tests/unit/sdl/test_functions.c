/* test_functions.c - the grammar of user functions, against values measured on the reference renderer, and its errors. */
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

static const char head[] =
    "#version 3.7; global_settings { assumed_gamma 1 }\n"
    "#declare C = 3; #declare V = <1,2,3>; #declare A = array[2] {4,5}\n"
    "#declare G = function(a,b) { a-b }\n"
    "#declare P = function { pattern { bozo scale 0.7 } }\n"
    "#declare K = function { pigment { gradient x color_map { [0 rgb <1,0,0>][1 rgb <0,1,0.5>] } } }\n"
    "#declare T = function { transform { rotate 90*y translate <1,2,3> } }\n"
    "#declare S = function { spline { linear_spline 0,<0,0,0> 1,<1,2,3> 2,<3,2,1> } }\n";

typedef struct Said { double value; char error[1024]; } Said;

static void show(void *user, const WhitMessage *m)
{
    Said *s = user;
    if (m->kind == WHIT_DEBUG)
        s->value = strtod(m->text, NULL);
    else if (m->kind == WHIT_ERROR)
        snprintf(s->error, sizeof s->error, "%s", m->text);
}

static Said run(const char *statement)
{
    Said said = { .value = NAN };
    char text[8192];
    int n = snprintf(text, sizeof text, "%s%s\n", head, statement);
    WhitOptions options = { 0 };
    Whit *w = whit_new(&options);
    whit_show(w, show, &said);
    whit_load_text(w, "functions.pov", text, (size_t)n);
    whit_free(w);
    return said;
}

static void every_measured_expression_is_met(void **state)
{
    (void)state;
    Csv c;
    int bad = 0;
    for (csv_open(&c, "tests/vectors/functions.csv"); csv_next(&c);) {
        char text[4096];
        snprintf(text, sizeof text, "#declare F = function%s { %s } #debug concat(str(F(%s),0,13),\"\\n\")", c.field[0], c.field[1],
                 c.field[2]);
        Said said = run(text);
        double want = csv_number(&c, 3), near = strchr(c.field[1], 'K') != NULL ? 1e-6 : 2e-12;
        if (!(fabs(said.value - want) <= near * (1 + fabs(want)))) {
            print_error("line %d: %s at %s is %.13g, not %s %s\n", c.line, c.field[1], c.field[2], said.value, c.field[3], said.error);
            bad++;
        }
    }
    assert_int_equal(bad, 0);
}

static void mistakes_are_told(void **state)
{
    (void)state;
    static const struct { const char *text, *error; } table[] = {
        { "#declare F = function { x + V }", "operand" },
        { "#declare F = function { --x }", "operand" },
        { "#declare F = function { x/0 }", "Division by zero." },
        { "#declare F = function { internal(99) }", "Function 'internal(99)' does not exist." },
        { "#declare F = function { pattern { slope x } }", "Invalid pattern" },
        { "#declare F = function(a,a) { a }", "two parameters" },
        { "#declare F = function { T(x,y,z) }", "period" },
        { "#declare F = function { T(x,y,z).t }", "Bad operands" },
        { "#declare F = function { F(x,y,z) }", "operand" },
        { "#declare F = function { G(x) }", "operand" },
        { "#declare F = function { sin(x }", ")" },
        { "#declare F = function { select(x,1) }", "arguments" },
        { "#declare F = function { x y }", "}" },
        { "#declare F = function { unknown }", "operand" },
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        Said said = run(table[i].text);
        if (strstr(said.error, table[i].error) == NULL)
            fail_msg("%s: %s", table[i].text, said.error);
    }
}

static void values_are_frozen_when_the_function_is_read(void **state)
{
    (void)state;
    Said said = run("#declare F = function { C*x + A[1] } #declare C = 100; #declare A[1] = 7; #debug concat(str(F(2,0,0),0,3),\"\\n\")");
    assert_true(said.value == 11);
}

static void deep_nesting_ends_in_an_error_not_a_crash(void **state)
{
    (void)state;
    enum { DEEP = 3000 };
    char *text = malloc(4 * DEEP);
    strcpy(text, "#declare F = function { ");
    memset(text + strlen(text), '(', DEEP);
    text[24 + DEEP] = 0;
    Said said = run(text);
    assert_true(said.error[0] != 0);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_measured_expression_is_met),
        cmocka_unit_test(mistakes_are_told),
        cmocka_unit_test(values_are_frozen_when_the_function_is_read),
        cmocka_unit_test(deep_nesting_ends_in_an_error_not_a_crash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
