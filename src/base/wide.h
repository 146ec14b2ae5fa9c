/* wide.h - vectors of doubles, for kernels that are built once per instruction set (cpu.h). They are as wide as the processor's own, or
 * WIDTH_MOST lanes: gcc takes comparisons of wider ones apart. */
#ifndef BASE_WIDE_H
#define BASE_WIDE_H

#include <stdint.h>

#ifdef __SSE2__
#include <immintrin.h>
#endif

#ifndef WIDTH_MOST
#define WIDTH_MOST 8
#endif

#if defined(__AVX512F__) && WIDTH_MOST >= 8
enum { WIDTH = 8 };
#elif defined(__AVX2__)
enum { WIDTH = 4 };
#else
enum { WIDTH = 2 };
#endif

typedef double Lanes __attribute__((vector_size(8 * WIDTH)));
typedef int64_t Mask __attribute__((vector_size(8 * WIDTH)));  /* of each lane all bits, or none */

#define INLINE static inline __attribute__((always_inline))

INLINE Lanes all(double v) { return (Lanes){ 0 } + v; }
INLINE Lanes chosen(Mask m, Lanes a, Lanes b) { return (Lanes)((m & (Mask)a) | (~m & (Mask)b)); }

/* Bit i: lane i. */
INLINE uint32_t bits(Mask m)
{
#if defined(__AVX512F__) && WIDTH_MOST >= 8
    return _mm512_movepi64_mask((__m512i)m);
#elif defined(__AVX2__)
    return (uint32_t)_mm256_movemask_pd((__m256d)m);
#elif defined(__SSE2__)
    return (uint32_t)_mm_movemask_pd((__m128d)m);
#else
    return (uint32_t)(m[0] & 1) | (uint32_t)(m[1] & 2);
#endif
}

#endif
