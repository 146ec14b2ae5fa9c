/* png.c - PNG by libpng: samples as they stand in the file, and the chunks that say how they are encoded. */
#include <stdlib.h>
#include <string.h>

#include "image/codec.h"

static bool probe(Str bytes)
{
    return bytes.n >= 8 && memcmp(bytes.data, "\x89PNG\r\n\x1a\n", 8) == 0;
}

#ifdef HAVE_PNG
#include <png.h>
#include <zlib.h>

typedef struct Source {
    Str bytes;
    size_t at;
    char *error;
} Source;

static void on_error(png_structp png, png_const_charp message)
{
    Source *s = png_get_error_ptr(png);
    codec_fail(s->error, "damaged PNG: %s", message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void give(png_structp png, png_bytep out, size_t n)
{
    Source *s = png_get_io_ptr(png);
    if (n > s->bytes.n - s->at)
        png_error(png, "the file ends too early");
    memcpy(out, s->bytes.data + s->at, n);
    s->at += n;
}

static void read_palette(png_structp png, png_infop info, Image *im)
{
    png_colorp colours;
    png_bytep alpha = NULL;
    int n = 0, n_alpha = 0;
    png_get_PLTE(png, info, &colours, &n);
    png_get_tRNS(png, info, &alpha, &n_alpha, NULL);
    im->indexed = im->has_alpha = true;        /* POV: also without tRNS */
    im->n_palette = (uint32_t)n;
    for (int i = 0; i < n; i++) {
        uint8_t *entry = im->palette[i];
        entry[0] = colours[i].red;
        entry[1] = colours[i].green;
        entry[2] = colours[i].blue;
        entry[3] = i < n_alpha ? alpha[i] : 255;
    }
}

static void read_curve(png_structp png, png_infop info, Image *im)
{
    int intent;
    double file_gamma;
    if (png_get_sRGB(png, info, &intent)) {
        im->has_chunk = true;
        im->chunk = (Transfer){ TRANSFER_SRGB, 0 };
    } else if (png_get_gAMA(png, info, &file_gamma) && file_gamma > 0) {
        im->has_chunk = true;
        im->chunk = (Transfer){ TRANSFER_POWER, 1 / file_gamma };
    }
}

/* Sets up the transformations and the fields of the image. */
static void read_header(png_structp png, png_infop info, Image *im)
{
    png_read_info(png, info);
    im->width = (int)png_get_image_width(png, info);
    im->height = (int)png_get_image_height(png, info);
    int depth = png_get_bit_depth(png, info), type = png_get_color_type(png, info);
    im->max_value = depth == 16 ? 65535 : 255;
    if (type == PNG_COLOR_TYPE_PALETTE) {
        read_palette(png, info, im);
    } else if (png_get_valid(png, info, PNG_INFO_tRNS)) {
        png_set_tRNS_to_alpha(png);            /* one transparent colour becomes alpha */
    } else if (depth < 8) {
        im->max_value = (1u << depth) - 1;
    }
    png_set_packing(png);
    if (depth == 16 && (union { uint16_t all; uint8_t first; }){ 1 }.first)
        png_set_swap(png);
    read_curve(png, info, im);
}

static void read_rows(png_structp png, png_infop info, Image *im, unsigned char *pixels)
{
    int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    im->channels = png_get_channels(png, info);
    im->depth = png_get_bit_depth(png, info) == 16 ? IMAGE_U16 : IMAGE_U8;
    im->has_alpha |= im->channels % 2 == 0;
    if (pixels == NULL)
        return;
    size_t row = png_get_rowbytes(png, info);
    for (int pass = 0; pass < passes; pass++)
        for (int y = 0; y < im->height; y++)
            png_read_row(png, pixels + (size_t)y * row, NULL);
    png_read_end(png, NULL);
}

static bool read_image(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    if (!probe(bytes))
        return codec_fail(error, "this is no PNG file");
    Source source = { bytes, 0, error };
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, on_error, on_warning);
    png_infop info = png != NULL ? png_create_info_struct(png) : NULL;
    if (info == NULL) {
        png_destroy_read_struct(&png, NULL, NULL);
        return codec_fail(error, "not enough memory");
    }
    bool ok = false;
    if (setjmp(png_jmpbuf(png)) == 0) {
        png_set_read_fn(png, &source, give);
        png_set_user_limits(png, IMAGE_MAX_SIDE, IMAGE_MAX_SIDE);
        png_set_chunk_malloc_max(png, 1 << 24);
        read_header(png, info, im);
        /* deflate makes at most 1032 bytes of one; 8 pixels to the byte */
        ok = codec_size(im->width, im->height, bytes, 8 * 1032, error);
        if (ok)
            read_rows(png, info, im, pixels);
    } else {
        ok = false;
    }
    png_destroy_read_struct(&png, &info, NULL);
    return ok;
}

/* ---- writing ---- */

typedef struct Sink {
    FILE *to;
    char *error;
} Sink;

static void on_write_error(png_structp png, png_const_charp message)
{
    Sink *s = png_get_error_ptr(png);
    codec_fail(s->error, "%s", message);
    png_longjmp(png, 1);
}

static void take(png_structp png, png_bytep data, size_t n)
{
    Sink *s = png_get_io_ptr(png);
    if (fwrite(data, 1, n, s->to) != n)
        png_error(png, "the file cannot be written (is the disk full?)");
}

static void flush(png_structp png)
{
    (void)png;
}

static void write_header(png_structp png, png_infop info, const Codes *c)
{
    static const int types[] = { 0, PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA };
    const Quantising *q = &c->how->quantising;
    png_set_IHDR(png, info, (png_uint_32)c->width, (png_uint_32)c->height, c->bits, types[c->channels], PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (q->working.kind != TRANSFER_NONE && q->file.kind == TRANSFER_SRGB)
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    else if (q->working.kind != TRANSFER_NONE && q->file.kind == TRANSFER_POWER)
        png_set_gAMA(png, info, 1 / q->file.exponent);
    if (q->bits != c->bits) {
        png_byte bits = (png_byte)q->bits;
        png_set_sBIT(png, info, &(png_color_8){ bits, bits, bits, bits, bits });
    }
    /* One filter and runs only: a quarter of the default's time, and traced pictures lose little by it. */
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_PAETH);
    png_set_compression_strategy(png, Z_RLE);
    /* Blocks of 4096 tokens: codes that fit better make files 5 % smaller than blocks of 16384, in a third of the memory. Runs have
     * no use for the window, nor for the tables that shift with it. */
    png_set_compression_mem_level(png, 6);
    png_set_compression_window_bits(png, 14);
    png_write_info(png, info);
}

/* Codes as the file has them. */
static void narrow(const uint16_t *code, size_t n, int bits, unsigned char *out)
{
    typedef uint16_t Wide __attribute__((vector_size(16)));
    typedef uint8_t Slim __attribute__((vector_size(8)));
    size_t i = 0;
    if (bits == 16) {
        for (; i < n; i++) {
            out[2 * i] = (unsigned char)(code[i] >> 8);
            out[2 * i + 1] = (unsigned char)code[i];
        }
        return;
    }
    for (; i + 8 <= n; i += 8) {
        Wide wide;
        memcpy(&wide, code + i, sizeof wide);
        Slim slim = __builtin_convertvector(wide, Slim);
        memcpy(out + i, &slim, sizeof slim);
    }
    for (; i < n; i++)
        out[i] = (unsigned char)code[i];
}

/* A row like the one above leaves nothing with the plainest of filters, too, which takes libpng a fifth of the time. `rows`: room for two. */
static void write_rows(png_structp png, Codes *c, unsigned char *rows)
{
    size_t samples = (size_t)c->width * (size_t)c->channels, bytes = samples * (c->bits == 16 ? 2 : 1);
    for (int y = 0; y < c->height; y++) {
        unsigned char *row = y % 2 == 0 ? rows : rows + bytes, *above = y % 2 == 0 ? rows + bytes : rows;
        narrow(codes_next(c), samples, c->bits, row);
        bool again = y > 0 && memcmp(row, above, bytes) == 0;
        png_set_filter(png, PNG_FILTER_TYPE_BASE, again ? PNG_FILTER_UP : PNG_FILTER_PAETH);
        png_write_row(png, row);
    }
    png_write_end(png, NULL);
}

static bool write_image(FILE *to, Codes *c, char error[IMAGE_ERROR])
{
    Sink sink = { to, error };
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, on_write_error, on_warning);
    png_infop info = png != NULL ? png_create_info_struct(png) : NULL;
    unsigned char *const rows = malloc((size_t)c->width * (size_t)c->channels * 4);
    bool ok = info != NULL && rows != NULL;
    if (!ok) {
        codec_fail(error, "not enough memory");
    } else if (setjmp(png_jmpbuf(png)) == 0) {
        png_set_write_fn(png, &sink, take, flush);
        write_header(png, info, c);
        write_rows(png, c, rows);
    } else {
        ok = false;
    }
    free(rows);
    png_destroy_write_struct(&png, &info);
    return ok;
}

const ImageCodec codec_png = { IMAGE_PNG, probe, read_image, write_image };

#else

static bool read_image(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    (void)bytes, (void)im, (void)pixels;
    return codec_fail(error, "this build has no libpng and cannot read PNG files");
}

static bool write_image(FILE *to, Codes *c, char error[IMAGE_ERROR])
{
    (void)to, (void)c;
    return codec_fail(error, "this build has no libpng and cannot write PNG files; PPM, TGA and BMP work");
}

const ImageCodec codec_png = { IMAGE_PNG, probe, read_image, write_image };

#endif
