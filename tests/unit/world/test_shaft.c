/* test_shaft.c - narrowing a shaft drops nothing that its rays meet, and no ray gets through a closed one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#undef fail                                    /* base/diag.h has a better one */

#include "lib/bodies.h"
#include "lib/scene_text.h"
#include "world/shaft.h"

/* Opaque bodies, alone and in set operations, at odd places and sizes. */
static const char *const scenes[] = {
    "sphere { <0.1, 0.2, 0.3>, 0.7 }",
    "sphere { 0, 1 scale <2, 0.3, 0.7> rotate <20, 30, 40> translate <0.3, -0.2, 0.1> }",
    "box { <-0.5, -0.4, -0.3>, <0.7, 0.6, 0.5> }",
    "box { -1, 1 scale <0.9, 0.02, 0.6> rotate <10, 70, 20> }",
    "box { <-2, -0.3, -1>, <2, -0.3, 1> }",
    "cylinder { <0, -0.8, 0>, <0.3, 0.9, 0.2>, 0.4 }",
    "cylinder { <0, -0.8, 0>, <0.3, 0.9, 0.2>, 0.6 open }",
    "cone { <0, -0.8, 0>, 0.8, <0.3, 0.9, 0.2>, 0.1 }",
    "cone { <0, -0.8, 0>, 0.8, <0.3, 0.9, 0.2>, 0.3 open rotate 50 }",
    "plane { <1, 2, 3>, -0.3 }",
    "disc { 0, <1, 2, 3>, 0.9, 0.2 }",
    "torus { 0.7, 0.2 rotate 30 }",
    "difference { box { <-1, -1, 0>, <1, 1, 0.2> } box { <-0.5, -0.5, -1>, <0.5, 0.5, 1> } rotate <15, 25, 45> }",
    "intersection { sphere { <-0.4, 0, 0>, 0.8 } sphere { <0.4, 0, 0>, 0.8 } plane { y, 0.3 } }",
    "sphere { -0.4, 0.5 } box { 0.1, 0.9 } cylinder { <-1, 0.5, 0>, <1, 0.6, 0>, 0.1 } plane { y, -0.8 }",
};

enum { N_SCENES = sizeof scenes / sizeof *scenes, ROUNDS = 1500, RAYS = 12 };

static bool count(void *user, const Hit *hit)
{
    (void)hit;
    ++*(uint32_t *)user;
    return false;
}

typedef struct View {
    Vec3 o, up;
    Window to;
} View;

/* Every other one starts on a surface, as shadow rays do. False if those rays do not clearly leave it. */
static bool random_view(const World *w, Dice *d, bool on_surface, View *v)
{
    *v = (View){ .o = scaled(dice_point(d, 2), w->unit) };
    v->to.middle = scaled(dice_point(d, 2), w->unit);
    v->to.half1 = scaled(dice_direction(d), w->unit * dice_between(d, 0, 0.3));
    v->to.half2 = scaled(dice_direction(d), w->unit * dice_between(d, 0, 0.3));
    Ray ray = { v->o, normalized(sub(scaled(dice_point(d, 1), w->unit), v->o)), 0, INFINITY };
    Hit hit;
    Surface s;
    if (!on_surface || !world_nearest(w, &ray, 0, &hit))
        return true;
    world_surface(w, &ray, &hit, false, &s);
    Vec3 m = sub(v->to.middle, s.p);
    v->o = surface_offset(&s, m);
    v->up = dot(s.geometric, m) > 0 ? s.geometric : negated(s.geometric);
    return dot(v->up, m) > fabs(dot(v->up, v->to.half1)) + fabs(dot(v->up, v->to.half2)) + 1e-5 * length(m);
}

static Bounds bounds_of_window(const Window *to)
{
    Vec3 a = to->half1, b = to->half2, half = vec3(fabs(a.x) + fabs(b.x), fabs(a.y) + fabs(b.y), fabs(a.z) + fabs(b.z));
    return bounds_grown((Bounds){ sub(to->middle, half), add(to->middle, half) }, 1e-12);
}

/* Corners, points of the rim and points within. */
static Ray ray_into(const View *v, Dice *d, int i)
{
    double a = dice_between(d, -1, 1), b = dice_between(d, -1, 1);
    if (i < 4) {
        a = i & 1 ? 1 : -1;
        b = i & 2 ? 1 : -1;
    } else if (i < 8)
        a = a > 0 ? 1 : -1;
    Vec3 end = add(v->to.middle, add(scaled(v->to.half1, a), scaled(v->to.half2, b))), step = sub(end, v->o);
    return (Ray){ v->o, normalized(step), 0, length(step) * (1 - 0x1p-36) };
}

static void each_view(void (*expect)(const World *, const View *, Dice *, const Shaft *, int *seen), int least)
{
    int seen = 0;
    for (int k = 0; k < N_SCENES; k++) {
        SceneText s;
        assert_true(scene_text(&s, scenes[k]));
        World *w = &s.world;
        Dice d = { (uint64_t)k + 1 };
        for (int i = 0; i < ROUNDS; i++) {
            View v;
            Shaft shaft;
            if (!random_view(w, &d, i % 2, &v))
                continue;
            world_shaft(w, v.o, bounds_of_window(&v.to), 0, &shaft);
            expect(w, &v, &d, &shaft, &seen);
        }
        scene_text_end(&s);
    }
    assert_true(seen >= least);
}

static void expect_narrowed_holds_all(const World *w, const View *v, Dice *d, const Shaft *shaft, int *seen)
{
    Shaft narrow = *shaft;
    shaft_narrow(w, v->o, &v->to, v->up, &narrow);
    *seen += narrow.n < shaft->n;
    for (int i = 0; i < RAYS; i++) {
        Ray ray = ray_into(v, d, i);
        uint32_t all = 0, kept = 0;
        world_each_hit(w, &ray, 0, count, &all);
        shaft_each_hit(w, &narrow, &ray, count, &kept);
        assert_int_equal(all, kept);
    }
}

static void narrowing_leaves_out_only_what_no_ray_meets(void **state)
{
    (void)state;
    each_view(expect_narrowed_holds_all, 3000);
}

static void expect_closed_is_dark(const World *w, const View *v, Dice *d, const Shaft *shaft, int *seen)
{
    if (window_closed_by(w, v->o, &v->to, shaft->prim, shaft->n) == 0)
        return;
    ++*seen;
    for (int i = 0; i < RAYS; i++) {
        Ray ray = ray_into(v, d, i);
        uint32_t n = 0;
        world_each_hit(w, &ray, 0, count, &n);
        assert_true(n > 0);
    }
}

static void no_ray_gets_through_a_closed_shaft(void **state)
{
    (void)state;
    each_view(expect_closed_is_dark, 1000);
}

static void what_can_be_seen_through_closes_no_shaft(void **state)
{
    (void)state;
    static const char *const open[] = {
        "box { -1, 1 pigment { rgbt <1, 1, 1, 0.5> } }", "cylinder { -3 * y, 3 * y, 1 open }", "torus { 1, 0.5 }",
        "difference { box { -1, 1 } sphere { 0, 1.2 } }", "box { -1, 1 no_shadow }",
    };
    for (size_t k = 0; k < sizeof open / sizeof *open; k++) {
        SceneText s;
        assert_true(scene_text(&s, open[k]));
        World *w = &s.world;
        View v = { .o = scaled(vec3(0, 0, -3), w->unit) };
        v.to = (Window){ scaled(vec3(0, 0, 3), w->unit), scaled(vec3(0.2, 0, 0), w->unit), scaled(vec3(0, 0.2, 0), w->unit) };
        Shaft shaft;
        world_shaft(w, v.o, bounds_of_window(&v.to), PRIM_NO_SHADOW, &shaft);
        assert_int_equal(window_closed_by(w, v.o, &v.to, shaft.prim, shaft.n), 0);
        scene_text_end(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(narrowing_leaves_out_only_what_no_ray_meets),
        cmocka_unit_test(no_ray_gets_through_a_closed_shaft),
        cmocka_unit_test(what_can_be_seen_through_closes_no_shaft),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
