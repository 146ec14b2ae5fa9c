/* test_fan.c - four rays at once meet what each of them meets alone. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#undef fail                                    /* base/diag.h has a better one */

#include "lib/bodies.h"
#include "lib/scene_text.h"
#include "world/fan.h"
#include "world/prim.h"

static const char *const scenes[] = {
    "sphere { <0.1, 0.2, 0.3>, 0.7 }",
    "sphere { 0, 1 scale <2, 0.3, 0.7> rotate <20, 30, 40> }",
    "box { <-0.5, -0.4, -0.3>, <0.7, 0.6, 0.5> }",
    "box { -1, 1 scale <0.9, 0.02, 0.6> rotate <10, 70, 20> }",
    "box { <-2, -0.25, -1>, <2, -0.25, 1> }",
    "cylinder { <0, -0.8, 0>, <0.3, 0.9, 0.2>, 0.4 }",
    "cylinder { -y, y, 0.6 open }",
    "plane { <1, 2, 3>, -0.3 }",
    "plane { y, 0.25 }",
    "disc { 0, <1, 2, 3>, 0.9, 0.2 }",
    "disc { 0, y, 0.9 }",
    "cone { <0, -0.8, 0>, 0.8, <0.3, 0.9, 0.2>, 0.1 }",
    "torus { 0.7, 0.2 rotate 30 }",
    "difference { box { <-1, -1, 0>, <1, 1, 0.2> } box { <-0.5, -0.5, -1>, <0.5, 0.5, 1> } rotate <15, 25, 45> }",
    "intersection { sphere { <-0.4, 0, 0>, 0.8 } sphere { <0.4, 0, 0>, 0.8 } plane { y, 0.25 } cylinder { -x, x, 0.3 inverse } }",
    "difference { union { box { -0.75, 0.25 } cylinder { -x, x, 0.4 } } sphere { 0, 0.6 } plane { x, -0.5 } }",
    "merge { box { -0.75, 0.25 } sphere { 0, 0.6 } }",
    "union { sphere { -0.25, 0.5 } difference { box { -0.5, 0.5 } cylinder { -z, z, 0.25 } } clipped_by { plane { y, 0.2 } } }",
    "intersection { box { -0.5, 0.5 } sphere { 0, 0.6 } bounded_by { sphere { 0, 0.4 } } }",
    "intersection { quadric { <1, 1, 1>, 0, 0, -0.5 } box { -0.6, 0.6 } }",
};

enum { N_SCENES = sizeof scenes / sizeof *scenes, ROUNDS = 3000 };

/* Every third direction leads along axes, every fifth fan starts on their grid: in planes of sides. */
static Vec3 random_step(Dice *d, int i)
{
    if (i % 3 == 0)
        return vec3(round(dice_between(d, -1.4, 1.4)), round(dice_between(d, -1.4, 1.4)), round(dice_between(d, -1.4, 1.4)));
    return scaled(dice_direction(d), dice_between(d, 0.1, 2));
}

static void expect_same(const World *w, Dice *d, int round_no, int *met)
{
    Vec3 o = round_no % 5 == 0 ? vec3(round(dice_between(d, -4, 4)) / 4, round(dice_between(d, -4, 4)) / 4, round(dice_between(d, -4, 4)) / 4)
                               : dice_point(d, 1.5);
    Ray ray[FAN_RAYS];
    double x[4], y[4], z[4], t_max[4];
    for (int i = 0; i < FAN_RAYS; i++) {
        ray[i] = (Ray){ scaled(o, w->unit), scaled(random_step(d, round_no + i), w->unit), 0.01, dice_between(d, 0.1, 3) };
        x[i] = ray[i].d.x;
        y[i] = ray[i].d.y;
        z[i] = ray[i].d.z;
        t_max[i] = ray[i].t_max;
    }
    Fan fan = { ray[0].o, 0.01, { d4_load(x), d4_load(y), d4_load(z) }, d4_load(t_max) };
    for (uint32_t prim = 0; prim < w->n_prims; prim++) {
        if (w->prim[prim].flags & PRIM_HELPER)
            continue;
        uint32_t rays = (uint32_t)(dice_between(d, 0, 16)) & FAN_ALL, expected = 0;
        for (int i = 0; i < FAN_RAYS; i++)
            if (rays >> i & 1)
                expected |= (uint32_t)prim_meets(w, prim, &ray[i], 0) << i;
        assert_int_equal(fan_meets(w, prim, &fan, rays), expected);
        *met += expected != 0;
    }
}

static void each_ray_of_a_fan_meets_what_it_meets_alone(void **state)
{
    (void)state;
    for (int k = 0; k < N_SCENES; k++) {
        SceneText s;
        assert_true(scene_text(&s, scenes[k]));
        Dice d = { (uint64_t)k + 1 };
        int met = 0;
        for (int i = 0; i < ROUNDS; i++)
            expect_same(&s.world, &d, i, &met);
        assert_true(met > ROUNDS / 100);
        scene_text_end(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(each_ray_of_a_fan_meets_what_it_meets_alone) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
