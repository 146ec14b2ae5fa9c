/* test_contrast.c - the quick answer against the formula: a power for every channel. */
#include "render/contrast.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "lib/bodies.h"

#define COUNT(a) (sizeof(a) / sizeof(a)[0])

typedef struct Setting { GammaMode gamma; double assumed, antialias_gamma; } Setting;

static const Setting settings[] = {
    { GAMMA_POWER, 1, 2.5 }, { GAMMA_POWER, 2.2, 2.5 }, { GAMMA_POWER, 2.2, 1 }, { GAMMA_SRGB, 0, 2.5 }, { GAMMA_SRGB, 0, 1 },
    { GAMMA_NONE, 0, 2.5 }, { GAMMA_NONE, 0, 1 }, { GAMMA_POWER, 1, 0.3 }, { GAMMA_POWER, 1, 40 }
};

static double light(const Setting *s, float value)
{
    double v = fmax(0, (double)value), p = s->antialias_gamma == 1 ? 1 : 1 / s->antialias_gamma;
    if (s->gamma == GAMMA_SRGB)
        v = v < 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
    else if (s->gamma == GAMMA_POWER && s->assumed != 1)
        p *= s->assumed;
    return p == 1 ? v : pow(v, p);
}

static double distance(const Setting *s, Colour a, Colour b)
{
    return fabs(light(s, a.r) - light(s, b.r)) + fabs(light(s, a.g) - light(s, b.g)) + fabs(light(s, a.b) - light(s, b.b)) +
           fabs((double)a.t - (double)b.t);
}

static Contrast *contrast_of(Arena *a, const Setting *s, double threshold)
{
    World w = { .globals = { .assumed_gamma = s->gamma, .assumed_gamma_value = s->assumed } };
    return contrast_new(a, &w, &(RenderOptions){ .threshold = threshold, .antialias_gamma = s->antialias_gamma });
}

static bool differ(const Contrast *c, Colour a, Colour b)
{
    Seen p, q;
    p.colour = a;
    q.colour = b;
    contrast_see(c, &p);
    contrast_see(c, &q);
    return contrast_differ(c, &p, &q);
}

static float any_light(Dice *d)
{
    double v = pow(2, dice_between(d, -30, 8));
    return (float)(dice(d) < 0.1 ? 0 : dice(d) < 0.1 ? -v : v);
}

static Colour any_colour(Dice *d)
{
    float grey = any_light(d);
    if (dice(d) < 0.2)
        return (Colour){ grey, grey, grey, 0, 0 };
    return (Colour){ grey, any_light(d), any_light(d), 0, dice(d) < 0.5 ? 0 : (float)dice(d) };
}

static Colour brighter(Colour c, double by)
{
    return (Colour){ (float)(c.r * by), (float)(c.g * by), (float)(c.b * by), 0, c.t };
}

/* For each pair, thresholds at its own distance, just above, and anywhere: neither the table's ends nor its error may show. */
static void the_quick_answer_is_the_exact_one(void **state)
{
    (void)state;
    Arena arena;
    arena_init(&arena);
    Dice d = { 7 };
    for (size_t i = 0; i < COUNT(settings); i++)
        for (int k = 0; k < 400; k++) {
            const Setting *s = &settings[i];
            Colour a = any_colour(&d), b = k % 2 ? any_colour(&d) : brighter(a, dice_between(&d, 0.9, 1.1));
            double exact = distance(s, a, b);
            const double threshold[] = { exact, nextafter(exact, INFINITY), exact * (1 + 1e-4), exact * (1 - 1e-4), dice(&d) };
            for (size_t t = 0; t < COUNT(threshold); t++) {
                ArenaMark mark = arena_mark(&arena);
                if (differ(contrast_of(&arena, s, threshold[t]), a, b) != (exact >= threshold[t]))
                    fail_msg("setting %zu, pair %d, threshold %zu", i, k, t);
                arena_rewind(&arena, mark);
            }
        }
    arena_free(&arena);
}

static void what_is_no_number_never_differs(void **state)
{
    (void)state;
    Arena arena;
    arena_init(&arena);
    const Contrast *c = contrast_of(&arena, &settings[0], 0.3);
    assert_false(differ(c, (Colour){ NAN, 0, 0, 0, 0 }, (Colour){ 1, 1, 1, 0, 0 }));
    assert_true(differ(c, (Colour){ INFINITY, 0, 0, 0, 0 }, (Colour){ 1, 1, 1, 0, 0 }));
    arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_quick_answer_is_the_exact_one),
        cmocka_unit_test(what_is_no_number_never_differs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
