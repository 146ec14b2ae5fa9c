/* gif.c - the first picture of a GIF, by giflib.
 *
 * POT files, the 16-bit potentials of Fractint, are GIFs twice as wide: upper bytes in the left half, lower ones in the right. */
#include <stdlib.h>
#include <string.h>

#include "image/codec.h"

static bool probe(Str bytes)
{
    return bytes.n >= 13 && memcmp(bytes.data, "GIF8", 4) == 0;
}

#ifdef HAVE_GIF
#include <gif_lib.h>

#include "base/library.h"

#define FUNCTIONS(each)                                                                                                \
    each(DGifOpen) each(DGifGetRecordType) each(DGifGetImageDesc) each(DGifGetExtension) each(DGifGetExtensionNext)    \
    each(DGifGetLine) each(DGifCloseFile) each(GifErrorString)

typedef struct Library { FUNCTIONS(LIBRARY_FIELD) } Library;

enum { GIF_CODES = 4096 };                     /* a code stands for so many pixels at most */

static int read_bytes(GifFileType *gif, GifByteType *to, int n)
{
    ByteReader *from = gif->UserData;
    size_t left = (size_t)(from->end - from->next), most = (size_t)n < left ? (size_t)n : left;
    memcpy(to, from->next, most);
    from->next += most;
    return (int)most;
}

static bool gif_fail(const Library *lib, const GifFileType *gif, char error[IMAGE_ERROR])
{
    if (gif->Error == D_GIF_ERR_READ_FAILED || gif->Error == D_GIF_ERR_EOF_TOO_SOON)
        return codec_fail(error, "the file ends before its last pixel");
    const char *why = lib->GifErrorString(gif->Error);
    return codec_fail(error, "damaged GIF: %s", why != NULL ? why : "its data make no sense");
}

/* Goes to the first picture; of the extensions on the way, one names the transparent entry of the palette. */
static bool find_picture(const Library *lib, GifFileType *gif, int *transparent, char error[IMAGE_ERROR])
{
    GifRecordType type;
    while (lib->DGifGetRecordType(gif, &type) == GIF_OK) {
        if (type == IMAGE_DESC_RECORD_TYPE)
            return lib->DGifGetImageDesc(gif) == GIF_OK || gif_fail(lib, gif, error);
        if (type != EXTENSION_RECORD_TYPE)
            break;
        int label;
        GifByteType *data;
        bool more = lib->DGifGetExtension(gif, &label, &data) == GIF_OK;
        while (more && data != NULL) {
            if (label == GRAPHICS_EXT_FUNC_CODE && data[0] == 4 && (data[1] & 1))
                *transparent = data[4];
            more = lib->DGifGetExtensionNext(gif, &data) == GIF_OK;
        }
        if (!more)
            return gif_fail(lib, gif, error);
    }
    return codec_fail(error, "there is no picture in this GIF file");
}

static bool take_palette(const GifFileType *gif, int transparent, Image *im, char error[IMAGE_ERROR])
{
    const ColorMapObject *map = gif->Image.ColorMap != NULL ? gif->Image.ColorMap : gif->SColorMap;
    if (map == NULL || map->ColorCount < 1 || map->ColorCount > 256)
        return codec_fail(error, "this GIF file has no palette");
    im->n_palette = (uint32_t)map->ColorCount;
    for (uint32_t i = 0; i < im->n_palette; i++) {
        GifColorType c = map->Colors[i];
        memcpy(im->palette[i], (uint8_t[4]){ c.Red, c.Green, c.Blue, 255 }, 4);
    }
    if (transparent >= 0 && (uint32_t)transparent < im->n_palette)
        im->palette[transparent][3] = 0;
    return true;
}

/* Rows of an interlaced picture come as every 8th from 0, every 8th from 4, every 4th from 2, every 2nd from 1. */
static bool read_rows(const Library *lib, GifFileType *gif, uint8_t *pixels, char error[IMAGE_ERROR])
{
    static const int first[] = { 0, 4, 2, 1 }, step[] = { 8, 8, 4, 2 };
    int width = gif->Image.Width, height = gif->Image.Height, passes = gif->Image.Interlace ? 4 : 1;
    for (int pass = 0; pass < passes; pass++)
        for (int y = first[pass]; y < height; y += passes > 1 ? step[pass] : 1)
            if (lib->DGifGetLine(gif, pixels + (size_t)y * (size_t)width, width) != GIF_OK)
                return gif_fail(lib, gif, error);
    return true;
}

static bool read_with(const Library *lib, GifFileType *gif, Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    int transparent = -1;
    if (!find_picture(lib, gif, &transparent, error) ||
        !codec_size(gif->Image.Width, gif->Image.Height, bytes, GIF_CODES, error) || !take_palette(gif, transparent, im, error))
        return false;
    im->width = gif->Image.Width;
    im->height = gif->Image.Height;
    im->channels = 1;
    im->max_value = 255;
    im->indexed = im->has_alpha = true;        /* POV: also without a transparent entry */
    return pixels == NULL || read_rows(lib, gif, pixels, error);
}

static bool read_image(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    static const char *const names[] = { FUNCTIONS(LIBRARY_NAME) };
    Library lib;
    if (!library_load(LIBRARY_GIF, names, sizeof names / sizeof *names, &lib))
        return codec_fail(error, "giflib, which reads GIF files, is not installed");
    int code = 0;
    ByteReader from = reader_of(bytes);
    GifFileType *gif = lib.DGifOpen(&from, read_bytes, &code);
    if (gif == NULL)
        return codec_fail(error, probe(bytes) ? "there is no picture in this GIF file" : "this is no GIF file");
    bool read = read_with(&lib, gif, bytes, im, pixels, error);
    lib.DGifCloseFile(gif, &code);
    return read;
}
#else
static bool read_image(Str bytes, Image *im, void *pixels, char error[IMAGE_ERROR])
{
    (void)bytes, (void)im, (void)pixels;
    return codec_fail(error, "this build has no giflib and cannot read GIF files");
}
#endif

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
