/* codec.h - the form of a file format: one row per format in image.c, one file per format. */
#ifndef IMAGE_CODEC_H
#define IMAGE_CODEC_H

#include "image/image.h"

/* What a writer is given: codes ready for the file, 8 or 16 bits wide each. */
typedef struct Codes {
    int width, height, channels;               /* 1 grey, 2 grey and alpha, 3 rgb, 4 rgba */
    int bits;                                  /* of the codes: 8 or 16 (PPM: 5..16) */
    const ImageWriting *how;
    const float *rgba;                         /* where the next row comes from; codes_next() alone asks */
    Quantiser *quantiser;
    uint16_t *row;
} Codes;

/* width * channels codes of the next row, the top one first. They stay until the next call. */
const uint16_t *codes_next(Codes *c);

typedef struct ImageCodec {
    ImageFormat format;
    bool (*probe)(Str bytes);                  /* do the first bytes look like this format? */
    /* Called twice: with pixels NULL to fill in width, height, channels, depth, max_value, indexed, the palette, has_alpha; then with room
     * for width * height * channels samples of `depth`. Frees what it took either way. False: `error` says why. */
    bool (*read)(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR]);
    bool (*write)(FILE *to, Codes *codes, char error[IMAGE_ERROR]);      /* NULL: read only */
} ImageCodec;

extern const ImageCodec codec_png, codec_jpeg, codec_gif, codec_pot, codec_tiff, codec_tga, codec_ppm, codec_bmp, codec_hdr;

/* Always false, to be returned. */
bool codec_fail(char error[IMAGE_ERROR], const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Checks what a header says before anything is allocated: sides of 1 to IMAGE_MAX_SIDE, and no more pixels than `per_byte` for each byte of the
 * file - the most its compression can do. */
bool codec_size(long width, long height, Str bytes, long per_byte, char error[IMAGE_ERROR]);

/* Bytes read in order; past the end they are 0 and `ended` is set. */
typedef struct ByteReader {
    const unsigned char *next, *end;
    bool ended;
} ByteReader;

static inline ByteReader reader_of(Str bytes)
{
    const unsigned char *data = (const unsigned char *)bytes.data;
    return (ByteReader){ data, data + bytes.n, false };
}

static inline unsigned read_u8(ByteReader *r)
{
    if (r->next == r->end) {
        r->ended = true;
        return 0;
    }
    return *r->next++;
}

static inline unsigned read_le16(ByteReader *r)
{
    unsigned low = read_u8(r);
    return low | read_u8(r) << 8;
}

static inline uint32_t read_le32(ByteReader *r)
{
    uint32_t low = read_le16(r);
    return low | (uint32_t)read_le16(r) << 16;
}

static inline void read_skip(ByteReader *r, size_t n)
{
    size_t left = (size_t)(r->end - r->next);
    r->ended |= n > left;
    r->next += n < left ? n : left;
}

#endif
