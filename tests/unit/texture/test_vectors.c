/* test_vectors.c - pigments, images, normals and surface patterns as the reference renderer has them, row by row. */
#include "lib/csv.h"
#include "lib/scene_text.h"
#include "texture/texture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

enum { ROW_TEXT = 1000 };

/* Rows come in blocks of one scene: it is read once for each. */
typedef struct Block {
    SceneText scene;
    char key[ROW_TEXT];
    bool open;
} Block;

static const Object *block_object(Block *b, const char *settings, const char *object)
{
    char key[ROW_TEXT];
    snprintf(key, sizeof key, "%s|%s", settings, object);
    if (b->open && strcmp(key, b->key) == 0)
        return b->scene.scene.object[0];
    if (b->open)
        scene_text_end(&b->scene);
    strcpy(b->key, key);
    b->open = true;
    char text[2 * ROW_TEXT];
    snprintf(text, sizeof text, "#version 3.7; global_settings { %s }\n%s", settings, object);
    if (!scene_text(&b->scene, text))
        fail_msg("%s\n%s", text, b->scene.messages);
    return b->scene.scene.object[0];
}

static void block_close(Block *b)
{
    if (b->open)
        scene_text_end(&b->scene);
}

static int failures, name_field;

static void check(const Csv *c, const char *what, double got, double expected, double tolerance)
{
    if (fabs(got - expected) <= tolerance)
        return;
    if (failures++ < 40)
        print_error("row %d (%s) %s: %.9g, not %.9g\n", c->line, c->field[name_field], what, got, expected);
}

static Vec3 csv_point(const Csv *c, int field)
{
    return vec3(csv_number(c, field), csv_number(c, field + 1), csv_number(c, field + 2));
}

static void check_colour(const Csv *c, int field, Colour got, double tolerance)
{
    check(c, "red", (double)got.r, csv_number(c, field), tolerance);
    check(c, "green", (double)got.g, csv_number(c, field + 1), tolerance);
    check(c, "blue", (double)got.b, csv_number(c, field + 2), tolerance);
    check(c, "filter", (double)got.f, csv_number(c, field + 3), tolerance);
    check(c, "transmit", (double)got.t, csv_number(c, field + 4), tolerance);
}

/* settings_field < 0: none */
static void check_pigments(const char *path, int settings_field, double tolerance)
{
    static Csv c;
    Block b = { 0 };
    int point = settings_field < 0 ? 1 : 2;
    failures = name_field = 0;
    csv_open(&c, path);
    while (csv_next(&c)) {
        char object[ROW_TEXT];
        snprintf(object, sizeof object, "sphere { 0, 1 pigment { %s } }", c.field[0]);
        const Object *o = block_object(&b, settings_field < 0 ? "assumed_gamma 1" : c.field[settings_field], object);
        check_colour(&c, point + 3, pigment_colour(o->texture->pigment, csv_point(&c, point), NULL, NULL), tolerance);
    }
    block_close(&b);
    assert_int_equal(failures, 0);
}

static void pigments_have_the_measured_colours(void **state)
{
    (void)state;
    check_pigments("tests/vectors/pigments.csv", -1, 2e-6);
}

static void images_have_the_measured_colours(void **state)
{
    (void)state;
    /* Measured in one scene where a file's gamma of 0.45455 came before `gamma 2.2` and was taken for the same. */
    check_pigments("tests/vectors/images.csv", 1, 5e-6);
}

/* ---- normals ---- */

typedef struct Perturbed {
    Vec3 raw, sum;
    TextureContext *at;
} Perturbed;

/* The measured vector was read off the colours of a slope pigment, so what that pigment sees is blended. */
static void add_leaf(void *user, const TextureLeaf *leaf)
{
    Perturbed *p = user;
    texture_layer_normal(leaf, leaf->top, p->raw, p->at);
    p->sum = add(p->sum, scaled(p->at->normal, (double)leaf->weight));
}

/* Under no_bump_scale the vector is not of unit length, and slope clips it. */
static double seen(double v)
{
    return fmax(-1, fmin(1, v));
}

static void normals_have_the_measured_directions(void **state)
{
    (void)state;
    static Csv c;
    Block b = { 0 };
    failures = 0;
    name_field = 2;
    csv_open(&c, "tests/vectors/normals.csv");
    while (csv_next(&c)) {
        char object[ROW_TEXT];
        bool whole = strncmp(c.field[2], "texture", 7) == 0;
        snprintf(object, sizeof object,
                 whole ? "#macro PIG() pigment { rgb 1 } #end #macro FIN() finish { ambient 0 } #end sphere { 0, 1 %s }"
                       : "sphere { 0, 1 pigment { rgb 1 } normal { %s } }",
                 c.field[2]);
        if (whole)                             /* the row's PIG and FIN are macros of ours */
            for (char *s = strstr(object, "sphere"); (s = strpbrk(s, "PF")) != NULL; s += 3)
                if (strncmp(s, "PIG", 3) == 0 || strncmp(s, "FIN", 3) == 0) {
                    memmove(s + 5, s + 3, strlen(s + 3) + 1);
                    memcpy(s + 3, "()", 2);
                }
        const Object *o = block_object(&b, c.field[1], object);
        Vec3 p = csv_point(&c, 3), raw = csv_point(&c, 6);
        if (dot(raw, vec3(0, 0, 1)) > 0)
            raw = negated(raw);
        TextureContext at = { .point = p, .ray = { 0, 0, 1 }, .normal = raw, .hit = true, .quality = 9,
                              .number_of_waves = b.scene.scene.globals.number_of_waves };
        Perturbed got = { .raw = raw, .at = &at };
        texture_resolve(&(PlacedTexture){ .texture = o->texture, .place = o->texture_place }, p, &at, add_leaf, &got);
        check(&c, "x", seen(got.sum.x), csv_number(&c, 9), 1.5e-4);
        check(&c, "y", seen(got.sum.y), csv_number(&c, 10), 1.5e-4);
        check(&c, "z", seen(got.sum.z), csv_number(&c, 11), 1.5e-4);
    }
    block_close(&b);
    assert_int_equal(failures, 0);
}

static void slope_and_aoi_see_the_surface(void **state)
{
    (void)state;
    static Csv c;
    Block b = { 0 };
    failures = name_field = 0;
    csv_open(&c, "tests/vectors/surface.csv");
    while (csv_next(&c)) {
        char object[ROW_TEXT];
        snprintf(object, sizeof object, "sphere { 0, 1 pigment { %s } }", c.field[0]);
        const Object *o = block_object(&b, "assumed_gamma 1", object);
        Vec3 p = csv_point(&c, 1);
        TextureContext at = { .point = p, .ray = { 0, 0, 1 }, .normal = csv_point(&c, 4), .hit = true, .quality = 9 };
        check(&c, "value", (double)pigment_colour(o->texture->pigment, p, &at, NULL).g, csv_number(&c, 7), 2e-4);
    }
    block_close(&b);
    assert_int_equal(failures, 0);
}

static void normals_follow_the_noise_generator_of_the_scene(void **state)
{
    (void)state;
    for (int generator = 1; generator <= 3; generator++) {
        Block b = { 0 };
        char settings[100];
        snprintf(settings, sizeof settings, "assumed_gamma 1 noise_generator %d", generator);
        const Object *o = block_object(&b, settings, "sphere { 0, 1 pigment { bozo } normal { bozo 0.5 } }");
        assert_int_equal(o->texture->normal->pattern->noise_generator, generator);
        assert_int_equal(o->texture->pigment->pattern->noise_generator, generator);
        block_close(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pigments_have_the_measured_colours),
        cmocka_unit_test(images_have_the_measured_colours),
        cmocka_unit_test(normals_have_the_measured_directions),
        cmocka_unit_test(normals_follow_the_noise_generator_of_the_scene),
        cmocka_unit_test(slope_and_aoi_see_the_surface),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
