/* test_blocks.c - what blocks become: defaults, what acts on what, and what is shared. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "sdl/parsed.h"                        /* before cmocka, which has a macro called fail */

#include <cmocka.h>

#define HEAD "#version 3.7; global_settings { assumed_gamma 1 }\n"

static Parsed *good(const char *text)
{
    Parsed *s = parsed(text);
    if (s->failed)
        print_message("%.*s\n", STR_ARGS(diag_message(s->diag, diag_count(s->diag) - 1)->text));
    assert_false(s->failed);
    return s;
}

static Vec3 carried(const Affine *place, Vec3 p)
{
    Affine a = affine_of(place);
    return affine_point(&a, p);
}

static void near_vec(Vec3 a, double x, double y, double z)
{
    if (max_abs(sub(a, vec3(x, y, z))) > 1e-12)
        print_message("<%g,%g,%g> instead of <%g,%g,%g>\n", a.x, a.y, a.z, x, y, z);
    assert_true(max_abs(sub(a, vec3(x, y, z))) <= 1e-12);
}

/* ---- objects ---- */

static void transforms_act_in_the_order_written(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 translate x scale 2 rotate 90*y translate y }");
    near_vec(carried(s->scene.object[0]->place, vec3(0, 0, 0)), 0, 1, -2);
    parsed_free(s);
}

static void a_texture_moves_only_with_what_follows_it(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 translate x pigment { checker } translate y }");
    const Object *o = s->scene.object[0];
    near_vec(carried(o->place, vec3(0, 0, 0)), 1, 1, 0);
    near_vec(carried(o->texture_place, vec3(0, 0, 0)), 0, 1, 0);
    parsed_free(s);
}

static void a_layer_added_later_does_not_move_with_earlier_transforms(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 texture { pigment { checker } } translate x texture { pigment { checker } } translate y }");
    const Object *o = s->scene.object[0];
    near_vec(carried(o->texture_place, vec3(0, 0, 0)), 0, 1, 0);
    assert_int_equal(o->texture->pigment->pattern->chain.n, 0);
    const WarpChain *below = &o->texture->below->pigment->pattern->chain;
    assert_int_equal(below->n, 1);
    near_vec(affine_point(&below->warp[0].transform, vec3(0, 0, 0)), 1, 0, 0);
    parsed_free(s);
}

static void uv_mapped_textures_stay(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 uv_mapping pigment { checker } translate x }");
    assert_true(s->scene.object[0]->flags & OBJECT_UV_MAPPING);
    near_vec(carried(s->scene.object[0]->texture_place, vec3(0, 0, 0)), 0, 0, 0);
    parsed_free(s);
}

static void a_copy_leaves_its_original_alone(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "#declare A = sphere { 0, 1 translate x }\nobject { A translate y }\nA\nobject { A scale 2 pigment { rgb 1 } }");
    near_vec(carried(s->scene.object[0]->place, vec3(0, 0, 0)), 1, 1, 0);
    near_vec(carried(s->scene.object[1]->place, vec3(0, 0, 0)), 1, 0, 0);
    near_vec(carried(s->scene.object[2]->place, vec3(0, 0, 0)), 2, 0, 0);
    assert_null(s->scene.object[1]->texture);
    assert_ptr_equal(s->scene.object[0]->params, s->scene.object[1]->params);
    parsed_free(s);
}

static void clips_and_bounds_move_with_what_follows_them(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 translate x clipped_by { plane { y, 0 } rotate 90*z } translate y bounded_by { clipped_by } translate z }");
    const Object *o = s->scene.object[0];
    assert_int_equal(object_more(o)->n_clipped_by, 1);
    near_vec(carried(object_more(o)->clipped_by[0]->place, vec3(0, 0, 0)), 0, 1, 1);
    near_vec(carried(object_more(o)->clipped_by[0]->place, vec3(1, 0, 0)), 0, 2, 1);
    assert_int_equal(object_more(o)->n_bounded_by, 1);
    parsed_free(s);
}

static void the_default_texture_at_the_end_of_the_statement_counts(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 }\n#default { pigment { rgb 1 } }\nunion { sphere { 0, 1 } #default { pigment { rgb 2 } } }");
    assert_true(s->scene.object[0]->default_texture->pigment->colour.r == 0);
    assert_true(s->scene.object[1]->default_texture->pigment->colour.r == 2);
    parsed_free(s);
}

static void old_finishes_give_their_ior_to_the_interior(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 pigment { rgbf 1 } finish { ior 1.5 } interior { ior 1.2 fade_power 2 } }");
    const Interior *i = object_more(s->scene.object[0])->interior;
    assert_true(i->ior == 1.5f && i->fade_power == 2);
    parsed_free(s);
}

static void flags_may_be_switched_off(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 hollow no_image off no_shadow inverse inverse }\nsphere { 0, 1 hollow off double_illuminate inverse }");
    assert_int_equal(s->scene.object[0]->flags, OBJECT_HOLLOW | OBJECT_HOLLOW_SET | OBJECT_NO_SHADOW);
    assert_int_equal(s->scene.object[1]->flags, OBJECT_HOLLOW_SET | OBJECT_DOUBLE_ILLUMINATE | OBJECT_INVERSE);
    parsed_free(s);
}

static void looks_like_stands_at_the_light_without_shadow(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "light_source { <1,2,3>, 1 rotate 90*y looks_like { box { -1, 1 } } translate x }");
    const Object *o = s->scene.object[0], *l = o->light->looks_like;
    Vec3 centre = carried(o->place, carried(l->place, vec3(0, 0, 0))), corner = carried(o->place, carried(l->place, vec3(1, 0, 0)));
    near_vec(centre, 4, 2, -1);
    near_vec(sub(corner, centre), 1, 0, 0);
    assert_true(l->flags & OBJECT_NO_SHADOW);
    parsed_free(s);
}

static void sizes_of_area_lights_stop_at_the_largest_int(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "light_source { 0, 1 area_light x, y, 2.9, 1e109 }");
    assert_true(s->scene.object[0]->light->size1 == 2 && s->scene.object[0]->light->size2 == 2147483647);
    parsed_free(s);
}

static void spotlights_and_cylinders_have_their_own_defaults(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "light_source { 0, 1 spotlight } light_source { 0, 1 cylinder point_at y } light_source { 0 }");
    const LightSource *spot = s->scene.object[0]->light, *tube = s->scene.object[1]->light;
    assert_true(spot->radius == 30 && spot->falloff == 45 && spot->tightness == 0 && !spot->parallel && spot->point_at.z == 1);
    assert_true(tube->radius == 0.75 && tube->falloff == 1 && tube->parallel && tube->point_at.y == 1);
    assert_true(rgb_is_zero(s->scene.object[2]->light->colour));
    parsed_free(s);
}

/* ---- textures ---- */

static void equal_plain_textures_are_one(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "#declare I = 0;\n#while (I < 4) sphere { I, 1 texture { pigment { rgb <1,0.5,mod(I,2)> } finish { phong 1 } } } #declare I = I+1; #end");
    assert_ptr_equal(s->scene.object[0]->texture, s->scene.object[2]->texture);
    assert_ptr_equal(s->scene.object[1]->texture, s->scene.object[3]->texture);
    assert_ptr_not_equal(s->scene.object[0]->texture, s->scene.object[1]->texture);
    parsed_free(s);
}

static void an_untouched_texture_is_the_default_itself(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 texture { } }");
    assert_ptr_equal(s->scene.object[0]->texture, s->scene.object[0]->default_texture);
    parsed_free(s);
}

static void a_new_pattern_keeps_the_map_and_warps_of_its_identifier(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "#declare P = pigment { marble color_map { [0 rgb 1] [1 rgb 2] } turbulence 0.5 scale 2 }\n"
                          "sphere { 0, 1 pigment { P gradient x scale 3 } }");
    const Pigment *g = s->scene.object[0]->texture->pigment;
    assert_string_equal(g->pattern->ops->keyword, "gradient");
    assert_int_equal(g->pattern->wave, WAVE_TRIANGLE);         /* of the marble: only some patterns set it */
    assert_int_equal(g->map.n, 2);
    assert_true(g->map.entry[1].colour.r == 2);
    assert_true(g->pattern->chain.has_turbulence && g->pattern->chain.turbulence.amount.x == 0.5);
    assert_int_equal(g->pattern->chain.n, 1);
    assert_true(g->pattern->chain.warp[0].transform.m[0][0] == 6);
    parsed_free(s);
}

static void warps_written_last_come_first(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 pigment { bozo translate x warp { cubic } scale 2 warp { planar } warp { repeat 2*x } rotate y translate z } }");
    const WarpChain *c = &s->scene.object[0]->texture->pigment->pattern->chain;
    const WarpKind expected[] = { WARP_TRANSFORM, WARP_REPEAT, WARP_PLANAR, WARP_TRANSFORM, WARP_CUBIC, WARP_TRANSFORM };
    assert_int_equal(c->n, 6);
    for (unsigned i = 0; i < 6; i++)
        assert_int_equal(c->warp[i].kind, expected[i]);
    assert_true(c->warp[0].transform.m[3][2] == 1);
    assert_true(c->warp[5].transform.m[3][0] == 1);
    parsed_free(s);
}

static void maps_take_the_old_form_and_keep_their_order(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 pigment { bozo color_map { [0.5, 0.2 color red 1 color rgb <0,1,0>] [0.1 color rgb 1 transmit 0.5] } } }");
    const BlendMap *m = &s->scene.object[0]->texture->pigment->map;
    assert_int_equal(m->n, 3);
    assert_true(m->entry[0].key == 0.5f && m->entry[0].colour.r == 1 && m->entry[0].colour.g == 0);
    assert_true(m->entry[1].key == 0.2f && m->entry[1].colour.g == 1);
    assert_true(m->entry[2].key == 0.1f && m->entry[2].colour.t == 0.5f);
    parsed_free(s);
}

static void lists_are_filled_up_by_position(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 pigment { hexagon rgb 5 } }\nsphere { 0, 1 pigment { checker pigment { rgb 3 } } }");
    const BlendMap *m = &s->scene.object[0]->texture->pigment->map;
    assert_int_equal(m->n, 3);
    assert_true(m->entry[0].colour.r == 5 && m->entry[1].colour.g == 1 && m->entry[2].colour.r == 1);
    const BlendMap *pigments = &s->scene.object[1]->texture->pigment->map;
    assert_int_equal(pigments->kind, MAP_PIGMENT);
    assert_int_equal(pigments->n, 2);
    assert_true(pigments->entry[1].pigment->colour.r == 0);
    parsed_free(s);
}

static void weights_of_averages_may_be_left_out(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 pigment { average pigment_map { [2 rgb 1] [checker] } } }");
    const Pigment *g = s->scene.object[0]->texture->pigment;
    assert_int_equal(g->kind, PIGMENT_AVERAGE);
    assert_true(g->map.entry[0].key == 2 && g->map.entry[1].key == 1);
    parsed_free(s);
}

static void layers_lie_with_the_last_on_top(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "#declare T = texture { pigment { rgb 1 } } texture { pigment { rgbt 2 } }\nsphere { 0, 1 texture { T } texture { pigment { rgbt 3 } } }");
    const Texture *t = s->scene.object[0]->texture;
    assert_true(t->pigment->colour.r == 3 && t->below->pigment->colour.r == 2 && t->below->below->pigment->colour.r == 1);
    assert_null(t->below->below->below);
    parsed_free(s);
}

static void normals_take_their_amount_after_the_pattern(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "#declare N = normal { bumps 0.8 scale 3 }\nsphere { 0, 1 normal { N 0.3 } }\nsphere { 0, 1 normal { wrinkles } }\n"
                          "sphere { 0, 1 normal { gradient x, 0.7 slope_map { [0 <0,1>] [1 <1,1>] } } }");
    const Normal *n = s->scene.object[0]->texture->normal;
    assert_true(n->amount == 0.3f && n->pattern->chain.n == 1);
    assert_true(s->scene.object[1]->texture->normal->amount == 0.5f);
    const Normal *m = s->scene.object[2]->texture->normal;
    assert_true(m->amount == 0.7f && m->map.kind == MAP_SLOPE && m->map.entry[1].slope.slope == 1);
    parsed_free(s);
}

static void finishes_start_from_the_defaults_and_albedo_waits_for_the_end(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 finish { diffuse albedo 0.5 brilliance 3 reflection { 0.1, 0.9 fresnel metallic } metallic } }\n"
                          "sphere { 0, 1 finish { reflection { 0.5 fresnel } diffuse 0.6, 0.3 diffuse 0.4 } }");
    const Finish *f = s->scene.object[0]->texture->finish;
    assert_true(f->diffuse == 1 && f->brilliance == 3 && f->ambient[0] == 0.1f && f->roughness == 0.05f && f->phong_size == 40);
    assert_true(f->reflection_min[0] == 0.1f && f->reflection_max[0] == 0.9f && f->reflection_fresnel && f->reflection_metallic == 1 && f->metallic == 1);
    const Finish *g = s->scene.object[1]->texture->finish;
    assert_true(g->reflection_min[0] == 0 && g->reflection_max[0] == 0.5f);
    assert_true(g->diffuse == 0.4f && g->diffuse_back == 0);
    parsed_free(s);
}

static void the_noise_generator_may_come_after_the_patterns(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 pigment { bozo } }\nsphere { 0, 1 pigment { bozo noise_generator 1 } }\nglobal_settings { noise_generator 3 }");
    assert_int_equal(s->scene.object[0]->texture->pigment->pattern->noise_generator, 3);
    assert_int_equal(s->scene.object[1]->texture->pigment->pattern->noise_generator, 1);
    parsed_free(s);
}

/* ---- camera ---- */

static void items_of_a_camera_may_come_in_any_order(void **state)
{
    (void)state;
    Parsed *a = good(HEAD "camera { location <1,2,-5> look_at <0,1,0> angle 40 right 4/3*x sky <0,1,1> }");
    Parsed *b = good(HEAD "camera { sky <0,1,1> right 4/3*x angle 40 look_at <0,1,0> location <1,2,-5> }");
    assert_memory_equal(&a->scene.camera.direction, &b->scene.camera.direction, sizeof(Vec3));
    assert_memory_equal(&a->scene.camera.right, &b->scene.camera.right, sizeof(Vec3));
    assert_memory_equal(&a->scene.camera.up, &b->scene.camera.up, sizeof(Vec3));
    double expected = length(a->scene.camera.right) / (2 * tan(20 * PI / 180));
    assert_true(fabs(length(a->scene.camera.direction) - expected) < 1e-12);
    parsed_free(a);
    parsed_free(b);
}

static void an_old_camera_acts_as_it_is_read(void **state)
{
    (void)state;
    Parsed *s = good("#version 3.1;\ncamera { location -5*z look_at 0 right <-2,0,0> }");
    near_vec(s->scene.camera.right, -2, 0, 0);
    parsed_free(s);
    s = good("#version 3.5;\ncamera { location -5*z look_at 0 right <-2,0,0> }");
    near_vec(s->scene.camera.right, -2, 0, 0);
    parsed_free(s);
    s = good("#version 3.5;\ncamera { location <-5,0,0> look_at 0 right <2,0,0> }");
    near_vec(s->scene.camera.right, 0, 0, -2);
    parsed_free(s);
    s = good("#version 3.1;\ncamera { location <-5,0,0> look_at 0 right <2,0,0> }");
    near_vec(s->scene.camera.right, 2, 0, 0);
    parsed_free(s);
}

static void an_orthographic_camera_covers_what_it_looks_at(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "camera { orthographic location -4*z }");
    near_vec(s->scene.camera.right, 1.33 * 5, 0, 0);
    near_vec(s->scene.camera.up, 0, 5, 0);
    parsed_free(s);
    s = good(HEAD "camera { orthographic location -4*z look_at 0 right 2*x up y }");
    near_vec(s->scene.camera.right, 2, 0, 0);
    parsed_free(s);
}

static void focal_distance_follows_what_was_written(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "camera { location -4*z focal_point <0,3,0> aperture 1 blur_samples 5, 20 }");
    assert_true(s->scene.camera.focal_distance == 5 && s->scene.camera.blur_samples_min == 5 && s->scene.camera.blur_samples == 20);
    parsed_free(s);
    s = good(HEAD "camera { location -4*z direction 3*z look_at 0 }");
    assert_true(s->scene.camera.focal_distance == 3);
    parsed_free(s);
    s = good(HEAD "camera { location -4*z direction 3*z }");
    assert_true(s->scene.camera.focal_distance == 1);
    parsed_free(s);
}

static void transforms_of_a_camera_come_last(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "camera { rotate 90*y translate y location -4*z look_at 0 }");
    near_vec(s->scene.camera.location, -4, 1, 0);
    near_vec(s->scene.camera.direction, 1, 0, 0);
    parsed_free(s);
}

/* ---- the rest ---- */

static void interiors_and_media_have_their_defaults(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "sphere { 0, 1 interior { media { scattering { 5, rgb 1 eccentricity 0.3 } density { spherical } density { rgb 2 } scale 2 } } }\nmedia { emission 1 }");
    const Interior *i = object_more(s->scene.object[0])->interior;
    assert_true(i->ior == 1 && i->dispersion == 1 && i->dispersion_samples == 7 && i->n_media == 1);
    const Media *m = i->media;
    assert_true(m->method == 3 && m->intervals == 1 && m->samples_min == 10 && m->ratio == 0.9f && m->collect);
    assert_int_equal(m->n_density, 2);
    assert_int_equal(m->density[0]->pattern->chain.n, 1);
    assert_int_equal(s->scene.n_media, 1);
    assert_int_equal(s->scene.unmodelled, 0);
    parsed_free(s);
    s = good("#version 3.1;\nmedia { }");
    assert_true(s->scene.media[0]->intervals == 10 && s->scene.media[0]->samples_max == 1 && s->scene.media[0]->method == 1);
    parsed_free(s);
}

static void fogs_and_rainbows_add_up_and_skies_replace(void **state)
{
    (void)state;
    Parsed *s = good(HEAD "fog { rgb 0.5 distance 10 } fog { fog_type 2 up 2*z color rgb 1 20 }\n"
                          "rainbow { direction z angle 40 width 5 color_map { [0 rgb 0] [1 rgb 1] } arc_angle 90 }\n"
                          "sky_sphere { pigment { rgb 1 } } sky_sphere { pigment { rgb 2 } pigment { rgb 3 } rotate y }");
    assert_int_equal(s->scene.n_fog, 2);
    assert_true(s->scene.fog[0]->distance == 10 && s->scene.fog[1]->distance == 20 && s->scene.fog[1]->up.z == 1);
    assert_true(s->scene.rainbow[0]->falloff_angle == 90 && s->scene.rainbow[0]->distance == 1e7);
    assert_int_equal(s->scene.sky_sphere->n, 2);
    assert_true(said(s, DIAG_WARNING, "sky-sphere"));
    parsed_free(s);
}

static void global_settings_have_their_defaults(void **state)
{
    (void)state;
    Parsed *s = good("#version 3.7;\nglobal_settings { photons { count 100 } radiosity { count 50 nearest_count 7,2 } }");
    const Globals *g = &s->scene.globals;
    assert_true(g->adc_bailout == 1.0 / 255 && g->max_trace_level == 5 && g->noise_generator == 2 && g->number_of_waves == 10);
    assert_true(g->assumed_gamma == GAMMA_POWER && g->assumed_gamma_value == 1 && !g->has_assumed_gamma);
    assert_true(g->photons.on && g->photons.count == 100 && g->photons.gather_max == 100);
    assert_true(g->radiosity.on && g->radiosity.count_bank == 1600 && g->radiosity.nearest_count_adaptive == 2);
    assert_int_equal(s->scene.unmodelled, SCENE_HAS_PHOTONS);
    parsed_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(transforms_act_in_the_order_written),
        cmocka_unit_test(a_texture_moves_only_with_what_follows_it),
        cmocka_unit_test(a_layer_added_later_does_not_move_with_earlier_transforms),
        cmocka_unit_test(uv_mapped_textures_stay),
        cmocka_unit_test(a_copy_leaves_its_original_alone),
        cmocka_unit_test(clips_and_bounds_move_with_what_follows_them),
        cmocka_unit_test(the_default_texture_at_the_end_of_the_statement_counts),
        cmocka_unit_test(old_finishes_give_their_ior_to_the_interior),
        cmocka_unit_test(flags_may_be_switched_off),
        cmocka_unit_test(looks_like_stands_at_the_light_without_shadow),
        cmocka_unit_test(sizes_of_area_lights_stop_at_the_largest_int),
        cmocka_unit_test(spotlights_and_cylinders_have_their_own_defaults),
        cmocka_unit_test(equal_plain_textures_are_one),
        cmocka_unit_test(an_untouched_texture_is_the_default_itself),
        cmocka_unit_test(a_new_pattern_keeps_the_map_and_warps_of_its_identifier),
        cmocka_unit_test(warps_written_last_come_first),
        cmocka_unit_test(maps_take_the_old_form_and_keep_their_order),
        cmocka_unit_test(lists_are_filled_up_by_position),
        cmocka_unit_test(weights_of_averages_may_be_left_out),
        cmocka_unit_test(layers_lie_with_the_last_on_top),
        cmocka_unit_test(normals_take_their_amount_after_the_pattern),
        cmocka_unit_test(finishes_start_from_the_defaults_and_albedo_waits_for_the_end),
        cmocka_unit_test(the_noise_generator_may_come_after_the_patterns),
        cmocka_unit_test(items_of_a_camera_may_come_in_any_order),
        cmocka_unit_test(an_old_camera_acts_as_it_is_read),
        cmocka_unit_test(an_orthographic_camera_covers_what_it_looks_at),
        cmocka_unit_test(focal_distance_follows_what_was_written),
        cmocka_unit_test(transforms_of_a_camera_come_last),
        cmocka_unit_test(interiors_and_media_have_their_defaults),
        cmocka_unit_test(fogs_and_rainbows_add_up_and_skies_replace),
        cmocka_unit_test(global_settings_have_their_defaults),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
