/* test_prim.c - surfaces, rays that go on from them, what rays skip, and which bodies are around a point. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#undef fail                                    /* base/diag.h has a better one */

#include "lib/bodies.h"
#include "world/prim.h"

static void normals_face_the_ray_and_points_lie_on_the_surface(void **state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 60; seed++) {
        Arena a;
        arena_init(&a);
        Dice d = { seed };
        const Object *o[6];
        for (int i = 0; i < 6; i++)
            o[i] = random_body(&a, &d, 2, 1);
        World *w = world_of(&a, 6, o, "bvh");
        for (int i = 0; i < 200; i++) {
            Ray ray = random_ray(&d, 1);
            ray.o = scaled(ray.o, w->unit);
            Hit hit;
            Surface s;
            if (!world_nearest(w, &ray, 0, &hit))
                continue;
            world_surface(w, &ray, &hit, false, &s);
            assert_true(fabs(length(s.normal) - 1) < 1e-14 && fabs(length(s.geometric) - 1) < 1e-14);
            assert_true(dot(s.normal, ray.d) <= 0 && dot(s.geometric, ray.d) <= 0);
            assert_true(length(sub(s.p, ray_at(&ray, hit.t))) < 1e-12 * (1 + hit.t));
            assert_true(s.error > 0 && s.error < 1e-10 * (1 + hit.t));
        }
        arena_free(&a);
    }
}

/* The step off a surface is larger than the error of the point and smaller than anything seen. */
static void rays_that_go_on_do_not_meet_the_surface_they_left(void **state)
{
    (void)state;
    static const double sizes[] = { 1e-6, 1e-3, 1, 1e3, 1e6 };
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        Arena a;
        arena_init(&a);
        Dice d = { 11 };
        double size = sizes[k];                /* one ball of this size in a scene of size 5 */
        Vec3 centre = vec3(0.3, -0.2, 0.6);
        const Object *o[2] = { placed(&a, ball(&a, vec3(0, 0, 0), size), affine_translate(centre)),
                               ball(&a, vec3(5, 5, 5), 0.001) };
        World *w = world_of(&a, 2, o, "bvh");
        for (int i = 0; i < 2000; i++) {
            Vec3 from = add(centre, scaled(dice_direction(&d), size * 3));
            Vec3 to = add(centre, scaled(dice_direction(&d), 0.95 * size * dice(&d)));
            Ray ray = { scaled(from, w->unit), normalized(sub(to, from)), 0, INFINITY };
            Hit hit, next;
            Surface s;
            assert_true(world_nearest(w, &ray, 0, &hit));
            world_surface(w, &ray, &hit, false, &s);
            Vec3 away = dice_direction(&d);
            if (dot(away, s.geometric) < 0)
                away = negated(away);
            Ray out = { surface_offset(&s, away), away, 0, INFINITY };
            assert_false(world_nearest(w, &out, 0, &next) && next.prim == hit.prim);
            Ray in = { surface_offset(&s, ray.d), ray.d, 0, INFINITY };
            assert_true(world_nearest(w, &in, 0, &next) && next.prim == hit.prim && next.part != hit.part);
        }
        arena_free(&a);
    }
}

static bool seen(const World *w, uint32_t skip)
{
    Ray ray = { scaled(vec3(0, 0, -5), w->unit), vec3(0, 0, 1), 0, INFINITY };
    Hit hit;
    return world_nearest(w, &ray, skip, &hit);
}

static void flags_hide_from_the_rays_they_name(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    const Object *one = ball(&a, vec3(0, 0, 0), 1), *clear = ball(&a, vec3(9, 0, 0), 1);
    static const struct { uint32_t object, prim; } flags[] = {
        { OBJECT_NO_SHADOW, PRIM_NO_SHADOW }, { OBJECT_NO_IMAGE, PRIM_NO_IMAGE }, { OBJECT_NO_REFLECTION, PRIM_NO_REFLECTION },
        { OBJECT_NO_RADIOSITY, PRIM_NO_RADIOSITY },
    };
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++) {
        const Object *flagged_one = flagged(&a, one, flags[i].object);
        World *w = world_of(&a, 1, &flagged_one, "bvh");
        assert_true(seen(w, 0) && !seen(w, flags[i].prim));
        const Object *inner = flagged(&a, combined2(&a, OBJECT_UNION, one, clear), flags[i].object);
        w = world_of(&a, 1, &inner, "bvh");
        assert_true(seen(w, 0) && !seen(w, flags[i].prim));
        /* measured: on a child of an intersection none of them counts */
        const Object *child = combined2(&a, OBJECT_INTERSECTION, flagged_one, ball(&a, vec3(0, 0, 0), 2));
        w = world_of(&a, 1, &child, "bvh");
        assert_true(seen(w, flags[i].prim));
    }
    /* measured: on a child of an unsplit union no_image is for later rays only, no_shadow for none; all children together
     * have their say */
    const Object *later = flagged(&a, combined2(&a, OBJECT_UNION, flagged(&a, one, OBJECT_NO_IMAGE | OBJECT_NO_SHADOW), clear),
                                  OBJECT_NO_SPLIT_UNION);
    World *w = world_of(&a, 1, &later, "bvh");
    assert_true(seen(w, PRIM_NO_IMAGE) && !seen(w, PRIM_NO_IMAGE | PRIM_NO_IMAGE_LATER) && seen(w, PRIM_NO_SHADOW));
    const Object *pair = combined2(&a, OBJECT_UNION, flagged(&a, one, OBJECT_NO_SHADOW), flagged(&a, clear, OBJECT_NO_SHADOW));
    const Object *all = flagged(&a, pair, OBJECT_NO_SPLIT_UNION);
    w = world_of(&a, 1, &all, "bvh");
    assert_false(seen(w, PRIM_NO_SHADOW));
    arena_free(&a);
}

static const Object *filled(Arena *a, const Object *o, const Interior *interior)
{
    Object *out = arena_copy(a, o, sizeof *o);
    ObjectMore more = { .interior = interior };
    out->more = arena_copy(a, &more, sizeof more);
    return out;
}

static void bodies_around_a_point_come_in_scene_order_and_without_clips(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    static const Interior water = { .ior = 1.3f }, glass = { .ior = 1.5f }, air = { .ior = 1 }, oil = { .ior = 1.4f };
    const Object *o[4] = {
        filled(&a, half_space(&a, vec3(0, 1, 0), 0), &water),
        filled(&a, ball(&a, vec3(0, 0, 0), 1), &glass),
        filled(&a, clipped_to(&a, ball(&a, vec3(0, 0, 0), 2), half_space(&a, vec3(0, 0, 1), -1.5)), &oil),
        filled(&a, inverted(&a, ball(&a, vec3(0, 0, 0), 10)), &air),
    };
    World *w = world_of(&a, 4, o, "bvh");
    uint32_t found[4];
    assert_int_equal(world_interiors_at(w, scaled(vec3(0, -0.5, 0), w->unit), found, 4), 3);
    assert_ptr_equal(w->interior[found[0]].interior, &water);
    assert_ptr_equal(w->interior[found[1]].interior, &glass);
    assert_ptr_equal(w->interior[found[2]].interior, &oil);
    assert_int_equal(world_interiors_at(w, scaled(vec3(0, 0.5, 0), w->unit), found, 4), 2);
    /* POV: outside the box of the inverse ball nothing asks whether the point is in it. */
    assert_int_equal(world_interiors_at(w, scaled(vec3(0, 20, 0), w->unit), found, 4), 0);
    assert_int_equal(world_interiors_at(w, scaled(vec3(9, 9, 0), w->unit), found, 4), 1);
    assert_ptr_equal(w->interior[found[0]].interior, &air);
    assert_int_equal(world_interiors_at(w, scaled(vec3(0, 5, 0), w->unit), found, 4), 0);
    arena_free(&a);
}

/* One body: all leaves of an outermost union share an interior; two statements are two bodies. */
static void children_share_the_interior_of_their_parent(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    static const Interior glass = { .ior = 1.5f }, water = { .ior = 1.3f };
    const Object *one = ball(&a, vec3(0, 0, 0), 1), *other = ball(&a, vec3(0.5, 0, 0), 1);
    const Object *own = filled(&a, ball(&a, vec3(1, 0, 0), 1), &water);
    const Object *children[3] = { one, own, other };
    const Object *o = filled(&a, combined(&a, OBJECT_UNION, 3, children), &glass);
    World *w = world_of(&a, 1, &o, "bvh");
    uint32_t i[3];
    for (int k = 0; k < 3; k++)
        i[k] = w->material[w->prim[k].material].interior;
    assert_int_equal(i[0], i[2]);
    assert_true(i[0] != i[1]);
    assert_ptr_equal(w->interior[i[0]].interior, &glass);
    assert_ptr_equal(w->interior[i[1]].interior, &water);
    const Object *two[2] = { filled(&a, one, &glass), filled(&a, other, &glass) };
    w = world_of(&a, 2, two, "bvh");
    assert_true(w->material[w->prim[0].material].interior != w->material[w->prim[1].material].interior);
    arena_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normals_face_the_ray_and_points_lie_on_the_surface),
        cmocka_unit_test(rays_that_go_on_do_not_meet_the_surface_they_left),
        cmocka_unit_test(flags_hide_from_the_rays_they_name),
        cmocka_unit_test(bodies_around_a_point_come_in_scene_order_and_without_clips),
        cmocka_unit_test(children_share_the_interior_of_their_parent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
