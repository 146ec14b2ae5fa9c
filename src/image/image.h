/* image.h - pictures as samples: read from the bytes of a file, asked pixel by pixel, written whole or not at all.
 *
 * An Image keeps the file's own samples, one or two bytes each, and a table that turns a sample into a working-space
 * value: as small as the file's pixels, and exact. Images live in an arena. */
#ifndef IMAGE_IMAGE_H
#define IMAGE_IMAGE_H

#include <stdio.h>

#include "base/str.h"
#include "image/gamma.h"
#include "math/colour.h"

enum { IMAGE_ERROR = 256, IMAGE_MAX_SIDE = 65500 };

typedef enum ImageFormat {
    IMAGE_BY_CONTENT, IMAGE_PNG, IMAGE_JPEG, IMAGE_GIF, IMAGE_TIFF, IMAGE_TGA, IMAGE_PPM, IMAGE_PGM, IMAGE_BMP,
    IMAGE_HDR, IMAGE_IFF, IMAGE_POT, IMAGE_EXR
} ImageFormat;

typedef enum ImageDepth { IMAGE_U8, IMAGE_U16, IMAGE_FLOAT } ImageDepth;

typedef struct Image {
    int width, height;
    int channels;                              /* 1 grey or palette index, 2 grey and alpha, 3 rgb, 4 rgba */
    ImageDepth depth;
    ImageFormat format;
    uint32_t max_value;                        /* of a sample: 1..65535; not for floats */
    bool indexed;                              /* samples are numbers of palette entries (U8, one channel) */
    bool has_alpha;                            /* PNG and GIF palettes always count as having one */
    bool translucent;                          /* some pixel or entry has alpha below 1 */
    uint32_t n_palette;
    uint8_t palette[256][4];                   /* as stored: red, green, blue, alpha */
    Colour entry[256];                         /* the palette decoded: transmit = 1 - alpha, filter 0 */
    bool has_chunk;                            /* PNG: the file says how it is encoded ... */
    Transfer chunk;                            /* ... like this */
    const void *pixels;                        /* top row first; in the arena */
    const float *value;                        /* max_value + 1 decoded colour samples; NULL for palettes and floats */
} Image;

/* For what an image is read (07-textures, section 6.4). */
typedef struct ImageReading {
    bool colour;                               /* image_map: to the working space; else raw unless `gamma` was written */
    bool exact;                                /* samples as they stand in the file, for comparing pictures */
    bool has_gamma;
    Transfer gamma;                            /* `gamma g` or `gamma srgb` */
    bool has_assumed_gamma;
    Transfer working;                          /* assumed_gamma; 1.0 when a scene of 3.7 has none */
    int version;                               /* language version * 100 */
} ImageReading;

/* NULL: `error` says why, in a sentence without the file's name. BY_CONTENT looks at the first bytes. */
Image *image_read(Arena *a, Str bytes, ImageFormat format, const ImageReading *how, char error[IMAGE_ERROR]);

/* A grey (channels 1) or rgb + transmit (channels 4, alpha = 1 - transmit) image of 16-bit samples, as `function` images are. */
Image *image_of_samples(Arena *a, int width, int height, int channels, const uint16_t *samples);

/* By the end of a file's name; IMAGE_BY_CONTENT if it is none of ours. */
ImageFormat image_format_of(Str name);
const char *image_format_name(ImageFormat f);

Colour image_pixel(const Image *im, int x, int y);         /* row 0 on top; transmit = 1 - alpha, filter 0 */
int image_index(const Image *im, int x, int y);            /* palette index, else the red sample scaled to 0..255, truncated */

typedef struct ImageWriting {
    ImageFormat format;                        /* PNG, PPM (PGM when grey), TGA, BMP, JPEG */
    bool run_length;                           /* TGA: compressed */
    Quantising quantising;
    int quality;                               /* JPEG 1..100; 0: 85 */
} ImageWriting;

/* Writes premultiplied working-space colours. The file appears whole under its name or not at all: it is written beside,
 * synced, and renamed. "-" is standard output. False: `error` says why. */
bool image_write(const char *path, const float *rgba, int width, int height, const ImageWriting *how, char error[IMAGE_ERROR]);

#endif
