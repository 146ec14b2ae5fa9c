/* test_shading.c - light on surfaces as measured on the reference (04-shading, section 14): each row to 1e-5 or so. */
#include "lib/picture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

static const char HEAD[] = "#version 3.7; global_settings { assumed_gamma 1 }";

typedef struct Row {
    const char *what;                          /* what goes into the gap of the scene */
    int x, y;
    double rgb[3];
} Row;

static void check_rows(const char *before, const char *after, const Row *row, size_t n, double tolerance)
{
    WhitOptions options = { .width = 8, .height = 6, .threads = 1 };
    int wrong = 0;
    for (size_t i = 0; i < n; i++) {
        Picture p = picture_of(&options, (const char *[]){ HEAD, before, row[i].what, after, NULL });
        if (!picture_has(&p, row[i].x, row[i].y, row[i].rgb, tolerance)) {
            fprintf(stderr, "  with: %s\n", row[i].what);
            wrong++;
        }
        picture_free(&p);
    }
    assert_int_equal(wrong, 0);
}

#define COUNT(a) (sizeof(a) / sizeof(a)[0])

static const char FRONT[] = "camera { orthographic location -5*z right 4*x up 3*y direction z }";
static const char LIGHT[] = "light_source { <1,2,-3> rgb <.9,.8,.7> }";
#define WALL "plane { z, 0 pigment { rgb <.5,.8,.3> } "

static void finishes_answer_light_as_measured(void **state)
{
    (void)state;
    static const Row rows[] = {
        { "", 3, 2, { .21944, .31209, .10240 } },
        { "diffuse .7 brilliance 3", 3, 2, { .16912, .24051, .07892 } },
        { "diffuse 0 phong .5 phong_size 10", 3, 2, { .05660, .05031, .04402 } },
        { "diffuse 0 specular .5 roughness .1", 3, 2, { .27526, .24468, .21408 } },
        { "diffuse 0 specular .5 roughness .1 metallic .4", 3, 2, { .22110, .22542, .15511 } },
        { "diffuse .6 irid { .4 thickness .3 }", 3, 2, { .23420, .43180, .12988 } },
    };
    char before[512];
    snprintf(before, sizeof before, "%s %s " WALL "finish { ambient 0 ", FRONT, LIGHT);
    check_rows(before, "} }", rows, COUNT(rows), 1.5e-5);
}

static void lights_shine_as_measured(void **state)
{
    (void)state;
    static const Row rows[] = {
        { "spotlight point_at <.3,.2,0> radius 5 falloff 20 tightness 8", 3, 2, { .19191, .27294, .08956 } },
        { "cylinder point_at <.3,.2,0> radius .4 falloff 1.5 tightness 3", 3, 2, { .05559, .07904, .02594 } },
        { "fade_distance 3 fade_power 2.5", 3, 2, { .16381, .23297, .07645 } },
    };
    char before[512];
    snprintf(before, sizeof before, "%s " WALL "finish { ambient 0 } } light_source { <1,2,-3> rgb <.9,.8,.7> ", FRONT);
    check_rows(before, "}", rows, COUNT(rows), 1.5e-5);
}

static void coloured_things_cast_coloured_shadows(void **state)
{
    (void)state;
    static const Row rows[] = {
        { "pigment { rgbft <.9,.5,.2,.6,.2> }", 3, 2, { .12016, .07802, .01048 } },
        { "pigment { rgbf <.9,.5,.2,.6> } interior { ior 1.5 caustics .2 }", 3, 2, { .08533, .03745, .00197 } },
    };
    char before[512];
    snprintf(before, sizeof before, "%s %s " WALL "finish { ambient 0 } } box { <-9,-9,-1.2>, <9,9,-1> no_image ", FRONT, LIGHT);
    check_rows(before, "}", rows, COUNT(rows), 1.5e-5);
}

static void crand_is_the_same_grain(void **state)
{
    (void)state;
    static const Row rows[] = { { "crand .3", 3, 2, { .08469, .12045, .03952 } } };
    char before[512];
    snprintf(before, sizeof before, "%s %s " WALL "finish { ambient 0 ", FRONT, LIGHT);
    check_rows(before, "} }", rows, COUNT(rows), 1.5e-5);
}

/* The sky reads back 0.5 + 0.4 x of the direction. */
#define GLOBE "sky_sphere { pigment { gradient x color_map { [0 rgb -1.5][1 rgb 2.5] } scale 10 translate -5*x } }"
static const char INSIDE[] = "camera { location <0,0,-3> direction z right 2*x up 1.5*y } " GLOBE;

static void mirrors_and_glass_are_as_measured(void **state)
{
    (void)state;
    static const Row rows[] = {
        { "plane { -z, 0 pigment { rgb <.5,.8,.3> } finish { ambient 0 diffuse 0 reflection { .2, .9 falloff 3 } } }", 6, 1,
          { .14388, .14388, .14388 } },
        { "plane { -z, 0 pigment { rgb <.5,.8,.3> } finish { ambient 0 diffuse 0 reflection { .7 metallic } } }", 6, 1,
          { .24977, .39477, .15312 } },
        { "plane { -z, 0 pigment { rgb <.5,.8,.3> } finish { ambient 0 diffuse 0 reflection { .4 exponent .5 } } }", 6, 1,
          { .19713, .19713, .19713 } },
        { "plane { -z, 0 pigment { rgb <.5,.8,.3> } finish { ambient 0 diffuse 0 reflection { .1, .9 fresnel } } interior { ior 1.5 } }",
          6, 1, { .09465, .09465, .09465 } },
        { "plane { -z, 0 pigment { rgbft <.5,.8,.3,.4,.3> } finish { ambient 0 diffuse 0 } interior { ior 1.5 } }", 6, 1,
          { .31734, .39350, .26658 } },
        { "plane { -z, 0 pigment { rgbft <.5,.8,.3,.4,.3> } finish { ambient 0 diffuse 0 reflection .3 conserve_energy } "
          "interior { ior 1.5 } }", 6, 1, { .43275, .48606, .39721 } },
        { "plane { -z, 0 pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { ior 1.5 dispersion 1.2 } }", 6, 1,
          { .63714, .63674, .62657 } },
        { "plane { -z, 0 pigment { rgb <.5,.8,.3> } finish { ambient 0 diffuse 0 reflection .5 irid { .4 thickness .3 } } }", 6, 1,
          { .30153, .47897, .49114 } },
        { "box { <-99,-99,0>, <99,99,.5> pigment { rgbf <.9,.5,.2,.6> } finish { ambient 0 diffuse 0 } "
          "interior { ior 1.5 fade_distance .3 fade_power 2 fade_color <.3,.6,.9> } }", 6, 1, { .09487, .04381, .00934 } },
        { "box { <-99,-99,0>, <99,99,.5> pigment { rgbf <.9,.5,.2,.6> } finish { ambient 0 diffuse 0 } "
          "interior { ior 1.5 fade_distance .3 } }", 6, 1, { .10236, .03159, .00505 } },
        { "plane { z, 0 pigment { rgbft <.5,.8,.3,.4,.3> } finish { ambient 0 diffuse 0 reflection .25 } interior { ior 1.5 } }", 0, 0,
          { .26165, .26165, .26165 } },
        { "plane { z, 0 pigment { rgbft <.5,.8,.3,.4,.3> } finish { ambient 0 diffuse 0 reflection .25 } interior { ior 1.5 } }", 4, 2,
          { .42423, .49310, .37833 } },
    };
    check_rows(INSIDE, "", rows, COUNT(rows), 2e-5);
}

static void facing_mirrors_stop_where_the_limits_say(void **state)
{
    (void)state;
    static const struct { const char *limit; double value; } rows[] = {
        { "max_trace_level 1", .05 }, { "max_trace_level 2", .075 }, { "max_trace_level 3", .0875 },
        { "max_trace_level 5", .096875 }, { "max_trace_level 10 adc_bailout 0", .0999 },
        { "max_trace_level 10 adc_bailout .5", .075 }, { "max_trace_level 10 adc_bailout .26", .075 },
        { "max_trace_level 10 adc_bailout .25", .0875 }, { "max_trace_level 10 adc_bailout .1", .09375 },
    };
    WhitOptions options = { .width = 4, .height = 4, .threads = 1 };
    for (size_t i = 0; i < COUNT(rows); i++) {
        char limits[256];
        snprintf(limits, sizeof limits, "global_settings { assumed_gamma 1 %s }", rows[i].limit);
        Picture p = picture_of(&options, (const char *[]){ "#version 3.7;", limits,
            "#default { pigment { rgb 1 } finish { ambient .05 diffuse 0 reflection .5 } }",
            "camera { location <0,0,0> direction z right x up y } plane { z, 1 } plane { z, -1 inverse }", NULL });
        assert_true(picture_has(&p, 2, 2, (double[]){ rows[i].value, rows[i].value, rows[i].value }, 1e-4));
        picture_free(&p);
    }
}

static void area_lights_are_as_measured(void **state)
{
    (void)state;
    static const struct { const char *how; double value[8]; } rows[] = {
        { "2, 2", { .25228, .26423, .27440, .42280, .28583, .28583, .28186, .41160 } },
        { "5, 5", { .37842, .26423, .13719, .06166, .07146, .21437, .36995, .48878 } },
        { "5, 5 jitter", { .37842, .31377, .08576, .07047, .07146, .25011, .35233, .46305 } },
        { "5, 5 circular", { .40996, .26423, .10289, 0, .06253, .21437, .35233, .49735 } },
        { "5, 5 circular orient", { .38631, .27250, .12862, 0, .10719, .25011, .39637, .50593 } },
        { "17, 17 adaptive 1", { .39124, .27352, .14899, .02037, .07369, .21437, .35564, .48180 } },
        { "4, 4 area_illumination", { .37432, .29290, .20201, .10344, .13962, .27926, .34481, .43771 } },
    };
    WhitOptions options = { .width = 8, .height = 6, .threads = 1 };
    for (size_t i = 0; i < COUNT(rows); i++) {
        Picture p = picture_of(&options, (const char *[]){ HEAD, FRONT,
            "plane { z, 0 pigment { rgb 1 } finish { ambient 0 } } disc { <.2,.4,-2>, z, .6 no_image }",
            "light_source { <.5,1,-4> rgb 1 area_light <2,0,0>, <0,1.5,.3>, ", rows[i].how, "}", NULL });
        for (int x = 0; x < 8; x++) {
            double v = rows[i].value[x];
            if (!picture_has(&p, x, 3, (double[]){ v, v, v }, 2e-5))
                fail_msg("area light %s", rows[i].how);
        }
        picture_free(&p);
    }
}

static const char AIR[] = "camera { location <0,1,-3> direction z right 2*x up 1.5*y } "
                          "plane { -z, -2 pigment { rgb <.2,.9,.4> } finish { ambient 1 diffuse 0 } } ";

static void fog_is_as_measured(void **state)
{
    (void)state;
    static const Row rows[] = {
        { "fog { distance 6 rgb <.8,.5,.1> }", 6, 1, { .58605, .64263, .20697 } },
        { "fog { distance 6 rgbf <.8,.5,.1,.4> }", 6, 1, { .58035, .57845, .15563 } },
        { "fog { distance 6 rgb <.8,.5,.1> } fog { distance 9 rgb <.1,.1,.9> }", 6, 1, { .60031, .53280, .58350 } },
        { "fog { fog_type 2 distance 6 rgb <.8,.5,.1> fog_offset .6 fog_alt 2 }", 6, 1, { .50719, .69520, .24640 } },
        { "fog { distance 6 rgb <.8,.5,.1> turbulence .8 turb_depth .7 }", 6, 1, { .54511, .66993, .22745 } },
    };
    check_rows(AIR, "", rows, COUNT(rows), 2e-5);
}

static void rainbows_are_as_measured(void **state)
{
    (void)state;
    static const char bow[] = "rainbow { angle 25 width 20 distance 4 direction <0,.1,1> arc_angle 200 falloff_angle 80 "
                              "color_map { [0 rgbt <1,0,0,.2>] [1 rgbt <0,0,1,.8>] } }";
    static const Row rows[] = {
        { bow, 0, 1, { .2, .9, .4 } }, { bow, 1, 1, { .18212, .76913, .47605 } }, { bow, 2, 1, { .35358, .49274, .42742 } },
        { bow, 3, 1, { .74531, .23470, .15038 } }, { bow, 4, 1, { .74531, .23470, .15038 } },
    };
    check_rows(AIR, "", rows, COUNT(rows), 2e-5);
}

static void skies_are_layered_as_measured(void **state)
{
    (void)state;
    static const struct { const char *version, *a, *b; double rgb[3]; } rows[] = {
        { "3.7", "rgbft <.9,.5,.2,.3,.4>", "rgbft <.2,.9,.5,.2,.5>", { .24198, .4468, .2688 } },
        { "3.6", "rgbft <.9,.5,.2,.3,.4>", "rgbft <.2,.9,.5,.2,.5>", { .27008, .4204, .2538 } },
        { "3.7", "rgb <.9,.5,.2>", "rgbft <.2,.9,.5,.3,.4>", { .474, .605, .26 } },
        { "3.6", "rgb <.9,.5,.2>", "rgbft <.2,.9,.5,.3,.4>", { .69, .62, .29 } },
    };
    WhitOptions options = { .width = 2, .height = 2, .threads = 1 };
    for (size_t i = 0; i < COUNT(rows); i++) {
        char text[512];
        snprintf(text, sizeof text, "#version %s; global_settings { assumed_gamma 1 } background { rgb <.1,.2,.3> } camera { direction z } "
                 "sky_sphere { pigment { %s } pigment { %s } }", rows[i].version, rows[i].a, rows[i].b);
        Picture p = picture_of(&options, (const char *[]){ text, NULL });
        assert_true(picture_has(&p, 1, 1, rows[i].rgb, 1e-5));
        picture_free(&p);
    }
}

/* What is known beforehand spares the general way; here each pair takes the one and the other. */
static void short_ways_lead_to_the_same_bytes(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {
        { "rgb <.9,.8,.7> } plane { z, 0 pigment { rgb <.5,.8,.3> }",                     /* flat, matte, plain light */
          "rgb <.9,.8,.7> } plane { z, 0 pigment { rgb <.5,.8,.3> quick_colour rgb 1 }" },
        { "rgb <.9,.8,.7> } plane { z, 0 pigment { rgb <.5,.8,.3> }",
          "rgb <.9,.8,.7> } plane { z, 0 pigment { rgb <.5,.8,.3> } finish { reflection 1e-30 }" },
        { "rgb <.9,.8,.7> } plane { z, 0 pigment { rgb <.5,.8,.3> }",
          "rgb <.45,.4,.35> fade_distance 1e300 fade_power 2 } plane { z, 0 pigment { rgb <.5,.8,.3> }" },
        { "rgb 1 } plane { z, 0 pigment { rgb .5 } finish { specular .9 roughness .002 }",
          "rgb 1 } plane { z, 0 pigment { rgb .5 } finish { specular .9 roughness .002 phong 1e-30 phong_size 1 }" },
        { "rgb 1 } light_group { light_source { <-2,1,-3> rgb .3 } plane { z, 0 pigment { rgb .5 } } global_lights on",
          "rgb 1 } light_source { <-2,1,-3> rgb .3 } plane { z, 0 pigment { rgb .5 }" },
        { "rgb 1 } light_group { light_source { <-2,1,-3> rgb .3 } plane { z, 0 pigment { rgb .5 } } global_lights off",
          "rgb 0 } light_source { <-2,1,-3> rgb .3 } plane { z, 0 pigment { rgb .5 }" },
        { "rgb 1 } plane { <1,2,-9>, 0 pigment { rgb .5 }",                               /* a face, and one that is carried */
          "rgb 1 } plane { <-1,-2,9>, 0 inverse pigment { rgb .5 }" },
        { "rgb 1 } plane { z, 0 pigment { rgb .5 } } box { <-2,-2,-.2>, <0,2,-.1> pigment { rgbf <.9,.5,.2,.6> }",
          "rgb 1 } plane { z, 0 pigment { rgb .5 } } box { <-2,-2,-.2>, <0,2,-.1> pigment { rgbf <.9,.5,.2,.6> quick_colour rgb 1 }" },
        { "rgb 1 } plane { z, 0 pigment { rgb .5 } } sphere { <.5,1,-2>, .4 } box { <-2,-2,-.2>, <1,2,-.1> rotate 9*y "
          "pigment { rgbf 1 } finish { specular .9 roughness .002 diffuse 0 ambient 0 }",                  /* faint highlights */
          "rgb 1 } plane { z, 0 pigment { rgb .5 } } sphere { <.5,1,-2>, .4 } box { <-2,-2,-.2>, <1,2,-.1> rotate 9*y "
          "pigment { rgbf 1 quick_colour rgbf 2 } finish { specular .9 roughness .002 diffuse 0 ambient 0 }" },
    };
    WhitOptions options = { .width = 8, .height = 6, .threads = 1 };
    for (size_t i = 0; i < COUNT(pairs); i++) {
        Picture p[2];
        for (int k = 0; k < 2; k++)
            p[k] = picture_of(&options, (const char *[]){ HEAD, FRONT, "light_source { <1,2,-3> ", pairs[i][k], "}", NULL });
        assert_memory_equal(p[0].image.rgba, p[1].image.rgba, 8 * 6 * 4 * sizeof p[0].image.rgba[0]);
        picture_free(&p[0]);
        picture_free(&p[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finishes_answer_light_as_measured),
        cmocka_unit_test(lights_shine_as_measured),
        cmocka_unit_test(coloured_things_cast_coloured_shadows),
        cmocka_unit_test(crand_is_the_same_grain),
        cmocka_unit_test(mirrors_and_glass_are_as_measured),
        cmocka_unit_test(facing_mirrors_stop_where_the_limits_say),
        cmocka_unit_test(area_lights_are_as_measured),
        cmocka_unit_test(fog_is_as_measured),
        cmocka_unit_test(rainbows_are_as_measured),
        cmocka_unit_test(skies_are_layered_as_measured),
        cmocka_unit_test(short_ways_lead_to_the_same_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
