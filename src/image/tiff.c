/* tiff.c - TIFF by libtiff, as eight bits of red, green, blue and alpha whatever the file holds. */
#include <string.h>

#include "image/codec.h"

static bool probe(Str bytes)
{
    return bytes.n >= 8 && (memcmp(bytes.data, "II*\0", 4) == 0 || memcmp(bytes.data, "MM\0*", 4) == 0);
}

#ifdef HAVE_TIFF
#include <tiffio.h>

#include "base/library.h"

#if TIFFLIB_VERSION >= 20221213                /* handlers of one file; before, only of the whole process */
#define OPENING(each)                                                                                                  \
    each(TIFFOpenOptionsAlloc) each(TIFFOpenOptionsFree) each(TIFFOpenOptionsSetErrorHandlerExtR)                      \
    each(TIFFOpenOptionsSetWarningHandlerExtR) each(TIFFOpenOptionsSetMaxSingleMemAlloc) each(TIFFClientOpenExt)
#else
#define OPENING(each) each(TIFFClientOpen)
#endif
#define FUNCTIONS(each) OPENING(each) each(TIFFClose) each(TIFFGetField) each(TIFFRGBAImageOK) each(TIFFReadRGBAImageOriented)

typedef struct Library { FUNCTIONS(LIBRARY_FIELD) } Library;

typedef struct Source {
    Library lib;
    Str bytes;
    uint64_t at;
    char *error;
} Source;

static tmsize_t give(thandle_t h, void *out, tmsize_t n)
{
    Source *s = (Source *)h;
    uint64_t left = s->at < s->bytes.n ? s->bytes.n - s->at : 0;
    uint64_t take = (uint64_t)n < left ? (uint64_t)n : left;
    memcpy(out, s->bytes.data + s->at, take);
    s->at += take;
    return (tmsize_t)take;
}

static tmsize_t refuse(thandle_t h, void *data, tmsize_t n)
{
    (void)h, (void)data, (void)n;
    return 0;
}

static toff_t seek(thandle_t h, toff_t to, int from)
{
    Source *s = (Source *)h;
    s->at = from == SEEK_SET ? to : from == SEEK_CUR ? s->at + to : s->bytes.n + to;
    if (s->at > s->bytes.n)
        s->at = s->bytes.n;
    return s->at;
}

static int done(thandle_t h)
{
    (void)h;
    return 0;
}

static toff_t size(thandle_t h)
{
    return ((Source *)h)->bytes.n;
}

#if TIFFLIB_VERSION >= 20221213
static int on_error(TIFF *t, void *user, const char *module, const char *format, va_list args)
{
    (void)t, (void)module;
    char message[200];
    vsnprintf(message, sizeof message, format, args);
    codec_fail(((Source *)user)->error, "damaged TIFF: %s", message);
    return 1;
}

static int on_warning(TIFF *t, void *user, const char *module, const char *format, va_list args)
{
    (void)t, (void)user, (void)module, (void)format, (void)args;
    return 1;
}

static TIFF *tiff_open(Source *s)
{
    TIFFOpenOptions *options = s->lib.TIFFOpenOptionsAlloc();
    if (options == NULL)
        return NULL;
    s->lib.TIFFOpenOptionsSetErrorHandlerExtR(options, on_error, s);
    s->lib.TIFFOpenOptionsSetWarningHandlerExtR(options, on_warning, s);
    s->lib.TIFFOpenOptionsSetMaxSingleMemAlloc(options, 1 << 30);
    TIFF *t = s->lib.TIFFClientOpenExt("image", "rm", s, give, refuse, seek, done, size, NULL, NULL, options);
    s->lib.TIFFOpenOptionsFree(options);
    return t;
}
#else
static TIFF *tiff_open(Source *s)
{
    return s->lib.TIFFClientOpen("image", "rm", s, give, refuse, seek, done, size, NULL, NULL);
}
#endif

/* The library hands out colours multiplied by alpha; ours are not. */
static void unpack(const uint32_t *raster, size_t n, uint8_t *out)
{
    for (size_t i = 0; i < n; i++, out += 4) {
        uint32_t v = raster[i];
        uint32_t c[3] = { TIFFGetR(v), TIFFGetG(v), TIFFGetB(v) }, alpha = TIFFGetA(v);
        for (int k = 0; k < 3; k++) {
            uint32_t plain = alpha == 0 ? 0 : (c[k] * 255 + alpha / 2) / alpha;
            out[k] = (uint8_t)(plain > 255 ? 255 : plain);
        }
        out[3] = (uint8_t)alpha;
    }
}

static bool read_with(const Library *lib, TIFF *t, Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    uint32_t width = 0, height = 0;
    uint16_t n_extra = 0, *extra = NULL;
    char why[1024];
    lib->TIFFGetField(t, TIFFTAG_IMAGEWIDTH, &width);
    lib->TIFFGetField(t, TIFFTAG_IMAGELENGTH, &height);
    if (!codec_size((long)width, (long)height, bytes, 1 << 14, error))
        return false;
    if (!lib->TIFFRGBAImageOK(t, why))
        return codec_fail(error, "this kind of TIFF is not read: %.200s", why);
    lib->TIFFGetField(t, TIFFTAG_EXTRASAMPLES, &n_extra, &extra);
    im->width = (int)width;
    im->height = (int)height;
    im->channels = 4;
    im->max_value = 255;
    im->has_alpha = n_extra > 0;
    if (pixels == NULL)
        return true;
    codec_fail(error, "the file ends before its last pixel");
    if (!lib->TIFFReadRGBAImageOriented(t, width, height, pixels, ORIENTATION_TOPLEFT, 1))
        return false;
    unpack(pixels, (size_t)width * height, pixels);
    return true;
}

static bool read_image(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    if (!probe(bytes))
        return codec_fail(error, "this is no TIFF file");
    static const char *const names[] = { FUNCTIONS(LIBRARY_NAME) };
    Source source = { .bytes = bytes, .error = error };
    if (!library_load(LIBRARY_TIFF, names, sizeof names / sizeof *names, &source.lib))
        return codec_fail(error, "libtiff, which reads TIFF files, is not installed");
    codec_fail(error, "damaged TIFF");
    TIFF *t = tiff_open(&source);
    if (t == NULL)
        return false;
    bool ok = read_with(&source.lib, t, bytes, im, pixels, error);
    source.lib.TIFFClose(t);
    return ok;
}

const ImageCodec codec_tiff = { IMAGE_TIFF, probe, read_image, NULL };

#else

static bool read_image(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    (void)bytes, (void)im, (void)pixels;
    return codec_fail(error, "this build has no libtiff and cannot read TIFF files");
}

const ImageCodec codec_tiff = { IMAGE_TIFF, probe, read_image, NULL };

#endif
