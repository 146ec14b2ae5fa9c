/* test_fractal.c - fractal patterns: the kernel of several points against the loop of one. */
#include "pattern/fractal.h"
#include "pattern/pattern.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

extern const PatternOps pattern_mandel;        /* its functions serve all kinds */

static void points_of_a_fractal_side_by_side_are_as_one_by_one(void **state)
{
    (void)state;
    enum { N = 31 };
    Vec3 p[N];
    for (int i = 0; i < N; i++)
        p[i] = vec3(-2 + i * 0.123, 0.9 - i % 7 * 0.21, 0);
    for (int kind = FRACTAL_MANDEL; kind <= FRACTAL_MAGNET_JULIA; kind++)
        for (int magnet = 1; magnet <= 2; magnet++)
            for (int type = 0; type <= 6; type++) {
                Fractal f = { .kind = (FractalKind)kind, .magnet = magnet, .c = { -0.12, 0.75 }, .iterations = 150 + type,
                              .exponent = magnet == 1 ? 2 : 3, .exterior = type, .interior = type,
                              .exterior_factor = 0.7, .interior_factor = 1.3 };
                double many[N];
                pattern_mandel.values(&f, NULL, p, many, N);
                for (int i = 0; i < N; i++) {
                    double one = pattern_mandel.value(&f, &(PatternPoint){ .p = p[i] });
                    assert_memory_equal(&many[i], &one, sizeof one);
                }
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(points_of_a_fractal_side_by_side_are_as_one_by_one) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
