/* test_internal.c - the built-in functions against numbers measured on the reference renderer. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "func/func.h"
#include "lib/csv.h"

static const int generator = 2;

static void every_measured_value_is_met(void **state)
{
    (void)state;
    Arena arena;
    arena_init(&arena);
    Csv c;
    csv_open(&c, "tests/vectors/internal.csv");
    int bad = 0;
    while (csv_next(&c)) {
        const Function *f = func_internal(&arena, (int)csv_number(&c, 1), &generator);
        assert_non_null(f);
        assert_int_equal(func_parameters(f), c.n - 3);
        double arguments[16];
        for (int i = 3; i < c.n; i++)
            arguments[i - 3] = csv_number(&c, i);
        double got = func_call(f, arguments), want = csv_number(&c, 2);
        if (!(fabs(got - want) <= 2e-11 * (1 + fabs(want))) && !(isnan(got) && isnan(want))) {
            print_error("line %d: %s gives %.13g, not %.13g\n", c.line, c.field[0], got, want);
            bad++;
        }
    }
    assert_int_equal(bad, 0);
    arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(every_measured_value_is_met) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
