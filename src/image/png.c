/* png.c - PNG: samples as they stand in the file, and the chunks that say how they are encoded. libpng reads; what is written is of
 * one kind, so that a tenth of libpng's time is enough for it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/codec.h"
#include "image/deflate.h"

static bool probe(Str bytes)
{
    return bytes.n >= 8 && memcmp(bytes.data, "\x89PNG\r\n\x1a\n", 8) == 0;
}

#ifdef HAVE_PNG
#include <png.h>

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

#else

static bool read_image(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    (void)bytes, (void)im, (void)pixels;
    return codec_fail(error, "this build has no libpng and cannot read PNG files");
}

#endif

/* ---- writing ---- */

/* Chunks on their way into the file. */
typedef struct Chunks {
    FILE *to;
    uint32_t table[256];                       /* of the checksum: what a byte adds to it */
} Chunks;

static void checksum_table(uint32_t table[256])
{
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t c = i;
        for (int k = 0; k < 8; k++)
            c = c >> 1 ^ (c & 1 ? 0xedb88320 : 0);
        table[i] = c;
    }
}

static uint8_t *put32(uint8_t *out, uint32_t v)
{
    for (int i = 0; i < 4; i++)
        *out++ = (uint8_t)(v >> (24 - 8 * i));
    return out;
}

static uint32_t checksum(const uint32_t table[256], uint32_t sum, const uint8_t *bytes, size_t n)
{
    for (size_t i = 0; i < n; i++)
        sum = sum >> 8 ^ table[(sum ^ bytes[i]) & 255];
    return sum;
}

static void write_chunk(const Chunks *c, const char *type, const uint8_t *data, size_t n)
{
    uint8_t head[8], sum[4];
    memcpy(put32(head, (uint32_t)n), type, 4);
    put32(sum, ~checksum(c->table, checksum(c->table, 0xffffffff, head + 4, 4), data, n));
    fwrite(head, 1, sizeof head, c->to);
    fwrite(data, 1, n, c->to);
    fwrite(sum, 1, sizeof sum, c->to);
}

static void write_header(const Chunks *to, const Codes *c)
{
    enum { SRGB_GAMMA = 45455, ALPHA = 4, COLOUR = 2 };
    /* White, red, green, blue of sRGB: x and y, times 100,000. */
    static const uint32_t primaries[] = { 31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000 };
    const Quantising *q = &c->how->quantising;
    uint8_t data[8 * 4], *end = put32(put32(data, (uint32_t)c->width), (uint32_t)c->height);
    bool has_curve = q->working.kind != TRANSFER_NONE, srgb = has_curve && q->file.kind == TRANSFER_SRGB;
    *end++ = (uint8_t)c->bits;
    *end++ = (uint8_t)((c->channels % 2 == 0 ? ALPHA : 0) + (c->channels > 2 ? COLOUR : 0));
    memset(end, 0, 3);                         /* compression, filters, interlacing */
    fwrite("\x89PNG\r\n\x1a\n", 1, 8, to->to);
    write_chunk(to, "IHDR", data, 13);
    if (srgb || (has_curve && q->file.kind == TRANSFER_POWER)) {
        put32(data, srgb ? SRGB_GAMMA : (uint32_t)floor(100000 / q->file.exponent + 0.5));
        write_chunk(to, "gAMA", data, 4);
    }
    if (srgb)
        write_chunk(to, "sRGB", (const uint8_t *)"", 1);
    if (q->bits != c->bits) {
        memset(data, q->bits, 4);
        write_chunk(to, "sBIT", data, (size_t)c->channels);
    }
    if (srgb) {
        for (int i = 0; i < 8; i++)
            put32(data + 4 * i, primaries[i]);
        write_chunk(to, "cHRM", data, sizeof data);
    }
}

enum { PAETH = 4, MARGIN = 16, BLOCK = 1 << 14 };      /* the filter's number; bytes around rows; of filtered rows, about */

typedef uint8_t Bytes __attribute__((vector_size(16)));

static inline Bytes load(const uint8_t *from)
{
    Bytes b;
    memcpy(&b, from, sizeof b);
    return b;
}

static inline Bytes pick(Bytes mask, Bytes yes, Bytes no)
{
    return (mask & yes) | (~mask & no);
}

/* What is left of a row when each byte is told from those to the left, above, and left above, whichever is nearest to
 * left + above - left above (PNG specification, 9.4); in bytes alone. Rows lie between margins, the left of zeros. */
static void filter_paeth(const uint8_t *row, const uint8_t *above, size_t pixel, size_t n, uint8_t *out)
{
    for (size_t i = 0; i < n; i += sizeof(Bytes)) {
        Bytes a = load(row + i - pixel), b = load(above + i), c = load(above + i - pixel);
        Bytes falls_a = (Bytes)(b < c), falls_b = (Bytes)(a < c);
        Bytes from_a = ((b - c) ^ falls_a) - falls_a, from_b = ((a - c) ^ falls_b) - falls_b;
        Bytes a_first = (Bytes)(from_a <= from_b), nearer = pick(a_first, from_a, from_b), farther = pick(a_first, from_b, from_a);
        /* From c it is the sum of both if they lead the same way, else the difference. */
        Bytes c_last = ~(falls_a ^ falls_b) | (Bytes)(nearer <= farther - nearer);
        Bytes left = load(row + i) - pick(c_last, pick(a_first, a, b), c);
        memcpy(out + i, &left, sizeof left);
    }
}

static void narrow(const uint16_t *code, size_t n, int bits, uint8_t *out)
{
    if (bits == 8)
        for (size_t i = 0; i < n; i++)
            out[i] = (uint8_t)code[i];
    else
        for (size_t i = 0; i < n; i++) {
            out[2 * i] = (uint8_t)(code[i] >> 8);
            out[2 * i + 1] = (uint8_t)code[i];
        }
}

/* All rows by one filter: traced pictures lose little by it. `above` and `row` take turns. */
static void write_rows(const Chunks *to, const Codes *c, Deflate *d, uint8_t *row, uint8_t *above, uint8_t *block, size_t block_rows,
                       uint8_t *packed)
{
    size_t samples = (size_t)c->width * (size_t)c->channels, n = samples * (size_t)c->bits / 8, pixel = (size_t)(c->channels * c->bits / 8);
    const uint16_t *code = c->code;
    size_t rows = (size_t)c->height;
    while (rows > 0) {
        size_t now = rows < block_rows ? rows : block_rows;
        uint8_t *out = block;
        for (size_t i = 0; i < now; i++, code += samples, out += 1 + n) {
            uint8_t *old = above;
            above = row;
            row = old;
            narrow(code, samples, c->bits, row);
            *out = PAETH;
            filter_paeth(row, above, pixel, n, out + 1);
        }
        rows -= now;
        write_chunk(to, "IDAT", packed, deflate_block(d, block, now * (1 + n), rows == 0, packed));
    }
}

static bool write_image(FILE *to, const Codes *c, char error[IMAGE_ERROR])
{
    size_t n = (size_t)c->width * (size_t)c->channels * (size_t)c->bits / 8, stride = MARGIN + n + MARGIN;
    size_t block_rows = 1 + BLOCK / (n + 1), block_bytes = block_rows * (n + 1);
    uint8_t *rows = calloc(2, stride), *block = malloc(block_bytes + MARGIN), *packed = malloc(deflate_most(block_bytes));
    Chunks chunks = { .to = to };
    Deflate d;
    bool ok = deflate_start(&d, block_bytes) && rows != NULL && block != NULL && packed != NULL;
    if (!ok) {
        codec_fail(error, "not enough memory");
    } else {
        checksum_table(chunks.table);
        write_header(&chunks, c);
        write_rows(&chunks, c, &d, rows + MARGIN, rows + stride + MARGIN, block, block_rows, packed);
        write_chunk(&chunks, "IEND", block, 0);
    }
    deflate_free(&d);
    free(rows);
    free(block);
    free(packed);
    return ok;
}

const ImageCodec codec_png = { IMAGE_PNG, probe, read_image, write_image };
