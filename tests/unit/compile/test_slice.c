/* test_slice.c - endless shapes between planes get boxes that hold all that is left of them, however they are turned. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>
#undef fail                                    /* base/diag.h has a better one */

#include "lib/bodies.h"
#include "lib/scene_text.h"
#include "world/prim.h"

#define CONE "quadric { <1, -1, 1>, 0, 0, 0 }"
#define TUBE "quadric { <1, 0, 1>, 0, 0, -0.5 }"

static const char *const bodies[] = {
    "intersection { plane { y, 1 } " CONE " clipped_by { plane { y, 0 inverse } }",
    "intersection { plane { y, 1 } " CONE " object { " CONE " scale <0.9, 1, 0.9> inverse } clipped_by { plane { -y, -0.2 } }",
    "intersection { " TUBE " plane { y, 1 } plane { -y, 1 }",
    "object { " TUBE " clipped_by { plane { y, 0.5 } plane { y, -0.5 inverse } }",
    "difference { " TUBE " plane { y, 1 inverse } plane { -y, 1 inverse } sphere { y, 0.3 }",
};
static const char *const places[] = {
    "", "rotate <10, 20, 30>", "rotate 86.5 * z translate <1, 2, 3>", "scale <1, 1.5, 0.7> rotate 45 * x scale 3",
    "rotate <-70, 0, 5> translate <1e3, 0, 0>", "matrix <1, 0.2, 0, 0, 1, 0.3, 0, 0, 1, 0, 0, 0>",
};

static bool all_contain(const World *w, Vec3 p)
{
    for (uint32_t i = 0; i < w->n_prims; i++) {
        const Prim *prim = &w->prim[i];
        if (prim->ops->inside(prim->data, affine_point_back(prim->place, p)) == ((prim->flags & PRIM_INVERSE) != 0))
            return false;
    }
    return true;
}

static void expect_boxes_hold_the_rest(const World *w, uint64_t seed)
{
    Dice d = { seed };
    int inside = 0;
    assert_int_equal(w->n_unbounded, 0);
    Vec3 middle = scaled(add(w->bounds.lo, w->bounds.hi), 0.5), size = sub(w->bounds.hi, w->bounds.lo);
    for (int i = 0; i < 20000; i++) {
        Vec3 p = add(middle, mul(dice_point(&d, 0.6), size));
        if (!all_contain(w, p))
            continue;
        inside++;
        for (uint32_t k = 0; k < w->n_prims; k++)
            assert_true((w->prim[k].flags & (PRIM_HELPER | PRIM_INVERSE)) || bounds_contain(w->box[k], p));
    }
    assert_true(inside > 100);
}

static void turned_slices_of_endless_shapes_have_boxes(void **state)
{
    (void)state;
    for (size_t b = 0; b < sizeof bodies / sizeof *bodies; b++)
        for (size_t k = 0; k < sizeof places / sizeof *places; k++) {
            char text[512];
            snprintf(text, sizeof text, "%s %s }", bodies[b], places[k]);
            SceneText s;
            assert_true(scene_text(&s, text));
            expect_boxes_hold_the_rest(&s.world, b * 100 + k + 1);
            scene_text_end(&s);
        }
}

static void planes_that_do_not_end_a_shape_leave_it_endless(void **state)
{
    (void)state;
    static const char *const endless[] = {
        "intersection { plane { y, 1 } " CONE " rotate 30 }", "intersection { plane { x, 1 } plane { -x, 1 } " CONE " rotate 30 }",
        "union { plane { y, 1 } " TUBE " }",
        "difference { " TUBE " intersection { plane { y, 1 } plane { -y, 1 } } }",
    };
    for (size_t k = 0; k < sizeof endless / sizeof *endless; k++) {
        SceneText s;
        assert_true(scene_text(&s, endless[k]));
        assert_true(s.world.n_unbounded > 0);
        scene_text_end(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turned_slices_of_endless_shapes_have_boxes),
        cmocka_unit_test(planes_that_do_not_end_a_shape_leave_it_endless),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
