/* test_many.c - colours of many points at once are those of each alone, to the bit. */
#include "lib/scene_text.h"
#include "scene/ops.h"
#include "texture/texture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

/* Points of a row as functions ask them, by `z` in the plane z = 0 or beside it. */
static void compare(const char *pigment, double step, double z)
{
    static SceneText s;
    char text[2000];
    snprintf(text, sizeof text, "#version 3.7; global_settings { assumed_gamma 1 }"
             "#declare F = function { pigment { granite scale 0.2 } } #declare N = function { internal(76) } sphere { 0, 1 pigment { %s } }", pigment);
    if (!scene_text(&s, text))
        fail_msg("%s\n%s", text, s.messages);
    const Pigment *p = s.scene.object[0]->texture->pigment;
    for (int row = -10; row < 10; row++) {
        Vec3 at[PATTERN_MANY];
        Colour many[PATTERN_MANY];
        for (int i = 0; i < PATTERN_MANY; i++)
            at[i] = vec3((i - 7) * step, row * 0.31, z);
        for (int n = 1; n <= PATTERN_MANY; n += 31)
            pigment_colours(p, at, many, n);
        for (int i = 0; i < PATTERN_MANY; i++) {
            Colour one = pigment_colour(p, at[i], NULL, NULL);
            if (memcmp(&one, &many[i], sizeof one) != 0)
                fail_msg("%s: point %d of row %d", pigment, i, row);
        }
    }
    scene_text_end(&s);
}

static void many_points_have_the_colours_of_each(void **state)
{
    (void)state;
    static const char *const pigments[] = {
        "rgb 1", "checker rgb 1, rgb 0.5 scale 0.3", "wrinkles scale 0.25", "granite turbulence 0.3 lambda 3 scale 0.7",
        "marble turbulence 0.4 sine_wave frequency 3 phase 0.2", "bozo noise_generator 1 scale <1, -0.2, 1>",
        "spotted noise_generator 3 warp { turbulence 0.2 } scale 0.4 color_map { [0 rgb 0][0.5 rgbft 0.7][0.5 rgb x] }",
        "crackle scale 0.5 pigment_map { [0.1 granite scale 0.1][0.3 rgb y][0.3 bozo][0.5 wrinkles poly_wave 2] }",
        "pigment_pattern { wrinkles scale 0.3 } pigment_map { [0.5 agate][0.5 checker pigment { leopard }, pigment { dents }] }",
        "function { N(x * 3, y, z) + F(y, x, z).gray / 3 } pigment_map { [0.4 wood scale 0.2][0.6 average pigment_map { [1 onion][2 radial] }] }",
        "gradient x warp { repeat x * 0.3 flip x } warp { black_hole <0, 1, 0>, 2 } warp { spherical } scallop_wave",
    };
    for (size_t i = 0; i < sizeof pigments / sizeof *pigments; i++) {
        compare(pigments[i], 0.007, 0);
        compare(pigments[i], 0.13, 0);
        compare(pigments[i], -3.1, 0.4);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(many_points_have_the_colours_of_each) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
