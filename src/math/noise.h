/* noise.h - POV-Ray's lattice noise: three generators, vector noise, turbulence, and the hash tables under them.
 *
 * The numbers are 06-noise-and-patterns, sections 2 to 4. One kernel computes everything (noise_kernel.c); its builds for
 * different instruction sets give the same bits. */
#ifndef MATH_NOISE_H
#define MATH_NOISE_H

#include <stdbool.h>

#include "math/vec.h"

/* In 0..1; generator 1 (also 0), 2 or 3. */
double noise_value(int generator, const Vec3 *p);

/* D(p): components about -1..1, the same for all generators. */
Vec3 noise_vector(const Vec3 *p);

/* out[k] = noise at p * first * step^k, k < n (n <= 10). */
void noise_octaves(int generator, Vec3 p, double first, double step, int n, double *out);
void noise_vector_octaves(Vec3 p, double first, double step, int n, Vec3 *out);

/* Sum over six octaves from p * 4 on, each counting half of the one before, of |0.5 - noise|; generators 2 and 3: doubled, at most 0.5. */
double noise_ridges(int generator, const Vec3 *p);

/* U(p) and V(p) of section 4; octaves 1..10. */
double noise_turbulence(int generator, Vec3 p, int octaves, double omega, double lambda);
Vec3 noise_vector_turbulence(const Vec3 *p, int octaves, double omega, double lambda);
Vec2 noise_pair_turbulence(const Vec3 *p, int octaves, double omega, double lambda);       /* x and y of V(p) */
void noise_displace(Vec3 *p, const Vec3 *amount, int octaves, double omega, double lambda);    /* adds amount * V(p) to p */

enum { NOISE_CELLS = 4096 };

/* C(a,b,c) of section 2.3: 0..4095. */
unsigned noise_cell(long long a, long long b, long long c);

/* T[k] of section 2.2, k < NOISE_CELLS + 2: a hash and the two numbers after it. */
double noise_random(unsigned k);

/* The same in two steps, for those who visit many neighbouring cells. */
unsigned noise_cell_row(long long a, long long b);                  /* C(a,b,c) = noise_cell_in_row(row, c) */
unsigned noise_cell_in_row(unsigned row, long long c);

/* Each cube of the grid of whole numbers has one point, its low corner and three random numbers on from it: of the cube that holds p,
 * each number less `shift`, and the 26 around it, the squares of the two least distances to p. False: this machine has no fast way to
 * find them, or a number of p is 1e6 or more. */
bool noise_two_nearest(const Vec3 *p, double shift, double square[2]);

/* Steps the congruential generator of section 2.1 and gives 15 bits. */
static inline unsigned noise_sample(unsigned *state)
{
    *state = *state * 1812433253u + 12345u;
    return *state >> 16 & 32767u;
}

#endif
