/* test_turns.c - where a ramp begins again. */
#include "pattern/pattern.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#undef fail
#include <cmocka.h>

static double as_given(const void *params, const PatternPoint *at)
{
    (void)params;
    return at->p.x;
}

static void ramps_begin_again_where_fmod_does(void **state)
{
    (void)state;
    const PatternOps row = { .value = as_given };
    const Pattern ramp = { .ops = &row, .frequency = 1 };
    for (int turns = 0; turns < 1100000; turns += 1 + turns / 30) {
        double v = turns * 1.00001;
        for (int i = 0; i < 5; i++)
            v = nextafter(v, 0);
        for (int i = 0; i < 10; i++, v = nextafter(v, INFINITY))
            for (int sign = -1; sign <= 1; sign += 2) {
                double rest = fmod(sign * v, 1.00001), expected = rest < 0 ? rest - floor(rest) : rest;
                double got = pattern_value_at(&ramp, vec3(sign * v, 0, 0), NULL);
                assert_true(got == expected);
            }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(ramps_begin_again_where_fmod_does) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
