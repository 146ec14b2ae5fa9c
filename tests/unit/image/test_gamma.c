/* test_gamma.c - curves, rounding, alpha and dither of the way from colours to codes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "image/gamma.h"

static const Transfer none = { TRANSFER_NONE, 1 }, linear = { TRANSFER_POWER, 1 }, srgb = { TRANSFER_SRGB, 0 };

static float random_float(uint32_t *s)
{
    *s = *s * 1812433253u + 12345;
    return (float)(*s >> 8) / 16777216.0f;
}

static void decoding_undoes_encoding(void **state)
{
    (void)state;
    const Transfer all[] = { none, linear, srgb, { TRANSFER_POWER, 2.2 }, { TRANSFER_POWER, 0.5 } };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        for (double x = 0; x <= 1; x += 0.001)
            assert_true(fabs(transfer_encode(all[i], transfer_decode(all[i], x)) - x) < 1e-6);
}

static void nearly_equal_powers_are_equal(void **state)
{
    (void)state;
    assert_true(transfer_same((Transfer){ TRANSFER_POWER, 2.2 }, (Transfer){ TRANSFER_POWER, 2.21 }));
    assert_false(transfer_same((Transfer){ TRANSFER_POWER, 2.2 }, (Transfer){ TRANSFER_POWER, 2.3 }));
    assert_true(transfer_same(linear, none));
    assert_false(transfer_same(linear, srgb));
    assert_true(transfer_convert((Transfer){ TRANSFER_POWER, 2.2 }, (Transfer){ TRANSFER_POWER, 2.2 }, 0.3) == 0.3);
}

/* The table of steps is only a quick way to the formula. */
static void quick_rounding_has_the_codes_of_the_formula(void **state)
{
    (void)state;
    const Transfer files[] = { srgb, linear, { TRANSFER_POWER, 2.2 }, { TRANSFER_POWER, 0.4 } };
    enum { N = 4000 };
    float *rgba = malloc(N * 4 * sizeof *rgba);
    uint16_t *code = malloc(N * 4 * sizeof *code);
    uint32_t s = 7;
    for (int i = 0; i < N * 4; i++)
        rgba[i] = i % 4 < 2 ? exp2f(-16 * random_float(&s)) : random_float(&s) * 1.4f - 0.2f;
    rgba[0] = NAN;
    rgba[1] = INFINITY;
    rgba[2] = -INFINITY;
    for (size_t f = 0; f < 4; f++)
        for (int k = 0; k < 8; k++) {
            Quantising q = { .working = linear, .file = files[f], .bits = 5 + k % 4, .grey = k >= 4 };
            int max = (1 << q.bits) - 1, n = quantise_channels(&q);
            assert_true(quantise(rgba, N, 1, &q, code));
            for (int i = 0; i < N * n; i++) {
                const float *p = &rgba[4 * (i / n)];
                double v = q.grey ? 0.297 * (double)p[0] + 0.589 * (double)p[1] + 0.114 * (double)p[2] : (double)p[i % n];
                double e = transfer_convert(linear, files[f], (double)(float)v);
                assert_int_equal(code[i], e > 0 ? (int)floor(fmin(e, 1) * max + 0.5) : 0);
            }
        }
    free(rgba);
    free(code);
}

static void colours_without_a_working_gamma_are_written_as_they_are(void **state)
{
    (void)state;
    const float rgba[4] = { 0.5f, 0.25f, 0.75f, 1 };
    uint16_t code[4];
    quantise(rgba, 1, 1, &(Quantising){ .working = none, .file = srgb, .bits = 8 }, code);
    assert_int_equal(code[0], 128);
    assert_int_equal(code[1], 64);
    assert_int_equal(code[2], 191);
}

static void colours_are_divided_by_alpha_and_highlights_raise_it(void **state)
{
    (void)state;
    Quantising q = { .working = linear, .file = linear, .bits = 8, .alpha = true };
    uint16_t code[4];
    const float half[4] = { 0.25f, 0.1f, 0, 0.5f }, bright[4] = { 0.6f, 0.6f, 0.6f, 0 };
    quantise(half, 1, 1, &q, code);
    assert_int_equal(code[0], 128);
    assert_int_equal(code[1], 51);
    assert_int_equal(code[3], 128);
    quantise(bright, 1, 1, &q, code);
    assert_int_equal(code[0], 255);
    assert_int_equal(code[3], 153);
}

/* Dither moves single codes but not the mean. */
static void dither_keeps_the_mean(void **state)
{
    (void)state;
    enum { W = 48, H = 48 };
    static float rgba[W * H * 4];
    static uint16_t code[W * H * 3];
    for (int i = 0; i < W * H * 4; i++)
        rgba[i] = 0.3f;
    const DitherKind kinds[] = { DITHER_B2, DITHER_B3, DITHER_B4, DITHER_D1, DITHER_D2, DITHER_FS };
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        Quantising q = { .working = linear, .file = linear, .bits = 5, .dither = kinds[k] };
        assert_true(quantise(rgba, W, H, &q, code));
        double sum = 0;
        int differ = 0;
        for (int i = 0; i < W * H * 3; i++) {
            sum += code[i] / 31.0;
            differ += code[i] != code[0];
            assert_true(fabs(code[i] / 31.0 - 0.3) < 1.6 / 31);
        }
        assert_true(differ > 0);
        double bias = kinds[k] == DITHER_B2 || kinds[k] == DITHER_B3 || kinds[k] == DITHER_B4 ? 0.01 : 0.003;
        assert_true(fabs(sum / (W * H * 3) - 0.3) < bias);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decoding_undoes_encoding),
        cmocka_unit_test(nearly_equal_powers_are_equal),
        cmocka_unit_test(quick_rounding_has_the_codes_of_the_formula),
        cmocka_unit_test(colours_without_a_working_gamma_are_written_as_they_are),
        cmocka_unit_test(colours_are_divided_by_alpha_and_highlights_raise_it),
        cmocka_unit_test(dither_keeps_the_mean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
