/* tga.c - Targa: true colour, grey and palettes, plain or run-length coded. */
#include <string.h>

#include "image/codec.h"

typedef struct Header {
    unsigned id_length, map_type, type, map_first, map_length, map_bits, width, height, bits, descriptor;
} Header;

static Header header_of(ByteReader *r)
{
    Header h;
    h.id_length = read_u8(r);
    h.map_type = read_u8(r);
    h.type = read_u8(r);
    h.map_first = read_le16(r);
    h.map_length = read_le16(r);
    h.map_bits = read_u8(r);
    read_skip(r, 4);                           /* origin */
    h.width = read_le16(r);
    h.height = read_le16(r);
    h.bits = read_u8(r);
    h.descriptor = read_u8(r);
    return h;
}

static bool known_type(unsigned type)
{
    return (type >= 1 && type <= 3) || (type >= 9 && type <= 11);
}

/* Without a mark of its own, TGA is recognised by a header that makes sense. */
static bool probe(Str bytes)
{
    ByteReader r = reader_of(bytes);
    Header h = header_of(&r);
    return !r.ended && h.map_type <= 1 && known_type(h.type) && h.width > 0 && h.height > 0
           && (h.bits == 8 || h.bits == 15 || h.bits == 16 || h.bits == 24 || h.bits == 32);
}

/* One pixel or palette entry as red, green, blue, alpha. */
static void read_colour(ByteReader *r, unsigned bits, uint8_t out[4])
{
    if (bits == 15 || bits == 16) {
        unsigned v = read_le16(r);
        uint8_t c[4] = { (uint8_t)((v >> 10 & 31) * 8), (uint8_t)((v >> 5 & 31) * 8), (uint8_t)((v & 31) * 8),
                         bits == 16 && !(v >> 15) ? 0 : 255 };
        memcpy(out, c, 4);
        return;
    }
    out[2] = (uint8_t)read_u8(r);
    out[1] = (uint8_t)read_u8(r);
    out[0] = (uint8_t)read_u8(r);
    out[3] = bits == 32 ? (uint8_t)read_u8(r) : 255;
}

static bool read_map(ByteReader *r, const Header *h, Image *im, char error[IMAGE_ERROR])
{
    if (h->map_type != 1 || h->bits != 8)
        return codec_fail(error, "TGA palettes are read with 8 bits per pixel only");
    if (h->map_first + h->map_length > 256 || h->map_length == 0)
        return codec_fail(error, "the TGA palette has %u entries; the limit is 256", h->map_first + h->map_length);
    im->indexed = true;
    im->n_palette = h->map_first + h->map_length;
    for (unsigned i = h->map_first; i < im->n_palette; i++)
        read_colour(r, h->map_bits, im->palette[i]);
    for (unsigned i = 0; i < h->map_first; i++)
        im->palette[i][3] = 255;
    im->has_alpha = h->map_bits == 32;
    return true;
}

static void put_pixel(const Image *im, const Header *h, size_t i, const uint8_t value[4], uint8_t *pixels)
{
    size_t x = i % h->width, y = i / h->width;
    if (h->descriptor & 16)
        x = h->width - 1 - x;
    if (!(h->descriptor & 32))
        y = h->height - 1 - y;
    memcpy(pixels + (y * h->width + x) * (size_t)im->channels, value, (size_t)im->channels);
}

static void read_value(ByteReader *r, const Image *im, const Header *h, uint8_t value[4])
{
    if (im->channels == 1)
        value[0] = (uint8_t)read_u8(r);
    else
        read_colour(r, h->bits, value);
}

static void read_pixels(ByteReader *r, const Image *im, const Header *h, uint8_t *pixels)
{
    size_t n = (size_t)h->width * h->height;
    bool packed = h->type >= 9;
    uint8_t value[4];
    for (size_t i = 0; i < n && !r->ended;) {
        unsigned head = packed ? read_u8(r) : 0;
        size_t run = packed ? (head & 127) + 1 : 1;
        for (size_t k = 0; k < run && i < n; k++, i++) {
            if (k == 0 || !(head & 128))
                read_value(r, im, h, value);
            put_pixel(im, h, i, value, pixels);
        }
    }
}

static bool read_image(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    ByteReader r = reader_of(bytes);
    Header h = header_of(&r);
    if (r.ended || !known_type(h.type))
        return codec_fail(error, "this is no TGA file of a kind that can be read");
    bool grey = h.type == 3 || h.type == 11, map = h.type == 1 || h.type == 9;
    if (grey ? h.bits != 8 : !map && h.bits != 15 && h.bits != 16 && h.bits != 24 && h.bits != 32)
        return codec_fail(error, "TGA files with %u bits per pixel are not read", h.bits);
    if (!codec_size((long)h.width, (long)h.height, bytes, 128, error))
        return false;
    im->width = (int)h.width;
    im->height = (int)h.height;
    im->max_value = 255;
    im->has_alpha = !grey && !map && (h.bits == 32 || h.bits == 16);
    im->channels = grey || map ? 1 : im->has_alpha ? 4 : 3;
    read_skip(&r, h.id_length);
    if (map ? !read_map(&r, &h, im, error) : false)
        return false;
    if (!map && h.map_type == 1)
        read_skip(&r, (size_t)h.map_length * ((h.map_bits + 7) / 8));
    if (pixels != NULL)
        read_pixels(&r, im, &h, pixels);
    return !r.ended || codec_fail(error, "the file ends before its last pixel");
}

/* ---- writing ---- */

static void write_pixel(FILE *to, const uint16_t *c, int channels)
{
    putc(c[2], to);
    putc(c[1], to);
    putc(c[0], to);
    if (channels == 4)
        putc(c[3], to);
}

static bool same(const uint16_t *a, const uint16_t *b, int channels)
{
    return memcmp(a, b, (size_t)channels * sizeof *a) == 0;
}

/* Runs and literal packets of up to 128 pixels, within one row. */
static void write_packed_row(FILE *to, const uint16_t *row, int width, int n)
{
    for (int x = 0; x < width;) {
        int run = 1;
        while (run < 128 && x + run < width && same(row + x * n, row + (x + run) * n, n))
            run++;
        if (run > 1) {
            putc(128 | (run - 1), to);
            write_pixel(to, row + x * n, n);
        } else {
            while (run < 128 && x + run < width
                   && (x + run + 1 == width || !same(row + (x + run) * n, row + (x + run + 1) * n, n)))
                run++;
            putc(run - 1, to);
            for (int i = 0; i < run; i++)
                write_pixel(to, row + (x + i) * n, n);
        }
        x += run;
    }
}

static bool write_image(FILE *to, Codes *c, char error[IMAGE_ERROR])
{
    if (c->width > 65535 || c->height > 65535)
        return codec_fail(error, "TGA files have at most 65535 pixels a side");
    bool packed = c->how->run_length;
    unsigned char head[18] = { [2] = packed ? 10 : 2, [12] = (unsigned char)c->width, [13] = (unsigned char)(c->width >> 8),
                               [14] = (unsigned char)c->height, [15] = (unsigned char)(c->height >> 8),
                               [16] = (unsigned char)(8 * c->channels), [17] = c->channels == 4 ? 0x28 : 0x20 };
    fwrite(head, 1, sizeof head, to);
    for (int y = 0; y < c->height; y++) {
        const uint16_t *row = codes_next(c);
        if (packed)
            write_packed_row(to, row, c->width, c->channels);
        else
            for (int x = 0; x < c->width; x++)
                write_pixel(to, row + x * c->channels, c->channels);
    }
    return true;
}

const ImageCodec codec_tga = { IMAGE_TGA, probe, read_image, write_image };
