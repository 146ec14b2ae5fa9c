/* test_chi_square.c - quantiles as printed in tables, and where POV-Ray differs. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "math/chi_square.h"

static void quantiles_are_those_of_the_tables(void **state)
{
    (void)state;
    assert_true(fabs(chi_square_quantile(1, 0.05) - 3.841459) < 1e-6);
    assert_true(fabs(chi_square_quantile(6, 0.9) - 2.204131) < 1e-6);
    assert_true(fabs(chi_square_quantile(10, 0.5) - 9.341818) < 1e-6);
    assert_true(fabs(chi_square_quantile(100, 0.95) - 77.929465) < 1e-5);
}

static void only_few_degrees_err(void **state)
{
    (void)state;
    for (uint32_t k = 1; k < 60; k++) {
        double right = chi_square_quantile(k, 0.9), pov = chi_square_quantile_pov(k, 0.9);
        if (k % 2 == 1 && k < 26)
            assert_true(pov > right * 1.007 && pov < right * 1.1);
        else
            assert_true(pov == right);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quantiles_are_those_of_the_tables),
        cmocka_unit_test(only_few_degrees_err),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
