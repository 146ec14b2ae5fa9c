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

/* Cells are those of floats with equal upper bits, 256 to the octave from 2^-14 to 1: for eight bits and the usual curves, at most one
 * code begins within a cell. */
enum { CELL_BITS = 15, CELL_FIRST = (127 - 14) << 8, CELLS = 14 << 8 };

typedef struct Steps {
    float at[257];                             /* code k for at[k] <= v < at[k + 1] */
    uint8_t from[CELLS + 1];                   /* the code of a cell's least float; last that of 1 */
    bool fine;                                 /* one code at most begins within a cell */
} Steps;

static void find_cells(Steps *s)
{
    int k = 0;
    s->fine = true;
    for (uint32_t i = 0; i <= CELLS; i++) {
        float least = float_of_bits((CELL_FIRST + i) << CELL_BITS);
        while (least >= s->at[k + 1])
            k++;
        s->from[i] = (uint8_t)k;
        s->fine &= i == 0 || k <= s->from[i - 1] + 1;
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

static inline uint32_t cell_of(float v)       /* CELLS or more: none */
{
    return (float_bits(v) >> CELL_BITS) - CELL_FIRST;
}

static uint16_t step_of(const Steps *s, float v)
{
    uint32_t cell = cell_of(v);
    int k = cell < CELLS ? s->from[cell] : v >= 1 ? s->from[CELLS] : 0;
    while (v >= s->at[k + 1])                  /* NaN fails every comparison: 0 */
        k++;
    return (uint16_t)k;
}

/* The same of steps that are fine: a number added, not a branch that none can guess. */
static inline uint16_t fine_step_of(const Steps *s, float v)
{
    uint32_t cell = cell_of(v);
    if (cell >= CELLS)
        return step_of(s, v);
    uint32_t k = s->from[cell];
    return (uint16_t)(k + (float_bits(v) >= float_bits(s->at[k + 1])));
}

static inline bool repeats(const float *rgba)         /* much of many pictures is of one colour */
{
    return memcmp(rgba, rgba - 4, 4 * sizeof *rgba) == 0;
}

/* Neither grey nor alpha, as most files are: a third of the work of the general loop below. */
static void quantise_rgb(const float *rgba, size_t n_pixels, const Steps *s, uint16_t *out)
{
    for (size_t p = 0; p < n_pixels; p++, rgba += 4, out += 3) {
        if (p > 0 && repeats(rgba)) {
            memcpy(out, out - 3, 3 * sizeof *out);
            continue;
        }
        out[0] = fine_step_of(s, rgba[0]);
        out[1] = fine_step_of(s, rgba[1]);
        out[2] = fine_step_of(s, rgba[2]);
    }
}

typedef struct Carry { double c[4]; } Carry;   /* errors of one pixel's codes */

struct Quantiser {
    Quantising how;
    int width, y;                              /* of the next row */
    bool by_steps;
    Steps colour, alpha;
    Carry error;                               /* D1: of the pixel before */
    Carry *this_row, *next_row;                /* D2, FS: each with a spare entry on either side */
    Carry rows[];
};

static void plain_row(const Quantiser *state, const float *rgba, uint16_t *out)
{
    const Quantising *q = &state->how;
    int n = quantise_channels(q), max = (1 << q->bits) - 1, n_colours = q->grey ? 1 : 3;
    if (state->by_steps && state->colour.fine && n == 3) {
        quantise_rgb(rgba, (size_t)state->width, &state->colour, out);
        return;
    }
    for (int x = 0; x < state->width; x++, rgba += 4, out += n) {
        if (x > 0 && repeats(rgba)) {
            memcpy(out, out - n, (size_t)n * sizeof *out);
            continue;
        }
        double v[4];
        channels_of(q, rgba, v);
        for (int i = 0; i < n; i++)
            out[i] = state->by_steps ? step_of(i < n_colours ? &state->colour : &state->alpha, (float)v[i])
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

static void ordered_row(const Quantiser *state, const float *rgba, uint16_t *out)
{
    const Quantising *q = &state->how;
    int n = quantise_channels(q), max = (1 << q->bits) - 1, n_colours = q->grey ? 1 : 3;
    for (int x = 0; x < state->width; x++, rgba += 4) {
        double v[4], offset = bayer(q->dither, x, state->y) / max;
        channels_of(q, rgba, v);
        for (int i = 0; i < n; i++)
            *out++ = code_of(encoded(q, i >= n_colours, v[i]) + offset, max);
    }
}

/* ---- error diffusion ---- */

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

/* D1: runs on across line ends. */
static void along_row(Quantiser *state, const float *rgba, uint16_t *out)
{
    int n = quantise_channels(&state->how);
    for (int x = 0; x < state->width; x++, rgba += 4, out += n) {
        Carry carried = state->error;
        diffuse_pixel(&state->how, rgba, &carried, &state->error, out);
    }
}

static void diffused_row(Quantiser *state, const float *rgba, uint16_t *out)
{
    int n = quantise_channels(&state->how);
    for (int x = 0; x < state->width; x++, rgba += 4, out += n) {
        Carry carried = state->this_row[x];
        if (x == 0) {                          /* POV: exchanged after the first pixel has read its offset */
            Carry *old = state->this_row;
            state->this_row = state->next_row;
            state->next_row = old;
            memset(old - 1, 0, ((size_t)state->width + 2) * sizeof *old);
        }
        diffuse_pixel(&state->how, rgba, &carried, &state->error, out);
        spread(state->how.dither, state->this_row, state->next_row, x, &state->error, n);
    }
}

/* ---- pictures ---- */

Quantiser *quantiser_new(const Quantising *how, int width, int height)
{
    enum { FEW = 256 };                        /* pixels, for which finding all steps does not pay */
    assert(how->bits >= 1 && how->bits <= 16);
    bool rows = how->dither == DITHER_D2 || how->dither == DITHER_FS;
    size_t row = (size_t)width + 2;
    Quantiser *q = calloc(1, sizeof *q + (rows ? 2 * row * sizeof(Carry) : 0));
    if (q == NULL)
        return NULL;
    q->how = *how;
    q->width = width;
    q->this_row = q->rows + 1;
    q->next_row = q->rows + row + 1;
    q->by_steps = how->dither == DITHER_NONE && how->bits <= 8 && (size_t)width * (size_t)height > FEW;
    if (q->by_steps)
        find_steps(how, false, (1 << how->bits) - 1, &q->colour);
    if (q->by_steps && how->alpha)
        find_steps(how, true, (1 << how->bits) - 1, &q->alpha);
    return q;
}

void quantiser_free(Quantiser *q)
{
    free(q);
}

void quantiser_row(Quantiser *q, const float *rgba, uint16_t *out)
{
    switch (q->how.dither) {
    case DITHER_NONE:
        plain_row(q, rgba, out);
        break;
    case DITHER_B2: case DITHER_B3: case DITHER_B4:
        ordered_row(q, rgba, out);
        break;
    case DITHER_D1:
        along_row(q, rgba, out);
        break;
    case DITHER_D2: case DITHER_FS:
        diffused_row(q, rgba, out);
        break;
    }
    q->y++;
}

bool quantise(const float *rgba, int width, int height, const Quantising *how, uint16_t *out)
{
    Quantiser *q = quantiser_new(how, width, height);
    size_t n = (size_t)width * (size_t)quantise_channels(how);
    for (int y = 0; q != NULL && y < height; y++, rgba += 4 * (size_t)width, out += n)
        quantiser_row(q, rgba, out);
    quantiser_free(q);
    return q != NULL;
}
