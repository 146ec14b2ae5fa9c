/* test_isosurface.c - roots found by calculus are those found by halving alone.
 *
 * Of a function that asks a pattern nothing is known, so a pattern times 0 makes the slow twin of any function. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>
#undef fail

#include <stdio.h>

#include "lib/bodies.h"
#include "lib/scene_text.h"

static const char *const functions[] = {
    "x*x + y*y + z*z - 0.6",
    "y + 0.6*N(2*x, 2*y, 2*z) - 0.2",
    "max(abs(x), abs(y), abs(z)) - 0.6 + 0.1*sin(9*x)",
    "sqrt(pow(max(abs(x) - 0.4, 0), 2) + pow(max(abs(y) - 0.5, 0), 2) + pow(max(abs(z) - 0.3, 0), 2)) - 0.3*N(3*x, 3*y, 3*z)",
    "min(sqrt(x*x + z*z) - 0.2, abs(y) - 0.1) + 0.02*sin(20*x)*sin(20*y)",
    "sqrt(pow(sqrt(x*x + z*z) - 0.6, 2) + y*y) - 0.2 + 0.1*cos(5*atan2(x, z))",
    "select(x, y + 0.3, z - x)",
    "exp(-4*(x*x + y*y)) + exp(-4*(pow(x - 0.5, 2) + z*z)) - 0.7",
    "acos(x*1.3) + y - mod(z, 0.3)",               /* not a number at both ends of x */
    "floor(4*x)/4 + y",
};

static void calculus_finds_the_roots_that_halving_finds(void **state)
{
    (void)state;
    static const char *const ways[] = {
        "max_gradient 0.6", "max_gradient 3", "max_gradient 12 accuracy 0.0001", "max_gradient 2 open accuracy 0.3",
    };
    enum { FUNCTIONS = sizeof functions / sizeof *functions, WAYS = sizeof ways / sizeof *ways, RAYS = 1000 };
    int hits = 0, wrong = 0;
    Dice d = { 5 };
    for (int i = 0; i < FUNCTIONS * WAYS; i++) {
        SceneText s[2] = { 0 };
        for (int twin = 0; twin < 2; twin++) {
            char text[1000];
            snprintf(text, sizeof text,
                     "#declare N = function { internal(76) } #declare P = function { pattern { checker } }"
                     "isosurface { function { %s %s } contained_by { box { -1, 1 } } %s }",
                     functions[i / WAYS], twin ? "+ 0*P(x, y, z)" : "", ways[i % WAYS]);
            bool read = scene_text(&s[twin], text);
            if (!read)
                print_message("%s\n", s[twin].messages);
            assert_true(read);
        }
        for (int k = 0; k < RAYS; k++) {
            Vec3 from = dice_point(&d, k % 2 ? 2 : 1), to = dice_direction(&d), p[2], n[2];
            bool hit = scene_text_trace(&s[0], from, to, &p[0], &n[0]);
            if (hit != scene_text_trace(&s[1], from, to, &p[1], &n[1]) || (hit && memcmp(&p[0], &p[1], sizeof p[0]) != 0)) {
                print_message("%s, %s, ray %d: hit %d at %.17g\n", functions[i / WAYS], ways[i % WAYS], k, hit, hit ? p[0].x : 0);
                wrong++;
            }
            hits += hit;
        }
        scene_text_end(&s[0]);
        scene_text_end(&s[1]);
    }
    assert_int_equal(wrong, 0);
    assert_true(hits > FUNCTIONS * WAYS * RAYS / 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(calculus_finds_the_roots_that_halving_finds) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
