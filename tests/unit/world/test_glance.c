/* test_glance.c - what is told at a glance is what single rays meet, and little is left open. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#undef fail                                    /* base/diag.h has a better one */

#include "lib/bodies.h"
#include "lib/scene_text.h"
#include "world/glance.h"

typedef struct Sample { const char *text; double told; } Sample;       /* told: the least share of rays about which something is */

static const Sample samples[] = {
    { "sphere { <0.1, 0.2, 0.3>, 0.7 }", 0.9 },
    { "sphere { 0, 1 scale <2, 0.3, 0.7> rotate <20, 30, 40> translate <0.3, -0.2, 0.1> }", 0.8 },
    { "sphere { <0.1, 0.2, 0.3>, 0.7 inverse }", 0.9 },
    { "sphere { <0, -1000, 0>, 1000 }", 0.1 },
    { "box { <-0.5, -0.4, -0.3>, <0.7, 0.6, 0.5> }", 0.9 },
    { "box { -1, 1 scale <0.9, 0.02, 0.6> rotate <10, 70, 20> }", 0.9 },
    { "box { <-2, -0.25, -1>, <2, -0.25, 1> }", 0.3 },
    { "cylinder { <0, -0.8, 0>, <0.3, 0.9, 0.2>, 0.4 }", 0.9 },
    { "cylinder { -2 * x, 2 * x, 0.4 scale <1, 0.5, 1.5> rotate 70 * z }", 0.85 },
    { "cylinder { -y, y, 0.6 open }", 0.2 },
    { "plane { <1, 2, 3>, -0.3 }", 0.75 },
    { "plane { y, 0.25 }", 0.7 },
    { "disc { 0, <1, 2, 3>, 0.9, 0.2 }", 0.2 },
    { "torus { 0.7, 0.2 rotate 30 }", 0.2 },
    { "difference { box { <-1, -1, 0>, <1, 1, 0.2> } box { <-0.5, -0.5, -1>, <0.5, 0.5, 1> } rotate <15, 25, 45> }", 0.9 },
    { "difference { sphere { 0, 1 } cylinder { -2 * z, 2 * z, 0.6 } }", 0.8 },
    { "intersection { sphere { <-0.4, 0, 0>, 0.8 } sphere { <0.4, 0, 0>, 0.8 } plane { y, 0.25 } cylinder { -x, x, 0.3 inverse } }", 0.7 },
    { "difference { union { box { -0.75, 0.25 } cylinder { -x, x, 0.4 } } sphere { 0, 0.6 } plane { x, -0.5 } }", 0.2 },
    { "merge { box { -0.75, 0.25 } sphere { 0, 0.6 } }", 0.2 },
    { "sphere { -0.4, 0.5 } box { 0.1, 0.9 } cylinder { <-1, 0.5, 0>, <1, 0.6, 0>, 0.1 } plane { y, -0.8 }", 0.85 },
    { "sphere { -0.4, 0.5 pigment { rgbt <1, 1, 1, 0.5> } } box { 0.1, 0.9 }", 0.8 },
    { "union { sphere { -0.25, 0.5 } box { -0.5, 0.5 } clipped_by { plane { y, 0.2 } } }", 0.5 },
    { "intersection { box { -0.5, 0.5 } sphere { 0, 0.6 } bounded_by { sphere { 0, 0.4 } } }", 0.2 },
};

enum { N_SAMPLES = sizeof samples / sizeof *samples, ROUNDS = 3000, CLOSE = 4 };

/* Every third one starts on a surface, as shadow rays do, every fifth on a grid, among sides. */
static Sight random_sight(const World *w, Dice *d, int round_no)
{
    Vec3 o = dice_point(d, 2), end = dice_point(d, 2);
    if (round_no % 5 == 0)
        o = vec3(round(4 * o.x) / 4, round(4 * o.y) / 4, round(4 * o.z) / 4);
    o = scaled(o, w->unit);
    Ray ray = { o, normalized(sub(scaled(dice_point(d, 1), w->unit), o)), 0, INFINITY };
    Hit hit;
    Surface s;
    if (round_no % 3 == 0 && world_nearest(w, &ray, 0, &hit)) {
        world_surface(w, &ray, &hit, false, &s);
        o = surface_offset(&s, sub(scaled(end, w->unit), s.p));
    }
    return (Sight){ o, sub(scaled(end, w->unit), o), scaled(dice_direction(d), w->unit * dice_between(d, 0, 0.3)),
                    scaled(dice_direction(d), w->unit * dice_between(d, 0, 0.3)) };
}

/* Exactly: a glance takes s and r as floats. */
static Ray ray_to(const Sight *from, double s, double r)
{
    Vec3 step = add(from->to, add(scaled(from->along1, s), scaled(from->along2, r)));
    return (Ray){ from->o, normalized(step), 0, length(step) * (1 - 0x1p-36) };
}

typedef struct Scenery { const World *w; Sight from; Shaft shaft; Glance glance; } Scenery;

static void look(const Scenery *scene, double s, double r, bool *blocked, bool *met)
{
    Ray ray = ray_to(&scene->from, s, r);
    *blocked = *met = false;
    for (uint32_t k = 0; k < scene->shaft.n; k++) {
        bool meets = prim_meets(scene->w, scene->shaft.prim[k], &ray, 0);
        *met |= meets;
        *blocked |= meets && k < scene->shaft.n_opaque;
    }
}

static int n_true_told(Scenery *scene, const double s[4], const double r[4], uint32_t rays)
{
    f4 fs = f4_of((float)s[0], (float)s[1], (float)s[2], (float)s[3]), fr = f4_of((float)r[0], (float)r[1], (float)r[2], (float)r[3]);
    uint32_t clear, hidden = glance_hides(&scene->glance, fs, fr, rays, &clear);
    assert_int_equal((hidden | clear) & ~rays, 0);
    for (int i = 0; i < FAN_RAYS; i++) {
        bool blocked, met;
        look(scene, s[i], r[i], &blocked, &met);
        assert_true(!(hidden >> i & 1) || blocked);
        assert_true(!(clear >> i & 1) || !met);
    }
    return __builtin_popcount(hidden | clear);
}

/* Between the first two rays, if just one of them meets something: closer and closer to the edge. */
static void expect_true_at_edge(Scenery *scene, const double s[4], const double r[4])
{
    bool blocked, met[2];
    look(scene, s[0], r[0], &blocked, &met[0]);
    look(scene, s[1], r[1], &blocked, &met[1]);
    double at[2] = { 0, 1 };
    for (int i = 0; met[0] != met[1] && i < 24; i++) {
        double middle = (at[0] + at[1]) / 2, ends[4] = { at[0], middle, at[1], middle }, es[4], er[4];
        for (int k = 0; k < 4; k++) {
            es[k] = s[0] + ends[k] * (s[1] - s[0]);
            er[k] = r[0] + ends[k] * (r[1] - r[0]);
        }
        n_true_told(scene, es, er, FAN_ALL);
        bool here;
        look(scene, es[1], er[1], &blocked, &here);
        at[here == met[0] ? 0 : 1] = middle;
    }
}

static void nothing_wrong_is_told_and_much_is(void **state)
{
    (void)state;
    for (int k = 0; k < N_SAMPLES; k++) {
        SceneText text;
        assert_true(scene_text(&text, samples[k].text));
        World *w = &text.world;
        Dice d = { (uint64_t)k + 1 };
        int told = 0, asked = 0;
        for (int i = 0; i < ROUNDS; i++) {
            Scenery scene = { .w = w, .from = random_sight(w, &d, i) };
            const Sight *from = &scene.from;
            Vec3 end = add(from->o, from->to);
            double reach = max_abs(from->along1) + max_abs(from->along2) + 1e-12;
            world_shaft(w, from->o, bounds_grown((Bounds){ end, end }, reach), 0, &scene.shaft);
            glance_start(&scene.glance, w, &scene.shaft, from);
            for (int j = 0; j < CLOSE; j++) {
                double s[4], r[4];
                for (int q = 0; q < 4; q++) {
                    s[q] = dice_between(&d, -1, 1);
                    r[q] = dice_between(&d, -1, 1);
                }
                uint32_t rays = 1 + (uint32_t)dice_between(&d, 0, 15);
                told += n_true_told(&scene, s, r, rays);
                asked += __builtin_popcount(rays);
                expect_true_at_edge(&scene, s, r);
            }
        }
        assert_true(told > samples[k].told * asked);
        scene_text_end(&text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(nothing_wrong_is_told_and_much_is) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
