/* test_media.c - dust and glow as measured on the reference (05-global-effects, section 6), and what must hold for any. */
#include "lib/picture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

#define COUNT(a) (sizeof(a) / sizeof(a)[0])

/* A clear box, 2 thick, looked through along z. */
static Picture box_of(const char *hollow, const char *media)
{
    WhitOptions options = { .width = 2, .height = 2, .threads = 1 };
    return picture_of(&options, (const char *[]){
        "#version 3.7; global_settings { assumed_gamma 1 } background { rgb <.2,.4,.6> }",
        "camera { orthographic location -5*z right x up y direction z } box { <-9,-9,0>, <9,9,2>", hollow,
        "pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media {", media, "} } }", NULL });
}

#define GLOW "emission <.1,.2,.05> "
#define DUST "absorption <.3,.5,.7> "
#define RAMP "density { gradient z color_map { [0 rgb .3] [1 rgb 1.2] } scale 3 } "         /* 0.3 + 0.3 z */

static void media_are_as_measured(void **state)
{
    (void)state;
    static const struct { const char *media; double rgb[3]; } rows[] = {
        { GLOW, { .4, .8, .7 } },
        { DUST, { .10976, .14716, .14795 } },
        { GLOW DUST, { .26781, .42165, .20830 } },
        { GLOW DUST "samples 20", { .26430, .41167, .20526 } },
        { GLOW DUST "method 2 samples 4", { .26001, .39934, .20150 } },
        { GLOW DUST "method 2 samples 4 intervals 3", { .26001, .39934, .20150 } },
        { GLOW DUST RAMP, { .24067, .40830, .31633 } },
        { GLOW DUST RAMP "method 2 samples 5", { .23392, .38247, .29454 } },
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        Picture p = box_of("hollow", rows[i].media);
        if (!picture_has(&p, 0, 0, rows[i].rgb, 2e-5))
            fail_msg("media: %s", rows[i].media);
        picture_free(&p);
    }
}

static void bodies_that_are_not_hollow_hide_their_media(void **state)
{
    (void)state;
    Picture p = box_of("", GLOW DUST);
    assert_true(picture_has(&p, 0, 0, (double[]){ .2, .4, .6 }, 1e-6));
    picture_free(&p);
}

static void scattering_depends_on_the_angle(void **state)
{
    (void)state;
    static const struct { const char *type; double beside, ahead; } rows[] = {
        { "1, .02", .0200, .0200 }, { "2, .02", .01193, .11533 }, { "3, .02", .00992, .50562 },
        { "4, .02", .01599, .03197 }, { "5, .02 eccentricity .4", .01344, .07778 },
    };
    for (size_t i = 0; i < COUNT(rows); i++)
        for (int ahead = 0; ahead < 2; ahead++) {
            char light[256];
            snprintf(light, sizeof light, "scattering { %s extinction 0 } } } } light_source { %s, rgb .5 parallel point_at 0 } "
                     "union { interior { media {", rows[i].type, ahead ? "<0,0,100>" : "<0,100,0>");
            Picture p = box_of("hollow", light);
            double v = ahead ? rows[i].ahead : rows[i].beside;
            if (!picture_has(&p, 0, 0, (double[]){ .2 + v, .4 + v, .6 + v }, 6e-5))
                fail_msg("scattering { %s }", rows[i].type);
            picture_free(&p);
        }
}

/* Dust dims shadows by the length of the way through it, however the way is cut. */
static void shadows_of_dust_follow_the_law_of_absorption(void **state)
{
    (void)state;
    WhitOptions options = { .width = 4, .height = 4, .threads = 1 };
    Picture p = picture_of(&options, (const char *[]){
        "#version 3.7; global_settings { assumed_gamma 1 } camera { orthographic location <0,9,-.001> look_at 0 right x up y }",
        "light_source { 1000*y, rgb 1 parallel point_at 0 } plane { y, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } }",
        "box { <-9,1,-9>, <9,3,9> hollow no_image pigment { rgbt 1 } interior { media { absorption .25 } } }",
        "box { <-9,4,-9>, <9,6,9> hollow no_image pigment { rgbt 1 } interior { media { absorption .25 density { rgb 1 } } } }", NULL });
    double v = exp(-1);
    assert_true(picture_has(&p, 1, 1, (double[]){ v, v, v }, 1e-5));
    picture_free(&p);
}

static void air_hides_what_is_far(void **state)
{
    (void)state;
    WhitOptions options = { .width = 2, .height = 2, .threads = 1 };
    Picture p = picture_of(&options, (const char *[]){
        "#version 3.7; global_settings { assumed_gamma 1 } camera { orthographic location -2*z right x up y direction z }",
        "plane { -z, 0 pigment { rgb 1 } finish { ambient 1 diffuse 0 } } media { absorption <.5,1,2> }", NULL });
    assert_true(picture_has(&p, 0, 0, (double[]){ exp(-1), exp(-2), exp(-4) }, 1e-5));
    picture_free(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(media_are_as_measured),
        cmocka_unit_test(bodies_that_are_not_hollow_hide_their_media),
        cmocka_unit_test(scattering_depends_on_the_angle),
        cmocka_unit_test(shadows_of_dust_follow_the_law_of_absorption),
        cmocka_unit_test(air_hides_what_is_far),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
