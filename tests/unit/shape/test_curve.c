/* test_curve.c - curves sorted by rows say the same as curves asked piece by piece. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#undef fail                                    /* base/diag.h has a better one */

#include "lib/bodies.h"
#include "shape/curve.h"

enum { MAX_PIECES = 300 };

/* A closed line, straight or of cubic pieces; steep: every piece spans half the height. */
static Curve random_outline(Arena *a, Dice *d, uint32_t n, int degree, bool steep)
{
    Curve c = { .piece = arena_array(a, CurvePiece, n), .n = n };
    Vec2 first = { dice(d), floor(8 * dice(d)) / 8 }, p[4] = { first };
    for (uint32_t i = 0; i < n; i++) {
        for (int k = 1; k <= degree; k++)
            p[k] = (Vec2){ dice(d), floor(8 * dice(d)) / 8 + (steep && k == degree && i % 2 ? 8 : 0) };
        if (i == n - 1)
            p[degree] = first;
        c.piece[i] = curve_piece(p, degree);
        p[0] = p[degree];
    }
    return c;
}

static void points_are_inside_of_sorted_curves_as_of_all_pieces(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    Dice d = { 5 };
    uint32_t every[MAX_PIECES];
    for (uint32_t i = 0; i < MAX_PIECES; i++)
        every[i] = i;
    for (int round = 0; round < 200; round++) {
        uint32_t n = 1 + (uint32_t)(dice(&d) * (MAX_PIECES - 1)), ends[2] = { 0, n };
        bool steep = round % 2;
        Curve sorted = random_outline(&a, &d, n, round % 3 + 1, steep), plain = sorted;
        curve_sort(&a, &sorted);
        plain.rows = (CurveRows){ .n = 1, .first = ends, .piece = every };
        for (int i = 0; i < 200; i++) {
            double u = dice_between(&d, -0.2, 1.2), v = dice_between(&d, -0.2, steep ? 9.2 : 1.2);
            v = i % 2 ? v : floor(8 * v) / 8;  /* where pieces end */
            assert_int_equal(curve_inside(&sorted, u, v), curve_inside(&plain, u, v));
        }
    }
    arena_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(points_are_inside_of_sorted_curves_as_of_all_pieces) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
