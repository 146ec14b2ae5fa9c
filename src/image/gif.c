/* gif.c - the first picture of a GIF: a palette and its own LZW decoder, so that no library is needed.
 *
 * POT files, the 16-bit potentials of Fractint, are GIFs twice as wide: upper bytes in the left half, lower ones in the right. */
#include <stdlib.h>
#include <string.h>

#include "image/codec.h"

enum { GIF_CODES = 4096 };

static bool probe(Str bytes)
{
    return bytes.n >= 13 && memcmp(bytes.data, "GIF8", 4) == 0;
}

static void read_palette(ByteReader *r, Image *im, unsigned flags)
{
    im->n_palette = 2u << (flags & 7);
    for (uint32_t i = 0; i < im->n_palette; i++) {
        for (int c = 0; c < 3; c++)
            im->palette[i][c] = (uint8_t)read_u8(r);
        im->palette[i][3] = 255;
    }
}

/* Skips sub-blocks up to the empty one. */
static void skip_blocks(ByteReader *r)
{
    for (unsigned n; (n = read_u8(r)) > 0 && !r->ended;)
        read_skip(r, n);
}

/* Codes of growing width from a chain of sub-blocks. */
typedef struct CodeReader {
    ByteReader *from;
    unsigned left_in_block, n_bits;
    uint32_t bits;
} CodeReader;

static int next_code(CodeReader *c, unsigned width)
{
    while (c->n_bits < width) {
        if (c->left_in_block == 0) {
            c->left_in_block = read_u8(c->from);
            if (c->left_in_block == 0)
                return -1;                     /* the terminator, or the end of the file */
        }
        c->left_in_block--;
        c->bits |= (uint32_t)read_u8(c->from) << c->n_bits;
        c->n_bits += 8;
        if (c->from->ended)
            return -1;
    }
    int code = (int)(c->bits & ((1u << width) - 1));
    c->bits >>= width;
    c->n_bits -= width;
    return code;
}

/* Rows of an interlaced picture come as every 8th from 0, every 8th from 4, every 4th from 2, every 2nd from 1. */
static int row_after(int y, int height, int *pass)
{
    static const int first[] = { 0, 4, 2, 1 }, step[] = { 8, 8, 4, 2 };
    if (*pass < 0)
        return y + 1;
    y += step[*pass];
    while (y >= height && *pass < 3)
        y = first[++*pass];
    return y;
}

typedef struct Canvas {
    uint8_t *pixels;
    int width, height, x, y, pass;             /* pass -1: not interlaced */
} Canvas;

static void canvas_put(Canvas *c, uint8_t index)
{
    if (c->y >= c->height)
        return;
    c->pixels[(size_t)c->y * (size_t)c->width + (size_t)c->x] = index;
    if (++c->x == c->width) {
        c->x = 0;
        c->y = row_after(c->y, c->height, &c->pass);
    }
}

/* Every code is an earlier code and one more byte; its string is unrolled backwards. */
static bool decode(ByteReader *r, Canvas *canvas, char error[IMAGE_ERROR])
{
    static const char damaged[] = "damaged GIF: the compressed data makes no sense";
    uint16_t before[GIF_CODES];
    uint8_t last[GIF_CODES], string[GIF_CODES + 1];
    unsigned root = read_u8(r);
    if (root < 1 || root > 8)
        return codec_fail(error, damaged);
    int clear = 1 << root, n = clear + 2, previous = -1;
    uint8_t first = 0;
    unsigned width = root + 1;
    CodeReader codes = { .from = r };
    while (canvas->y < canvas->height) {
        int code = next_code(&codes, width);
        if (code < 0 || code == clear + 1)
            return codec_fail(error, "the file ends before its last pixel");
        if (code == clear) {
            n = clear + 2;
            width = root + 1;
            previous = -1;
            continue;
        }
        if (code > n || (code == n && previous < 0))
            return codec_fail(error, damaged);
        int length = 0, c = code;
        if (code == n) {                       /* the one that is just being made */
            string[length++] = first;
            c = previous;
        }
        for (; c >= clear; c = before[c])
            string[length++] = last[c];
        string[length++] = first = (uint8_t)c;
        while (length > 0)
            canvas_put(canvas, string[--length]);
        if (previous >= 0 && n < GIF_CODES) {
            before[n] = (uint16_t)previous;
            last[n] = first;
            if (++n == 1 << width && width < 12)
                width++;
        }
        previous = code;
    }
    return true;
}

static bool read_image(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    if (!probe(bytes))
        return codec_fail(error, "this is no GIF file");
    ByteReader r = reader_of(bytes);
    read_skip(&r, 10);
    unsigned flags = read_u8(&r);
    read_skip(&r, 2);
    if (flags & 128)
        read_palette(&r, im, flags);
    int transparent = -1;
    unsigned block;
    while ((block = read_u8(&r)) == '!') {     /* extensions; 0xf9 names the transparent entry */
        unsigned label = read_u8(&r);
        if (label == 0xf9 && r.end - r.next > 5 && r.next[0] == 4 && (r.next[1] & 1))
            transparent = r.next[4];
        skip_blocks(&r);
    }
    read_skip(&r, 4);
    long width = (long)read_le16(&r), height = (long)read_le16(&r);
    flags = read_u8(&r);
    if (block != ',' || r.ended)
        return codec_fail(error, "there is no picture in this GIF file");
    if (!codec_size(width, height, bytes, GIF_CODES, error))
        return false;
    if (flags & 128)
        read_palette(&r, im, flags);
    if (im->n_palette == 0)
        return codec_fail(error, "this GIF file has no palette");
    if (transparent >= 0 && (uint32_t)transparent < im->n_palette)
        im->palette[transparent][3] = 0;
    im->width = (int)width;
    im->height = (int)height;
    im->channels = 1;
    im->max_value = 255;
    im->indexed = im->has_alpha = true;        /* POV: also without a transparent entry */
    if (pixels == NULL)
        return true;
    Canvas canvas = { .pixels = pixels, .width = im->width, .height = im->height, .pass = flags & 64 ? 0 : -1 };
    return decode(&r, &canvas, error);
}

/* Both halves of a row become one row of 16-bit numbers, of the same size. */
static bool join_halves(const Image *im, void *pixels)
{
    size_t width = (size_t)im->width;
    uint8_t *row = malloc(2 * width);
    if (row == NULL)
        return false;
    for (int y = 0; y < im->height; y++) {
        uint8_t *from = (uint8_t *)pixels + (size_t)y * 2 * width;
        memcpy(row, from, 2 * width);
        for (size_t x = 0; x < width; x++) {
            uint16_t v = (uint16_t)(row[x] << 8 | row[width + x]);
            memcpy(from + 2 * x, &v, 2);
        }
    }
    free(row);
    return true;
}

static bool read_pot(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    Image gif = { 0 };
    if (!read_image(bytes, &gif, pixels, error))
        return false;
    if (gif.width % 2 != 0)
        return codec_fail(error, "a POT file has an even number of columns, this one has %d", gif.width);
    im->width = gif.width / 2;
    im->height = gif.height;
    im->channels = 1;
    im->depth = IMAGE_U16;
    im->max_value = 65535;
    return pixels == NULL || join_halves(im, pixels) || codec_fail(error, "not enough memory");
}

static bool never(Str bytes)
{
    (void)bytes;                               /* by name only: its bytes are a GIF's */
    return false;
}

const ImageCodec codec_pot = { IMAGE_POT, never, read_pot, NULL };
const ImageCodec codec_gif = { IMAGE_GIF, probe, read_image, NULL };
