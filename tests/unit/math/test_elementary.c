/* test_elementary.c - the branchless functions are within one unit in the last place of the exact values. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "math/elementary.h"
#include "math/noise.h"

static double units_apart(double got, long double exact)
{
    double near = (double)exact;
    double unit = nextafter(fabs(near), INFINITY) - fabs(near);
    return (double)fabsl(((long double)got - exact) / (long double)unit);
}

static double random_number(unsigned *seed)
{
    double v = noise_sample(seed);
    return (v * 32768 + noise_sample(seed)) / 1073741824.0;
}

static void sine_and_cosine_are_within_a_unit(void **state)
{
    (void)state;
    unsigned seed = 1;
    for (int i = 0; i < 300000; i++) {
        double x = (random_number(&seed) * 2 - 1) * (i % 3 == 0 ? 4 : i % 3 == 1 ? 1000 : 0x1p19);
        if (i % 10 == 0)
            x = nearbyint(x) * 1.5707963267948966; /* where digits cancel */
        if (!elementary_angle_holds(x))
            continue;
        assert_true(units_apart(elementary_sin(x), sinl((long double)x)) < 1);
        assert_true(units_apart(elementary_cos(x), cosl((long double)x)) < 1);
    }
    assert_true(elementary_sin(0) == 0 && elementary_cos(0) == 1);
}

static void exponential_and_logarithm_are_within_a_unit(void **state)
{
    (void)state;
    unsigned seed = 2;
    for (int i = 0; i < 300000; i++) {
        double x = (random_number(&seed) * 2 - 1) * (i % 2 ? 2 : 699);
        assert_true(units_apart(elementary_exp(x), expl((long double)x)) < 1);
        double y = i % 2 ? 0.5 + random_number(&seed) : exp(x * 0.9);
        assert_true(units_apart(elementary_ln(y), logl((long double)y)) < 1);
    }
    assert_true(elementary_ln(1) == 0 && elementary_exp(0) == 1);
}

static void arc_tangents_of_quotients_are_within_two_units(void **state)
{
    (void)state;
    unsigned seed = 3;
    double worst = 0;
    for (int i = 0; i < 300000; i++) {
        double y = random_number(&seed) * 2 - 1, x = random_number(&seed) * 2 - 1;
        if (i % 4 == 0)
            y *= exp(-30 * random_number(&seed));
        if (i % 4 == 1)
            x *= exp(-300 * random_number(&seed));
        double off = units_apart(elementary_atan2(y, x), atan2l((long double)y, (long double)x));
        worst = off > worst ? off : worst;
    }
    assert_true(worst < 2);
    assert_true(elementary_atan2(0.0, 1) == 0 && signbit(elementary_atan2(-0.0, 1)));
    assert_true(elementary_atan2(-0.0, -2) == -0x1.921fb54442d18p1 && elementary_atan2(3, 0) == 0x1.921fb54442d18p0);
    assert_true(elementary_atan2_holds(0, 1) && !elementary_atan2_holds(0, 0) && !elementary_atan2_holds(NAN, NAN));
    assert_false(elementary_atan2_holds(INFINITY, 1));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sine_and_cosine_are_within_a_unit),
        cmocka_unit_test(exponential_and_logarithm_are_within_a_unit),
        cmocka_unit_test(arc_tangents_of_quotients_are_within_two_units),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
