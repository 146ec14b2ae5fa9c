/* ppm.c - the portable pixmaps: P1 to P6 read, P5 (grey) and P6 written. */
#include <stdlib.h>

#include "image/codec.h"

static bool probe(Str bytes)
{
    return bytes.n >= 3 && bytes.data[0] == 'P' && bytes.data[1] >= '1' && bytes.data[1] <= '6';
}

static bool space(int c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* White space and comments, then a number; -1 if there is none or it is large. */
static long number(ByteReader *r)
{
    while (r->next < r->end && (space(*r->next) || *r->next == '#')) {
        if (*r->next == '#')
            while (r->next < r->end && *r->next != '\n')
                r->next++;
        else
            r->next++;
    }
    long n = -1;
    while (r->next < r->end && *r->next >= '0' && *r->next <= '9' && n < 1000000)
        n = (n < 0 ? 0 : n * 10) + (*r->next++ - '0');
    return n;
}

/* Bitmaps: 1 is black; '0' and '1' need no space between them. */
static long bit(ByteReader *r)
{
    while (r->next < r->end && space(*r->next))
        r->next++;
    int c = (int)read_u8(r);
    return c == '0' ? 1 : c == '1' ? 0 : -1;
}

static bool read_text(ByteReader *r, Image *im, bool bits, void *pixels, char error[IMAGE_ERROR])
{
    size_t n = (size_t)im->width * (size_t)im->height * (size_t)im->channels;
    for (size_t i = 0; i < n; i++) {
        long v = bits ? bit(r) : number(r);
        if (v < 0)
            return codec_fail(error, "number %zu of %zu is missing", i + 1, n);
        if (v > (long)im->max_value)
            return codec_fail(error, "a sample is larger than the file's maximum of %u", im->max_value);
        if (im->depth == IMAGE_U8)
            ((uint8_t *)pixels)[i] = (uint8_t)v;
        else
            ((uint16_t *)pixels)[i] = (uint16_t)v;
    }
    return true;
}

static void read_binary(ByteReader *r, const Image *im, void *pixels)
{
    size_t n = (size_t)im->width * (size_t)im->height * (size_t)im->channels;
    for (size_t i = 0; i < n; i++) {
        unsigned v = read_u8(r);
        if (im->depth == IMAGE_U8)
            ((uint8_t *)pixels)[i] = (uint8_t)v;
        else
            ((uint16_t *)pixels)[i] = (uint16_t)(v << 8 | read_u8(r));
    }
}

static void read_packed_bits(ByteReader *r, const Image *im, uint8_t *pixels)
{
    for (int y = 0; y < im->height; y++) {
        unsigned byte = 0;
        for (int x = 0; x < im->width; x++) {
            if (x % 8 == 0)
                byte = read_u8(r);
            *pixels++ = !(byte >> (7 - x % 8) & 1);
        }
    }
}

static bool read_image(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    if (!probe(bytes))
        return codec_fail(error, "this is no PPM or PGM file");
    ByteReader r = reader_of(bytes);
    read_skip(&r, 1);
    int kind = (int)read_u8(&r) - '0';
    bool bits = kind == 1 || kind == 4;
    long width = number(&r), height = number(&r), max = bits ? 1 : number(&r);
    if (!codec_size(width, height, bytes, kind == 4 ? 8 : 1, error))
        return false;
    if (max < 1 || max > 65535)
        return codec_fail(error, "the largest sample must be from 1 to 65535");
    im->width = (int)width;
    im->height = (int)height;
    im->channels = kind == 3 || kind == 6 ? 3 : 1;
    im->max_value = (uint32_t)max;
    im->depth = max > 255 ? IMAGE_U16 : IMAGE_U8;
    if (pixels == NULL)
        return true;
    if (kind <= 3)
        return read_text(&r, im, bits, pixels, error);
    read_skip(&r, 1);                          /* exactly one white space before the samples */
    if (kind == 4)
        read_packed_bits(&r, im, pixels);
    else
        read_binary(&r, im, pixels);
    return !r.ended || codec_fail(error, "the file ends before its last pixel");
}

static bool write_image(FILE *to, Codes *c, char error[IMAGE_ERROR])
{
    (void)error;                               /* the caller looks at ferror */
    fprintf(to, "P%d\n%d %d\n%d\n", c->channels == 1 ? 5 : 6, c->width, c->height, (1 << c->bits) - 1);
    for (int y = 0; y < c->height; y++) {
        const uint16_t *code = codes_next(c);
        for (int i = 0; i < c->width * c->channels; i++) {
            if (c->bits > 8)
                putc(code[i] >> 8, to);
            putc(code[i] & 255, to);
        }
    }
    return true;
}

const ImageCodec codec_ppm = { IMAGE_PPM, probe, read_image, write_image };
