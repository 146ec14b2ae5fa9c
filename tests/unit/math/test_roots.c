/* test_roots.c - polynomials made from known roots give them back. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "math/roots.h"

static uint64_t state_ = 1;

static double uniform(double lo, double hi)
{
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return lo + (hi - lo) * ((double)(state_ >> 11) * 0x1p-53);
}

/* c := c (x - r) */
static void times_root(double *c, int *n, double r)
{
    c[*n + 1] = c[*n];
    for (int k = *n; k > 0; k--)
        c[k] = c[k - 1] - r * c[k];
    c[0] *= -r;
    (*n)++;
}

/* c := c (x^2 + b x + d), without real roots */
static void times_complex(double *c, int *n, double re, double im)
{
    double b = -2 * re, d = re * re + im * im, out[40] = { 0 };
    for (int k = 0; k <= *n; k++) {
        out[k + 2] += c[k];
        out[k + 1] += b * c[k];
        out[k] += d * c[k];
    }
    *n += 2;
    memcpy(c, out, (size_t)(*n + 1) * sizeof *c);
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void roots_put_in_come_out(void **state)
{
    (void)state;
    for (int round = 0; round < 20000; round++) {
        double c[40] = { 1 }, root[40], want[40];
        int n = 0, reals = 1 + round % 4, pairs = round / 4 % 3;
        for (int i = 0; i < reals; i++) {
            double r;
            bool apart;
            do {
                r = uniform(-1, 1);
                apart = true;
                for (int j = 0; j < i; j++)
                    apart &= fabs(r - want[j]) > 0.02;
            } while (!apart);
            want[i] = r;
            times_root(c, &n, r);
        }
        for (int i = 0; i < pairs; i++)
            times_complex(c, &n, uniform(-1, 1), uniform(0.1, 1));
        qsort(want, (size_t)reals, sizeof *want, ascending);
        double k = ldexp(1, (int)uniform(-200, 200));
        for (int i = 0; i <= n; i++)
            c[i] *= k;
        int got = roots_all(c, n, root);
        if (got != reals)
            fail_msg("round %d: %d roots of degree %d, expected %d", round, got, n, reals);
        for (int i = 0; i < reals; i++)
            assert_true(fabs(root[i] - want[i]) < 1e-8);
        got = roots_between(c, n, -1.5, 1.5, root);
        assert_int_equal(got, reals);
        for (int i = 0; i < reals; i++)
            assert_true(fabs(root[i] - want[i]) < 1e-6);
    }
}

static void roots_follow_powers_of_two_exactly(void **state)
{
    (void)state;
    for (int round = 0; round < 2000; round++) {
        double c[5], moved[5], root[4], other[4];
        int k = (int)uniform(-100, 100);
        for (int i = 0; i <= 4; i++) {
            c[i] = uniform(-1, 1);
            moved[i] = ldexp(c[i], -k * i);
        }
        int n = roots_all(c, 4, root), m = roots_all(moved, 4, other);
        assert_int_equal(n, m);
        for (int i = 0; i < n; i++)
            assert_true(ldexp(root[i], k) == other[i]);
    }
}

static void wilkinsons_polynomial_of_degree_ten(void **state)
{
    (void)state;
    double c[40] = { 1 }, root[40];
    int n = 0;
    for (int i = 1; i <= 10; i++)
        times_root(c, &n, i);
    assert_int_equal(roots_all(c, n, root), 10);
    for (int i = 0; i < 10; i++)
        assert_true(fabs(root[i] - (i + 1)) < 1e-6);
}

static void a_chebyshev_polynomial_of_degree_35_has_all_its_roots(void **state)
{
    (void)state;
    double a[36] = { 1 }, b[36] = { 0, 1 }, root[35];
    for (int n = 2; n <= 24; n++) {
        double next[36] = { 0 };
        for (int k = 0; k < n; k++)
            next[k + 1] += 2 * b[k];
        for (int k = 0; k < n; k++)
            next[k] -= a[k];
        memcpy(a, b, sizeof a);
        memcpy(b, next, sizeof b);
        int got = roots_between(b, n, -1, 1, root);
        if (n <= 16) {
            assert_int_equal(got, n);
            for (int i = 0; i < n; i++)
                assert_true(fabs(root[i] - cos((2 * (n - i) - 1) * 3.14159265358979323846 / (2 * n))) < 1e-6);
        }
    }
    double c[36] = { 0 };
    c[35] = 1;
    c[0] = -1;
    assert_int_equal(roots_all(c, 35, root), 1);
    assert_true(root[0] == 1);
}

static void touches_count_once(void **state)
{
    (void)state;
    double root[4];
    const double square[] = { 0.0625, -0.5, 1 }, fourth[] = { 0, 0, 1, -2, 1 };      /* (x - 1/4)^2, x^2 (x - 1)^2 */
    assert_int_equal(roots_between(square, 2, -1, 1, root), 1);
    assert_true(fabs(root[0] - 0.25) < 1e-7);
    assert_int_equal(roots_all(fourth, 4, root), 2);
    assert_true(root[0] == 0 && fabs(root[1] - 1) < 1e-7);
}

static void nothing_comes_of_nothing(void **state)
{
    (void)state;
    double root[4];
    const double zero[5] = { 0 }, one[5] = { 1 };
    assert_int_equal(roots_all(zero, 4, root), 0);
    assert_int_equal(roots_all(one, 4, root), 0);
    assert_int_equal(roots_between(zero, 4, -1, 1, root), 0);
    assert_int_equal(roots_quadratic(0, 0, 1, root), 0);
    assert_int_equal(roots_quadratic(1, 0, 1, root), 0);
}

static void small_roots_of_a_quadratic_keep_their_digits(void **state)
{
    (void)state;
    double root[2];
    assert_int_equal(roots_quadratic(1, -5e7, 1, root), 2);
    assert_true(fabs(root[0] - 1e-8) < 1e-22);
    assert_true(fabs(root[1] - 1e8) < 1e-6);
}

static void leading_terms_that_almost_vanish_do_no_harm(void **state)
{
    (void)state;
    for (int k = 14; k < 300; k += 7) {
        const double c[5] = { -0.119465, 1e-15, 1, ldexp(0.3, -k), ldexp(1, -2 * k) };
        double root[4];
        assert_int_equal(roots_all(c, 4, root), 2);
        assert_true(fabs(root[0] + sqrt(0.119465)) < 1e-4 && fabs(root[1] - sqrt(0.119465)) < 1e-4);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roots_put_in_come_out),
        cmocka_unit_test(roots_follow_powers_of_two_exactly),
        cmocka_unit_test(wilkinsons_polynomial_of_degree_ten),
        cmocka_unit_test(a_chebyshev_polynomial_of_degree_35_has_all_its_roots),
        cmocka_unit_test(touches_count_once),
        cmocka_unit_test(leading_terms_that_almost_vanish_do_no_harm),
        cmocka_unit_test(nothing_comes_of_nothing),
        cmocka_unit_test(small_roots_of_a_quadratic_keep_their_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
