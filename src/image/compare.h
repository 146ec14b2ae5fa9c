/* compare.h - how far two pictures are apart. */
#ifndef IMAGE_COMPARE_H
#define IMAGE_COMPARE_H

#include "image/image.h"

typedef struct Comparison {                    /* channels in units of 1/255 */
    double over_1, over_4;                     /* shares of pixels with a channel that differs by more */
    double blocks_over_6;                      /* share of 4x4 blocks whose means differ by more in some channel */
    double mean, max, rmse, psnr;              /* over all channels; psnr in dB, INFINITY for equal pictures */
    const char *verdict;                       /* exact, match, close, off */
} Comparison;

/* Pictures of one size. Alpha counts as a channel if one of them has it. `heat`: NULL, or width * height * 4 floats to fill:
 * black where equal, through red and yellow to white at 32 or more. */
void image_compare(const Image *a, const Image *b, Comparison *out, float *heat);

#endif
