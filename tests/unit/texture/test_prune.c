/* test_prune.c - pruned textures are smaller and look the same. */
#include "base/arena.h"
#include "texture/texture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

static const Colour red = { 1, 0, 0, 0, 0 }, blue = { 0, 0, 1, 0, 0 }, glass = { 0, 0, 1, 0.5f, 0 };
static const Pattern nothing = { .frequency = 1 };

static Pigment map_of_two(MapEntry entry[2], Colour a, Colour b)
{
    entry[0] = (MapEntry){ .key = 0, .colour = a };
    entry[1] = (MapEntry){ .key = 1, .colour = b };
    return (Pigment){ .kind = PIGMENT_PATTERN, .pattern = &nothing, .map = { MAP_COLOUR, 2, entry } };
}

static void a_map_of_one_colour_becomes_plain(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    MapEntry entry[2];
    Pigment p = map_of_two(entry, red, red);
    Texture t = { .pigment = &p };
    const Texture *pruned = texture_prune(&a, &t);
    assert_int_equal(pruned->pigment->kind, PIGMENT_PLAIN);
    assert_memory_equal(&pruned->pigment->colour, &red, sizeof red);
    p = map_of_two(entry, red, blue);
    assert_ptr_equal(texture_prune(&a, &t), &t);
    arena_free(&a);
}

static void layers_under_an_opaque_one_are_dropped(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    Pigment opaque = { .colour = blue }, clear = { .colour = glass };
    Texture bottom = { .pigment = &opaque }, middle = { .pigment = &opaque, .below = &bottom }, top = { .pigment = &clear, .below = &middle };
    const Texture *pruned = texture_prune(&a, &top);
    assert_non_null(pruned->below);
    assert_null(pruned->below->below);
    assert_ptr_equal(texture_prune(&a, &bottom), &bottom);
    assert_true(texture_is_opaque(&top));
    middle.pigment = bottom.pigment = &clear;
    assert_ptr_equal(texture_prune(&a, &top), &top);
    assert_false(texture_is_opaque(&top));
    arena_free(&a);
}

static void what_passes_more_than_comes_does_not_dim(void **state)
{
    (void)state;
    const Colour bright = { 2, 1, 1, 0.5f, 0 }, twice = { 1, 1, 1, 0.5f, 0.6f }, negative = { 1, 1, 1, -0.5f, 0 };
    assert_true(pigment_dims(&(Pigment){ .colour = glass }));
    assert_false(pigment_dims(&(Pigment){ .colour = bright }));
    assert_false(pigment_dims(&(Pigment){ .colour = twice }));
    assert_false(pigment_dims(&(Pigment){ .colour = negative }));
    assert_false(pigment_dims(&(Pigment){ .colour = glass, .quick = &twice }));
    MapEntry entry[2];
    Pigment dim = map_of_two(entry, red, glass);
    Texture bottom = { .pigment = &dim }, top = { .pigment = &dim, .below = &bottom };
    assert_true(texture_dims(&top));
    entry[1].colour = bright;
    assert_false(texture_dims(&top));
    entry[1].colour = glass;
    MapEntry texture = { .key = -1, .texture = &top };
    assert_true(texture_dims(&(Texture){ .kind = TEXTURE_PATTERN, .pattern = &nothing, .map = { MAP_TEXTURE, 1, &texture } }));
    assert_false(texture_dims(&(Texture){ .kind = TEXTURE_AVERAGE, .pattern = &nothing, .map = { MAP_TEXTURE, 1, &texture } }));
}

static void textures_in_maps_are_pruned_too(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    MapEntry colours[2];
    Pigment p = map_of_two(colours, red, red), q = map_of_two(colours, red, red);
    Texture one = { .pigment = &p }, two = { .pigment = &q };
    MapEntry entry[2] = { { .key = 0, .texture = &one }, { .key = 1, .texture = &two } };
    Texture t = { .kind = TEXTURE_PATTERN, .pattern = &nothing, .map = { MAP_TEXTURE, 2, entry } };
    const Texture *pruned = texture_prune(&a, &t);
    assert_int_equal(pruned->map.entry[1].texture->pigment->kind, PIGMENT_PLAIN);
    assert_ptr_equal(t.map.entry[1].texture, &two);
    arena_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_map_of_one_colour_becomes_plain),
        cmocka_unit_test(layers_under_an_opaque_one_are_dropped),
        cmocka_unit_test(what_passes_more_than_comes_does_not_dim),
        cmocka_unit_test(textures_in_maps_are_pruned_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
