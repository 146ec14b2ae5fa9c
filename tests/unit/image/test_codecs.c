/* test_codecs.c - files become pixels, pixels become files, and damaged files become messages. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "image/image.h"

static const ImageReading exact = { .exact = true };

static Str read_file(Arena *a, const char *path)
{
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    char *data = arena_alloc(a, 1 << 20);
    size_t n = fread(data, 1, 1 << 20, f);
    fclose(f);
    return (Str){ data, (uint32_t)n };
}

static Image *read_input(Arena *a, const char *name)
{
    char path[200], error[IMAGE_ERROR] = "";
    snprintf(path, sizeof path, "tests/vectors/inputs/%s", name);
    Image *im = image_read(a, read_file(a, path), IMAGE_BY_CONTENT, &exact, error);
    if (im == NULL)
        print_error("%s: %s\n", name, error);
    assert_non_null(im);
    return im;
}

static void assert_same_colours(const Image *a, const Image *b)
{
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    for (int y = 0; y < a->height; y++)
        for (int x = 0; x < a->width; x++) {
            Colour ca = image_pixel(a, x, y), cb = image_pixel(b, x, y);
            assert_memory_equal(&ca, &cb, sizeof ca);
        }
}

static void the_same_picture_in_every_format_has_the_same_pixels(void **state)
{
    (void)state;
    static const char *const same[] = { "rgb.ppm", "rgb.tga", "rgb.bmp", "rgb_srgb.png", "rgb_g1.png", "rgb_g22.png" };
    Arena a;
    arena_init(&a);
    Image *png = read_input(&a, "rgb.png");
    for (size_t i = 0; i < sizeof same / sizeof *same; i++)
        assert_same_colours(png, read_input(&a, same[i]));
    assert_same_colours(read_input(&a, "rgba.png"), read_input(&a, "rgba.tga"));
    assert_same_colours(read_input(&a, "pal.png"), read_input(&a, "pal.gif"));
    assert_same_colours(read_input(&a, "gray.png"), read_input(&a, "gray.pgm"));
    arena_free(&a);
}

static void chunks_palettes_and_alpha_are_reported(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    assert_int_equal(read_input(&a, "rgb_srgb.png")->chunk.kind, TRANSFER_SRGB);
    Image *g = read_input(&a, "rgb_g1.png");
    assert_true(g->has_chunk && g->chunk.kind == TRANSFER_POWER && g->chunk.exponent == 1);
    assert_false(read_input(&a, "rgb.png")->has_chunk);
    assert_true(read_input(&a, "pal.png")->indexed);
    assert_false(read_input(&a, "pal.png")->translucent);
    assert_true(read_input(&a, "palt.png")->translucent);
    assert_true(read_input(&a, "rgba.png")->translucent);
    assert_int_equal(read_input(&a, "gray2.png")->max_value, 3);
    assert_int_equal(read_input(&a, "rgb31.ppm")->max_value, 31);
    assert_int_equal(read_input(&a, "rgb16.png")->depth, IMAGE_U16);
    assert_int_equal(read_input(&a, "graya.png")->channels, 2);
    arena_free(&a);
}

/* The formats that say how long they are must notice every missing byte of their pixels; none may crash. */
static void files_cut_short_are_refused(void **state)
{
    (void)state;
    static const char *const names[] = { "rgb.png", "rgba.png", "gray16.png", "pal.png", "pal.gif", "rgb.ppm", "gray.pgm", "rgb.tga",
                                         "rgba.tga", "rgb.bmp" };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        Arena a;
        arena_init(&a);
        char path[200], error[IMAGE_ERROR];
        snprintf(path, sizeof path, "tests/vectors/inputs/%s", names[i]);
        Str whole = read_file(&a, path);
        ImageFormat format = image_format_of(str_of(names[i]));
        int refused = 0;
        for (uint32_t n = 0; n < whole.n; n++) {
            char *part = malloc(n + 1);        /* its own block, so that the sanitizers see reads past the end */
            memcpy(part, whole.data, n);
            strcpy(error, "");
            if (image_read(&a, (Str){ part, n }, format, &exact, error) == NULL) {
                assert_true(strlen(error) > 0);
                refused++;
            }
            free(part);
        }
        if (refused < (int)whole.n - 14)
            print_error("%s: %d of %d refused\n", names[i], refused, (int)whole.n);
        assert_true(refused >= (int)whole.n - 14);
        arena_free(&a);
    }
}

static void every_single_damaged_byte_is_survived(void **state)
{
    (void)state;
    static const char *const names[] = { "rgb.png", "pal.png", "graya.png", "pal.gif", "rgb.ppm", "rgb.tga", "rgb.bmp" };
    static const unsigned char changes[] = { 0x01, 0x80, 0xff, 0x10 };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        Arena a;
        arena_init(&a);
        char path[200], error[IMAGE_ERROR];
        snprintf(path, sizeof path, "tests/vectors/inputs/%s", names[i]);
        Str whole = read_file(&a, path);
        for (uint32_t at = 0; at < whole.n; at++)
            for (size_t c = 0; c < sizeof changes; c++) {
                Arena inner;
                arena_init(&inner);
                char *copy = malloc(whole.n);
                memcpy(copy, whole.data, whole.n);
                copy[at] = (char)(copy[at] ^ changes[c]);
                strcpy(error, "");
                Image *im = image_read(&inner, (Str){ copy, whole.n }, image_format_of(str_of(names[i])), &exact, error);
                assert_true(im != NULL || strlen(error) > 0);
                free(copy);
                arena_free(&inner);
            }
        arena_free(&a);
    }
}

static void huge_sizes_in_small_files_are_refused_before_anything_is_allocated(void **state)
{
    (void)state;
    static const char ppm[] = "P6 65000 65000 255\n", gif[] = "GIF89a\xff\xff\xff\xff\x80\0\0abcdef,\0\0\0\0\xff\xff\xff\xff\0\2";
    static const char tga[] = "\0\0\2\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff\x18\0", wide[] = "P5 70000 1 255\n";
    Arena a;
    arena_init(&a);
    char error[IMAGE_ERROR];
    assert_null(image_read(&a, (Str){ ppm, sizeof ppm }, IMAGE_PPM, &exact, error));
    assert_string_equal(error, "the file is much too short for the 65000 x 65000 pixels it promises");
    assert_null(image_read(&a, (Str){ gif, sizeof gif }, IMAGE_GIF, &exact, error));
    assert_null(image_read(&a, (Str){ tga, sizeof tga }, IMAGE_TGA, &exact, error));
    assert_null(image_read(&a, (Str){ wide, sizeof wide }, IMAGE_PGM, &exact, error));
    assert_string_equal(error, "the image says it is 70000 x 1 pixels; the limit is 65500 a side");
    assert_null(image_read(&a, str_of("hello, I am a text"), IMAGE_BY_CONTENT, &exact, error));
    assert_true(a.used < 100000);
    arena_free(&a);
}

static void a_text_bitmap_and_a_comment_are_read(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    char error[IMAGE_ERROR];
    Image *im = image_read(&a, str_of("P1 # one\n2 2\n10\n0 1"), IMAGE_BY_CONTENT, &exact, error);
    assert_non_null(im);
    assert_true(image_pixel(im, 0, 0).r == 0 && image_pixel(im, 1, 0).r == 1);
    assert_true(image_pixel(im, 0, 1).r == 1 && image_pixel(im, 1, 1).r == 0);
    arena_free(&a);
}

/* ---- formats made by hand ---- */

static Image *read_bytes(Arena *a, const void *bytes, size_t n, ImageFormat format)
{
    char error[IMAGE_ERROR] = "";
    Image *im = image_read(a, (Str){ bytes, (uint32_t)n }, format, &exact, error);
    if (im == NULL)
        print_error("%s\n", error);
    assert_non_null(im);
    return im;
}

static void assert_pixel(const Image *im, int x, int y, double r, double g, double b, double transmit)
{
    Colour c = image_pixel(im, x, y);
    assert_true(fabs((double)c.r - r) < 1e-5 && fabs((double)c.g - g) < 1e-5 && fabs((double)c.b - b) < 1e-5
                && fabs((double)c.t - transmit) < 1e-5);
}

static void tga_colours_of_16_bits_and_palettes_are_read(void **state)
{
    (void)state;
    static const unsigned char deep[] = { 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, 16, 0x20, 0x1f, 0x80, 0xe0, 0x03 };
    static const unsigned char palette[] = { 0, 1, 9, 0, 0, 2, 0, 24, 0, 0, 0, 0, 3, 0, 1, 0, 8, 0x20,
                                             255, 0, 0, 0, 0, 255, 0x81, 1, 0x00, 0 };
    Arena a;
    arena_init(&a);
    Image *im = read_bytes(&a, deep, sizeof deep, IMAGE_TGA);
    assert_pixel(im, 0, 0, 0, 0, 248 / 255.0, 0);
    assert_pixel(im, 1, 0, 0, 248 / 255.0, 0, 1);
    im = read_bytes(&a, palette, sizeof palette, IMAGE_TGA);
    assert_true(im->indexed);
    assert_pixel(im, 1, 0, 1, 0, 0, 0);
    assert_pixel(im, 2, 0, 0, 0, 1, 0);
    arena_free(&a);
}

static void interlaced_gif_rows_are_put_in_order(void **state)
{
    (void)state;
    /* one pixel wide, five high, rows 0 4 2 1 3 of colours 0 1 0 1 1; 4 clears the table so that codes stay at 3 bits */
    static const unsigned char gif[] = { 'G', 'I', 'F', '8', '9', 'a', 1, 0, 5, 0, 0x80, 0, 0, 0, 0, 0, 255, 255, 255,
                                         ',', 0, 0, 0, 0, 1, 0, 5, 0, 0x40, 2, 3, 0, 0, 0, 0, ';' };
    unsigned char file[sizeof gif];
    memcpy(file, gif, sizeof gif);
    uint32_t bits = 0;
    const unsigned code[] = { 4, 0, 1, 4, 0, 1, 4, 1 };
    for (int i = 0; i < 8; i++)
        bits |= code[i] << (3 * i);
    for (int i = 0; i < 3; i++)
        file[31 + i] = (unsigned char)(bits >> (8 * i));
    Arena a;
    arena_init(&a);
    Image *im = read_bytes(&a, file, sizeof file, IMAGE_GIF);
    static const double row[] = { 0, 1, 0, 1, 1 };
    for (int y = 0; y < 5; y++)
        assert_pixel(im, 0, y, row[y], row[y], row[y], 0);
    arena_free(&a);
}

static void the_halves_of_a_pot_are_upper_and_lower_bytes(void **state)
{
    (void)state;
    /* two pixels wide, numbers 1 and 2: codes 4 1 2 5 */
    static const unsigned char gif[] = { 'G', 'I', 'F', '8', '7', 'a', 2, 0, 1, 0, 0x81, 0, 0, 0, 0, 0, 9, 9, 9, 9, 9, 9, 9, 9, 9,
                                         ',', 0, 0, 0, 0, 2, 0, 1, 0, 0, 2, 2, 0x8c, 0x0a, 0, ';' };
    Arena a;
    arena_init(&a);
    Image *im = read_bytes(&a, gif, sizeof gif, IMAGE_POT);
    assert_int_equal(im->width, 1);
    assert_int_equal(*(const uint16_t *)im->pixels, 0x0102);
    arena_free(&a);
}

static void hdr_pixels_have_a_shared_exponent_and_runs(void **state)
{
    (void)state;
    char file[200] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 3\n";
    size_t n = strlen(file);
    static const unsigned char pixels[] = { 128, 64, 0, 129, 1, 1, 1, 2 };
    memcpy(file + n, pixels, sizeof pixels);
    Arena a;
    arena_init(&a);
    Image *im = read_bytes(&a, file, n + sizeof pixels, IMAGE_BY_CONTENT);
    for (int x = 0; x < 3; x++)
        assert_pixel(im, x, 0, 128.5 / 128, 64.5 / 128, 0.5 / 128, 0);
    char error[IMAGE_ERROR];
    assert_null(image_read(&a, (Str){ file, (uint32_t)n + 6 }, IMAGE_HDR, &exact, error));
    assert_string_equal(error, "the file ends before its last pixel");
    arena_free(&a);
}

static void a_run_length_coded_bmp_is_read(void **state)
{
    (void)state;
    unsigned char file[54 + 8 + 8] = { 'B', 'M', [10] = 62, [14] = 40, [18] = 4, [22] = 2, [26] = 1, [28] = 8, [30] = 1, [46] = 2 };
    static const unsigned char rest[] = { 0, 0, 0, 0, 255, 255, 255, 0, 3, 1, 0, 0, 4, 1, 0, 1 };
    memcpy(file + 54, rest, sizeof rest);
    Arena a;
    arena_init(&a);
    Image *im = read_bytes(&a, file, sizeof file, IMAGE_BY_CONTENT);
    assert_pixel(im, 2, 1, 1, 1, 1, 0);
    assert_pixel(im, 3, 1, 0, 0, 0, 0);
    assert_pixel(im, 3, 0, 1, 1, 1, 0);
    arena_free(&a);
}

#ifdef HAVE_TIFF
static void a_tiff_is_read_and_a_cut_one_refused(void **state)
{
    (void)state;
    /* two grey pixels, values 51 and 204, in one strip at 8; seven tags at 10 */
    static const unsigned char tiff[] = {
        'I', 'I', 42, 0, 10, 0, 0, 0, 51, 204, 7, 0,
        0x00, 1, 3, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0x01, 1, 3, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0x02, 1, 3, 0, 1, 0, 0, 0, 8, 0, 0, 0,
        0x03, 1, 3, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0x06, 1, 3, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0x11, 1, 4, 0, 1, 0, 0, 0, 8, 0, 0, 0,
        0x17, 1, 4, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0
    };
    Arena a;
    arena_init(&a);
    Image *im = read_bytes(&a, tiff, sizeof tiff, IMAGE_BY_CONTENT);
    assert_pixel(im, 0, 0, 0.2, 0.2, 0.2, 0);
    assert_pixel(im, 1, 0, 0.8, 0.8, 0.8, 0);
    char error[IMAGE_ERROR];
    for (uint32_t n = 8; n < 90; n++) {
        strcpy(error, "");
        assert_null(image_read(&a, (Str){ (const char *)tiff, n }, IMAGE_TIFF, &exact, error));
        assert_true(strlen(error) > 0);
    }
    arena_free(&a);
}
#endif

/* ---- writing ---- */

static void fill(float *rgba, int n, bool clear)
{
    uint32_t s = 1;
    for (int i = 0; i < n; i++) {
        float alpha = 1;
        for (int c = 3; c >= 0; c--) {
            s = s * 1812433253u + 12345;
            float v = (float)(s >> 24) / 255.0f;
            if (c == 3)
                alpha = clear ? v : 1;
            rgba[4 * i + c] = c == 3 ? alpha : v * alpha;
        }
    }
}

static void written_files_read_back_as_they_were(void **state)
{
    (void)state;
    static const struct { ImageFormat format; bool run_length, alpha, grey; int bits; } kinds[] = {
        { IMAGE_PNG, false, false, false, 8 }, { IMAGE_PNG, false, true, false, 8 }, { IMAGE_PNG, false, false, true, 16 },
        { IMAGE_PNG, false, true, false, 16 }, { IMAGE_PPM, false, false, false, 8 }, { IMAGE_PPM, false, false, false, 16 },
        { IMAGE_PGM, false, false, true, 16 }, { IMAGE_TGA, false, false, false, 8 }, { IMAGE_TGA, true, true, false, 8 },
        { IMAGE_TGA, true, false, false, 8 }, { IMAGE_BMP, false, false, false, 8 }, { IMAGE_BMP, false, true, false, 8 }
    };
    enum { W = 37, H = 11 };
    static float rgba[W * H * 4];
    char path[] = "/tmp/whit-test-XXXXXX";
    int fd = mkstemp(path);
    assert_true(fd >= 0);
    close(fd);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        fill(rgba, W * H, kinds[k].alpha);
        for (int i = W; i < 3 * W; i++)        /* rows of one colour for the run-length coder */
            for (int c = 0; c < 4; c++)
                rgba[4 * i + c] = rgba[4 * (i / 20) + c];
        ImageWriting how = { .format = kinds[k].format, .run_length = kinds[k].run_length,
                             .quantising = { .bits = kinds[k].bits, .alpha = kinds[k].alpha, .grey = kinds[k].grey } };
        char error[IMAGE_ERROR] = "";
        if (!image_write(path, rgba, W, H, &how, error))
            fail_msg("%s", error);
        Arena a;
        arena_init(&a);
        Image *im = image_read(&a, read_file(&a, path), IMAGE_BY_CONTENT, &exact, error);
        assert_non_null(im);
        uint16_t code[W * H * 4];
        assert_true(quantise(rgba, W, H, &how.quantising, code));
        int n = quantise_channels(&how.quantising), max = (1 << kinds[k].bits) - 1;
        for (int i = 0; i < W * H; i++) {
            Colour c = image_pixel(im, i % W, i / W);
            float got[4] = { c.r, n < 3 ? 1 - c.t : c.g, c.b, 1 - c.t };
            for (int j = 0; j < n; j++)
                assert_true(fabsf(got[j] * (float)max - (float)code[i * n + j]) < 0.01f);
        }
        arena_free(&a);
    }
    unlink(path);
}

enum { LONG = 20000 };

/* A grey PNG of one row: what its filter leaves is how much each byte differs from the one before. */
static void assert_row_survives(const uint8_t *row, int n)
{
    static float rgba[4 * LONG];
    char path[] = "/tmp/whit-test-XXXXXX", error[IMAGE_ERROR] = "";
    close(mkstemp(path));
    for (int i = 0; i < 4 * n; i++)
        rgba[i] = i % 4 == 3 ? 1 : (float)row[i / 4] / 255.0f;
    ImageWriting how = { .format = IMAGE_PNG, .quantising = { .bits = 8, .grey = true } };
    assert_true(image_write(path, rgba, n, 1, &how, error));
    Arena a;
    arena_init(&a);
    Image *im = image_read(&a, read_file(&a, path), IMAGE_PNG, &exact, error);
    if (im == NULL)
        fail_msg("%s", error);
    assert_memory_equal(im->pixels, row, (size_t)n);
    arena_free(&a);
    unlink(path);
}

static void runs_of_every_length_are_written(void **state)
{
    (void)state;
    static uint8_t row[LONG];
    for (int length = 1; length < 530; length++) {
        for (int i = 0; i < 2 * length; i++)
            row[i] = (uint8_t)(row[i > 0 ? i - 1 : 0] + (i < length ? 3 : 7));
        assert_row_survives(row, 2 * length);
    }
}

/* Differences as frequent as Lucas' numbers make the deepest of trees: 18, where codes may have 15 bits. */
static void codes_that_would_be_too_long_are_shortened(void **state)
{
    (void)state;
    static uint8_t row[LONG];
    int all = 7, times[16] = { 3, 4 }, due[16] = { 0 };
    for (int k = 2; k < 16; k++)
        all += times[k] = times[k - 1] + times[k - 2];
    for (int i = 0; i < all; i++) {            /* the one longest due, so that there are no runs of one difference */
        int most = 0;
        for (int k = 0; k < 16; k++) {
            due[k] += times[k];
            most = due[k] > due[most] ? k : most;
        }
        due[most] -= all;
        row[i] = (uint8_t)(row[i > 0 ? i - 1 : 0] + 5 + most);
    }
    assert_row_survives(row, all);
}

static void jpeg_is_close(void **state)
{
    (void)state;
    enum { W = 32, H = 32 };
    static float rgba[W * H * 4];
    for (int i = 0; i < W * H * 4; i++)
        rgba[i] = i % 4 == 3 ? 1 : (float)(i / 4 % W) / W;
    char path[] = "/tmp/whit-test-XXXXXX", error[IMAGE_ERROR];
    close(mkstemp(path));
    ImageWriting how = { .format = IMAGE_JPEG, .quantising = { .bits = 8 } };
    assert_true(image_write(path, rgba, W, H, &how, error));
    Arena a;
    arena_init(&a);
    Str bytes = read_file(&a, path);
    Image *im = image_read(&a, bytes, IMAGE_BY_CONTENT, &exact, error);
    assert_non_null(im);
    for (int i = 0; i < W * H; i++)
        assert_true(fabsf(image_pixel(im, i % W, i / W).g - rgba[4 * i + 1]) < 0.03f);
    bytes.n /= 2;
    assert_null(image_read(&a, bytes, IMAGE_JPEG, &exact, error));
    arena_free(&a);
    unlink(path);
}

static void a_failed_write_leaves_the_old_file_and_no_other(void **state)
{
    (void)state;
    char path[] = "/tmp/whit-test-XXXXXX", error[IMAGE_ERROR];
    int fd = mkstemp(path);
    assert_int_equal(write(fd, "old", 3), 3);
    close(fd);
    float pixel[4] = { 0, 0, 0, 1 };
    ImageWriting how = { .format = IMAGE_GIF, .quantising = { .bits = 8 } };
    assert_false(image_write(path, pixel, 1, 1, &how, error));
    Arena a;
    arena_init(&a);
    assert_true(str_is(read_file(&a, path), "old"));
    arena_free(&a);
    char beside[100];
    snprintf(beside, sizeof beside, "%s.%d-0", path, (int)getpid());
    assert_int_not_equal(access(beside, F_OK), 0);
    unlink(path);
    assert_false(image_write("/no/such/folder/picture.png", pixel, 1, 1, &how, error));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_picture_in_every_format_has_the_same_pixels),
        cmocka_unit_test(chunks_palettes_and_alpha_are_reported),
        cmocka_unit_test(files_cut_short_are_refused),
        cmocka_unit_test(every_single_damaged_byte_is_survived),
        cmocka_unit_test(huge_sizes_in_small_files_are_refused_before_anything_is_allocated),
        cmocka_unit_test(a_text_bitmap_and_a_comment_are_read),
        cmocka_unit_test(tga_colours_of_16_bits_and_palettes_are_read),
        cmocka_unit_test(interlaced_gif_rows_are_put_in_order),
        cmocka_unit_test(the_halves_of_a_pot_are_upper_and_lower_bytes),
        cmocka_unit_test(hdr_pixels_have_a_shared_exponent_and_runs),
        cmocka_unit_test(a_run_length_coded_bmp_is_read),
#ifdef HAVE_TIFF
        cmocka_unit_test(a_tiff_is_read_and_a_cut_one_refused),
#endif
        cmocka_unit_test(written_files_read_back_as_they_were),
        cmocka_unit_test(runs_of_every_length_are_written),
        cmocka_unit_test(codes_that_would_be_too_long_are_shortened),
        cmocka_unit_test(jpeg_is_close),
        cmocka_unit_test(a_failed_write_leaves_the_old_file_and_no_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
