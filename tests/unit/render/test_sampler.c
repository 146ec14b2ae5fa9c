/* test_sampler.c - places in a row see what they see one by one, whatever the camera. */
#include "lib/scene_text.h"
#include "render/sampler.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

#define COUNT(a) (sizeof(a) / sizeof(a)[0])

static bool same_vec3(Vec3 a, Vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static void each_in_row_is_as_alone(const SceneText *text, bool *seen)
{
    enum { N = 33 };
    Arena arena;
    arena_init(&arena);
    const RenderOptions options = { .width = 37, .height = 23, .threads = 1, .quality = 9 };
    Sampler s;
    sampler_init(&s, &arena, sampling_new(&arena, &text->world, &options), NULL);
    for (int y = 0; y < 23; y++) {
        Colour alone[N];
        Ray ray[N];
        for (int i = 0; i < N; i++) {
            alone[i] = sampler_colour(&s, i + 0.25, y - 0.5);
            ray[i] = *s.ray;
            *seen |= alone[i].r > 0;
        }
        sampler_row(&s, 0.25, y - 0.5, N);
        for (int i = N; i-- > 0;) {
            Colour c = sampler_in_row(&s, i);
            assert_true(c.r == alone[i].r && c.g == alone[i].g && c.b == alone[i].b && c.t == alone[i].t);
            if (s.sampling->pinhole || s.sampling->parallel)   /* others may have no ray there */
                assert_true(same_vec3(s.ray->o, ray[i].o) && same_vec3(s.ray->d, ray[i].d));
            sampler_colour(&s, 3, y);          /* other places between do not matter */
        }
    }
    sampler_free(&s);
    arena_free(&arena);
}

static void a_row_sees_what_its_places_see(void **state)
{
    (void)state;
    static const char *const cameras[] = {
        "location <1, 2, -6> look_at 0.3*x", "location -6*z right 3*x up -2*y direction 0.7*z rotate <12, 34, 56>",
        "orthographic location <0.1, 1, -6> look_at 0 right 4*x up 3*y", "fisheye angle 140 location -4*z",
        "location <0, 1, -6> look_at 0 aperture 0.3 blur_samples 7 focal_point 0", "location -6*z normal { bumps 0.3 }",
    };
    for (size_t i = 0; i < COUNT(cameras); i++) {
        char scene[512];
        snprintf(scene, sizeof scene, "#version 3.7; camera { %s } plane { y, -1 pigment { bozo scale 0.3 } finish { ambient 1 } } "
                 "sphere { 0, 1 pigment { gradient x } finish { ambient 1 } }", cameras[i]);
        SceneText text = { .accel = NULL };
        bool seen = false;
        assert_true(scene_text(&text, scene));
        each_in_row_is_as_alone(&text, &seen);
        assert_true(seen);
        scene_text_end(&text);
    }
}

/* In the middle of the picture such a camera looks nowhere; its neighbours in the row are not to share that. */
static void a_direction_without_length_is_alone_with_it(void **state)
{
    (void)state;
    SceneText text = { .accel = NULL };
    assert_true(scene_text(&text, "#version 3.7; camera { location -z } sphere { 0, 1 pigment { gradient x } finish { ambient 1 } }"));
    text.world.camera.direction = vec3(0, 0, 0);
    Arena arena;
    arena_init(&arena);
    const RenderOptions options = { .width = 5, .height = 5, .threads = 1, .quality = 9 };
    Sampler s;
    sampler_init(&s, &arena, sampling_new(&arena, &text.world, &options), NULL);
    for (int i = 0; i < 5; i++) {
        sampler_row(&s, 0, 2, 5);
        sampler_in_row(&s, i);
        assert_true(same_vec3(s.ray->d, vec3(i < 2 ? -1 : i > 2 ? 1 : 0, 0, 0)));
    }
    sampler_free(&s);
    arena_free(&arena);
    scene_text_end(&text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_row_sees_what_its_places_see),
        cmocka_unit_test(a_direction_without_length_is_alone_with_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
