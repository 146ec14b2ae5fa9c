/* compare.c - differences of pictures in one pass over 4x4 blocks.
 *
 * exact: at least 99.9 % of pixels within 1; match: at least 98 % within 4 and a mean of at most 0.6; close: after a 4x4
 * box filter at least 97 % of blocks within 6; else off. */
#include "image/compare.h"

#include <math.h>

enum { BLOCK = 4, CHANNELS = 4 };

static void pixel(const Image *im, int x, int y, double out[CHANNELS])
{
    Colour c = image_pixel(im, x, y);
    out[0] = 255 * (double)c.r;
    out[1] = 255 * (double)c.g;
    out[2] = 255 * (double)c.b;
    out[3] = 255 * (1 - (double)c.t);
}

static void heat_colour(double d, float *rgba)
{
    double v = fmin(d / 32, 1) * 3;
    for (int c = 0; c < 3; c++)
        rgba[c] = (float)fmin(fmax(v - c, 0), 1);
    rgba[3] = 1;
}

typedef struct Sums {
    double absolute, square, max;
    long over_1, over_4, blocks, blocks_over_6;
} Sums;

static void compare_block(const Image *a, const Image *b, int x0, int y0, int channels, Sums *s, float *heat)
{
    double mean[CHANNELS] = { 0 };
    int n = 0;
    for (int y = y0; y < y0 + BLOCK && y < a->height; y++)
        for (int x = x0; x < x0 + BLOCK && x < a->width; x++, n++) {
            double p[CHANNELS], q[CHANNELS], worst = 0;
            pixel(a, x, y, p);
            pixel(b, x, y, q);
            for (int c = 0; c < channels; c++) {
                double d = p[c] - q[c];
                mean[c] += d;
                s->absolute += fabs(d);
                s->square += d * d;
                worst = fmax(worst, fabs(d));
            }
            /* Eight-bit codes differ by whole numbers; the slack keeps rounding of 1 - t out of the count. */
            s->over_1 += worst > 1.001;
            s->over_4 += worst > 4.001;
            s->max = fmax(s->max, worst);
            if (heat)
                heat_colour(worst, heat + 4 * ((size_t)y * (size_t)a->width + (size_t)x));
        }
    bool over = false;
    for (int c = 0; c < channels; c++)
        over = over || fabs(mean[c]) / n > 6;
    s->blocks++;
    s->blocks_over_6 += over;
}

void image_compare(const Image *a, const Image *b, Comparison *out, float *heat)
{
    Sums s = { 0 };
    int channels = a->has_alpha || b->has_alpha ? 4 : 3;
    for (int y = 0; y < a->height; y += BLOCK)
        for (int x = 0; x < a->width; x += BLOCK)
            compare_block(a, b, x, y, channels, &s, heat);
    double pixels = (double)a->width * a->height, samples = pixels * channels;
    out->over_1 = (double)s.over_1 / pixels;
    out->over_4 = (double)s.over_4 / pixels;
    out->blocks_over_6 = (double)s.blocks_over_6 / (double)s.blocks;
    out->mean = s.absolute / samples;
    out->max = s.max;
    out->rmse = sqrt(s.square / samples);
    out->psnr = s.square > 0 ? 20 * log10(255 / out->rmse) : INFINITY;
    out->verdict = out->over_1 <= 0.001 ? "exact"
                   : out->over_4 <= 0.02 && out->mean <= 0.6 ? "match"
                   : out->blocks_over_6 <= 0.03 ? "close" : "off";
}
