/* test_camera.c - every kind of camera looks where its formula says, and turns with its vectors. */
#include "render/camera.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

static CameraDef camera_of(CameraKind kind)
{
    return (CameraDef){ .kind = kind, .direction = { 0, 0, 1 }, .right = { 1.33, 0, 0 }, .up = { 0, 1, 0 } };
}

static bool close_to(Vec3 a, Vec3 b)
{
    return max_abs(sub(a, b)) < 1e-12;
}

static void the_middle_looks_along_the_direction(void **state)
{
    (void)state;
    for (int kind = CAMERA_PERSPECTIVE; kind <= CAMERA_CYLINDER_4; kind++) {
        if (kind == CAMERA_OMNIMAX)
            continue;                          /* its axis is not in the middle of a wide picture */
        CameraDef def = camera_of((CameraKind)kind);
        Camera c = camera_new(&def, 5, 5);
        CameraRay ray;
        assert_true(camera_ray(&c, 2, 2, &ray));
        assert_true(close_to(normalized(ray.d), vec3(0, 0, 1)));
    }
}

static void left_and_up_are_where_they_should_be(void **state)
{
    (void)state;
    for (int kind = CAMERA_PERSPECTIVE; kind <= CAMERA_CYLINDER_4; kind++) {
        CameraDef def = camera_of((CameraKind)kind);
        def.has_angle = kind == CAMERA_FISHEYE;
        def.angle = 100;
        Camera c = camera_new(&def, 9, 9);
        CameraRay ray;
        if (!camera_ray(&c, 3, 3, &ray))
            fail_msg("camera %d sees nothing near its middle", kind);
        Vec3 seen = add(ray.o, ray.d);
        assert_true(seen.x < 0 && seen.y > 0);
    }
}

/* Rotating all vectors of a camera rotates its rays. */
static void rays_turn_with_the_camera(void **state)
{
    (void)state;
    for (int kind = CAMERA_PERSPECTIVE; kind <= CAMERA_CYLINDER_4; kind++) {
        CameraDef def = camera_of((CameraKind)kind), other = def;
        other.right = vec3(0, 1.33, 0);        /* x -> y -> z -> x */
        other.up = vec3(0, 0, 1);
        other.direction = vec3(1, 0, 0);
        Camera c = camera_new(&def, 16, 12), d = camera_new(&other, 16, 12);
        for (int i = 0; i < 16 * 12; i++) {
            CameraRay a, b;
            bool seen = camera_ray(&c, i % 16, i / 16, &a);
            assert_true(camera_ray(&d, i % 16, i / 16, &b) == seen);
            if (seen) {
                assert_true(close_to(vec3(a.d.z, a.d.x, a.d.y), b.d));
                assert_true(close_to(vec3(a.o.z, a.o.x, a.o.y), b.o));
            }
        }
    }
}

static void a_fisheye_sees_a_circle(void **state)
{
    (void)state;
    CameraDef def = camera_of(CAMERA_FISHEYE);
    def.right = vec3(1, 0, 0);
    def.angle = 180;
    def.has_angle = true;
    Camera c = camera_new(&def, 101, 101);
    CameraRay ray;
    assert_true(camera_ray(&c, 50, 0, &ray));
    assert_true(fabs(dot(normalized(ray.d), vec3(0, 0, 1))) < 0.02);
    assert_false(camera_ray(&c, 0, 0, &ray));
}

static void a_sphere_of_directions_is_covered_once(void **state)
{
    (void)state;
    CameraDef def = camera_of(CAMERA_SPHERICAL);
    Camera c = camera_new(&def, 360, 180);
    CameraRay ray;
    assert_true(camera_ray(&c, 0, 90, &ray) && ray.d.z < -0.999);
    assert_true(camera_ray(&c, 359, 90, &ray) && ray.d.z < -0.999);
    assert_true(camera_ray(&c, 180, 0, &ray) && ray.d.y > 0.999);
    assert_true(camera_ray(&c, 180, 179, &ray) && ray.d.y < -0.999);
}

static void orthographic_rays_are_parallel(void **state)
{
    (void)state;
    CameraDef def = camera_of(CAMERA_ORTHOGRAPHIC);
    Camera c = camera_new(&def, 4, 4);
    for (int x = 0; x < 4; x++) {
        CameraRay ray;
        assert_true(camera_ray(&c, x, 0, &ray));
        assert_true(close_to(ray.d, def.direction));
        assert_true(close_to(ray.o, vec3(1.33 * ((x + 0.5) / 4 - 0.5), 0.375, 0)));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_middle_looks_along_the_direction),
        cmocka_unit_test(left_and_up_are_where_they_should_be),
        cmocka_unit_test(rays_turn_with_the_camera),
        cmocka_unit_test(a_fisheye_sees_a_circle),
        cmocka_unit_test(a_sphere_of_directions_is_covered_once),
        cmocka_unit_test(orthographic_rays_are_parallel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
