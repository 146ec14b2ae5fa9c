/* test_block_errors.c - what is refused, and in which words: the reference's, wherever it has a word for it. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "sdl/parsed.h"                        /* before cmocka, which has a macro called fail */

#include <cmocka.h>

#define HEAD "#version 3.7; global_settings { assumed_gamma 1 }\n"

typedef struct Row { const char *scene, *message; } Row;

static const Row refused[] = {
    { "sphere { 0, 1 pigment { bozo gradient x } }",
      "No matching } in 'pigment', gradient found instead" },
    { "sphere { 0, 1 pigment { rgb 1 color_map { [0 rgb 1] } } }",
      "Cannot use color_map with this pattern type." },
    { "sphere { 0, 1 pigment { checker color_map { [0 rgb 1] } } }",
      "Cannot use color_map with this pattern type." },
    { "sphere { 0, 1 pigment { bozo texture_map { [0 pigment { rgb 1 }] } } }",
      "Keyword 'texture_map' can only be used in a texture statement." },
    { "sphere { 0, 1 normal { bozo color_map { [0 rgb 1] } } }",
      "Keyword 'color_map' can only be used in a pigment statement." },
    { "sphere { 0, 1 pigment { bozo normal_map { [0 bumps] } } }",
      "Keyword 'normal_map' can only be used in a normal statement." },
    { "sphere { 0, 1 pigment { bozo bump_size 1 } }",
      "Keyword 'bump_size' can only be used in a normal statement." },
    { "sphere { 0, 1 pigment { bozo mortar 1 } }",
      "Keyword 'mortar' cannot be used with non-brick." },
    { "sphere { 0, 1 pigment { bozo solid } }",
      "Keyword 'solid' can only be used in a crackle statement." },
    { "sphere { 0, 1 pigment { bozo control0 1 } }",
      "Keyword 'control0' cannot be used with this pattern." },
    { "sphere { 0, 1 pigment { bozo exterior 1,1 } }",
      "Keyword 'exterior' can only be used in a mandel, julia, magnet or pavement statement." },
    { "sphere { 0, 1 pigment { bozo brick_size 1 } }",
      "Keyword 'brick_size' cannot be used with non-brick." },
    { "sphere { 0, 1 pigment { bozo agate_turb 1 } }",
      "Keyword 'agate_turb' cannot be used with non-agate." },
    { "sphere { 0, 1 pigment { bozo metric 1 } }",
      "Keyword 'metric' can only be used in a facets or crackle statement." },
    { "sphere { 0, 1 pigment { bozo form x } }",
      "Keyword 'form' can only be used in a crackle or pavement statement." },
    { "sphere { 0, 1 pigment { bozo offset 1 } }",
      "Keyword 'offset' can only be used in a crackle statement." },
    { "sphere { 0, 1 pigment { bozo coords 1 } }",
      "Keyword 'coords' can only be used in a facets statement." },
    { "sphere { 0, 1 pigment { average } }",
      "Average must have map." },
    { "sphere { 0, 1 pigment { average color_map { [0 rgb 1] } } }",
      "Cannot use color_map with this pattern type." },
    { "sphere { 0, 1 pigment { average pigment_map { [rgb 1] } } }",
      "Float expected but vector or color expression found." },
    { "sphere { 0, 1 normal { } }",
      "No normal type given." },
    { "sphere { 0, 1 texture { bozo } }",
      "Patterned texture must have texture_map." },
    { "sphere { 0, 1 texture { bozo texture_map { [0 pigment { rgb 1 }] } } texture { pigment { rgb 1 } } }",
      "Cannot layer over a patterned texture." },
    { "sphere { 0, 1 texture { pigment { rgb 1 } } texture { bozo texture_map { [0 pigment { rgb 1 }] } } }",
      "Cannot layer a patterned texture over another." },
    { "sphere { 0, 1 texture { bozo texture_map { [0 pigment { rgb 1 }] } } pigment { rgb 1 } }",
      "Cannot layer over a patterned texture." },
    { "sphere { 0, 1 pigment { bozo warp { repeat 0 } } }",
      "No axis specified in repeat." },
    { "sphere { 0, 1 pigment { bozo warp { repeat <1,1,0> } } }",
      "Can only repeat along 1 axis." },
    { "sphere { 0, 1 pigment { bozo warp { bozo } } }",
      "Expected 'warp type', bozo found instead" },
    { "sphere { 0, 1 pigment { bozo noise_generator 7 } }",
      "Value for noise_generator must be 0, 1, 2, or 3." },
    { "sphere { 0, 1 pigment { bozo color_map { } } }",
      "Must have at least one color in color map." },
    { "sphere { 0, 1 pigment { bozo color_map { [0 <1,0,0>] } } }",
      "Expected 'color', ] found instead" },
    { "sphere { 0, 1 uv_mapping pigment { checker } uv_mapping }",
      "uv_mapping must be specified before texture." },
    { "sphere { 0, 1 interior_texture { pigment { rgb 1 } } }",
      "Interior texture requires an exterior texture." },
    { "sphere { 0, 1 sturm }",
      "Keyword 'sturm' cannot be used with this object." },
    { "sphere { 0, 1 hierarchy }",
      "Keyword 'hierarchy' cannot be used with this object." },
    { "sphere { 0, 1 open }",
      "No matching } in 'sphere', open found instead" },
    { "sphere { 0, 1 split_union on }",
      "split_union found in non-union object." },
    { "sphere { 0, 1 cutaway_textures }",
      "cutaway_textures can only be used with intersection and difference." },
    { "union { sphere { 0, 1 } cutaway_textures }",
      "cutaway_textures can only be used with intersection and difference." },
    { "sphere { 0, 1 clipped_by { sphere { 0, 1 pigment { rgb 1 } } } }",
      "Illegal texture or patch in clip, bound or object pattern." },
    { "sphere { 0, 1 clipped_by { triangle { 0, x, y } } }",
      "Illegal texture or patch in clip, bound or object pattern." },
    { "sphere { 0, 1 clipped_by { plane { y, 0 } } clipped_by { bounded_by } }",
      "Cannot link bounds with previous clips." },
    { "sphere { 0, 1 bounded_by { box { -1, 1 } } bounded_by { clipped_by } }",
      "Cannot link clips with previous bounds." },
    { "sphere { 0, 1 light_source { 0, 1 } }",
      "Light source must be defined using new syntax." },
    { "sphere { 0, 1 radiosity { importance 0 } }",
      "Radiosity importance must be greater than 0.0 and at most 1.0." },
    { "sphere { 0, 1",
      "No matching } in 'sphere', End of File found instead" },
    { "sphere 0, 1 }",
      "Missing { after 'sphere', float function 'float constant' found instead" },
    { "sphere { 0, 1 foo }",
      "No matching } in 'sphere', undeclared identifier 'foo'" },
    { "foo",
      "Expected 'object or directive', undeclared identifier 'foo'" },
    { "1",
      "Expected 'object or directive', float function 'float constant' found instead" },
    { ";",
      "Expected 'object or directive', ; found instead" },
    { "light_source { 0, 1 point_at x }",
      "Keyword 'point_at' cannot be used with standard light source." },
    { "light_source { 0, 1 radius 1 }",
      "Keyword 'radius' cannot be used with standard light source." },
    { "light_source { 0, 1 area_light x, y, 0, 1 }",
      "Area size must be greater than zero." },
    { "light_source { 0, 1 area_light x, y, 1, 3 circular }",
      "Circular area light must have more than 1 point per axis" },
    { "light_source { 0, 1 looks_like { sphere { 0, 1 } } looks_like { sphere { 0, 1 } } }",
      "Only one looks_like allowed per light_source." },
    { "camera { angle -1 }",
      "Negative viewing angle." },
    { "camera { angle 180 }",
      "Viewing angle has to be smaller than 180 degrees." },
    { "camera { location 1 look_at 1 }",
      "Camera location and look_at point must be different." },
    { "camera { location 0 fisheye }",
      "Expected 'perspective camera modifier', fisheye found instead" },
    { "camera { cylinder 5 }",
      "Invalid cylinder camera type, valid are types 1 to 4." },
    { "camera { blur_samples 0 }",
      "Illegal number of focal blur samples." },
    { "camera { blur_samples 5, 4 }",
      "Focal blur samples minimum must not be larger than maximum." },
    { "global_settings { number_of_waves 0 noise_generator 4 }",
      "Value for noise_generator in global_settings must be 1, 2, or 3." },
    { "global_settings { assumed_gamma 0 }",
      "gamma value must be positive." },
    { "global_settings { charset foo }",
      "Expected 'charset type', undeclared identifier 'foo'" },
    { "global_settings { radiosity { count 10, 5 } }",
      "Radiosity count can not be more than direction pool size (count 2nd value)." },
    { "global_settings { radiosity { nearest_count 30 } }",
      "Radiosity nearest count must be a value from 1 to 20." },
    { "global_settings { radiosity { pretrace_start 2 } }",
      "Radiosity pretrace start must be greater than 0 and no higher than 1." },
    { "global_settings { radiosity { recursion_limit 0 } }",
      "Radiosity recursion limit must be in the range 1 to 20." },
    { "global_settings { radiosity { gray_threshold 2 } }",
      "Radiosity gray threshold must be from 0.0 to 1.0." },
    { "global_settings { radiosity { error_bound 0 } }",
      "Radiosity error bound must be a positive number." },
    { "global_settings { radiosity { minimum_reuse 0.3 maximum_reuse 0.2 } }",
      "Radiosity maximum_reuse must be larger than minimum_reuse." },
    { "global_settings { radiosity { brightness 0 } }",
      "Radiosity brightness must be a positive number." },
    { "global_settings { photons { gather 5, 3 } }",
      "min_gather_count must be less than max_gather_count." },
    { "global_settings { photons { gather -5, 3 } }",
      "min_gather_count cannot be negative." },
    { "global_settings { photons { media -1 } }",
      "max media steps must be non-negative." },
    { "global_settings { photons { media 1, 0 } }",
      "media spacing factor must be greater than zero." },
    { "sphere { 0, 1 interior { media { scattering { 1, 1 eccentricity 0.5 } } } }",
      "Eccentricity cannot be used with this scattering type." },
    { "sphere { 0, 1 interior { media { method 4 } } }",
      "Sample method choices are 1, 2, or 3." },
    { "sphere { 0, 1 interior { media { intervals 0 } } }",
      "At least one interval is needed in media." },
    { "sphere { 0, 1 interior { media { samples 0 } } }",
      "At least one sample per interval is needed in media." },
    { "sphere { 0, 1 interior { media { samples 5,2 } } }",
      "Maximum number of samples per interval smaller than minimum number." },
    { "sphere { 0, 1 interior { media { confidence 1 } } }",
      "Illegal confidence value in media." },
    { "sphere { 0, 1 interior { media { aa_threshold 0 } } }",
      "aa_threshold in media must be greater than zero." },
    { "sphere { 0, 1 interior { media { aa_level 0 } } }",
      "aa_level in media must be at least one." },
    { "sphere { 0, 1 finish { reflection { 1 fresnel 2 } } }",
      "fresnel must be true or false" },
    { "rainbow { direction 0 }",
      "Rainbow's direction vector is zero." },
    { "rainbow { direction y }",
      "Rainbow's up and direction vector are co-linear." },
    { "rainbow { direction z up 0 }",
      "Rainbow's up vector is zero." },
    { "rainbow { direction z arc_angle 400 }",
      "Illegal arc angle in rainbow (Use value from 0 to 360 degrees)." },
    { "rainbow { direction z arc_angle 10 falloff_angle 20 }",
      "Arc angle is smaller than falloff angle in rainbow." },
    { "rainbow { angle 1 }",
      "Rainbow's direction vector is zero." },
    { "sky_sphere { }",
      "Empty sky_sphere statement." },
    { "fog { <1,0,0> }",
      "No matching } in 'fog', < found instead" },
    { "#default { texture { checker texture { } texture { } } }",
      "Default texture cannot be material map or tiles." },
    { "#default { texture { pigment { rgb 1 } } pigment { bozo } sphere { 0, 1 } }",
      "No matching } in 'default', sphere found instead" },
    { "#declare P = pigment { rgb 1 } texture { P }",
      "Expected 'object or directive', texture found instead" },
    { "#declare T = texture { } #default { texture { T pigment { rgb 1 } } } sphere { 0, 1 pigment { T } }",
      "No matching } in 'pigment', texture identifier found instead" },
    { "object { }",
      "Expected 'object', } found instead" },
    { "object { 1 }",
      "Expected 'object', float function 'float constant' found instead" },
    { "light_source { sphere { 0, 1 } }",
      "Expected 'numeric expression', sphere found instead" },
    { "sphere { 0, 1 transform { rotate } }",
      "Expected 'numeric expression', } found instead" },
    { "sphere { 0, 1 matrix <1,0,0, 0,1,0> }",
      "Expected 'numeric expression', > found instead" },
    { "sphere { 0, 1 pigment { image_map { foo \"x\" } } }",
      "Expected 'map file spec', undeclared identifier 'foo'" },
    { "sphere { 0, 1 pigment { image_map { \"o.xyz\" } } }",
      "Could not determine valid image file type from extension." },
    { "sphere { 0, 1 texture { tiles { texture { } } } }",
      "Expected 'tile2', } found instead" },
    { "sphere { 0, 1 texture { tiles { } } }",
      "Expected 'tile2', } found instead" },
    { "sphere { 0, 1 texture { checker texture { } rgb 1 } }",
      "No matching } in 'texture', color keyword 'rgb' found instead" },
    { "sphere { 0, 1 texture { uv_mapping texture { } } }",
      "No matching } in 'texture', texture found instead" },
    { "sphere { 0, 1 texture { pigment { rgb 1 } bozo texture_map { [0 pigment { rgb 1 }] } } }",
      "No matching } in 'texture', bozo found instead" },
    { "sphere { 0, 1 pigment { pigment_pattern { rgb 1 } color_map { [0 rgb 1] } slope 1 } }",
      "No matching } in 'pigment', slope found instead" },
    { "sphere { 0, 1 pigment { checker rgb 1 pigment { rgb 1 } } }",
      "No matching } in 'pigment', pigment found instead" },
    { "sphere { 0, 1 pigment { square rgb 1 rgb 1 rgb 1 rgb 1 rgb 1 } }",
      "No matching } in 'pigment', color keyword 'rgb' found instead" },
    { "sphere { 0, 1 finish { foo 1 } }",
      "No matching } in 'finish', undeclared identifier 'foo'" },
    { "sphere { 0, 1 normal { bozo pigment_map { [0 rgb 1] } } }",
      "Keyword 'pigment_map' can only be used in a pigment statement." },
    { "sphere { 0, 1 normal { bozo quick_color rgb 1 } }",
      "Keyword 'quick_color' can only be used in a pigment statement." },
    { "sphere { 0, 1 normal { checker slope_map { [0 <1,1>] } } }",
      "Keyword 'slope_map' cannot be used with this normal type." },
    { "sphere { 0, 1 normal { average slope_map { [0 <1,1>] } } }",
      "Keyword 'slope_map' cannot be used with this normal type." },
    { "sphere { 0, 1 interior { media { density { bozo pigment_map { [0 rgb 1] } } } } }",
      "Keyword 'pigment_map' can only be used in a pigment statement." },
    { "sphere { 0, 1 interior { media { density { bozo quick_color rgb 1 } } } }",
      "Keyword 'quick_color' can only be used in a pigment statement." },
    { "sphere { 0, 1 interior { media { density { bozo normal { bumps } } } } }",
      "No matching } in 'density', normal found instead" },
    { "camera { mesh_camera { 1, 4 sphere { 0, 1 } } }",
      "Illegal distribution method of mesh_camera: 4; there are 0 to 3." },
    { "union { sphere { 0, 1 } pigment { rgb 1 } sphere { x, 1 } }",
      "No matching } in 'union', sphere found instead" },
    { "light_group { light_source { 0, 1 } sphere { 0, 1 } global_lights on pigment { rgb 1 } }",
      "No matching } in 'light_group', pigment found instead" },
    { "camera { spherical angle -3 }",
      "Negative viewing angle." },
    { "sky_sphere { pigment { gradient y } foo }",
      "No matching } in 'sky_sphere', undeclared identifier 'foo'" },
    { "background { rgb 1 foo }",
      "No matching } in 'background', undeclared identifier 'foo'" },
    { "#declare S = sphere { 0, 1 } box { S, 1 }",
      "No matching } in 'box', ,  found instead" },
    { "light_source { 0, 1 projected_through { sphere { 0, 1 } } projected_through { sphere { 0, 1 } } }",
      "Only one projected_through allowed per light_source." },
};

static const Row warned[] = {
    { "fog { 0.5 }",
      "Should use distance keyword." },
    { "sphere { 0, 1 photons { target on refraction on pass_through } }",
      "Cannot use pass_through with refraction & target. Turning off refraction." },
    { "max_trace_level 3",
      "'max_trace_level' should be in global_settings block." },
    { "declare A = 1;",
      "Should have '#' before 'declare'." },
    { "camera { confidence 2 variance 2 }",
      "Illegal confidence value. Default is used." },
    { "intersection { triangle { 0, x, y } sphere { 0, 1 } }",
      "Patch objects not allowed in intersection." },
    { "sphere { 0, 1 scale 0 }",
      "Illegal Value: Scale X by 0.0. Changed to 1.0." },
    { "sphere { 0, 1 matrix <0,0,0, 0,1,0, 0,0,1, 0,0,0> }",
      "Illegal matrix column: Scale by 0.0. Changed to 1.0." },
    { "triangle { 0, x, y inverse }",
      "Cannot invert a patch object." },
    { "sphere { 0, 1 rgb 1 }",
      "Quick color belongs in texture. Color ignored." },
    { "sphere { 0, 1 finish { roughness 0 } }",
      "Zero roughness used." },
    { "composite { sphere { 0, 1 } sphere { x, 1 } }",
      "Use union instead of composite." },
    { "sphere { 0, 1 finish { ior 1.5 } }",
      "'ior' in a finish is old: moved to the interior." },
    { "global_settings { max_trace_level 300 }",
      "Maximum max_trace_level is 256 but 300 was specified." },
    { "camera { right <1,1,0> }",
      "Camera vectors are not perpendicular. Making look_at the last statement may help." },
};

/* Loops that would nest without end: refused before somebody's recursion meets the end of the stack. */
static const Row endless[] = {
    { "#declare P = pigment { rgb 1 } #while (1) #declare P = pigment { pigment_pattern { P } } #end",
      "patterns are nested more than 250 deep" },
    { "#declare P = pigment { rgb 1 } #while (1) #declare P = pigment { bozo pigment_map { [0 P] [1 rgb 1] } } #end",
      "patterns are nested more than 250 deep" },
    { "#declare M = pigment_map { [0 rgb 1] } #while (1) #declare M = pigment_map { [0 bozo pigment_map { M }] } #end",
      "patterns are nested more than 250 deep" },
    { "#declare N = normal { bumps } #while (1) #declare N = normal { checker normal { N } normal { N } } #end",
      "patterns are nested more than 250 deep" },
    { "#declare T = texture { pigment { rgb 1 } } #while (1) #declare T = texture { bozo texture_map { [0 T] } } #end",
      "patterns are nested more than 250 deep" },
    { "#declare T = texture { pigment { rgb 1 } } #while (1) #declare T = texture { T } texture { T } #end",
      "a texture has at most 250 layers" },
    { "#declare P = pigment { rgb 1 } #while (1) #declare F = function { pigment { P } } #declare P = pigment { function { F(x,y,z).x } } #undef F #end",
      "patterns are nested more than 250 deep" },
    { "#declare O = sphere { 0, 1 } #while (1) #declare O = union { object { O } sphere { 0, 1 } } #end",
      "objects are nested more than 1000 deep" },
    { "#declare O = sphere { 0, 1 } #while (1) #declare O = sphere { 0, 1 clipped_by { O } } #end",
      "objects are nested more than 1000 deep" },
    { "#declare O = sphere { 0, 1 } #while (1) #declare O = light_source { 0, 1 looks_like { O } } #end",
      "objects are nested more than 1000 deep" },
    { "#declare M = media { } #while (1) #declare M = media { M density { rgb 1 } } #end",
      "a media has at most 250 densities" },
};

static Parsed *scene_of(const Row *row)
{
    char text[512];
    snprintf(text, sizeof text, HEAD "%s\n", row->scene);
    return parsed(text);
}

static void wrong_blocks_are_refused_in_the_reference_s_words(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        Parsed *s = scene_of(&refused[i]);
        if (!s->failed || !said(s, DIAG_ERROR, refused[i].message))
            fail_msg("%s\nexpected: %s", refused[i].scene, refused[i].message);
        parsed_free(s);
    }
}

static void odd_blocks_are_taken_with_a_warning(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof warned / sizeof *warned; i++) {
        Parsed *s = scene_of(&warned[i]);
        if (s->failed || !said(s, DIAG_WARNING, warned[i].message))
            fail_msg("%s\nexpected: %s", warned[i].scene, warned[i].message);
        parsed_free(s);
    }
}

static void endless_nesting_is_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof endless / sizeof *endless; i++) {
        Parsed *s = scene_of(&endless[i]);
        if (!s->failed || !said(s, DIAG_ERROR, endless[i].message))
            fail_msg("%s\nexpected: %s", endless[i].scene, endless[i].message);
        parsed_free(s);
    }
}

static void changing_an_identifier_again_and_again_is_no_nesting(void **state)
{
    (void)state;
    const Row row = { "#declare P = pigment { bozo } #declare N = normal { bumps } #declare T = texture { pigment { bozo } } "
                      "#declare O = sphere { 0, 1 } #for (I, 1, 2000) #declare P = pigment { P scale 1.001 } "
                      "#declare N = normal { N scale 1.001 } #declare T = texture { T scale 1.001 } "
                      "#declare O = object { O translate x*0.001 } #end", "" };
    Parsed *s = scene_of(&row);
    assert_false(s->failed);
    parsed_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_blocks_are_refused_in_the_reference_s_words),
        cmocka_unit_test(odd_blocks_are_taken_with_a_warning),
        cmocka_unit_test(endless_nesting_is_refused),
        cmocka_unit_test(changing_an_identifier_again_and_again_is_no_nesting),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
