/* test_noise.c - noise against the measured numbers, its tables, and its builds against each other. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

#include "base/cpu.h"
#include "lib/csv.h"
#include "math/noise_tables.h"

static const NoiseKernel *const kernels[] = CPU_TABLE(noise_kernel);

/* Kernels read the tables as they are: those of generator 3 are made by its first use. */
static int make_tables(void **state)
{
    (void)state;
    noise_value(3, &(Vec3){ 0, 0, 0 });
    return 0;
}

static void hash_and_permutation_have_their_check_sums(void **state)
{
    (void)state;
    unsigned long long sum = 0;
    for (unsigned i = 0; i < 4096; i++)
        sum += i * (unsigned long long)noise_tables.hash[i];
    assert_true(sum == 17548613913ull);
    static const uint16_t tail[] = { 1690, 2045, 1710, 2047, 0, 1, 386, 3 };
    for (int i = 0; i < 8; i++)
        assert_int_equal(noise_tables.permutation3[2044 + i], tail[i]);
    assert_true(fabs(noise_tables.gradient3[2047][2] + 0.750507912678) < 1e-12);
    assert_true(noise_random(0) == 3499211612.0 / 4294967296.0 && noise_random(2) == 3890346734.0 / 4294967296.0);
}

static void every_measured_noise_is_met(void **state)
{
    (void)state;
    Csv c;
    csv_open(&c, "tests/vectors/noise.csv");
    while (csv_next(&c)) {
        Vec3 p = vec3(csv_number(&c, 1), csv_number(&c, 2), csv_number(&c, 3));
        double got = noise_value((int)csv_number(&c, 0), &p), want = csv_number(&c, 4);
        if (fabs(got - want) > 2e-12)
            fail_msg("line %d: %.13f, not %.13f", c.line, got, want);
    }
}

static void every_measured_vector_noise_and_turbulence_is_met(void **state)
{
    (void)state;
    Csv c;
    csv_open(&c, "tests/vectors/dnoise.csv");
    while (csv_next(&c)) {
        Vec3 p = vec3(csv_number(&c, 3), csv_number(&c, 4), csv_number(&c, 5));
        int octaves = (int)csv_number(&c, 2);
        Vec3 got = noise_vector_turbulence(&p, octaves, (float)csv_number(&c, 1), (float)csv_number(&c, 0));
        Vec3 want = vec3(csv_number(&c, 6), csv_number(&c, 7), csv_number(&c, 8));
        if (max_abs(sub(got, want)) > 4e-12)
            fail_msg("line %d: %.13f %.13f %.13f", c.line, got.x, got.y, got.z);
        Vec3 once = noise_vector(&p);
        if (octaves == 1)
            assert_memory_equal(&got, &once, sizeof got);
    }
}

static Vec3 random_point(unsigned *seed, double size)
{
    Vec3 p;
    p.x = (noise_sample(seed) / 16384.0 - 1) * size;
    p.y = (noise_sample(seed) / 16384.0 - 1) * size;
    p.z = (noise_sample(seed) / 16384.0 - 1) * size;
    return p;
}

/* Octaves are computed side by side; alone, far away and by the plainest instructions each must be the same. */
static void octaves_and_instruction_sets_give_the_same_bits(void **state)
{
    (void)state;
    const double size[] = { 3, 1e4, 1e8, 1e9, 1e12, 1e17, 1e18 };
    const NoiseKernel *base = kernels[CPU_BASE];
    unsigned seed = 7;
    for (int i = 0; i < 40000; i++) {
        Vec3 p = random_point(&seed, size[i % 7]);
        if (i % 11 == 0)
            p = vec3(floor(p.x), -0.0, i % 2 ? NAN : ceil(p.z));
        const NoiseKernel *best = kernels[i % 2 ? cpu_isa() : cpu_isa() > CPU_BASE ? CPU_AVX2 : CPU_BASE];
        for (int g = 1; g <= 3; g++) {
            double a = base->turbulence(g, &p, 6, 0.5, 2), b = best->turbulence(g, &p, 6, 0.5, 2);
            assert_memory_equal(&a, &b, sizeof a);
            double many[6], scale = 4;
            best->octaves(g, &p, 4, 2, 6, many);
            for (int k = 0; k < 6; k++, scale *= 2) {
                Vec3 q = scaled(p, scale);
                a = base->value(g, &q);
                assert_memory_equal(&a, &many[k], sizeof a);
            }
        }
        double a = base->ridges(1 + i % 3, &p);
        double b = best->ridges(1 + i % 3, &p);
        assert_memory_equal(&a, &b, sizeof a);
        Vec3 v = base->vector_turbulence(&p, 6, 0.5, 2), w = best->vector_turbulence(&p, 6, 0.5, 2);
        assert_memory_equal(&v, &w, sizeof v);
        Vec2 pair = base->pair_turbulence(&p, 6, 0.5, 2), two = best->pair_turbulence(&p, 6, 0.5, 2);
        assert_true(pair.u == v.x && pair.v == v.y && two.u == v.x && two.v == v.y);
        const Vec3 amount = { 0.5, -3, i % 3 };
        Vec3 moved = p, moved_best = p, sum = add(p, mul(amount, v));
        base->displace(&moved, &amount, 6, 0.5, 2);
        best->displace(&moved_best, &amount, 6, 0.5, 2);
        if (!isnan(p.z)) {
            assert_memory_equal(&moved, &sum, sizeof sum);
            assert_memory_equal(&moved_best, &sum, sizeof sum);
        }
        w = base->vector(&p);
        for (int k = 1; k < 6; k++) {                      /* octaves that come back from afar */
            Vec3 q = scaled(p, ldexp(1, -k));
            w = add(w, scaled(base->vector(&q), ldexp(1, -k)));
        }
        v = best->vector_turbulence(&p, 6, 0.5, 0.5);
        assert_memory_equal(&v, &w, sizeof v);
    }
}

static void the_two_nearest_points_are_those_of_all_cubes_around(void **state)
{
    (void)state;
    unsigned seed = 11;
    for (int i = 0; i < 3000; i++) {
        Vec3 p = random_point(&seed, 5000);
        if (i % 3 == 0)
            p.y = floor(p.y);
        const double shift = 1e-10;
        Vec3 low = vec3(floor(p.x - shift), floor(p.y - shift), floor(p.z - shift));
        double least = INFINITY, next = INFINITY, got[2];
        if (!noise_two_nearest(&p, shift, got))
            return;
        for (int k = 0; k < 27; k++) {
            int x = k % 3 - 1, y = k / 3 % 3 - 1, z = k / 9 - 1;
            unsigned cell = noise_cell((long long)low.x + x, (long long)low.y + y, (long long)low.z + z);
            Vec3 q = vec3(low.x + x + noise_random(cell), low.y + y + noise_random(cell + 1), low.z + z + noise_random(cell + 2));
            double s = length2(sub(p, q));
            next = s < least ? least : s < next ? s : next;
            least = s < least ? s : least;
        }
        assert_memory_equal(&got[0], &least, sizeof least);
        assert_memory_equal(&got[1], &next, sizeof next);
    }
}

static void noise_is_continuous_and_within_its_range(void **state)
{
    (void)state;
    unsigned seed = 9;
    for (int i = 0; i < 20000; i++) {
        Vec3 p = random_point(&seed, 50);
        if (i % 2)
            p.x = floor(p.x);
        Vec3 q = add(p, vec3(1e-9, -1e-9, 1e-9));
        for (int g = 1; g <= 3; g++) {
            double a = noise_value(g, &p), b = noise_value(g, &q);
            assert_true(a >= 0 && a <= 1);
            assert_true(fabs(a - b) < 1e-7);
        }
        assert_true(max_abs(sub(noise_vector(&p), noise_vector(&q))) < 1e-7);
    }
}

static void points_without_a_place_in_the_lattice_are_harmless(void **state)
{
    (void)state;
    const double odd[] = { NAN, INFINITY, -INFINITY, 1e300, -1e19, 1e17 };
    for (int i = 0; i < 6; i++)
        for (int g = 1; g <= 3; g++) {
            double v = noise_value(g, &(Vec3){ odd[i], 0.5, 0.5 });
            assert_true(v >= 0 && v <= 1);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hash_and_permutation_have_their_check_sums),
        cmocka_unit_test(every_measured_noise_is_met),
        cmocka_unit_test(every_measured_vector_noise_and_turbulence_is_met),
        cmocka_unit_test(octaves_and_instruction_sets_give_the_same_bits),
        cmocka_unit_test(the_two_nearest_points_are_those_of_all_cubes_around),
        cmocka_unit_test(noise_is_continuous_and_within_its_range),
        cmocka_unit_test(points_without_a_place_in_the_lattice_are_harmless),
    };
    return cmocka_run_group_tests(tests, make_tables, NULL);
}
