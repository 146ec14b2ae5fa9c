/* jpeg.c - JPEG by libjpeg with its default settings. */
#include <string.h>

#include "image/codec.h"

static bool probe(Str bytes)
{
    return bytes.n >= 3 && memcmp(bytes.data, "\xff\xd8\xff", 3) == 0;
}

#ifdef HAVE_JPEG
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <jpeglib.h>
#include <jerror.h>

#include "base/library.h"

#define FUNCTIONS(each)                                                                                                \
    each(jpeg_std_error) each(jpeg_CreateDecompress) each(jpeg_mem_src) each(jpeg_read_header) each(jpeg_start_decompress)      \
    each(jpeg_read_scanlines) each(jpeg_finish_decompress) each(jpeg_destroy_decompress) each(jpeg_CreateCompress)     \
    each(jpeg_stdio_dest) each(jpeg_set_defaults) each(jpeg_set_quality) each(jpeg_start_compress)                     \
    each(jpeg_write_scanlines) each(jpeg_finish_compress) each(jpeg_destroy_compress)

typedef struct Library { FUNCTIONS(LIBRARY_FIELD) } Library;

typedef struct Errors {
    struct jpeg_error_mgr base;
    jmp_buf landing;
    char *text;
} Errors;

_Noreturn static void on_error(j_common_ptr j)
{
    Errors *e = (Errors *)j->err;
    char message[JMSG_LENGTH_MAX];
    e->base.format_message(j, message);
    codec_fail(e->text, "damaged JPEG: %.200s", message);
    longjmp(e->landing, 1);
}

/* The library mends a file that ends early with grey; we say so instead. */
static void on_message(j_common_ptr j, int level)
{
    Errors *e = (Errors *)j->err;
    if (level < 0 && e->base.msg_code == JWRN_JPEG_EOF) {
        codec_fail(e->text, "the file ends before its last pixel");
        longjmp(e->landing, 1);
    }
}

static bool library(Library *lib, char error[IMAGE_ERROR])
{
    static const char *const names[] = { FUNCTIONS(LIBRARY_NAME) };
    return library_load(LIBRARY_JPEG, names, sizeof names / sizeof *names, lib) ||
           codec_fail(error, "libjpeg, which reads and writes JPEG files, is not installed");
}

static struct jpeg_error_mgr *errors_set(const Library *lib, Errors *e, char *text)
{
    lib->jpeg_std_error(&e->base);
    e->base.error_exit = on_error;
    e->base.emit_message = on_message;
    e->text = text;
    return &e->base;
}

static bool read_with(const Library *lib, struct jpeg_decompress_struct *j, Str bytes, Image *im, unsigned char *pixels,
                      char error[IMAGE_ERROR])
{
    lib->jpeg_mem_src(j, (const unsigned char *)bytes.data, bytes.n);
    lib->jpeg_read_header(j, TRUE);
    /* a scan of zeros needs little more than a bit for each block of 64 */
    if (!codec_size((long)j->image_width, (long)j->image_height, bytes, 4096, error))
        return false;
    if (j->jpeg_color_space == JCS_CMYK || j->jpeg_color_space == JCS_YCCK)
        return codec_fail(error, "JPEG files in CMYK are not read; convert it to RGB");
    j->out_color_space = j->num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
    im->width = (int)j->image_width;
    im->height = (int)j->image_height;
    im->channels = j->num_components == 1 ? 1 : 3;
    im->max_value = 255;
    if (pixels == NULL)
        return true;
    lib->jpeg_start_decompress(j);
    size_t row = (size_t)im->width * (size_t)im->channels;
    while (j->output_scanline < j->output_height) {
        JSAMPROW to = pixels + row * j->output_scanline;
        lib->jpeg_read_scanlines(j, &to, 1);
    }
    lib->jpeg_finish_decompress(j);
    return true;
}

static bool read_image(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    if (!probe(bytes))
        return codec_fail(error, "this is no JPEG file");
    Library lib;
    if (!library(&lib, error))
        return false;
    struct jpeg_decompress_struct j;
    Errors errors;
    j.err = errors_set(&lib, &errors, error);
    bool ok = false;
    if (setjmp(errors.landing) == 0) {
        lib.jpeg_CreateDecompress(&j, JPEG_LIB_VERSION, sizeof j);
        ok = read_with(&lib, &j, bytes, im, pixels, error);
    }
    lib.jpeg_destroy_decompress(&j);
    return ok;
}

static void write_with(const Library *lib, struct jpeg_compress_struct *j, FILE *to, Codes *c, unsigned char *row)
{
    lib->jpeg_stdio_dest(j, to);
    j->image_width = (JDIMENSION)c->width;
    j->image_height = (JDIMENSION)c->height;
    j->input_components = 3;
    j->in_color_space = JCS_RGB;
    lib->jpeg_set_defaults(j);
    int quality = c->how->quality;
    lib->jpeg_set_quality(j, quality <= 0 ? 85 : quality > 100 ? 100 : quality, TRUE);
    lib->jpeg_start_compress(j, TRUE);
    size_t n = (size_t)c->width * 3;
    for (int y = 0; y < c->height; y++) {
        const uint16_t *code = codes_next(c);
        for (size_t i = 0; i < n; i++)
            row[i] = (unsigned char)code[i];
        JSAMPROW from = row;
        lib->jpeg_write_scanlines(j, &from, 1);
    }
    lib->jpeg_finish_compress(j);
}

static bool write_image(FILE *to, Codes *c, char error[IMAGE_ERROR])
{
    Library lib;
    if (!library(&lib, error))
        return false;
    struct jpeg_compress_struct j;
    Errors errors;
    j.err = errors_set(&lib, &errors, error);
    unsigned char *const row = malloc((size_t)c->width * 3);
    if (row == NULL)
        return codec_fail(error, "not enough memory");
    bool ok = false;
    if (setjmp(errors.landing) == 0) {
        lib.jpeg_CreateCompress(&j, JPEG_LIB_VERSION, sizeof j);
        write_with(&lib, &j, to, c, row);
        ok = true;
    }
    lib.jpeg_destroy_compress(&j);
    free(row);
    return ok;
}

const ImageCodec codec_jpeg = { IMAGE_JPEG, probe, read_image, write_image };

#else

static bool read_image(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    (void)bytes, (void)im, (void)pixels;
    return codec_fail(error, "this build has no libjpeg and cannot read JPEG files");
}

static bool write_image(FILE *to, Codes *c, char error[IMAGE_ERROR])
{
    (void)to, (void)c;
    return codec_fail(error, "this build has no libjpeg and cannot write JPEG files");
}

const ImageCodec codec_jpeg = { IMAGE_JPEG, probe, read_image, write_image };

#endif
