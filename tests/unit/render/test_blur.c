/* test_blur.c - apertures are filled evenly, and sampling stops where the reference stops. */
#include "render/blur.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

static CameraDef camera_of(int samples)
{
    return (CameraDef){ .aperture = 0.5, .blur_samples = samples, .confidence = 0.9, .variance = 1e-4 };
}

static void thresholds_are_those_of_the_reference(void **state)
{
    (void)state;
    static const double expected[] = { 7.164e-7, 9.560e-6, 2.651e-5, 4.826e-5, 7.306e-5, 1e-4, 1.285e-4 };
    Arena arena;
    arena_init(&arena);
    CameraDef def = camera_of(7);
    const Blur *blur = blur_new(&arena, &def);
    for (int m = 2; m <= 7; m += 2)
        assert_true(fabs(blur->threshold[m] / expected[m - 1] - 1) < 1e-3);
    for (int m = 1; m <= 7; m += 2)            /* the reference errs upwards here, most for m = 1 */
        assert_true(blur->threshold[m] > expected[m - 1] && blur->threshold[m] < 1.1 * expected[m - 1]);
    def = camera_of(1);
    assert_true(blur_new(&arena, &def)->threshold[1] == 0);
    arena_free(&arena);
}

static void ten_samples_fill_up_the_grid_of_seven(void **state)
{
    (void)state;
    static const Vec2 expected[] = { { -0.176777, 0.306186 }, { 0.331707, 0.278335 }, { 0.068640, -0.389279 } };
    Arena arena;
    arena_init(&arena);
    CameraDef def = camera_of(10);
    const Blur *blur = blur_new(&arena, &def);
    for (int i = 0; i < 3; i++)
        assert_true(fabs(blur->place[7 + i].u - expected[i].u) < 1e-6 && fabs(blur->place[7 + i].v - expected[i].v) < 1e-6);
    arena_free(&arena);
}

static void places_lie_within_the_aperture_and_balance(void **state)
{
    (void)state;
    Arena arena;
    arena_init(&arena);
    for (int n = 1; n <= 300; n += n < 60 ? 1 : 37) {
        CameraDef def = camera_of(n);
        const Blur *blur = blur_new(&arena, &def);
        Vec2 sum = { 0, 0 };
        for (int i = 0; i < n; i++) {
            Vec2 p = blur->place[i];
            assert_true(p.u * p.u + p.v * p.v <= 0.2501);
            sum.u += p.u;
            sum.v += p.v;
        }
        if (n == 7 || n == 19 || n == 37)
            assert_true(fabs(sum.u) < 1e-5 && fabs(sum.v) < 1e-5);
    }
    arena_free(&arena);
}

static void no_aperture_is_no_blur(void **state)
{
    (void)state;
    Arena arena;
    arena_init(&arena);
    CameraDef def = camera_of(0);
    assert_null(blur_new(&arena, &def));
    def = camera_of(5);
    def.aperture = 0;
    assert_null(blur_new(&arena, &def));
    arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(thresholds_are_those_of_the_reference),
        cmocka_unit_test(ten_samples_fill_up_the_grid_of_seven),
        cmocka_unit_test(places_lie_within_the_aperture_and_balance),
        cmocka_unit_test(no_aperture_is_no_blur),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
