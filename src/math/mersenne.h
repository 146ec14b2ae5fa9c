/* mersenne.h - the Mersenne Twister of Matsumoto and Nishimura (1998), as std::mt19937 has it. */
#ifndef MATH_MERSENNE_H
#define MATH_MERSENNE_H

#include <stdint.h>

enum { MERSENNE_N = 624, MERSENNE_SEED = 5489 };       /* the seed of all tables that POV-Ray makes of it */

typedef struct Mersenne {                      /* MT19937 */
    uint32_t state[MERSENNE_N];
    uint32_t next;
} Mersenne;

void mersenne_seed(Mersenne *m, uint32_t seed);
uint32_t mersenne_next(Mersenne *m);

/* The first n numbers from MERSENNE_SEED on, in [0, 1). */
void mersenne_fill(double *out, uint32_t n);

#endif
