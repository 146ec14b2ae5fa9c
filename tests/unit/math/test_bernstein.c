/* test_bernstein.c - roots on [0, 1], and the promise that pieces agree where they meet. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "math/bernstein.h"

static uint64_t state_of_random = 88172645463325252u;

static double random_unit(void)
{
    state_of_random ^= state_of_random << 13;
    state_of_random ^= state_of_random >> 7;
    state_of_random ^= state_of_random << 17;
    return (double)(state_of_random >> 11) * 0x1p-53;
}

/* The product of (x - r) and the constant 1, by Bernstein products. */
static void from_roots(const double *r, int n, double *out)
{
    out[0] = 1;
    for (int i = 0; i < n; i++) {
        double linear[2] = { -r[i], 1 - r[i] }, next[BERNSTEIN_MAX + 1];
        bernstein_product(out, i, linear, 1, next);
        for (int k = 0; k <= i + 1; k++)
            out[k] = next[k];
    }
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void known_roots_are_found(void **state)
{
    (void)state;
    for (int turn = 0; turn < 20000; turn++) {
        int n = 1 + turn % 6, expected = 0;
        double r[6], inside[6], b[BERNSTEIN_MAX + 1], found[BERNSTEIN_MAX];
        double gap = 1;
        for (int i = 0; i < n; i++) {
            r[i] = -1 + 3 * random_unit();
            for (int k = 0; k < i; k++)
                gap = fmin(gap, fabs(r[i] - r[k]));
            gap = fmin(gap, fmin(fabs(r[i]), fabs(r[i] - 1)));
            if (r[i] > 0 && r[i] < 1)
                inside[expected++] = r[i];
        }
        if (gap < 1e-3)
            continue;
        qsort(inside, (size_t)expected, sizeof *inside, ascending);
        from_roots(r, n, b);
        assert_int_equal(bernstein_roots(b, n, found), expected);
        for (int i = 0; i < expected; i++)
            assert_true(fabs(found[i] - inside[i]) < 1e-9);
    }
}

static void the_number_of_roots_is_odd_if_the_ends_differ(void **state)
{
    (void)state;
    for (int turn = 0; turn < 50000; turn++) {
        int n = 1 + turn % 10;
        double b[BERNSTEIN_MAX + 1], found[BERNSTEIN_MAX];
        for (int i = 0; i <= n; i++) {
            b[i] = floor(random_unit() * 5) - 2;           /* zeros and double roots in plenty */
            if (turn % 3 == 0)
                b[i] *= exp(80 * (random_unit() - 0.5));
        }
        int count = bernstein_roots(b, n, found);
        assert_int_equal(count & 1, (b[0] < 0) != (b[n] < 0));
        for (int i = 0; i < count; i++) {
            assert_true(found[i] >= 0 && found[i] <= 1);
            assert_true(i == 0 || found[i - 1] <= found[i]);
        }
    }
}

static void a_zero_at_an_end_hides_no_root(void **state)
{
    (void)state;
    const double b[7] = { -0.72, -0.48, -0.24266666666666672, -0.07275, -0.0071666666666666337, 0.0083333333333333592, 0 };
    double found[BERNSTEIN_MAX];
    assert_int_equal(bernstein_roots(b, 6, found), 1);
    assert_true(fabs(bernstein_value(b, 6, found[0])) < 1e-15);
    assert_true(found[0] < 0.99);
}

static void products_and_slopes_are_those_of_values(void **state)
{
    (void)state;
    for (int turn = 0; turn < 1000; turn++) {
        double a[4], b[4], ab[7], u = random_unit();
        for (int i = 0; i < 4; i++) {
            a[i] = random_unit() - 0.5;
            b[i] = random_unit() - 0.5;
        }
        bernstein_product(a, 3, b, 3, ab);
        double expected = bernstein_value(a, 3, u) * bernstein_value(b, 3, u), h = 1e-6;
        assert_true(fabs(bernstein_value(ab, 6, u) - expected) < 1e-14);
        double slope = (bernstein_value(ab, 6, u + h) - bernstein_value(ab, 6, u - h)) / (2 * h);
        assert_true(fabs(bernstein_slope(ab, 6, u) - slope) < 1e-7);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_roots_are_found),
        cmocka_unit_test(the_number_of_roots_is_odd_if_the_ends_differ),
        cmocka_unit_test(a_zero_at_an_end_hides_no_root),
        cmocka_unit_test(products_and_slopes_are_those_of_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
