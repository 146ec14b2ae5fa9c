/* chi_square.h - quantiles of the chi-square distribution, by which adaptive sampling decides when to stop. */
#ifndef MATH_CHI_SQUARE_H
#define MATH_CHI_SQUARE_H

#include <stdint.h>

/* What a variable with that many degrees of freedom exceeds with probability p. */
double chi_square_quantile(uint32_t degrees, double p);

/* The same as POV-Ray has it, which errs for odd degrees below 26. */
double chi_square_quantile_pov(uint32_t degrees, double p);

#endif
