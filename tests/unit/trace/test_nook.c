/* test_nook.c - what is remembered about shadows is what each ray finds by itself. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>
#undef fail                                    /* base/diag.h has a better one */

#include "lib/bodies.h"
#include "lib/scene_text.h"
#include "trace/path.h"

typedef struct Sample { const char *text; double told; } Sample;       /* told: the least share of rays about which something is */

#define GLASS "pigment { rgbt <1, 1, 1, 0.5> }"

static const Sample samples[] = {
    { "sphere { <0.1, 0.2, 0.3>, 0.5 } plane { y, -0.8 }", 0.4 },
    { "sphere { 0, -0.5 } box { <-0.9, -0.9, -0.9>, <0.9, -0.7, 0.9> }", 0.4 },
    { "sphere { 0, 0.5 inverse } plane { y, -0.8 }", 0.35 },
    { "box { <-0.5, -0.4, -0.3>, <0.7, 0.6, 0.5> } box { -0.1, 0.1 scale <9, 0.1, 9> translate -0.6 * y }", 0.45 },
    { "cylinder { <0, -0.8, 0>, <0.3, 0.9, 0.2>, 0.4 } cone { <0.5, -0.8, 0>, 0.4, <0.5, 0.8, 0>, 0 }", 0.6 },
    { "cylinder { -y, y, 0.6 open } disc { -0.5 * y, y, 0.9, 0.2 }", 0.65 },
    { "difference { box { -0.7, 0.7 } sphere { 0.3 * y, 0.8 } rotate 30 }", 0.6 },
    { "merge { box { -0.5, 0.25 } sphere { 0, 0.4 } } plane { y, -0.6 }", 0.4 },
    { "sphere { 0, 0.5 " GLASS " } plane { y, -0.8 }", 0.2 },
    { "box { -0.3, 0.3 no_shadow } sphere { -0.5 * y, 0.3 } plane { y, -0.8 }", 0.35 },
    { "#for (I, 1, 300) sphere { <mod(I * 0.37, 1.6) - 0.8, mod(I * 0.17, 1.1), mod(I * 0.53, 1.6) - 0.8>, 0.01 } #end "
      "plane { y, -0.1 }", 0.4 },
    { "plane { y, -0.8 } plane { -y, -1.5 } plane { x, -1 inverse } torus { 0.6, 0.2 }", 0.4 },
};

enum { N_SAMPLES = sizeof samples / sizeof *samples, ROUNDS = 400, CLOSE = 40 };

static bool is_opaque(void *user, const Hit *hit)
{
    return (((const World *)user)->prim[hit->prim].flags & PRIM_OPAQUE) != 0;
}

static bool any(void *user, const Hit *hit)
{
    (void)user;
    (void)hit;
    return true;
}

static int n_true_told(const Spot *spot)
{
    const World *w = spot->t->world;
    Beam beam = { .d = 0 };
    light_towards(&w->light[0], &w->light[0].location, &spot->p, &beam);
    spot->t->nook_credit[0] = 1;
    Seen seen = nook_sees(spot, 0, &beam);
    Ray ray = shadow_ray(spot, beam.l, beam.d);
    assert_true(seen != SEEN_FULLY || !world_each_hit(w, &ray, PRIM_NO_SHADOW, any, NULL));
    assert_true(seen != SEEN_NOT || world_each_hit(w, &ray, PRIM_NO_SHADOW, is_opaque, (void *)w));
    return seen != SEEN_PERHAPS;
}

/* What a ray hits, or a place in the air. */
static int look_along(Tracer *t, Vec3 o, Vec3 to)
{
    const World *w = t->world;
    Interiors none = { .n = 0 };
    Spot spot = { .t = t, .p = to, .in = &none };
    Ray ray = { o, normalized(sub(to, o)), 0, INFINITY };
    Hit hit;
    Surface surface;
    if (world_nearest(w, &ray, 0, &hit)) {
        world_surface(w, &ray, &hit, false, &surface);
        spot = (Spot){ t, surface.p, &surface, &none, hit.prim };
    }
    return n_true_told(&spot);
}

/* Many rays in almost the same direction: they visit the same cubes. */
static int look_around(Tracer *t, Dice *d)
{
    double unit = t->world->unit;
    Vec3 o = scaled(dice_point(d, 1.5), unit), to = scaled(dice_point(d, 0.8), unit);
    int told = 0;
    for (int i = 0; i < CLOSE; i++)
        told += look_along(t, o, add(to, scaled(dice_point(d, 0.01), unit)));
    return told;
}

static void nothing_wrong_is_remembered_and_much_is(void **state)
{
    (void)state;
    for (int k = 0; k < N_SAMPLES; k++) {
        char text[1024];
        SceneText s;
        snprintf(text, sizeof text, "light_source { <0.4, 1.2, -0.9> rgb 1 } %s", samples[k].text);
        assert_true(scene_text(&s, text));
        Tracer *t = tracer_new(&s.arena, tracing_new(&s.arena, &s.world, 9, false), NULL);
        Dice d = { (uint64_t)k + 1 };
        int told = 0;
        for (int i = 0; i < ROUNDS; i++)
            told += look_around(t, &d);
        assert_true(told > samples[k].told * ROUNDS * CLOSE);
        tracer_free(t);
        scene_text_end(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(nothing_wrong_is_remembered_and_much_is) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
