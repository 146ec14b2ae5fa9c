/* noise_tables.h - the tables behind noise, for noise.c, the builds of noise_kernel.c, and who visits many cells. */
#ifndef MATH_NOISE_TABLES_H
#define MATH_NOISE_TABLES_H

#include <stdint.h>

#include "base/cpu.h"
#include "math/noise.h"

enum { NOISE_GRADIENTS = 267, NOISE_GRADIENT_ROW = NOISE_GRADIENTS + 5 };

typedef struct NoiseTables {
    uint16_t hash[8192];                       /* H */
    uint16_t corner[8192];                     /* the last step: where in `gradient` R is read, from H mod 256 on */
    /* R, four times over, so that wherever one begins to read there is a copy that begins a vector there: a load across two lines of the
     * cache takes as long as three others. */
    double gradient[4 * NOISE_GRADIENT_ROW] __attribute__((aligned(64)));
    double gradient3[4098][4];                 /* G of generator 3, fourth component 0 */
    uint16_t permutation3[4098];               /* P */
    double random[NOISE_CELLS + 3];            /* the part of T that hashes reach, and one more for loads of four */
} NoiseTables;

extern NoiseTables noise_tables;               /* written once: before main, or at the first use of generator 3 */

typedef struct NoiseKernel {
    double (*value)(int generator, const Vec3 *p);
    Vec3 (*vector)(const Vec3 *p);
    void (*octaves)(int generator, const Vec3 *p, double first, double step, int n, double *out);
    void (*vector_octaves)(const Vec3 *p, double first, double step, int n, Vec3 *out);
    bool (*two_nearest)(const Vec3 *p, double shift, double square[2]);    /* may be NULL */
    double (*ridges)(int generator, const Vec3 *p);
    double (*turbulence)(int generator, const Vec3 *p, int octaves, double omega, double lambda);
    Vec3 (*vector_turbulence)(const Vec3 *p, int octaves, double omega, double lambda);
    Vec2 (*pair_turbulence)(const Vec3 *p, int octaves, double omega, double lambda);
    void (*displace)(Vec3 *p, const Vec3 *amount, int octaves, double omega, double lambda);
} NoiseKernel;

/* One element each: a name that is an address fits CPU_TABLE. */
#define NOISE_DECLARE(isa) extern const NoiseKernel noise_kernel_##isa[1];
CPU_ISAS(NOISE_DECLARE)

#endif
