/* image.c - reading through the codecs, decoding samples to values, and writing whole files. */
#include "image/image.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "image/codec.h"

/* TGA has no mark of its own, so it is asked last. */
static const ImageCodec *const codecs[] = {
    &codec_png, &codec_jpeg, &codec_gif, &codec_pot, &codec_tiff, &codec_bmp, &codec_ppm, &codec_hdr, &codec_tga
};

bool codec_fail(char error[IMAGE_ERROR], const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(error, IMAGE_ERROR, format, args);
    va_end(args);
    return false;
}

bool codec_size(long width, long height, Str bytes, long per_byte, char error[IMAGE_ERROR])
{
    if (width < 1 || height < 1)
        return codec_fail(error, "the image says it is %ld x %ld pixels", width, height);
    if (width > IMAGE_MAX_SIDE || height > IMAGE_MAX_SIDE)
        return codec_fail(error, "the image says it is %ld x %ld pixels; the limit is %d a side", width, height, IMAGE_MAX_SIDE);
    if ((double)width * (double)height > (double)per_byte * ((double)bytes.n + 1024))
        return codec_fail(error, "the file is much too short for the %ld x %ld pixels it promises", width, height);
    return true;
}

static const ImageCodec *codec_of(ImageFormat f)
{
    if (f == IMAGE_PGM)
        f = IMAGE_PPM;
    for (size_t i = 0; i < sizeof codecs / sizeof *codecs; i++)
        if (codecs[i]->format == f)
            return codecs[i];
    return NULL;
}

static const ImageCodec *codec_by_content(Str bytes)
{
    for (size_t i = 0; i < sizeof codecs / sizeof *codecs; i++)
        if (codecs[i]->probe(bytes))
            return codecs[i];
    return NULL;
}

static const struct { const char *ending; ImageFormat format; } endings[] = {
    { ".png", IMAGE_PNG }, { ".jpg", IMAGE_JPEG }, { ".jpeg", IMAGE_JPEG }, { ".gif", IMAGE_GIF }, { ".tif", IMAGE_TIFF },
    { ".tiff", IMAGE_TIFF }, { ".tga", IMAGE_TGA }, { ".ppm", IMAGE_PPM }, { ".pgm", IMAGE_PGM }, { ".bmp", IMAGE_BMP },
    { ".hdr", IMAGE_HDR }, { ".iff", IMAGE_IFF }, { ".pot", IMAGE_POT }, { ".exr", IMAGE_EXR }
};

ImageFormat image_format_of(Str name)
{
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        uint32_t n = (uint32_t)strlen(endings[i].ending);
        if (name.n >= n && str_equal_nocase((Str){ name.data + name.n - n, n }, str_of(endings[i].ending)))
            return endings[i].format;
    }
    return IMAGE_BY_CONTENT;
}

const char *image_format_name(ImageFormat f)
{
    static const char *const names[] = { "unknown", "PNG", "JPEG", "GIF", "TIFF", "TGA", "PPM", "PGM", "BMP", "HDR", "IFF", "POT", "EXR" };
    return names[f];
}

/* ---- from samples to values ---- */

/* The curve that turns stored samples linear; *converts: something is to be done at all (07, section 6.4). */
static Transfer decoding_of(const Image *im, const ImageReading *how, bool *converts)
{
    const Transfer none = { TRANSFER_NONE, 1 }, srgb = { TRANSFER_SRGB, 0 };
    *converts = true;
    if (how->exact || im->format == IMAGE_IFF || im->format == IMAGE_POT) {
        *converts = false;
        return none;
    }
    if (how->has_gamma)
        return how->gamma;
    if (!how->colour) {
        *converts = false;
        return none;
    }
    if (how->version < 370 && im->format != IMAGE_HDR) {
        *converts = how->has_assumed_gamma && im->has_chunk;
        return *converts ? im->chunk : none;
    }
    switch (im->format) {
    case IMAGE_PPM: case IMAGE_PGM: case IMAGE_TIFF:
        *converts = false;
        return none;
    case IMAGE_HDR:
        return (Transfer){ TRANSFER_POWER, 1 };
    case IMAGE_PNG:
        return im->has_chunk ? im->chunk : srgb;
    default:
        return srgb;
    }
}

typedef struct Decoding {
    Transfer file, working;
    bool converts, requantises;
} Decoding;

static float decode(const Decoding *d, double x)
{
    if (!d->converts)
        return (float)x;
    return (float)transfer_convert(d->file, d->working, x);
}

/* POV: grey PNGs of up to 8 bits go through 8 bits once more after decoding, by a grey sum in single precision that falls just
 * short of many whole numbers. */
static float requantised(float y)
{
    float sum = 0.297f * y;
    sum += 0.589f * y;
    sum += 0.114f * y;
    return (float)((int)(255.0f * sum) / 255.0);
}

static void decode_palette(Image *im, const Decoding *d)
{
    for (uint32_t i = 0; i < im->n_palette; i++) {
        const uint8_t *c = im->palette[i];
        im->entry[i] = (Colour){ decode(d, c[0] / 255.0), decode(d, c[1] / 255.0), decode(d, c[2] / 255.0), 0,
                                 (float)(1 - c[3] / 255.0) };
        im->translucent |= c[3] < 255;
    }
}

static void decode_table(Arena *a, Image *im, const Decoding *d)
{
    float *value = arena_array(a, float, (size_t)im->max_value + 1);
    for (uint32_t i = 0; i <= im->max_value; i++) {
        value[i] = decode(d, (double)(float)((double)i / im->max_value));
        if (d->requantises)
            value[i] = requantised(value[i]);
    }
    im->value = value;
}

static void decode_floats(Image *im, float *samples, const Decoding *d)
{
    size_t n = (size_t)im->width * (size_t)im->height * (size_t)im->channels;
    for (size_t i = 0; i < n; i++)
        samples[i] = decode(d, (double)samples[i]);
}

static size_t sample_size(ImageDepth depth)
{
    return depth == IMAGE_U8 ? 1 : depth == IMAGE_U16 ? 2 : 4;
}

/* Sets `translucent`, and checks that no sample is beyond the tables. */
static bool check_samples(Image *im, char error[IMAGE_ERROR])
{
    size_t n = (size_t)im->width * (size_t)im->height, channels = (size_t)im->channels;
    const uint8_t *u8 = im->pixels;
    const uint16_t *u16 = im->pixels;
    if (im->indexed) {
        for (size_t i = 0; i < n; i++)
            if (u8[i] >= im->n_palette)
                return codec_fail(error, "a pixel has number %d of a palette with %u entries", u8[i], im->n_palette);
        return true;
    }
    if (im->depth == IMAGE_FLOAT)
        return true;
    uint32_t full = im->depth == IMAGE_U8 ? 255 : 65535;
    if (im->max_value < full)
        for (size_t i = 0; i < n * channels; i++)
            if ((im->depth == IMAGE_U8 ? u8[i] : u16[i]) > im->max_value)
                return codec_fail(error, "a sample is larger than the file's maximum of %u", im->max_value);
    if (im->has_alpha && channels % 2 == 0)
        for (size_t i = channels - 1; i < n * channels && !im->translucent; i += channels)
            im->translucent = (im->depth == IMAGE_U8 ? u8[i] : u16[i]) < im->max_value;
    return true;
}

static const ImageCodec *choose_codec(Str bytes, ImageFormat format, char error[IMAGE_ERROR])
{
    const ImageCodec *c = format == IMAGE_BY_CONTENT ? codec_by_content(bytes) : codec_of(format);
    if (c == NULL && format == IMAGE_BY_CONTENT)
        codec_fail(error, "this is no image of a kind that can be read");
    else if (c == NULL)
        codec_fail(error, "%s images cannot be read; convert it to PNG", image_format_name(format));
    return c;
}

Image *image_read(Arena *a, Str bytes, ImageFormat format, const ImageReading *how, char error[IMAGE_ERROR])
{
    const ImageCodec *codec = choose_codec(bytes, format, error);
    if (codec == NULL)
        return NULL;
    Image *im = arena_new(a, Image);
    im->format = codec->format;
    if (!codec->read(bytes, im, NULL, error))
        return NULL;
    size_t n = (size_t)im->width * (size_t)im->height * (size_t)im->channels;
    void *pixels = arena_alloc_array(a, n, sample_size(im->depth));
    if (!codec->read(bytes, im, pixels, error))
        return NULL;
    im->pixels = pixels;
    if (!check_samples(im, error))
        return NULL;

    Decoding d = { .working = how->colour ? how->working : (Transfer){ TRANSFER_NONE, 1 } };
    d.file = decoding_of(im, how, &d.converts);
    d.requantises = im->format == IMAGE_PNG && !how->exact && im->channels == 1 && im->depth == IMAGE_U8;
    if (im->indexed)
        decode_palette(im, &d);
    else if (im->depth == IMAGE_FLOAT)
        decode_floats(im, pixels, &d);
    else
        decode_table(a, im, &d);
    return im;
}

Image *image_of_samples(Arena *a, int width, int height, int channels, const uint16_t *samples)
{
    Image *im = arena_new(a, Image);
    size_t n = (size_t)width * (size_t)height * (size_t)channels;
    *im = (Image){ .width = width, .height = height, .channels = channels, .depth = IMAGE_U16, .max_value = 65535,
                   .has_alpha = channels == 4, .pixels = arena_copy(a, samples, n * sizeof *samples) };
    for (size_t i = 3; im->has_alpha && i < n; i += 4)
        im->translucent |= samples[i] < 65535;
    decode_table(a, im, &(Decoding){ 0 });
    return im;
}

Colour image_pixel(const Image *im, int x, int y)
{
    size_t at = ((size_t)y * (size_t)im->width + (size_t)x) * (size_t)im->channels;
    if (im->depth == IMAGE_FLOAT) {
        const float *s = (const float *)im->pixels + at;
        return (Colour){ s[0], s[1], s[2], 0, 0 };
    }
    uint32_t s[4];
    for (int i = 0; i < im->channels; i++)
        s[i] = im->depth == IMAGE_U8 ? ((const uint8_t *)im->pixels)[at + (size_t)i] : ((const uint16_t *)im->pixels)[at + (size_t)i];
    if (im->indexed)
        return im->entry[s[0]];
    const float *value = im->value;
    float transmit = im->has_alpha ? 1 - (float)s[im->channels - 1] / (float)im->max_value : 0;
    if (im->channels < 3)
        return (Colour){ value[s[0]], value[s[0]], value[s[0]], 0, transmit };
    return (Colour){ value[s[0]], value[s[1]], value[s[2]], 0, transmit };
}

int image_index(const Image *im, int x, int y)
{
    if (im->indexed)
        return ((const uint8_t *)im->pixels)[(size_t)y * (size_t)im->width + (size_t)x];
    double red = 255 * (double)image_pixel(im, x, y).r;
    return red > 0 ? (int)fmin(red, 65535) : 0;
}

/* ---- writing ---- */

/* POV: 5 to 7 bits are stored in 8 and 9 to 15 in 16, the upper bits repeated below. */
static void widen(uint16_t *code, size_t n, int from, int to)
{
    for (size_t i = 0; from < to && i < n; i++)
        code[i] = (uint16_t)(code[i] << (to - from) | code[i] >> (2 * from - to));
}

const uint16_t *codes_next(Codes *c)
{
    quantiser_row(c->quantiser, c->rgba, c->row);
    c->rgba += 4 * (size_t)c->width;
    widen(c->row, (size_t)c->width * (size_t)c->channels, c->how->quantising.bits, c->bits);
    return c->row;
}

static bool write_codes(FILE *to, const float *rgba, int width, int height, const ImageWriting *how, char error[IMAGE_ERROR])
{
    const ImageCodec *codec = codec_of(how->format);
    if (codec == NULL || codec->write == NULL)
        return codec_fail(error, "%s files cannot be written", image_format_name(how->format));
    ImageWriting w = *how;
    Quantising *q = &w.quantising;
    if (w.format == IMAGE_PGM)
        q->grey = true;
    if (w.format == IMAGE_PPM || w.format == IMAGE_PGM) {
        q->alpha = false;
        if (q->grey)                           /* POV: grey maps take no curve */
            q->working = (Transfer){ TRANSFER_NONE, 1 };
    } else if (w.format != IMAGE_PNG) {
        q->bits = 8;
        q->grey = false;
        q->alpha &= w.format != IMAGE_JPEG;
    }
    int bits = w.format != IMAGE_PNG ? q->bits : q->bits <= 8 ? 8 : 16, channels = quantise_channels(q);
    Codes codes = { width, height, channels, bits, &w, rgba, quantiser_new(q, width, height),
                    malloc((size_t)width * (size_t)channels * sizeof(uint16_t)) };
    bool ok = codes.quantiser != NULL && codes.row != NULL ? codec->write(to, &codes, error)
                                                           : codec_fail(error, "not enough memory for the picture");
    quantiser_free(codes.quantiser);
    free(codes.row);
    if (ok && (fflush(to) != 0 || ferror(to)))
        ok = codec_fail(error, "%s", strerror(errno));
    return ok;
}

/* Devices and pipes cannot be replaced by a rename. */
static bool write_in_place(const char *path, const float *rgba, int width, int height, const ImageWriting *how, char error[IMAGE_ERROR])
{
    FILE *to = fopen(path, "wb");
    if (to == NULL)
        return codec_fail(error, "%s", strerror(errno));
    bool ok = write_codes(to, rgba, width, height, how, error);
    if (fclose(to) != 0 && ok)
        ok = codec_fail(error, "%s", strerror(errno));
    return ok;
}

/* A new file next to `path`, with the usual rights (mkstemp would make a private one); its name into `beside`. */
static FILE *open_beside(const char *path, char *beside, size_t n)
{
    for (int i = 0; i < 100; i++) {
        snprintf(beside, n, "%s.%d-%d", path, (int)getpid(), i);
        int fd = open(beside, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd < 0 && errno != EEXIST)
            return NULL;
        if (fd < 0)
            continue;
        FILE *to = fdopen(fd, "wb");
        if (to == NULL) {
            close(fd);
            unlink(beside);
        }
        return to;
    }
    return NULL;
}

static bool write_beside(const char *path, char *beside, size_t n, const float *rgba, int width, int height,
                         const ImageWriting *how, char error[IMAGE_ERROR])
{
    FILE *to = open_beside(path, beside, n);
    if (to == NULL)
        return codec_fail(error, "%s", strerror(errno));
    bool ok = write_codes(to, rgba, width, height, how, error);
    if (ok && fsync(fileno(to)) != 0)
        ok = codec_fail(error, "%s", strerror(errno));
    if (fclose(to) != 0 && ok)
        ok = codec_fail(error, "%s", strerror(errno));
    if (ok && rename(beside, path) != 0)
        ok = codec_fail(error, "%s", strerror(errno));
    if (!ok)
        unlink(beside);
    return ok;
}

bool image_write(const char *path, const float *rgba, int width, int height, const ImageWriting *how, char error[IMAGE_ERROR])
{
    struct stat there;
    if (strcmp(path, "-") == 0)
        return write_codes(stdout, rgba, width, height, how, error);
    if (stat(path, &there) == 0 && !S_ISREG(there.st_mode))
        return write_in_place(path, rgba, width, height, how, error);
    size_t n = strlen(path) + 40;
    char *beside = malloc(n);
    if (beside == NULL)
        return codec_fail(error, "not enough memory for the picture");
    bool ok = write_beside(path, beside, n, rgba, width, height, how, error);
    free(beside);
    return ok;
}
