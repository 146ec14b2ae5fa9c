/* test_sampling.c - pixels of antialiased and blurred pictures as measured on the reference, and what must not change them. */
#include "lib/picture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#define COUNT(a) (sizeof(a) / sizeof(a)[0])

static const char HEAD[] = "#version 3.7; global_settings { assumed_gamma 1.0 }";

/* ---- measured (03-camera-and-sampling, section 12) ---- */

static void antialiasing_is_as_measured(void **state)
{
    (void)state;
    static const struct { WhitOptions o; double value[3][10]; } rows[] = {
        { { .antialias = 1 },
          { { .268, .1, .292, .292, .724, .58, .772, .58, .748, .604 }, { .1, .244, .124, .268, .172, .46, .58, .7, .604, .7 },
            { .1, .244, .1, .22, .124, .244, .34, .7, .628, .7 } } },
        { { .antialias = 1, .jitter = -1 },
          { { .268, .1, .292, .244, .772, .58, .82, .58, .748, .58 }, { .1, .22, .1, .244, .148, .604, .58, .724, .58, .7 },
            { .1, .22, .1, .244, .1, .268, .292, .724, .58, .7 } } },
        { { .antialias = 2 },
          { { .25, .12625, .29875, .2425, .7075, .58, .58, .58, .775, .61 },
            { .13, .20875, .11875, .21625, .16, .55, .58, .69625, .6175, .7 },
            { .1375, .21625, .13375, .22375, .1, .2275, .325, .67375, .6175, .7 } } },
        { { .antialias = 2, .jitter = -1 },
          { { .25, .12625, .29875, .2425, .7225, .58, .58, .58, .7825, .61 },
            { .1375, .21625, .12625, .22375, .175, .55, .58, .71125, .6175, .6775 },
            { .1375, .21625, .12625, .22375, .1, .22, .3175, .68875, .6175, .6775 } } },
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        WhitOptions o = rows[i].o;
        o.width = 10;
        o.height = 8;
        o.threads = 1;
        Picture p = picture_of(&o, (const char *[]){ HEAD,
            "camera { orthographic location -5*z right 10*x up 8*y direction z }",
            "#declare F = function { 0.1 + 0.48*select(0.7*x+y-0.63, 0, 1) + 0.24*select(sin(3*x)*cos(2*y)-0.2, 0, 1) }",
            "plane { z, 0 pigment { function { F(x,y,z) } color_map { [0 rgb 0] [1 rgb 1] } } finish { ambient 1 diffuse 0 } }",
            NULL });
        for (int y = 0; y < 3; y++)
            for (int x = 0; x < 10; x++) {
                double v = rows[i].value[y][x];
                if (!picture_has(&p, x, y + 2, (double[]){ v, v, v }, 2e-5))
                    fail_msg("antialiasing, row %zu", i);
            }
        picture_free(&p);
    }
}

static void focal_blur_is_as_measured(void **state)
{
    (void)state;
    static const struct { int n; double value[8]; } rows[] = {
        { 7, { .2491, .4803, .3462, .2766, .7039, .5850, .6535, .7605 } },
        { 19, { .2518, .4163, .3395, .2906, .7285, .6076, .6344, .7420 } },
        { 50, { .2386, .4200, .3519, .2848, .7235, .6005, .6271, .7334 } },
    };
    WhitOptions o = { .width = 8, .height = 6, .threads = 1 };
    for (size_t i = 0; i < COUNT(rows); i++) {
        char camera[256];
        snprintf(camera, sizeof camera, "camera { location 0 look_at 6*z right 1.33*x aperture 0.8 focal_point <0,0,4> "
                 "blur_samples %d }", rows[i].n);
        Picture p = picture_of(&o, (const char *[]){ HEAD, camera,
            "#declare F = function { 0.35 + 0.25*sin(2.3*x+0.4)*cos(1.7*y) + 0.3*select(x+0.6*y-0.3, 0, 1) }",
            "plane { z, 6 pigment { function { F(x,y,z) } color_map { [0 rgb 0] [1 rgb 1] } } finish { ambient 1 diffuse 0 } }",
            NULL });
        for (int x = 0; x < 8; x++) {
            double v = rows[i].value[x];
            if (!picture_has(&p, x, 2, (double[]){ v, v, v }, 1e-4))
                fail_msg("blur_samples %d", rows[i].n);
        }
        picture_free(&p);
    }
}

/* The location is in none of the spheres. */
static void parallel_rays_start_in_the_bodies_around_each(void **state)
{
    (void)state;
    WhitOptions o = { .width = 4, .height = 1, .threads = 1 };
    for (int with = 0; with < 2; with++) {
        Picture p = picture_of(&o, (const char *[]){ HEAD,
            "camera { orthographic location -5*z right 4*x up y direction z }",
            "plane { z, 0 pigment { rgb 1 } finish { ambient 1 diffuse 0 } }",
            with ? "sphere { <-1.5,0,-5>, 0.6 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { fade_distance 0.3 fade_power 2 } }" : "",
            NULL });
        for (int x = 0; x < 4; x++) {
            double v = with && x == 0 ? 0.2 : 1;           /* 1 / (1 + (0.6 / 0.3)^2) */
            if (!picture_has(&p, x, 0, (double[]){ v, v, v }, 1e-4))
                fail_msg("%s sphere", with ? "with a" : "without the");
        }
        picture_free(&p);
    }
}

/* ---- what must not change a picture ---- */

/* A bit of everything that draws chance, bends rays or measures lengths. */
static const char MIXTURE[] =
    "camera { location <0,3,-7>*S look_at <0,0.6,0>*S angle 45 }"
    "plane { y, 0 pigment { checker rgb 0.9 rgb <.5,.4,.3> scale S } }"
    "light_source { <-8,12,-10>*S rgb 1 area_light 2*S*x, 2*S*z, 4, 4 adaptive 1 jitter fade_distance 10*S fade_power 2 }"
    "sphere { <-1.2,1,0>*S, S pigment { rgbf <0.9,1,0.9,.9> } finish { phong 0.6 reflection .1 } "
    "  interior { ior 1.5 dispersion 1.02 fade_distance S fade_power 2 } }"
    "box { <.5,0,-1>*S, <2,1.2,1>*S pigment { bozo scale .3*S color_map { [0 rgb 1] [1 rgb <1,0,0>] } } "
    "  normal { bumps .3 scale .1*S } finish { crand .1 } }"
    "torus { S, .3*S rotate 60*x translate <0,1.5,2>*S pigment { rgb <.2,.9,.2> } }"
    "difference { sphere { 0, S } cylinder { -2*S*z, 2*S*z, .4*S } translate <2.2,1,1.5>*S pigment { rgb <.2,.3,.9> } }"
    "fog { distance 30*S rgb .7 }"
    "rainbow { angle 20 width 8 distance 40*S direction <0,-.1,1> jitter .02 color_map { [0 rgbt <1,0,0,.6>] [1 rgbt <0,0,1,1>] } }";

static Picture mixture(const WhitOptions *o, int power)
{
    char scale[64];
    snprintf(scale, sizeof scale, "#declare S = pow(2, %d);", power);
    return picture_of(o, (const char *[]){ HEAD, scale, MIXTURE, NULL });
}

static void assert_same(const Picture *a, const Picture *b)
{
    size_t n = 4 * (size_t)a->image.width * (size_t)a->image.height;
    assert_memory_equal(a->image.rgba, b->image.rgba, n * sizeof(float));
}

static void threads_leave_no_trace(void **state)
{
    (void)state;
    for (int antialias = 0; antialias <= 2; antialias++) {
        WhitOptions o = { .width = 90, .height = 70, .threads = 1, .antialias = antialias };
        Picture one = mixture(&o, 0);
        for (int threads = 2; threads <= 7; threads += 5) {
            o.threads = threads;
            Picture many = mixture(&o, 0);
            assert_same(&one, &many);
            picture_free(&many);
        }
        picture_free(&one);
    }
}

static void powers_of_two_scale_exactly(void **state)
{
    (void)state;
    static const int powers[] = { -300, -100, -40, -20, 20, 40, 100, 300 };
    WhitOptions o = { .width = 48, .height = 36, .threads = 2, .antialias = 1 };
    Picture plain = mixture(&o, 0);
    for (size_t i = 0; i < COUNT(powers); i++) {
        Picture scaled = mixture(&o, powers[i]);
        assert_same(&plain, &scaled);
        picture_free(&scaled);
    }
    picture_free(&plain);
}

static void accelerators_do_not_matter(void **state)
{
    (void)state;
    WhitOptions o = { .width = 60, .height = 45, .threads = 1, .accel = "list" };
    Picture slow = mixture(&o, 0);
    o.accel = "bvh";
    Picture fast = mixture(&o, 0);
    assert_same(&slow, &fast);
    picture_free(&slow);
    picture_free(&fast);
}

/* A region shows what the whole picture shows there, as long as chance and tiles stay out of it. */
static void a_region_is_cut_out(void **state)
{
    (void)state;
    const char *const scene[] = { HEAD, "camera { location -5*z direction z } sphere { 0, 1 pigment { rgb <1,.5,.2> } }",
                                  "light_source { <3,4,-5> rgb 1 }", NULL };
    WhitOptions o = { .width = 64, .height = 48, .threads = 1 };
    Picture whole = picture_of(&o, scene);
    o.start_column = 21;
    o.end_column = 50;
    o.start_row = 0.25;
    o.end_row = 0.75;
    Picture part = picture_of(&o, scene);
    for (int y = 0; y < 48; y++)
        for (int x = 0; x < 64; x++) {
            const float *got = picture_pixel(&part, x, y), *full = picture_pixel(&whole, x, y);
            if (x >= 20 && x < 50 && y >= 12 && y < 36)
                assert_memory_equal(got, full, 4 * sizeof(float));
            else
                assert_true(got[0] == 0 && got[1] == 0 && got[2] == 0 && got[3] == 1);
        }
    picture_free(&whole);
    picture_free(&part);
}

/* The tile in the middle is given the colours along its edges by its neighbours; as the first of a region it has none. */
static void tiles_share_their_edges_unseen(void **state)
{
    (void)state;
    const char *const scene[] = { HEAD, "camera { location -5*z direction z } light_source { <3,4,-5> rgb 1 }",
        "plane { z, 0 pigment { checker rgb <1,.5,.2> rgb .3 scale .17 rotate 20 } }", NULL };
    WhitOptions o = { .width = 96, .height = 96, .threads = 1, .antialias = 1 };
    Picture whole = picture_of(&o, scene);
    o.start_column = o.start_row = 33;
    o.end_column = o.end_row = 64;
    Picture part = picture_of(&o, scene);
    for (int y = 32; y < 64; y++)
        assert_memory_equal(picture_pixel(&part, 32, y), picture_pixel(&whole, 32, y), 32 * 4 * sizeof(float));
    picture_free(&whole);
    picture_free(&part);
}

static bool stop_at_once(void *user, int done, int all)
{
    (void)all;
    *(int *)user = done;
    return false;
}

static void progress_can_cancel(void **state)
{
    (void)state;
    static const char text[] = "#version 3.7; sphere { 5*z, 1 }";
    int done = 0;
    Whit *w = whit_new(&(WhitOptions){ .width = 320, .height = 320, .threads = 1 });
    assert_true(whit_load_text(w, "test.pov", text, strlen(text)));
    assert_false(whit_render(w, stop_at_once, &done));
    assert_int_equal(done, 1);
    assert_null(whit_image(w).rgba);
    whit_free(w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(antialiasing_is_as_measured),
        cmocka_unit_test(focal_blur_is_as_measured),
        cmocka_unit_test(parallel_rays_start_in_the_bodies_around_each),
        cmocka_unit_test(threads_leave_no_trace),
        cmocka_unit_test(powers_of_two_scale_exactly),
        cmocka_unit_test(accelerators_do_not_matter),
        cmocka_unit_test(a_region_is_cut_out),
        cmocka_unit_test(tiles_share_their_edges_unseen),
        cmocka_unit_test(progress_can_cancel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
