/* test_sloppy.c - what programs of the field write and the reference accepts (09-programs-and-manners): one test each. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "sdl/parsed.h"                        /* before cmocka, which has a macro called fail */

#include <cmocka.h>

#define HEAD "#version 3.7; global_settings { assumed_gamma 1 }\n"

static const Object *only_object(const Parsed *s)
{
    if (s->failed)
        print_message("%.*s\n", STR_ARGS(diag_message(s->diag, diag_count(s->diag) - 1)->text));
    assert_false(s->failed);
    assert_int_equal(s->scene.n_objects, 1);
    return s->scene.object[0];
}

static void accepted(const char *text)
{
    Parsed *s = parsed(text);
    if (s->failed)
        print_message("%s\n%.*s\n", text, STR_ARGS(diag_message(s->diag, diag_count(s->diag) - 1)->text));
    assert_false(s->failed);
    parsed_free(s);
}

static void what_has_one_meaning_is_read_with_a_warning_and_strictly_refused(void **state)
{
    (void)state;
    static const char *const texts[] = {
        HEAD "#declare A = rgb 1 + rgb 1;", HEAD "#declare A = <1,2,3>.x.x;", HEAD "#declare A = min(3 1);",
        HEAD "cylinder { 0, x, 1 open open pigment { rgb 1 } }", HEAD "light_source { 0, 1 rgb 1 }",
        HEAD "#macro M(X) X #end #declare A = array[2] { M(1), 2 };", HEAD "#declare A = array[3] { #for (I, 0, 2) I, #end };",
        HEAD "#declare A = array[1][2] { { 1, #local X = 2; X } };", HEAD "cylinder { 0, x, 1 scale 2 open pigment { rgb 1 } }",
        HEAD "isosurface { function { x } scale 2 max_gradient 3 }", HEAD "mesh { triangle { 0, x, y } scale 2 inside_vector y }",
        HEAD "blob { sphere { 0, 1, 1 } sturm sphere { x, 1, 1 } }", HEAD "blob { sphere { 0, 1, 1, } }",
        HEAD "fog { distance 1, rgb 1 }", HEAD "#declare F = function { min(x y) }",
        HEAD "sphere { 0, 1 pigment { image_map { function 2, 2 { x } interpolate 0 } } }", HEAD "prism { 0, 1, 4, <0,0>, <1,0>, <1,1>, <0,0>, }", HEAD "height_field { function 9, 9 { x } water_level 0.1, smooth }",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        Parsed *s = parsed(texts[i]);
        assert_false(s->failed);
        assert_true(said(s, DIAG_WARNING, "read all the same"));
        parsed_free(s);
        s = parsed_strictly(texts[i]);
        assert_true(s->failed);
        parsed_free(s);
    }
}

static void commas_may_stand_behind_the_last_item_and_before_what_may_lack(void **state)
{
    (void)state;
    static const char *const texts[] = {
        HEAD "sphere { 0, 1 pigment { checker rgb 1, rgb 0, } }", HEAD "sphere { 0, 1 pigment { brick rgb 1, rgb 0, mortar 0.1 } }",
        HEAD "sphere { 0, 1 texture { checker texture { }, texture { }, scale 2 } }",
        HEAD "sphere { 0, 1 normal { checker normal { bumps }, normal { dents }, } }",
        HEAD "sphere { 0, 1 pigment { slope { y, , 0.8 altitude y, 0, } } }", HEAD "#for (I, 0, 4 2) #end #for (I, 0, 4, ) #end",
        HEAD "disc { 0, z, 1, }", HEAD "sphere { 0, 1 finish { diffuse 0.5, phong 1 } normal { bumps, scale 2 } }",
        HEAD "parametric { function { u }, function { v }, function { 0 } <0,0>, <1,2> precompute 5 x, , z }",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        accepted(texts[i]);
}

/* What is said before the pattern waits for it; until then the pigment is black. */
static void a_pigment_may_have_a_map_and_no_pattern_yet(void **state)
{
    (void)state;
    Parsed *s = parsed(HEAD "#declare P = pigment { color_map { [0 rgb x] [1 rgb y] } turbulence 2 }\nsphere { 0, 1 pigment { P } }");
    const Pigment *g = only_object(s)->texture->pigment;
    assert_true(said(s, DIAG_WARNING, "Pigment type unspecified"));
    assert_int_equal(g->kind, PIGMENT_PLAIN);
    assert_true(g->colour.r == 0 && g->colour.g == 0);
    parsed_free(s);
    s = parsed(HEAD "#declare P = pigment { color_map { [0 rgb x] [1 rgb y] } turbulence 2 }\nsphere { 0, 1 pigment { P wood } }");
    g = only_object(s)->texture->pigment;
    assert_int_equal(g->kind, PIGMENT_PATTERN);
    assert_int_equal(g->map.n, 2);
    assert_true(g->map.entry[0].colour.r == 1 && g->map.entry[1].colour.g == 1);
    assert_true(g->pattern->chain.has_turbulence);
    parsed_free(s);
}

static void a_mesh_may_say_its_inside_vector_anywhere_among_its_triangles(void **state)
{
    (void)state;
    Parsed *s = parsed(HEAD "#declare M = mesh { inside_vector y triangle { 0, x, y } }\n#if (inside(M, 0)) #end object { M }");
    only_object(s);
    parsed_free(s);
}

static void a_vector_may_lack_a_comma(void **state)
{
    (void)state;
    Parsed *s = parsed(HEAD "sphere { 0, 1 pigment { rgbf <0.8, 0.3, 0.2 0.0> } }");
    Colour c = only_object(s)->texture->pigment->colour;
    assert_true(c.r == 0.8f && c.g == 0.3f && c.b == 0.2f && c.f == 0 && c.t == 0);
    parsed_free(s);
}

static void a_polygon_may_lack_commas_and_its_last_point(void **state)
{
    (void)state;
    Parsed *s = parsed(HEAD "polygon { 3, <0,0,0> <1,0,0> <0,1,0> pigment { rgb 1 } }");
    only_object(s);
    parsed_free(s);
}

static void macro_parameters_may_lack_a_comma(void **state)
{
    (void)state;
    Parsed *s = parsed(HEAD "#macro atom(LOC, R, TRANS FIN) sphere { LOC, R pigment { rgbt <1,0,0,TRANS> } finish { FIN } } #end\n"
                            "#declare F = finish { phong 0.5 }\natom(<1,2,3>, 2, 0.25, F)");
    const Object *o = only_object(s);
    assert_true(o->texture->pigment->colour.t == 0.25f);
    assert_true(o->texture->finish->phong == 0.5f);
    parsed_free(s);
}

static void meshes_may_have_commas_before_their_braces(void **state)
{
    (void)state;
    Parsed *s = parsed(HEAD "mesh2 { vertex_vectors { 3, <0,0,0>, <1,0,0>, <0,1,0>, } face_indices { 1, <0,1,2>, } }");
    only_object(s);
    parsed_free(s);
}

static void zero_normals_in_a_mesh_are_a_warning(void **state)
{
    (void)state;
    Parsed *s = parsed(HEAD "mesh2 { vertex_vectors { 3, <0,0,0>, <1,0,0>, <0,1,0> } normal_vectors { 3, 0, 0, 0 } face_indices { 1, <0,1,2> } }");
    only_object(s);
    assert_true(said(s, DIAG_WARNING, "cannot be zero"));
    parsed_free(s);
}

static void a_union_may_have_few_children_or_none(void **state)
{
    (void)state;
    accepted(HEAD "union { } union { sphere { 0, 1 } }");
}

static void phong_may_be_negative(void **state)
{
    (void)state;
    Parsed *s = parsed(HEAD "sphere { 0, 1 finish { phong -1.000 } }");
    assert_true(only_object(s)->texture->finish->phong == -1);
    parsed_free(s);
}

static void an_object_may_stand_by_its_bare_name(void **state)
{
    (void)state;
    Parsed *s = parsed(HEAD "#declare mol_0 = sphere { 0, 1 }\nmol_0");
    only_object(s);
    parsed_free(s);
}

static void braces_may_be_split_over_branches(void **state)
{
    (void)state;
    Parsed *s = parsed(HEAD "#declare A = 1;\n#if (A) union { #else merge { #end sphere { 0, 1 } sphere { x, 1 } }");
    const Object *o = only_object(s);
    assert_int_equal(o->kind, OBJECT_UNION);
    assert_int_equal(o->n_child, 2);
    parsed_free(s);
}

static void old_streams_are_taken(void **state)
{
    (void)state;
    accepted(HEAD "#render \"\\b\\b \\n\\n\"\n#statistics \"x\\n\"\nsphere { 0, 1 }");
}

static void floats_stand_for_the_axes_of_an_area_light(void **state)
{
    (void)state;
    Parsed *s = parsed(HEAD "light_source { 0, rgb 1 area_light 200, 200, 10, 10 }");
    const LightSource *l = only_object(s)->light;
    assert_true(l->axis1.x == 200 && l->axis1.y == 200 && l->axis1.z == 200);
    assert_memory_equal(&l->axis1, &l->axis2, sizeof l->axis1);
    assert_true(l->size1 == 10 && l->size2 == 10);
    parsed_free(s);
}

static void colours_may_be_written_part_by_part(void **state)
{
    (void)state;
    Parsed *s = parsed(HEAD "light_source { <1,2,3> color red 4.0 green 4.0 blue 4.0 }");
    const LightSource *l = only_object(s)->light;
    assert_true(l->colour[0] == 4 && l->colour[1] == 4 && l->colour[2] == 4);
    parsed_free(s);
}

static void a_camera_may_be_tiny_mirrored_and_far(void **state)
{
    (void)state;
    Parsed *s = parsed(HEAD "camera { location <0,0,159> look_at 0 up <0, 0.1, 0> right <-0.1, 0, 0> }");
    assert_false(s->failed);
    CameraDef c = s->scene.camera;
    assert_true(fabs(length(c.right) - 0.1) < 1e-15 && fabs(length(c.up) - 0.1) < 1e-15);
    assert_true(dot(cross(c.up, c.direction), c.right) < 0);
    parsed_free(s);
}

static void comments_nest_and_numbers_may_be_odd(void **state)
{
    (void)state;
    Parsed *s = parsed(HEAD "/* a /* b */ c */ sphere { <-0, -9.30732e-15, .5>, 1 }\n"
                            "triangle { 0, 0, 0 }");
    assert_false(s->failed);
    assert_int_equal(s->scene.n_objects, 2);
    parsed_free(s);
}

static void settings_may_be_repeated_and_follow_the_objects(void **state)
{
    (void)state;
    Parsed *s = parsed("#version 3.7;\nsphere { 0, 1 }\nglobal_settings { assumed_gamma 1 ambient_light 2 }\n"
                       "global_settings { ambient_light rgb 3 }\ncamera { right x right 2*x }");
    only_object(s);
    assert_true(s->scene.globals.ambient_light[0] == 3);
    assert_true(s->scene.camera.right.x == 2);
    parsed_free(s);
}

static void a_scene_may_say_neither_version_nor_gamma(void **state)
{
    (void)state;
    Parsed *s = parsed("sphere { 0, 1 pigment { color rgb <1,0,0> } }");
    only_object(s);
    assert_int_equal(s->scene.globals.version, 362);
    assert_int_equal(s->scene.globals.assumed_gamma, GAMMA_NONE);
    parsed_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(commas_may_stand_behind_the_last_item_and_before_what_may_lack),
        cmocka_unit_test(a_pigment_may_have_a_map_and_no_pattern_yet),
        cmocka_unit_test(a_mesh_may_say_its_inside_vector_anywhere_among_its_triangles),
        cmocka_unit_test(what_has_one_meaning_is_read_with_a_warning_and_strictly_refused),
        cmocka_unit_test(a_vector_may_lack_a_comma),
        cmocka_unit_test(a_polygon_may_lack_commas_and_its_last_point),
        cmocka_unit_test(macro_parameters_may_lack_a_comma),
        cmocka_unit_test(meshes_may_have_commas_before_their_braces),
        cmocka_unit_test(zero_normals_in_a_mesh_are_a_warning),
        cmocka_unit_test(a_union_may_have_few_children_or_none),
        cmocka_unit_test(phong_may_be_negative),
        cmocka_unit_test(an_object_may_stand_by_its_bare_name),
        cmocka_unit_test(braces_may_be_split_over_branches),
        cmocka_unit_test(old_streams_are_taken),
        cmocka_unit_test(floats_stand_for_the_axes_of_an_area_light),
        cmocka_unit_test(colours_may_be_written_part_by_part),
        cmocka_unit_test(a_camera_may_be_tiny_mirrored_and_far),
        cmocka_unit_test(comments_nest_and_numbers_may_be_odd),
        cmocka_unit_test(settings_may_be_repeated_and_follow_the_objects),
        cmocka_unit_test(a_scene_may_say_neither_version_nor_gamma),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
