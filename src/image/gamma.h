/* gamma.h - transfer curves, and the way from traced colours to whole-number codes (03-camera-and-sampling, section 8). */
#ifndef IMAGE_GAMMA_H
#define IMAGE_GAMMA_H

#include <stdbool.h>
#include <stdint.h>

typedef enum TransferKind { TRANSFER_NONE, TRANSFER_POWER, TRANSFER_SRGB } TransferKind;

/* How stored values become linear light: NONE as they are and nothing to be done, POWER x^exponent (1: linear), SRGB. */
typedef struct Transfer {
    TransferKind kind;
    double exponent;
} Transfer;

double transfer_decode(Transfer t, double x);  /* to linear */
double transfer_encode(Transfer t, double y);  /* from linear */
bool transfer_same(Transfer a, Transfer b);    /* within the 1 % that count as equal */
double transfer_convert(Transfer from, Transfer to, double x);

typedef enum DitherKind { DITHER_NONE, DITHER_B2, DITHER_B3, DITHER_B4, DITHER_D1, DITHER_D2, DITHER_FS } DitherKind;

typedef struct Quantising {
    Transfer working, file;                    /* working NONE: colours are written as they are */
    int bits;                                  /* 5..16 */
    bool alpha, grey;
    DitherKind dither;
} Quantising;

/* Codes of pixels: `channels` (1 grey, 2 grey and alpha, 3, 4) numbers of 0 .. 2^bits - 1 each. Colours are premultiplied, alpha linear.
 * A Quantiser is given the rows of a picture from the top one on. NULL: out of memory. */
typedef struct Quantiser Quantiser;
Quantiser *quantiser_new(const Quantising *how, int width, int height);
void quantiser_free(Quantiser *q);             /* NULL: nothing */
void quantiser_row(Quantiser *q, const float *rgba, uint16_t *out);

/* All rows. False: out of memory. */
bool quantise(const float *rgba, int width, int height, const Quantising *how, uint16_t *out);

static inline int quantise_channels(const Quantising *how) { return (how->grey ? 1 : 3) + (how->alpha ? 1 : 0); }

#endif
