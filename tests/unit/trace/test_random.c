/* test_random.c - streams, hashes and sequences give the numbers measured on the reference (03-camera-and-sampling). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/arena.h"
#include "math/mersenne.h"
#include "trace/random.h"

static void the_twister_is_the_standard_one(void **state)
{
    (void)state;
    Mersenne m;
    mersenne_seed(&m, 5489);
    uint32_t last = 0;
    for (int i = 0; i < 10000; i++)
        last = mersenne_next(&m);
    assert_true(last == 4123659995u);          /* as the C++ standard asks of mt19937 */
}

static void the_stream_starts_with_its_second_entry(void **state)
{
    (void)state;
    static double table[STREAM_SIZE];
    static const double expected[] = { 0.135477, 0.905792, 0.835009, 0.126987, 0.968868, 0.913376 };
    mersenne_fill(table, STREAM_SIZE);
    Streams s;
    streams_start(&s, table, 0);
    for (int i = 0; i < 6; i++)
        assert_true(fabs(streams_uniform(&s) - expected[i]) < 1e-6);
    for (int i = 0; i < STREAM_SIZE - 6; i++)
        streams_uniform(&s);
    assert_true(fabs(streams_uniform(&s) - expected[0]) < 1e-6);       /* round and round */
}

static void skipping_is_drawing_without_looking(void **state)
{
    (void)state;
    static const uint32_t counts[] = { 0, 1, 32, STREAM_SIZE - 1, STREAM_SIZE + 5 };
    static double table[STREAM_SIZE];
    mersenne_fill(table, STREAM_SIZE);
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        Streams drawn, skipped;
        streams_start(&drawn, table, 3);
        streams_start(&skipped, table, 3);
        for (uint32_t i = 0; i < counts[k]; i++)
            streams_uniform(&drawn);
        streams_skip(&skipped, counts[k]);
        assert_true(drawn.at == skipped.at && drawn.used == skipped.used);
    }
}

static void tiles_start_in_different_places(void **state)
{
    (void)state;
    static double table[STREAM_SIZE];
    mersenne_fill(table, STREAM_SIZE);
    for (uint32_t tile = 1; tile < 1000; tile++) {
        Streams a, b;
        streams_start(&a, table, tile - 1);
        streams_start(&b, table, tile);
        assert_true(a.at != b.at && a.grain != b.grain);
    }
}

static void grain_is_within_its_range(void **state)
{
    (void)state;
    Streams s;
    streams_start(&s, NULL, 0);
    assert_true(fabs(streams_crand(&s) - 12345 / 4294967295.0) < 1e-15);
    double sum = 0;
    for (int i = 0; i < 10000; i++) {
        double u = streams_crand(&s);
        assert_true(0 <= u && u <= 1);
        sum += u;
    }
    assert_true(fabs(sum / 10000 - 0.5) < 0.02);
}

static void the_position_hash_matches_the_reference(void **state)
{
    (void)state;
    static PositionHash h;
    static const int first[] = { 2291, 2574, 3654, 1557, 1196, 3388, 2637, 1820 };
    static const float jitter[] = { -0.5f, 0.00589f, 0.011749f, -0.490234f, 0.023468f };
    static const struct { double x, y, jx, jy; } at[] = {
        { 0, 0, 0.084015, 0.084015 }, { 1.5, 2.25, -0.306641, -0.197235 }, { -1 / 3.0, 7, 0.414093, 0.412109 },
        { 10.25, 3.75, 0.390625, -0.339813 }
    };
    position_hash_fill(&h);
    for (int i = 0; i < 8; i++)
        assert_int_equal(h.permutation[i], first[i]);
    assert_int_equal(h.permutation[100], 1305);
    assert_int_equal(h.permutation[4095], 3088);
    for (int i = 0; i < 5; i++)
        assert_true(h.jitter[i] == jitter[i]);
    assert_true(h.jitter[255] == 0.001953f);
    for (int i = 0; i < 4; i++) {
        Vec2 j = position_jitter(&h, at[i].x, at[i].y);
        assert_true(fabs(j.u - at[i].jx) < 1e-6 && fabs(j.v - at[i].jy) < 1e-6);
    }
}

static void the_radical_inverse_mirrors_digits(void **state)
{
    (void)state;
    static const double two[] = { 0, 0.5, 0.25, 0.75, 0.125 };
    for (uint32_t i = 0; i < 5; i++)
        assert_true(radical_inverse(2, i) == two[i]);
    assert_true(fabs(radical_inverse(3, 5) - 7 / 9.0) < 1e-15);
    for (uint32_t i = 1; i < 1000; i++)
        assert_true(radical_inverse(3, i) > 0 && radical_inverse(3, i) < 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_twister_is_the_standard_one),
        cmocka_unit_test(the_stream_starts_with_its_second_entry),
        cmocka_unit_test(skipping_is_drawing_without_looking),
        cmocka_unit_test(tiles_start_in_different_places),
        cmocka_unit_test(grain_is_within_its_range),
        cmocka_unit_test(the_position_hash_matches_the_reference),
        cmocka_unit_test(the_radical_inverse_mirrors_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
