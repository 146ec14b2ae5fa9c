/* hdr.c - Radiance pictures: red, green, blue and a shared exponent, rows run-length coded by component. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/codec.h"

static bool probe(Str bytes)
{
    return bytes.n > 10 && (memcmp(bytes.data, "#?RADIANCE", 10) == 0 || memcmp(bytes.data, "#?RGBE", 6) == 0);
}

/* One line of the header, without its end; false at the end of the file. */
static bool line(ByteReader *r, char *out, size_t room)
{
    size_t n = 0;
    while (r->next < r->end && *r->next != '\n') {
        if (n + 1 < room)
            out[n++] = (char)*r->next;
        r->next++;
    }
    out[n] = 0;
    read_skip(r, 1);
    return !r->ended;
}

/* New coding: four components one after the other, in packets of runs (over 128) and literals. */
static void read_row(ByteReader *r, int width, uint8_t *row)
{
    for (int c = 0; c < 4; c++)
        for (int x = 0; x < width && !r->ended;) {
            unsigned n = read_u8(r), run = n > 128;
            unsigned value = run ? read_u8(r) : 0;
            for (n = run ? n - 128 : n; n > 0 && x < width; n--, x++)
                row[4 * x + c] = (uint8_t)(run ? value : read_u8(r));
        }
}

/* Old coding: whole pixels, (1,1,1,n) repeats the one before; several of them in a row shift n by 8 bits each. */
static void read_old_row(ByteReader *r, int width, uint8_t *row)
{
    int shift = 0;
    for (int x = 0; x < width && !r->ended;) {
        uint8_t p[4];
        for (int c = 0; c < 4; c++)
            p[c] = (uint8_t)read_u8(r);
        if (p[0] == 1 && p[1] == 1 && p[2] == 1 && x > 0) {
            for (long n = (long)p[3] << shift; n > 0 && x < width; n--, x++)
                memcpy(row + 4 * x, row + 4 * (x - 1), 4);
            shift = shift < 16 ? shift + 8 : shift;
        } else {
            memcpy(row + 4 * x++, p, 4);
            shift = 0;
        }
    }
}

static void to_floats(const uint8_t *row, int width, float *out)
{
    for (int x = 0; x < width; x++, row += 4)
        for (int c = 0; c < 3; c++)
            *out++ = row[3] == 0 ? 0 : (float)ldexp(row[c] + 0.5, row[3] - 136);
}

static bool read_image(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    if (!probe(bytes))
        return codec_fail(error, "this is no Radiance HDR file");
    ByteReader r = reader_of(bytes);
    char text[128];
    while (line(&r, text, sizeof text) && text[0] != 0)
        ;
    line(&r, text, sizeof text);
    int width, height;
    if (r.ended || sscanf(text, "-Y %9d +X %9d", &height, &width) != 2)
        return codec_fail(error, "the size of this HDR file cannot be read, or its rows do not run from the top");
    if (!codec_size(width, height, bytes, 1 << 14, error))
        return false;
    im->width = width;
    im->height = height;
    im->channels = 3;
    im->depth = IMAGE_FLOAT;
    if (pixels == NULL)
        return true;
    uint8_t *row = malloc(4 * (size_t)width);
    if (row == NULL)
        return codec_fail(error, "not enough memory");
    for (int y = 0; y < height && !r.ended; y++) {
        bool coded = r.end - r.next >= 4 && r.next[0] == 2 && r.next[1] == 2 && (r.next[2] << 8 | r.next[3]) == width;
        if (coded) {
            read_skip(&r, 4);
            read_row(&r, width, row);
        } else {
            read_old_row(&r, width, row);
        }
        if (!r.ended)
            to_floats(row, width, (float *)pixels + (size_t)y * (size_t)width * 3);
    }
    free(row);
    return !r.ended || codec_fail(error, "the file ends before its last pixel");
}

const ImageCodec codec_hdr = { IMAGE_HDR, probe, read_image, NULL };
