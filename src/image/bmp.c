/* bmp.c - Windows bitmaps: 1, 4, 8 (also run-length coded), 24 and 32 bits read, 24 and 32 written. */
#include <stdlib.h>
#include <string.h>

#include "image/codec.h"

typedef struct Header {
    uint32_t data_at, header_size, bits, compression, n_colours;
    int32_t width, height;                     /* height as a number of rows */
    bool top_down;
} Header;

enum { BMP_PLAIN, BMP_RLE8, BMP_RLE4, BMP_FIELDS };

static bool probe(Str bytes)
{
    return bytes.n >= 26 && memcmp(bytes.data, "BM", 2) == 0;
}

static bool read_header(ByteReader *r, Header *h, char error[IMAGE_ERROR])
{
    read_skip(r, 10);
    h->data_at = read_le32(r);
    h->header_size = read_le32(r);
    if (h->header_size == 12) {                /* OS/2 */
        h->width = (int32_t)read_le16(r);
        h->height = (int32_t)read_le16(r);
        read_skip(r, 2);
        h->bits = read_le16(r);
        return !r->ended || codec_fail(error, "the file ends in its header");
    }
    if (h->header_size < 40)
        return codec_fail(error, "a BMP header of %u bytes is not known", h->header_size);
    h->width = (int32_t)read_le32(r);
    int32_t height = (int32_t)read_le32(r);
    h->top_down = height < 0;
    h->height = height == INT32_MIN ? 0 : h->top_down ? -height : height;
    read_skip(r, 2);
    h->bits = read_le16(r);
    h->compression = read_le32(r);
    read_skip(r, 12);
    h->n_colours = read_le32(r);
    read_skip(r, 4);
    read_skip(r, h->header_size - 40);
    return !r->ended || codec_fail(error, "the file ends in its header");
}

static bool read_palette(ByteReader *r, const Header *h, Image *im, char error[IMAGE_ERROR])
{
    uint32_t n = h->n_colours != 0 ? h->n_colours : 1u << h->bits;
    if (n > 256)
        return codec_fail(error, "the BMP palette has %u entries; the limit is 256", n);
    im->indexed = true;
    im->n_palette = n;
    for (uint32_t i = 0; i < n; i++) {
        for (int c = 2; c >= 0; c--)
            im->palette[i][c] = (uint8_t)read_u8(r);
        im->palette[i][3] = 255;
        if (h->header_size != 12)
            read_skip(r, 1);
    }
    return !r->ended || codec_fail(error, "the file ends in its palette");
}

static uint8_t *row_of(const Image *im, const Header *h, void *pixels, int y)
{
    int row = h->top_down ? y : im->height - 1 - y;
    return (uint8_t *)pixels + (size_t)row * (size_t)im->width * (size_t)im->channels;
}

static void read_plain(ByteReader *r, const Header *h, const Image *im, void *pixels)
{
    size_t row_bytes = ((size_t)im->width * h->bits + 31) / 32 * 4;
    for (int y = 0; y < im->height && !r->ended; y++) {
        ByteReader row = *r;
        uint8_t *out = row_of(im, h, pixels, y);
        unsigned byte = 0;
        for (int x = 0; x < im->width; x++) {
            if (h->bits >= 24) {
                for (int c = 2; c >= 0; c--)
                    out[c] = (uint8_t)read_u8(&row);
                if (h->bits == 32)
                    out[3] = (uint8_t)read_u8(&row);
                out += im->channels;
                continue;
            }
            int per_byte = 8 / (int)h->bits;
            if (x % per_byte == 0)
                byte = read_u8(&row);
            *out++ = (uint8_t)(byte >> (8 - (int)h->bits * (x % per_byte + 1)) & ((1u << h->bits) - 1));
        }
        r->ended |= row.ended;
        read_skip(r, y + 1 < im->height ? row_bytes : 0);
    }
}

/* Pairs of count and value; a count of 0 escapes: end of line, end of picture, a step, or literal values. */
static void read_packed(ByteReader *r, const Header *h, const Image *im, void *pixels)
{
    int x = 0, y = 0;
    bool nibbles = h->compression == BMP_RLE4;
    while (y < im->height && !r->ended) {
        unsigned count = read_u8(r), value = read_u8(r);
        uint8_t *out = row_of(im, h, pixels, y);
        if (count > 0) {
            for (unsigned i = 0; i < count && x < im->width; i++)
                out[x++] = (uint8_t)(!nibbles ? value : i % 2 == 0 ? value >> 4 : value & 15);
        } else if (value == 0) {
            x = 0;
            y++;
        } else if (value == 1) {
            return;
        } else if (value == 2) {
            x += (int)read_u8(r);
            y += (int)read_u8(r);
        } else {
            unsigned byte = 0;
            for (unsigned i = 0; i < value; i++) {
                if (!nibbles || i % 2 == 0)
                    byte = read_u8(r);
                unsigned v = !nibbles ? byte : i % 2 == 0 ? byte >> 4 : byte & 15;
                if (x < im->width)
                    out[x++] = (uint8_t)v;
            }
            if ((nibbles ? (value + 1) / 2 : value) % 2 == 1)
                read_skip(r, 1);
        }
    }
}

static bool read_image(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    if (!probe(bytes))
        return codec_fail(error, "this is no BMP file");
    Header h = { 0 };
    ByteReader r = reader_of(bytes);
    if (!read_header(&r, &h, error))
        return false;
    bool packed = (h.compression == BMP_RLE8 && h.bits == 8) || (h.compression == BMP_RLE4 && h.bits == 4);
    bool plain = h.compression == BMP_PLAIN || (h.compression == BMP_FIELDS && h.bits == 32);
    if (!(packed || plain) || !(h.bits == 1 || h.bits == 4 || h.bits == 8 || h.bits == 24 || h.bits == 32))
        return codec_fail(error, "BMP files with %u bits and compression %u are not read", h.bits, h.compression);
    if (!codec_size(h.width, h.height, bytes, packed ? 1 << 14 : 8, error))
        return false;
    im->width = h.width;
    im->height = h.height;
    im->max_value = 255;
    im->channels = h.bits <= 8 ? 1 : h.bits == 32 ? 4 : 3;
    im->has_alpha = h.bits == 32;
    if (h.bits <= 8 && !read_palette(&r, &h, im, error))
        return false;
    if (pixels == NULL)
        return true;
    r = reader_of(bytes);
    read_skip(&r, h.data_at);
    if (packed)
        read_packed(&r, &h, im, pixels);
    else
        read_plain(&r, &h, im, pixels);
    return !r.ended || codec_fail(error, "the file ends before its last pixel");
}

/* ---- writing ---- */

static void put32(FILE *to, uint32_t v)
{
    for (int i = 0; i < 4; i++)
        putc((int)(v >> (8 * i) & 255), to);
}

/* The bottom row comes first in the file, and the top one as codes. */
static bool write_image(FILE *to, Codes *c, char error[IMAGE_ERROR])
{
    uint32_t row = ((uint32_t)(c->width * c->channels) + 3) & ~3u, data = row * (uint32_t)c->height;
    unsigned char *const rows = calloc((size_t)c->height, row);
    if (rows == NULL)
        return codec_fail(error, "not enough memory for the picture");
    for (int y = c->height - 1; y >= 0; y--) {
        const uint16_t *p = codes_next(c);
        unsigned char *out = rows + (size_t)y * row;
        for (int x = 0; x < c->width; x++, p += c->channels) {
            *out++ = (unsigned char)p[2];
            *out++ = (unsigned char)p[1];
            *out++ = (unsigned char)p[0];
            if (c->channels == 4)
                *out++ = (unsigned char)p[3];
        }
    }
    fwrite("BM", 1, 2, to);
    put32(to, 54 + data);
    put32(to, 0);
    put32(to, 54);
    put32(to, 40);
    put32(to, (uint32_t)c->width);
    put32(to, (uint32_t)c->height);
    put32(to, 1u | (uint32_t)(8 * c->channels) << 16);
    for (int i = 0; i < 6; i++)
        put32(to, i == 1 ? data : 0);
    fwrite(rows, row, (size_t)c->height, to);
    free(rows);
    return true;
}

const ImageCodec codec_bmp = { IMAGE_BMP, probe, read_image, write_image };
