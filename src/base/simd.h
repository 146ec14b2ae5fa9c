/* simd.h - d2 and d4, f4 and f8: two and four doubles, four and eight floats at once, the same results behind every instruction set.
 *
 * Only elementwise IEEE operations, so all versions give the same bits. max and min return the second operand when
 * either is NaN, as SSE does. */
#ifndef BASE_SIMD_H
#define BASE_SIMD_H

#include <stdint.h>

/* ---- two doubles or four floats, for code that is not built per instruction set ---- */

#if defined(__SSE2__)
#include <emmintrin.h>

typedef struct d2 { __m128d v; } d2;

static inline d2 d2_load(const double *p) { return (d2){ _mm_loadu_pd(p) }; }
static inline void d2_store(double *p, d2 a) { _mm_storeu_pd(p, a.v); }
static inline d2 d2_set(double x) { return (d2){ _mm_set1_pd(x) }; }
static inline d2 d2_of(double low, double high) { return (d2){ _mm_set_pd(high, low) }; }
static inline d2 d2_abs(d2 a) { return (d2){ _mm_andnot_pd(_mm_set1_pd(-0.0), a.v) }; }
static inline d2 d2_add(d2 a, d2 b) { return (d2){ _mm_add_pd(a.v, b.v) }; }
static inline d2 d2_mul(d2 a, d2 b) { return (d2){ _mm_mul_pd(a.v, b.v) }; }
static inline d2 d2_sub(d2 a, d2 b) { return (d2){ _mm_sub_pd(a.v, b.v) }; }
static inline d2 d2_div(d2 a, d2 b) { return (d2){ _mm_div_pd(a.v, b.v) }; }
static inline d2 d2_max(d2 a, d2 b) { return (d2){ _mm_max_pd(a.v, b.v) }; }
static inline d2 d2_min(d2 a, d2 b) { return (d2){ _mm_min_pd(a.v, b.v) }; }
static inline double d2_low(d2 a) { return _mm_cvtsd_f64(a.v); }
static inline double d2_high(d2 a) { return _mm_cvtsd_f64(_mm_unpackhi_pd(a.v, a.v)); }
/* Bit i: a[i] == b[i]. */
static inline uint32_t d2_eq(d2 a, d2 b) { return (uint32_t)_mm_movemask_pd(_mm_cmpeq_pd(a.v, b.v)); }

typedef struct f4 { __m128 v; } f4;
typedef struct d4 { __m128d a, b; } d4;

static inline f4 f4_load(const float *p) { return (f4){ _mm_loadu_ps(p) }; }
static inline void f4_store(float *p, f4 a) { _mm_storeu_ps(p, a.v); }
static inline f4 f4_set(float x) { return (f4){ _mm_set1_ps(x) }; }
static inline f4 f4_add(f4 a, f4 b) { return (f4){ _mm_add_ps(a.v, b.v) }; }
static inline f4 f4_sub(f4 a, f4 b) { return (f4){ _mm_sub_ps(a.v, b.v) }; }
static inline f4 f4_mul(f4 a, f4 b) { return (f4){ _mm_mul_ps(a.v, b.v) }; }
static inline f4 f4_div(f4 a, f4 b) { return (f4){ _mm_div_ps(a.v, b.v) }; }
static inline f4 f4_sqrt(f4 a) { return (f4){ _mm_sqrt_ps(a.v) }; }
static inline f4 f4_abs(f4 a) { return (f4){ _mm_andnot_ps(_mm_set1_ps(-0.0f), a.v) }; }
/* a >= 0 with the sign of b */
static inline f4 f4_signed(f4 a, f4 b) { return (f4){ _mm_or_ps(a.v, _mm_and_ps(_mm_set1_ps(-0.0f), b.v)) }; }
static inline f4 f4_of(float a, float b, float c, float d) { return (f4){ _mm_set_ps(d, c, b, a) }; }
static inline f4 f4_max(f4 a, f4 b) { return (f4){ _mm_max_ps(a.v, b.v) }; }
static inline f4 f4_min(f4 a, f4 b) { return (f4){ _mm_min_ps(a.v, b.v) }; }
/* Bit i: a[i] < b[i]. NaN is false. */
static inline uint32_t f4_lt(f4 a, f4 b) { return (uint32_t)_mm_movemask_ps(_mm_cmplt_ps(a.v, b.v)); }
/* Toward zero; what no int32_t holds is anything. */
static inline void f4_to_int(int32_t out[4], f4 a) { _mm_storeu_si128((__m128i_u *)(void *)out, _mm_cvttps_epi32(a.v)); }

static inline d4 d4_load(const double *p) { return (d4){ _mm_loadu_pd(p), _mm_loadu_pd(p + 2) }; }
static inline void d4_store(double *p, d4 x) { _mm_storeu_pd(p, x.a), _mm_storeu_pd(p + 2, x.b); }
static inline d4 d4_set(double x) { return (d4){ _mm_set1_pd(x), _mm_set1_pd(x) }; }
static inline d4 d4_of(double a, double b, double c, double d) { return (d4){ _mm_set_pd(b, a), _mm_set_pd(d, c) }; }
static inline d4 d4_add(d4 x, d4 y) { return (d4){ _mm_add_pd(x.a, y.a), _mm_add_pd(x.b, y.b) }; }
static inline d4 d4_sub(d4 x, d4 y) { return (d4){ _mm_sub_pd(x.a, y.a), _mm_sub_pd(x.b, y.b) }; }
static inline d4 d4_mul(d4 x, d4 y) { return (d4){ _mm_mul_pd(x.a, y.a), _mm_mul_pd(x.b, y.b) }; }
static inline d4 d4_div(d4 x, d4 y) { return (d4){ _mm_div_pd(x.a, y.a), _mm_div_pd(x.b, y.b) }; }
static inline d4 d4_max(d4 x, d4 y) { return (d4){ _mm_max_pd(x.a, y.a), _mm_max_pd(x.b, y.b) }; }
static inline d4 d4_min(d4 x, d4 y) { return (d4){ _mm_min_pd(x.a, y.a), _mm_min_pd(x.b, y.b) }; }
static inline d4 d4_sqrt(d4 x) { return (d4){ _mm_sqrt_pd(x.a), _mm_sqrt_pd(x.b) }; }
static inline d4 d4_abs(d4 x) { return (d4){ _mm_andnot_pd(_mm_set1_pd(-0.0), x.a), _mm_andnot_pd(_mm_set1_pd(-0.0), x.b) }; }
/* Bit i: x[i] < y[i]; x[i] <= y[i]; x[i] == y[i]. NaN is false. */
static inline uint32_t d4_lt(d4 x, d4 y)
{
    return (uint32_t)(_mm_movemask_pd(_mm_cmplt_pd(x.a, y.a)) | _mm_movemask_pd(_mm_cmplt_pd(x.b, y.b)) << 2);
}
static inline uint32_t d4_le(d4 x, d4 y)
{
    return (uint32_t)(_mm_movemask_pd(_mm_cmple_pd(x.a, y.a)) | _mm_movemask_pd(_mm_cmple_pd(x.b, y.b)) << 2);
}
static inline uint32_t d4_eq(d4 x, d4 y)
{
    return (uint32_t)(_mm_movemask_pd(_mm_cmpeq_pd(x.a, y.a)) | _mm_movemask_pd(_mm_cmpeq_pd(x.b, y.b)) << 2);
}

#else

#include <math.h>
typedef struct d2 { double v[2]; } d2;

#define D2_EACH(expression) for (int i = 0; i < 2; i++) expression
static inline d2 d2_load(const double *p) { d2 r; D2_EACH(r.v[i] = p[i]); return r; }
static inline void d2_store(double *p, d2 a) { D2_EACH(p[i] = a.v[i]); }
static inline d2 d2_set(double x) { d2 r; D2_EACH(r.v[i] = x); return r; }
static inline d2 d2_of(double low, double high) { return (d2){ { low, high } }; }
static inline d2 d2_abs(d2 a) { D2_EACH(a.v[i] = fabs(a.v[i])); return a; }
static inline d2 d2_add(d2 a, d2 b) { D2_EACH(a.v[i] += b.v[i]); return a; }
static inline d2 d2_mul(d2 a, d2 b) { D2_EACH(a.v[i] *= b.v[i]); return a; }
static inline d2 d2_sub(d2 a, d2 b) { D2_EACH(a.v[i] -= b.v[i]); return a; }
static inline d2 d2_div(d2 a, d2 b) { D2_EACH(a.v[i] /= b.v[i]); return a; }
static inline d2 d2_max(d2 a, d2 b) { D2_EACH(a.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i]); return a; }
static inline d2 d2_min(d2 a, d2 b) { D2_EACH(a.v[i] = a.v[i] < b.v[i] ? a.v[i] : b.v[i]); return a; }
static inline double d2_low(d2 a) { return a.v[0]; }
static inline double d2_high(d2 a) { return a.v[1]; }
static inline uint32_t d2_eq(d2 a, d2 b) { return (uint32_t)(a.v[0] == b.v[0]) | (uint32_t)(a.v[1] == b.v[1]) << 1; }

typedef struct f4 { float v[4]; } f4;
typedef struct d4 { double v[4]; } d4;

#define F4_EACH(expression) for (int i = 0; i < 4; i++) expression
static inline f4 f4_load(const float *p) { f4 r; F4_EACH(r.v[i] = p[i]); return r; }
static inline void f4_store(float *p, f4 a) { F4_EACH(p[i] = a.v[i]); }
static inline f4 f4_set(float x) { f4 r; F4_EACH(r.v[i] = x); return r; }
static inline f4 f4_add(f4 a, f4 b) { F4_EACH(a.v[i] += b.v[i]); return a; }
static inline f4 f4_sub(f4 a, f4 b) { F4_EACH(a.v[i] -= b.v[i]); return a; }
static inline f4 f4_mul(f4 a, f4 b) { F4_EACH(a.v[i] *= b.v[i]); return a; }
static inline f4 f4_div(f4 a, f4 b) { F4_EACH(a.v[i] /= b.v[i]); return a; }
static inline f4 f4_sqrt(f4 a) { F4_EACH(a.v[i] = sqrtf(a.v[i])); return a; }
static inline f4 f4_abs(f4 a) { F4_EACH(a.v[i] = fabsf(a.v[i])); return a; }
static inline f4 f4_signed(f4 a, f4 b) { F4_EACH(a.v[i] = copysignf(a.v[i], b.v[i])); return a; }
static inline f4 f4_of(float a, float b, float c, float d) { return (f4){ { a, b, c, d } }; }
static inline f4 f4_max(f4 a, f4 b) { F4_EACH(a.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i]); return a; }
static inline f4 f4_min(f4 a, f4 b) { F4_EACH(a.v[i] = a.v[i] < b.v[i] ? a.v[i] : b.v[i]); return a; }
static inline uint32_t f4_lt(f4 a, f4 b) { uint32_t m = 0; F4_EACH(m |= (uint32_t)(a.v[i] < b.v[i]) << i); return m; }
static inline void f4_to_int(int32_t out[4], f4 a) { F4_EACH(out[i] = a.v[i] > -0x1p31f && a.v[i] < 0x1p31f ? (int32_t)a.v[i] : 0); }

static inline d4 d4_load(const double *p) { d4 r; F4_EACH(r.v[i] = p[i]); return r; }
static inline void d4_store(double *p, d4 a) { F4_EACH(p[i] = a.v[i]); }
static inline d4 d4_set(double x) { d4 r; F4_EACH(r.v[i] = x); return r; }
static inline d4 d4_of(double a, double b, double c, double d) { return (d4){ { a, b, c, d } }; }
static inline d4 d4_add(d4 a, d4 b) { F4_EACH(a.v[i] += b.v[i]); return a; }
static inline d4 d4_sub(d4 a, d4 b) { F4_EACH(a.v[i] -= b.v[i]); return a; }
static inline d4 d4_mul(d4 a, d4 b) { F4_EACH(a.v[i] *= b.v[i]); return a; }
static inline d4 d4_div(d4 a, d4 b) { F4_EACH(a.v[i] /= b.v[i]); return a; }
static inline d4 d4_max(d4 a, d4 b) { F4_EACH(a.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i]); return a; }
static inline d4 d4_min(d4 a, d4 b) { F4_EACH(a.v[i] = a.v[i] < b.v[i] ? a.v[i] : b.v[i]); return a; }
static inline d4 d4_sqrt(d4 a) { F4_EACH(a.v[i] = sqrt(a.v[i])); return a; }
static inline d4 d4_abs(d4 a) { F4_EACH(a.v[i] = fabs(a.v[i])); return a; }
static inline uint32_t d4_lt(d4 a, d4 b) { uint32_t m = 0; F4_EACH(m |= (uint32_t)(a.v[i] < b.v[i]) << i); return m; }
static inline uint32_t d4_le(d4 a, d4 b) { uint32_t m = 0; F4_EACH(m |= (uint32_t)(a.v[i] <= b.v[i]) << i); return m; }
static inline uint32_t d4_eq(d4 a, d4 b) { uint32_t m = 0; F4_EACH(m |= (uint32_t)(a.v[i] == b.v[i]) << i); return m; }

#endif

/* ---- eight at once, for kernels ---- */

#if defined(__AVX__)
#include <immintrin.h>

typedef struct f8 { __m256 v; } f8;

static inline f8 f8_load(const float *p) { return (f8){ _mm256_loadu_ps(p) }; }
static inline f8 f8_set(float x) { return (f8){ _mm256_set1_ps(x) }; }
static inline void f8_store(float *p, f8 a) { _mm256_storeu_ps(p, a.v); }
static inline f8 f8_sub(f8 a, f8 b) { return (f8){ _mm256_sub_ps(a.v, b.v) }; }
static inline f8 f8_mul(f8 a, f8 b) { return (f8){ _mm256_mul_ps(a.v, b.v) }; }
static inline f8 f8_max(f8 a, f8 b) { return (f8){ _mm256_max_ps(a.v, b.v) }; }
static inline f8 f8_min(f8 a, f8 b) { return (f8){ _mm256_min_ps(a.v, b.v) }; }
/* Bit i: a[i] <= b[i]; NaN is false. */
static inline uint32_t f8_le(f8 a, f8 b) { return (uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)); }

#elif defined(__SSE2__)
#include <emmintrin.h>

typedef struct f8 { __m128 a, b; } f8;

static inline f8 f8_load(const float *p) { return (f8){ _mm_loadu_ps(p), _mm_loadu_ps(p + 4) }; }
static inline f8 f8_set(float x) { return (f8){ _mm_set1_ps(x), _mm_set1_ps(x) }; }
static inline void f8_store(float *p, f8 x) { _mm_storeu_ps(p, x.a), _mm_storeu_ps(p + 4, x.b); }
static inline f8 f8_sub(f8 x, f8 y) { return (f8){ _mm_sub_ps(x.a, y.a), _mm_sub_ps(x.b, y.b) }; }
static inline f8 f8_mul(f8 x, f8 y) { return (f8){ _mm_mul_ps(x.a, y.a), _mm_mul_ps(x.b, y.b) }; }
static inline f8 f8_max(f8 x, f8 y) { return (f8){ _mm_max_ps(x.a, y.a), _mm_max_ps(x.b, y.b) }; }
static inline f8 f8_min(f8 x, f8 y) { return (f8){ _mm_min_ps(x.a, y.a), _mm_min_ps(x.b, y.b) }; }
static inline uint32_t f8_le(f8 x, f8 y)
{
    return (uint32_t)(_mm_movemask_ps(_mm_cmple_ps(x.a, y.a)) | _mm_movemask_ps(_mm_cmple_ps(x.b, y.b)) << 4);
}

#else

typedef struct f8 { float v[8]; } f8;

#define F8_EACH(expression) for (int i = 0; i < 8; i++) expression
static inline f8 f8_load(const float *p) { f8 r; F8_EACH(r.v[i] = p[i]); return r; }
static inline f8 f8_set(float x) { f8 r; F8_EACH(r.v[i] = x); return r; }
static inline void f8_store(float *p, f8 a) { F8_EACH(p[i] = a.v[i]); }
static inline f8 f8_sub(f8 a, f8 b) { F8_EACH(a.v[i] -= b.v[i]); return a; }
static inline f8 f8_mul(f8 a, f8 b) { F8_EACH(a.v[i] *= b.v[i]); return a; }
static inline f8 f8_max(f8 a, f8 b) { F8_EACH(a.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i]); return a; }
static inline f8 f8_min(f8 a, f8 b) { F8_EACH(a.v[i] = a.v[i] < b.v[i] ? a.v[i] : b.v[i]); return a; }
static inline uint32_t f8_le(f8 a, f8 b) { uint32_t m = 0; F8_EACH(m |= (uint32_t)(a.v[i] <= b.v[i]) << i); return m; }

#endif

#endif
