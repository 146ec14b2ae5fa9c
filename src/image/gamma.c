/* gamma.c - transfer curves, quantising and dither.
 *
 * Without dither the encoded value of a channel only decides which of at most 256 codes it gets, so the curve is inverted once:
 * `at[k]` is the smallest float that gets code k, found by bisecting over the floats themselves. Then a picture costs a look-up
 * and a comparison or two a channel and no power, with the bits of the direct formula. */
#include "image/gamma.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"

static bool linear(Transfer t)
{
    return t.kind == TRANSFER_NONE || (t.kind == TRANSFER_POWER && fabs(t.exponent - 1) <= 0.01);
}

bool transfer_same(Transfer a, Transfer b)
{
    if (linear(a) || linear(b))
        return linear(a) && linear(b);
    if (a.kind != b.kind)
        return false;
    return a.kind == TRANSFER_SRGB || fabs(a.exponent / b.exponent - 1) <= 0.01;
}

double transfer_decode(Transfer t, double x)
{
    if (linear(t))
        return x;
    if (t.kind == TRANSFER_POWER)
        return pow(fmax(x, 0), t.exponent);
    return x < 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

double transfer_encode(Transfer t, double y)
{
    if (linear(t))
        return y;
    if (t.kind == TRANSFER_POWER)
        return pow(fmax(y, 0), 1 / t.exponent);
    return y <= 0.0031308 ? y * 12.92 : 1.055 * pow(y, 1 / 2.4) - 0.055;
}

/* Two powers make one, which keeps equal curves exact and saves a power. */
double transfer_convert(Transfer from, Transfer to, double x)
{
    if (transfer_same(from, to))
        return x;
    if (from.kind == TRANSFER_POWER && to.kind == TRANSFER_POWER)
        return pow(fmax(x, 0), from.exponent / to.exponent);
    return transfer_encode(to, transfer_decode(from, x));
}

static double clamp01(double v)
{
    return v > 0 ? v < 1 ? v : 1 : 0;          /* NaN becomes 0 */
}

/* Alpha takes no curve. */
static double encoded(const Quantising *q, bool is_alpha, double v)
{
    return is_alpha || q->working.kind == TRANSFER_NONE ? v : transfer_convert(q->working, q->file, v);
}

static double decoded(const Quantising *q, bool is_alpha, double v)
{
    return is_alpha || q->working.kind == TRANSFER_NONE ? v : transfer_convert(q->file, q->working, v);
}

static uint16_t code_of(double v, int max)
{
    return (uint16_t)floor(clamp01(v) * max + 0.5);
}

/* The values to be encoded, alpha last; colours divided by alpha (03, section 8.3). */
static void channels_of(const Quantising *q, const float *rgba, double out[4])
{
    double grey = 0.297 * (double)rgba[0] + 0.589 * (double)rgba[1] + 0.114 * (double)rgba[2];
    double alpha = (double)rgba[3];
    int n = 0;
    if (q->grey)
        out[n++] = grey;
    else
        for (; n < 3; n++)
            out[n] = (double)rgba[n];
    if (!q->alpha)
        return;
    if (grey > alpha)                          /* keeps highlights on clear pixels */
        alpha = fmin(1, grey);
    double by = alpha != 0 ? alpha : 1e-6;
    for (int i = 0; i < n; i++)
        out[i] /= by;
    out[n] = alpha;
}

/* ---- no dither ---- */

enum { INFINITE = 0x7f800000 };                /* the bits of it */

/* Cells are those of floats with equal upper bits, 128 to the octave from 2^-14 to 1: for eight bits and the usual curves, at most one
 * code begins within a cell. */
enum { CELL_BITS = 16, CELL_FIRST = (127 - 14) << 7, CELLS = 14 << 7 };

typedef struct Steps {
    float at[257];                             /* code k for at[k] <= v < at[k + 1] */
    uint8_t from[CELLS + 1];                   /* the code of a cell's least float; last that of 1 */
} Steps;

static void find_cells(Steps *s)
{
    int k = 0;
    for (uint32_t i = 0; i <= CELLS; i++) {
        float least = float_of_bits((CELL_FIRST + i) << CELL_BITS);
        while (least >= s->at[k + 1])
            k++;
        s->from[i] = (uint8_t)k;
    }
}

static void find_steps(const Quantising *q, bool is_alpha, int max, Steps *s)
{
    s->at[0] = -INFINITY;
    for (int k = 1; k <= 256; k++) {
        s->at[k] = NAN;                        /* nothing reaches it, not even infinity */
        if (k > max)
            continue;
        /* The bits of floats from 0 to infinity rise with them. From where the inverse says, in ever larger steps; then halves. */
        uint32_t at = float_bits((float)decoded(q, is_alpha, (k - 0.5) / max)), low = 0, high = INFINITE;
        for (uint32_t step = 1; at > low && at < high; step *= 4) {
            if (code_of(encoded(q, is_alpha, (double)float_of_bits(at)), max) >= k) {
                high = at;
                at = at > step ? at - step : 0;
            } else {
                low = at;
                at = at + step;
            }
        }
        while (high - low > 1) {
            uint32_t middle = low + (high - low) / 2;
            if (code_of(encoded(q, is_alpha, (double)float_of_bits(middle)), max) >= k)
                high = middle;
            else
                low = middle;
        }
        s->at[k] = float_of_bits(high);
    }
    find_cells(s);
}

static uint16_t step_of(const Steps *s, float v)
{
    uint32_t cell = (float_bits(v) >> CELL_BITS) - CELL_FIRST;
    int k = cell < CELLS ? s->from[cell] : v >= 1 ? s->from[CELLS] : 0;
    k += v >= s->at[k + 1];                    /* a number, not a branch that none can guess; NaN fails every comparison: 0 */
    while (v >= s->at[k + 1])
        k++;
    return (uint16_t)k;
}

static bool repeats(const float *rgba)         /* much of many pictures is of one colour */
{
    return memcmp(rgba, rgba - 4, 4 * sizeof *rgba) == 0;
}

/* Neither grey nor alpha, as most files are: half the work of the general loop below. */
static void quantise_rgb(const float *rgba, size_t n_pixels, const Steps *s, uint16_t *out)
{
    for (size_t p = 0; p < n_pixels; p++, rgba += 4, out += 3)
        if (p > 0 && repeats(rgba))
            memcpy(out, out - 3, 3 * sizeof *out);
        else
            for (int i = 0; i < 3; i++)
                out[i] = step_of(s, rgba[i]);
}

static void quantise_plain(const float *rgba, size_t n_pixels, const Quantising *q, uint16_t *out)
{
    int n = quantise_channels(q), max = (1 << q->bits) - 1;
    int n_colours = q->grey ? 1 : 3;
    Steps colour, alpha;
    bool by_steps = q->bits <= 8 && n_pixels > 256;
    if (by_steps) {
        find_steps(q, false, max, &colour);
        if (q->alpha)
            find_steps(q, true, max, &alpha);
    }
    if (by_steps && n == 3) {
        quantise_rgb(rgba, n_pixels, &colour, out);
        return;
    }
    for (size_t p = 0; p < n_pixels; p++, rgba += 4, out += n) {
        if (p > 0 && repeats(rgba)) {
            memcpy(out, out - n, (size_t)n * sizeof *out);
            continue;
        }
        double v[4];
        channels_of(q, rgba, v);
        for (int i = 0; i < n; i++)
            out[i] = by_steps ? step_of(i < n_colours ? &colour : &alpha, (float)v[i])
                              : code_of(encoded(q, i >= n_colours, (double)(float)v[i]), max);
    }
}

/* ---- ordered dither ---- */

static double bayer(DitherKind kind, int x, int y)
{
    static const unsigned char b2[2][2] = { { 1, 3 }, { 4, 2 } };
    static const unsigned char b3[3][3] = { { 3, 7, 4 }, { 6, 1, 9 }, { 2, 8, 5 } };
    static const unsigned char b4[4][4] = { { 1, 9, 3, 11 }, { 13, 5, 15, 7 }, { 4, 12, 2, 10 }, { 16, 8, 14, 6 } };
    /* POV: the column counts rows. */
    switch (kind) {
    case DITHER_B2: return b2[x % 2][y % 2] / 4.0 - 0.5;
    case DITHER_B3: return b3[x % 3][y % 3] / 9.0 - 0.5;
    default: return b4[x % 4][y % 4] / 16.0 - 0.5;
    }
}

static void quantise_ordered(const float *rgba, int width, int height, const Quantising *q, uint16_t *out)
{
    int n = quantise_channels(q), max = (1 << q->bits) - 1, n_colours = q->grey ? 1 : 3;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++, rgba += 4) {
            double v[4], offset = bayer(q->dither, x, y) / max;
            channels_of(q, rgba, v);
            for (int i = 0; i < n; i++)
                *out++ = code_of(encoded(q, i >= n_colours, v[i]) + offset, max);
        }
}

/* ---- error diffusion ---- */

typedef struct Carry { double c[4]; } Carry;

static void carry_add(Carry *to, const Carry *error, double share, int n)
{
    for (int i = 0; i < n; i++)
        to->c[i] += error->c[i] * share;
}

/* Where the error of pixel x goes. this_row and next_row have a spare entry on either side. */
static void spread(DitherKind kind, Carry *this_row, Carry *next_row, int x, const Carry *error, int n)
{
    if (kind == DITHER_D2) {
        carry_add(&this_row[x + 1], error, 0.5, n);
        carry_add(&next_row[x], error, 0.25, n);
        carry_add(&next_row[x + 1], error, 0.25, n);
    } else {
        carry_add(&this_row[x + 1], error, 7.0 / 16, n);
        carry_add(&next_row[x - 1], error, 3.0 / 16, n);
        carry_add(&next_row[x], error, 5.0 / 16, n);
        carry_add(&next_row[x + 1], error, 1.0 / 16, n);
    }
}

static void diffuse_pixel(const Quantising *q, const float *rgba, const Carry *carried, Carry *error, uint16_t *out)
{
    int n = quantise_channels(q), max = (1 << q->bits) - 1, n_colours = q->grey ? 1 : 3;
    double v[4];
    channels_of(q, rgba, v);
    for (int i = 0; i < n; i++) {
        double wanted = v[i] + carried->c[i];
        out[i] = code_of(encoded(q, i >= n_colours, wanted), max);
        error->c[i] = clamp01(wanted) - decoded(q, i >= n_colours, (double)out[i] / max);
    }
}

static bool quantise_diffused(const float *rgba, int width, int height, const Quantising *q, uint16_t *out)
{
    int n = quantise_channels(q);
    Carry error = { 0 };
    if (q->dither == DITHER_D1) {              /* runs on across line ends */
        for (size_t p = 0; p < (size_t)width * (size_t)height; p++) {
            Carry carried = error;
            diffuse_pixel(q, rgba + 4 * p, &carried, &error, out + (size_t)n * p);
        }
        return true;
    }
    size_t row = (size_t)width + 2;
    Carry *rows = calloc(2 * row, sizeof *rows);
    if (rows == NULL)
        return false;
    Carry *this_row = rows + 1, *next_row = rows + row + 1;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++, rgba += 4, out += n) {
            Carry carried = this_row[x];
            if (x == 0) {                      /* POV: exchanged after the first pixel has read its offset */
                Carry *old = this_row;
                this_row = next_row;
                next_row = old;
                memset(next_row - 1, 0, row * sizeof *next_row);
            }
            diffuse_pixel(q, rgba, &carried, &error, out);
            spread(q->dither, this_row, next_row, x, &error, n);
        }
    free(rows);
    return true;
}

bool quantise(const float *rgba, int width, int height, const Quantising *how, uint16_t *out)
{
    assert(how->bits >= 1 && how->bits <= 16);
    switch (how->dither) {
    case DITHER_NONE:
        quantise_plain(rgba, (size_t)width * (size_t)height, how, out);
        return true;
    case DITHER_B2: case DITHER_B3: case DITHER_B4:
        quantise_ordered(rgba, width, height, how, out);
        return true;
    default:
        return quantise_diffused(rgba, width, height, how, out);
    }
}
