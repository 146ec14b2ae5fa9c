/* test_radiosity.c - gathered light as measured on the reference (05-global-effects, section 6), and what must not change it. */
#include "lib/picture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

#define COUNT(a) (sizeof(a) / sizeof(a)[0])

/* One pixel of a plane under a sky. */
static Picture plane_under(const char *version, const char *radiosity, const char *finish, const char *sky)
{
    WhitOptions options = { .width = 1, .height = 1, .threads = 1 };
    return picture_of(&options, (const char *[]){
        version, "global_settings { assumed_gamma 1 radiosity { pretrace_start 1 pretrace_end 1", radiosity,
        "} } camera { location <0,5,0> look_at 0 } plane { y, 0 pigment { rgb .8 } finish {", finish, "} } sky_sphere { pigment {", sky,
        "} }", NULL });
}

static void single_samples_are_as_measured(void **state)
{
    (void)state;
    static const struct { const char *version, *radiosity, *finish, *sky; double rgb[3]; } rows[] = {
        { "#version 3.7;", "", "ambient .3 diffuse .7", "rgb .5", { .28, .28, .28 } },
        { "#version 3.7;", "brightness 2", "ambient .3 diffuse .7", "rgb .5", { .56, .56, .56 } },
        { "#version 3.7;", "", "ambient .3 diffuse .7 emission .1", "rgb .5", { .36, .36, .36 } },
        { "#version 3.6;", "", "ambient .3 diffuse .7", "rgb .5", { .52, .52, .52 } },
        { "#version 3.7;", "max_sample .2", "ambient .3 diffuse .7", "rgb .5", { .112, .112, .112 } },
        { "#version 3.7;", "gray_threshold 1", "diffuse .7", "rgb <1,.5,.1>", { .33762, .33762, .33762 } },
        { "#version 3.7;", "gray_threshold .5", "diffuse .7", "rgb <1,.5,.1>", { .44881, .30881, .19681 } },
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        Picture p = plane_under(rows[i].version, rows[i].radiosity, rows[i].finish, rows[i].sky);
        if (!picture_has(&p, 0, 0, rows[i].rgb, 2e-5))
            fail_msg("row %zu", i);
        picture_free(&p);
    }
}

/* Skies that show a component of the direction give its mean over the rays of a sample. */
static void rays_go_where_they_should(void **state)
{
    (void)state;
    static const struct { const char *count; double mean[3]; } rows[] = {
        { "count 5", { -.02703, .7242, .01568 } }, { "count 35", { -.01123, .68074, .01241 } },
        { "count 100", { -.00094, .67645, .00396 } },
    };
    for (size_t i = 0; i < COUNT(rows); i++)
        for (int axis = 0; axis < 3; axis++) {
            char sky[128];
            snprintf(sky, sizeof sky, "function { 0.5 + 0.4*%c }", "xyz"[axis]);
            Picture p = plane_under("#version 3.7;", rows[i].count, "diffuse .7", sky);
            double found = ((double)picture_pixel(&p, 0, 0)[0] / .56 - .5) / .4;
            assert_true(fabs(found - rows[i].mean[axis]) < 1e-4);
            picture_free(&p);
        }
}

#define BOX(RADIOSITY) \
    "#version 3.7; global_settings { assumed_gamma 1 radiosity {" RADIOSITY "} }" \
    "camera { location <0,1,-3.5>*S look_at <0,.6,0>*S right x up y }" \
    "box { <-1,0,-4>*S, <1,2,1.2>*S pigment { rgb 1 } finish { ambient 0 diffuse .7 } inverse hollow }" \
    "box { <-.4,1.98,-.4>*S, <.4,1.99,.4>*S pigment { rgb 1 } finish { emission 8 diffuse 0 } }" \
    "sphere { <0,.5,.3>*S, .5*S pigment { rgb <1,.3,.3> } finish { ambient 0 diffuse .7 } }"

static Picture box_of(const char *text, int threads, int power)
{
    char scale[64];
    snprintf(scale, sizeof scale, "#declare S = pow(2, %d);", power);
    WhitOptions options = { .width = 64, .height = 64, .threads = threads };
    return picture_of(&options, (const char *[]){ scale, text, NULL });
}

static void assert_same(const Picture *a, const Picture *b)
{
    size_t n = 4 * (size_t)a->image.width * (size_t)a->image.height;
    assert_memory_equal(a->image.rgba, b->image.rgba, n * sizeof(float));
}

static void threads_and_scales_leave_no_trace(void **state)
{
    (void)state;
    static const char text[] = BOX("count 20 error_bound .8");
    Picture one = box_of(text, 1, 0), three = box_of(text, 3, 0), huge = box_of(text, 2, 100), tiny = box_of(text, 2, -100);
    assert_same(&one, &three);
    assert_same(&one, &huge);
    assert_same(&one, &tiny);
    picture_free(&one);
    picture_free(&three);
    picture_free(&huge);
    picture_free(&tiny);
}

static void a_closed_box_is_as_bright_as_measured(void **state)
{
    (void)state;
    static const double expected[] = { .138, .133, .133 };
    Picture p = box_of(BOX("count 200 error_bound .5 recursion_limit 1"), 2, 0);
    double sum[3] = { 0, 0, 0 };
    for (int i = 0; i < 64 * 64; i++)
        for (int c = 0; c < 3; c++)
            sum[c] += fmin(1, (double)picture_pixel(&p, i % 64, i / 64)[c]) / (64 * 64);
    for (int c = 0; c < 3; c++)
        if (fabs(sum[c] / expected[c] - 1) > 0.03)
            fail_msg("means are %.4f %.4f %.4f", sum[0], sum[1], sum[2]);
    picture_free(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(single_samples_are_as_measured),
        cmocka_unit_test(rays_go_where_they_should),
        cmocka_unit_test(threads_and_scales_leave_no_trace),
        cmocka_unit_test(a_closed_box_is_as_bright_as_measured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
