/* test_eval.c - compiled functions: every width and instruction set gives the same bits, and the values are those of the tree. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

#include "func/code.h"
#include "math/noise.h"

static const int generator = 2;

static double random_number(unsigned *seed)
{
    return noise_sample(seed) / 16384.0 - 1;
}

/* A tree of random operations over x, y, z. */
static FuncNode random_tree(FuncBuilder *b, unsigned *seed, int depth)
{
    unsigned kind = noise_sample(seed) % 12;
    if (depth == 0 || kind == 0)
        return noise_sample(seed) % 4 == 0 ? func_number(b, random_number(seed) * 3) : func_parameter(b, (int)(noise_sample(seed) % 3));
    FuncNode x = random_tree(b, seed, depth - 1);
    if (kind < 4)
        return func_unary(b, (FuncOp)(FUNC_NEG + noise_sample(seed) % (FUNC_ATANH - FUNC_NEG + 1)), x);
    FuncNode y = random_tree(b, seed, depth - 1);
    if (kind < 6)
        return func_choice(b, kind == 4 ? FUNC_IF_NEGATIVE : FUNC_IF_ZERO, x, y, random_tree(b, seed, depth - 1));
    if (kind < 10)
        return func_binary(b, (FuncOp)(FUNC_ADD + noise_sample(seed) % 4), x, y);
    return func_binary(b, (FuncOp)(FUNC_EQ + noise_sample(seed) % (FUNC_MAX - FUNC_EQ + 1)), x, y);
}

static bool same_bits(double a, double b)
{
    return (isnan(a) && isnan(b)) || memcmp(&a, &b, sizeof a) == 0;
}

static void widths_and_instruction_sets_give_the_same_bits(void **state)
{
    (void)state;
    unsigned seed = 3;
    for (int tree = 0; tree < 400; tree++) {
        Arena arena;
        arena_init(&arena);
        FuncBuilder *b = func_builder(&arena, 3);
        const Function *f = func_finish(b, random_tree(b, &seed, 7));
        double p[3][16], many[16], few[16];
        for (int k = 0; k < 3; k++)
            for (int l = 0; l < 16; l++)
                p[k][l] = random_number(&seed) * (tree % 3 == 0 ? 1e6 : 3);
        const double *const rows[] = { p[0], p[1], p[2] };
        for (int isa = CPU_BASE; isa <= (int)cpu_isa(); isa++) {
            const EvalKernel *kernel = code_kernel((CpuIsa)isa);
            int n = kernel->lanes < 16 ? kernel->lanes : 16 - tree % 3;
            kernel->upto_lanes(f, rows, many, n);
            kernel->upto_4(f, rows, few, 3);
            for (int l = 0; l < n; l++) {
                double one = code_kernel(CPU_BASE)->one(f, (const double[]){ p[0][l], p[1][l], p[2][l] });
                if (!same_bits(one, many[l]) || (l < 3 && !same_bits(one, few[l])))
                    fail_msg("tree %d, set %d, lane %d: %a %a", tree, isa, l, one, many[l]);
            }
        }
        arena_free(&arena);
    }
}

/* sum(i, from, to, i x + y), asked of one point and of many. */
static void sums_are_the_same_in_turns_and_in_lanes(void **state)
{
    (void)state;
    Arena arena;
    arena_init(&arena);
    FuncBuilder *b = func_builder(&arena, 3), *in = func_loop_body(b);
    FuncNode i = func_parameter(in, 3);
    FuncNode body = func_binary(in, FUNC_ADD, func_binary(in, FUNC_MUL, i, func_parameter(in, 0)), func_parameter(in, 1));
    const Function *inner = func_finish(in, body);
    const Function *f = func_finish(b, func_loop(b, FUNC_SUM, func_number(b, 1), func_parameter(b, 2), inner));
    double p[3][16], out[16];
    unsigned seed = 4;
    for (int l = 0; l < 16; l++) {
        p[0][l] = random_number(&seed);
        p[1][l] = random_number(&seed);
        p[2][l] = l * 3.3 - 2;                 /* no turn at all, for the first */
    }
    func_eval(f, (const double *const[]){ p[0], p[1], p[2] }, out, 16);
    for (int l = 0; l < 16; l++) {
        double sum = 0;
        for (double k = 1; k <= p[2][l]; k++)
            sum += k * p[0][l] + p[1][l];
        assert_true(same_bits(out[l], sum));
        assert_true(same_bits(out[l], func_call(f, (const double[]){ p[0][l], p[1][l], p[2][l] })));
    }
    arena_free(&arena);
}

static void equal_parts_are_computed_once_and_numbers_fold(void **state)
{
    (void)state;
    Arena arena;
    arena_init(&arena);
    FuncBuilder *b = func_builder(&arena, 3);
    FuncNode x = func_parameter(b, 0), y = func_parameter(b, 1);
    assert_int_equal(func_binary(b, FUNC_ADD, x, y), func_binary(b, FUNC_ADD, y, x));
    double v;
    FuncNode four = func_binary(b, FUNC_MUL, func_number(b, 2), func_number(b, 2));
    assert_true(func_is_number(b, four, &v) && v == 4);
    FuncNode s = func_unary(b, FUNC_SIN, x);
    const Function *f = func_finish(b, func_binary(b, FUNC_MUL, s, s));
    int n = 0;
    for (const Instr *i = f->code; i->op != CODE_END; i++)
        n++;
    assert_int_equal(n, 2);                    /* one sine, one square */
    arena_free(&arena);
}

/* Called functions dissolve; calling them one by one must give the same. */
static void calls_give_what_the_callee_gives(void **state)
{
    (void)state;
    Arena arena;
    arena_init(&arena);
    unsigned seed = 5;
    for (int number = 0; number < 76; number++) {
        const Function *callee = func_internal(&arena, number, &generator);
        int n = func_parameters(callee);
        FuncBuilder *b = func_builder(&arena, n);
        FuncNode a[16];
        for (int k = 0; k < n; k++)
            a[k] = func_parameter(b, n - 1 - k);
        const Function *f = func_finish(b, func_apply(b, callee, a, FUNC_X));
        for (int turn = 0; turn < 10; turn++) {
            double forward[16], backward[16];
            for (int k = 0; k < n; k++)
                forward[k] = backward[n - 1 - k] = random_number(&seed) + 1.5;
            assert_true(same_bits(func_call(f, forward), func_call(callee, backward)));
        }
    }
    arena_free(&arena);
}

/* Each function calls the one before it, which is too long to dissolve: without a limit the stack would end first. */
static void calls_that_nest_too_deep_are_refused(void **state)
{
    (void)state;
    Arena arena;
    arena_init(&arena);
    const Function *f = NULL;
    int depth = 0;
    do {
        FuncBuilder *b = func_builder(&arena, 1);
        FuncNode v = func_parameter(b, 0);
        for (int i = 0; i < CODE_INLINE_LIMIT; i++)
            v = func_binary(b, FUNC_MUL, v, func_number(b, 1 + i * 1e-9));
        if (f != NULL)
            v = func_apply(b, f, &v, FUNC_X);
        f = func_finish(b, v);
        if (f != NULL)
            func_call(f, (const double[]){ 1 });
    } while (f != NULL && ++depth < 1000);
    assert_true(depth > 10 && depth < 100);
    arena_free(&arena);
}

static void hosts_give_components(void **state)
{
    (void)state;
    Arena arena;
    arena_init(&arena);
    const Function *h = func_of_host(&arena, &(FuncHost){ .call = NULL, .parameters = 3, .terms = 5 });
    assert_int_equal(func_terms(h), 5);
    assert_int_equal(func_parameters(h), 3);
    assert_false(func_is_cheap(h));
    const double v[5] = { 0.2, 0.4, 0.6, 0.8, 1 };
    assert_true(code_part(v, FUNC_T) == 0.8 && fabs(code_part(v, FUNC_GREY) - (0.297 * 0.2 + 0.589 * 0.4 + 0.114 * 0.6)) < 1e-15);
    arena_free(&arena);
}

/* f along a line: its values at random points of each piece, its slopes and second differences between them. */
static int check_pieces(const Function *f, unsigned *seed, double length)
{
    FuncLine line;
    double *start = line.start, *speed = line.speed, at[FUNC_PIECES + 1];
    int known = 0;
    for (int k = 0; k < 3; k++) {
        start[k] = random_number(seed) * 3;
        speed[k] = random_number(seed);
    }
    for (int i = 0; i <= FUNC_PIECES; i++)
        at[i] = length * i;
    FuncPieces out;
    func_pieces(f, &line, at, &out);
    for (int i = 0; i < FUNC_PIECES; i++) {
        bool steep_known = isfinite(out.first[i]);
        known += steep_known;
        for (int turn = 0; turn < 20; turn++) {
            double t[3], v[3], u = noise_sample(seed) / 32768.0, w = noise_sample(seed) / 32768.0;
            t[0] = fmin(at[i] + length * (u < w ? u : w), at[i + 1]);
            t[2] = fmin(at[i] + length * (u < w ? w : u), at[i + 1]);
            t[1] = (t[0] + t[2]) / 2;
            for (int m = 0; m < 3; m++)
                v[m] = func_call(f, (const double[]){ start[0] + t[m] * speed[0], start[1] + t[m] * speed[1], start[2] + t[m] * speed[2] });
            for (int m = 0; m < 3; m++)
                if (isnan(v[m]) ? out.lo[i] > -INFINITY || out.hi[i] < INFINITY : v[m] < out.lo[i] || v[m] > out.hi[i])
                    fail_msg("%.17g is not in %.17g...%.17g", v[m], out.lo[i], out.hi[i]);
            if (!steep_known)
                continue;
            double h = t[2] - t[0], slack = 1e-12 * (1 + fabs(v[0]) + fabs(v[2]) + out.first[i]);
            if (!(fabs(v[2] - v[0]) <= out.first[i] * h + slack))
                fail_msg("steeper than %g: from %.17g to %.17g within %g", out.first[i], v[0], v[2], h);
            if (isfinite(out.second[i]) && !(fabs(v[0] - 2 * v[1] + v[2]) <= out.second[i] * h * h / 4 + slack))
                fail_msg("more curved than %g: %.17g, %.17g, %.17g within %g", out.second[i], v[0], v[1], v[2], h);
        }
    }
    return known;
}

static void pieces_bound_range_slope_and_curvature(void **state)
{
    (void)state;
    unsigned seed = 6;
    int known = 0;
    for (int tree = 0; tree < 3000; tree++) {
        Arena arena;
        arena_init(&arena);
        FuncBuilder *b = func_builder(&arena, 3);
        known += check_pieces(func_finish(b, random_tree(b, &seed, 5)), &seed, tree % 2 ? 0.3 : 1e-3);
        arena_free(&arena);
    }
    assert_true(known > 3000);
}

static void pieces_bound_noise_and_whole_waves_around_an_axis(void **state)
{
    (void)state;
    unsigned seed = 7;
    Arena arena;
    arena_init(&arena);
    for (int kind = 1; kind <= 3; kind++)
        for (int i = 0; i < 200; i++)
            assert_int_equal(check_pieces(func_internal(&arena, 76, &kind), &seed, 0.1), FUNC_PIECES);
    FuncBuilder *b = func_builder(&arena, 3);
    FuncNode angle = func_binary(b, FUNC_ATAN2, func_parameter(b, 0), func_parameter(b, 2));
    const Function *waves = func_finish(b, func_unary(b, FUNC_SIN, func_binary(b, FUNC_MUL, angle, func_number(b, 12))));
    FuncPieces out;
    const double at[FUNC_PIECES + 1] = { 0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8 };
    const FuncLine line = { { -0.35, 0, -1 }, { 1, 0, 0 } };
    func_pieces(waves, &line, at, &out);      /* over the cut of atan2 */
    assert_true(out.first[3] < 13 && out.second[3] < 300);
    func_pieces(func_finish(b, angle), &line, at, &out);
    assert_true(out.first[2] < 2 && isinf(out.first[3]));
    arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(widths_and_instruction_sets_give_the_same_bits),
        cmocka_unit_test(sums_are_the_same_in_turns_and_in_lanes),
        cmocka_unit_test(equal_parts_are_computed_once_and_numbers_fold),
        cmocka_unit_test(calls_give_what_the_callee_gives),
        cmocka_unit_test(calls_that_nest_too_deep_are_refused),
        cmocka_unit_test(hosts_give_components),
        cmocka_unit_test(pieces_bound_range_slope_and_curvature),
        cmocka_unit_test(pieces_bound_noise_and_whole_waves_around_an_axis),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
