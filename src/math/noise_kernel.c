/* noise_kernel.c - the arithmetic of noise, built once per instruction set with the same bits.
 *
 * Each of the eight corners of a lattice cell gives w (R0/2 + R1 dx + R2 dy + R3 dz): four neighbouring numbers of the table
 * times (1/2, dx, dy, dz). Those four products are the lanes of a vector and the sum over corners runs lane by lane, so
 * that a corner costs one load and three operations.
 *
 * The octaves of a turbulence do not depend on each other, but one octave alone fills the processor's window. So first all
 * points find their cells (Spots), then all sums are made: each of the two steps is short enough for several to overlap. */
#include <string.h>

#include "base/cpu.h"
#include "math/noise_tables.h"

#ifdef __AVX2__
#include <immintrin.h>
#endif

enum { MAX_OCTAVES = 10 };

/* Points that are far away and other rare ways; kept apart, so that their loads of pairs do not wait in front of the near way. */
#define AWAY __attribute__((noinline, cold))

typedef double Pair __attribute__((vector_size(16)));
typedef double Quad __attribute__((vector_size(32)));
typedef double QuadInMemory __attribute__((vector_size(32), aligned(8), may_alias));

static inline Quad load(const double *from)
{
    return *(const QuadInMemory *)from;
}

/* ---- spots: where points lie in the lattice ---- */

typedef struct Spots {
    Quad low[MAX_OCTAVES];                     /* 1/2 and the way from the low corner: x, y, z */
    Quad weight[2][MAX_OCTAVES];               /* of the corners of the lower layer and of the upper: 00, 10, 01, 11 */
    long long cell[MAX_OCTAVES][4];            /* -, x, y, z: 0..4095 */
} __attribute__((aligned(64))) Spots;

/* Beyond this no fraction is left in a double; the lattice index must fit an integer. */
static const double FAR = 4e18;

static inline bool is_far(Vec3 p)
{
    return !(fabs(p.x) < FAR && fabs(p.y) < FAR && fabs(p.z) < FAR);
}

static inline long long low_corner(double x)
{
    return (long long)(x - (x < 0 ? 1 - 1e-10 : 0));
}

static inline void spot_set(Spots *spots, int k, Vec3 p)
{
    long long mx = low_corner(p.x), my = low_corner(p.y), mz = low_corner(p.z);
    double x = p.x - (double)mx, y = p.y - (double)my, z = p.z - (double)mz;
    double sx = x * x * (3 - 2 * x), sy = y * y * (3 - 2 * y), sz = z * z * (3 - 2 * z);
    double tx = 1 - sx, ty = 1 - sy, tz = 1 - sz;
    double w00 = tx * ty, w10 = sx * ty, w01 = tx * sy, w11 = sx * sy;
    spots->low[k] = (Quad){ 0.5, x, y, z };
    spots->weight[0][k] = (Quad){ w00 * tz, w10 * tz, w01 * tz, w11 * tz };
    spots->weight[1][k] = (Quad){ w00 * sz, w10 * sz, w01 * sz, w11 * sz };
    spots->cell[k][1] = (mx + 10000) & 4095;
    spots->cell[k][2] = (my + 10000) & 4095;
    spots->cell[k][3] = (mz + 10000) & 4095;
}

#ifdef __AVX2__

typedef long long Lanes __attribute__((vector_size(32)));

static inline Quad quad(double x)
{
    return (Quad){ x, x, x, x };
}

/* All bits where p is negative. */
static inline Lanes signs(Quad p)
{
#ifdef __AVX512F__
    return (Lanes)_mm256_srai_epi64((__m256i)p, 63);
#else
    return p < 0;
#endif
}

/* What does not fit is far below 0. */
static inline Lanes truncated(Quad p)
{
#ifdef __AVX512F__
    return (Lanes)_mm256_cvttpd_epi64(p);
#else
    return (Lanes)_mm256_cvtepi32_epi64(_mm256_cvttpd_epi32(p));
#endif
}

/* The same for p = (1/2, x, y, z). Returns numbers of bits beyond 30 for points that are too far for this. A zero may lose its sign, which
 * shows nowhere. */
static inline Lanes spot_set_quad(Spots *spots, int k, Quad p)
{
    Lanes sign = signs(p);
    Quad shifted = p - (Quad)((Lanes)quad(1 - 1e-10) & sign);
    Lanes corner = truncated(shifted);
    Quad low = p - _mm256_round_pd(shifted, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC), s = low * low * (3 - 2 * low), t = 1 - s;
    Quad x = _mm256_permute4x64_pd(_mm256_unpackhi_pd(t, s), 0x44), y = _mm256_permute4x64_pd(_mm256_unpacklo_pd(t, s), 0xfa);
    spots->low[k] = low;
    spots->weight[0][k] = x * y * _mm256_permute4x64_pd(t, 0xff);
    spots->weight[1][k] = x * y * _mm256_permute4x64_pd(s, 0xff);
    *(Lanes *)spots->cell[k] = (corner + 10000) & 4095;
    return corner ^ sign;
}

#ifdef __AVX512F__

typedef double Oct __attribute__((vector_size(64)));
typedef long long Lanes8 __attribute__((vector_size(64)));

/* Two octaves. */
static inline Lanes8 spot_set_oct(Spots *spots, int k, Oct p)
{
    Lanes8 sign = (Lanes8)_mm512_srai_epi64((__m512i)p, 63);
    Oct shifted = p - (Oct)((Lanes8)_mm512_set1_pd(1 - 1e-10) & sign);
    Lanes8 corner = (Lanes8)_mm512_cvttpd_epi64(shifted);
    Oct low = p - _mm512_roundscale_pd(shifted, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC), s = low * low * (3 - 2 * low), t = 1 - s;
    Oct x = _mm512_permutex_pd(_mm512_unpackhi_pd(t, s), 0x44), y = _mm512_permutex_pd(_mm512_unpacklo_pd(t, s), 0xfa);
    *(Oct *)&spots->low[k] = low;
    *(Oct *)&spots->weight[0][k] = x * y * _mm512_permutex_pd(t, 0xff);
    *(Oct *)&spots->weight[1][k] = x * y * _mm512_permutex_pd(s, 0xff);
    *(Lanes8 *)spots->cell[k] = (corner + 10000) & 4095;
    return corner ^ sign;
}

#endif

/* Of p * first * step^k; false if one of them is too far for this. */
static inline bool spots_set(Spots *spots, const Vec3 *p, double first, double step, int n)
{
    /* Blended, as one load of y and z together would have to wait for two stores. */
    Quad from = _mm256_blend_pd(_mm256_blend_pd(quad(0.5), quad(p->x), 2), _mm256_blend_pd(quad(p->y), quad(p->z), 8), 12);
    Quad scale = { 1, first, first, first }, by = { 1, step, step, step };
    Lanes far = { 0 };
    int k = 0;
#ifdef __AVX512F__
    if (n >= 2) {
        Oct from2 = _mm512_broadcast_f64x4(from), by2 = _mm512_broadcast_f64x4(by);
        Oct scale2 = _mm512_insertf64x4(_mm512_castpd256_pd512(scale), scale * by, 1);
        Lanes8 far2 = { 0 };
        for (; k + 2 <= n; k += 2, scale2 = scale2 * by2 * by2)
            far2 |= spot_set_oct(spots, k, from2 * scale2);
        far = (Lanes)(_mm512_castsi512_si256((__m512i)far2) | _mm512_extracti64x4_epi64((__m512i)far2, 1));
        scale = _mm512_castpd512_pd256(scale2);
    }
#endif
    for (; k < n; k++, scale *= by)
        far |= spot_set_quad(spots, k, from * scale);
    return _mm256_testz_si256((__m256i)far, _mm256_set1_epi64x(~0x3fffffffll));
}

#else

static inline bool spots_set(Spots *spots, const Vec3 *p, double first, double step, int n)
{
    for (int k = 0; k < n; k++, first *= step) {
        Vec3 q = scaled(*p, first);
        if (is_far(q))
            return false;
        spot_set(spots, k, q);
    }
    return true;
}

#endif

/* ---- sums over the corners ---- */

/* Does `each` with the corner's numbers in R (`table`) and w (1/2, dx, dy, dz) (`factors`); `first` at the first, where sums begin. That
 * they do not begin with 0 shows nowhere, as the lane of 1/2 never sums to -0. Points with a whole z, most often 0 as
 * in the images that functions make, have no part in the upper layer: its weights are 0. */
#define FOR_CORNERS(spots, k, first, each)                                                                             \
    const uint16_t *h = noise_tables.hash;                                                                             \
    const uint16_t *last = noise_tables.corner;                                                                        \
    unsigned ix = (unsigned)(spots)->cell[k][1], iy = (unsigned)(spots)->cell[k][2];                                   \
    unsigned iz = (unsigned)(spots)->cell[k][3];                                                                       \
    unsigned h0 = h[ix], h1 = h[ix + 1];                                                                               \
    unsigned h00 = h[h0 ^ iy], h10 = h[h1 ^ iy], h01 = h[h0 ^ (iy + 1)], h11 = h[h1 ^ (iy + 1)];                       \
    CORNER(spots, k, h00 ^ iz, 0, 0, 0, first)                                                                         \
    CORNER(spots, k, h10 ^ iz, 1, 0, 0, each)                                                                          \
    CORNER(spots, k, h01 ^ iz, 0, 1, 0, each)                                                                          \
    CORNER(spots, k, h11 ^ iz, 1, 1, 0, each)                                                                          \
    if ((spots)->low[k][3] != 0) {                                                                                     \
        CORNER(spots, k, h00 ^ (iz + 1), 0, 0, 1, each)                                                                \
        CORNER(spots, k, h10 ^ (iz + 1), 1, 0, 1, each)                                                                \
        CORNER(spots, k, h01 ^ (iz + 1), 0, 1, 1, each)                                                                \
        CORNER(spots, k, h11 ^ (iz + 1), 1, 1, 1, each)                                                                \
    }

#define CORNER(spots, k, hash, x, y, z, each)                                                                          \
    {                                                                                                                  \
        const double *table = noise_tables.gradient + last[hash];                                                      \
        Quad factors = ((spots)->low[k] - (Quad){ 0, x, y, z }) * (spots)->weight[z][k][(x) + 2 * (y)];                \
        each                                                                                                           \
    }

/* The lanes of a sum are added crosswise, (0 + 2) + (1 + 3); this is the first half of that. */
static inline Pair halves(Quad v)
{
    return (Pair){ v[0], v[1] } + (Pair){ v[2], v[3] };
}

static inline Pair spot_noise(const Spots *spots, int k)
{
    Quad sum;
    FOR_CORNERS(spots, k, sum = factors * load(table);, sum += factors * load(table);)
    return halves(sum);
}

/* The fourth lane means nothing. */
static inline Quad vector_of(Quad dx, Quad dy, Quad dz)
{
    Pair y = halves(dy);
    Quad xz = __builtin_shufflevector(dx, dz, 0, 1, 4, 5) + __builtin_shufflevector(dx, dz, 2, 3, 6, 7), yy = { y[0], y[1], 0, 0 };
    return __builtin_shufflevector(xz, yy, 0, 4, 2, 6) + __builtin_shufflevector(xz, yy, 1, 5, 3, 7);
}

/* Stored as it will be loaded: in two parts. */
static inline Vec3 vector_stored(Quad v)
{
    Vec3 out;
    Pair xy = { v[0], v[1] };
    memcpy(&out, &xy, sizeof xy);
    out.z = v[2];
    return out;
}

static inline Quad spot_vector(const Spots *spots, int k)
{
    Quad dx, dy, dz;
    FOR_CORNERS(spots, k, dx = factors * load(table); dy = factors * load(table + 4); dz = factors * load(table + 8);
                , dx += factors * load(table); dy += factors * load(table + 4); dz += factors * load(table + 8);)
    return vector_of(dx, dy, dz);
}

/* ---- generator 3 ---- */

static inline void axis3(double x, unsigned *low, unsigned *high, double *r)
{
    double t = x + 10000000.023157213;
    double k = floor(t);
    long long i = (long long)k;
    *low = (unsigned)(i & 2047);
    *high = (unsigned)((i + 1) & 2047);
    *r = t - k;
}

/* g(p) of section 3.2: gradients of unit length on a lattice of period 2048. */
static inline double raw3(Vec3 p)
{
    unsigned x0, x1, y0, y1, z0, z1;
    double x, y, z;
    axis3(p.x, &x0, &x1, &x);
    axis3(p.y, &y0, &y1, &y);
    axis3(p.z, &z0, &z1, &z);
    const uint16_t *perm = noise_tables.permutation3;
    unsigned i = perm[x0], j = perm[x1];
    unsigned b00 = perm[i + y0], b10 = perm[j + y0], b01 = perm[i + y1], b11 = perm[j + y1];
    double sx = x * x * (3 - 2 * x), sy = y * y * (3 - 2 * y), sz = z * z * (3 - 2 * z);
    Quad near = { x, y, z, 0 };
    const double (*g)[4] = (const double (*)[4])noise_tables.gradient3;
    Quad layer[2];
    for (int k = 0; k < 2; k++) {
        unsigned zk = k ? z1 : z0;
        double c = k;
        Quad a00 = load(g[b00 + zk]) * (near - (Quad){ 0, 0, c, 0 });
        Quad a10 = load(g[b10 + zk]) * (near - (Quad){ 1, 0, c, 0 });
        Quad a01 = load(g[b01 + zk]) * (near - (Quad){ 0, 1, c, 0 });
        Quad a11 = load(g[b11 + zk]) * (near - (Quad){ 1, 1, c, 0 });
        Quad a = a00 + (a10 - a00) * sx, b = a01 + (a11 - a01) * sx;
        layer[k] = a + (b - a) * sy;
    }
    Pair sum = halves(layer[0] + (layer[1] - layer[0]) * sz);
    return sum[0] + sum[1];
}

/* Written so that it becomes two instructions without a branch. */
static inline double clamp(double v)
{
    v = v > 0 ? v : 0;
    return v < 1 ? v : 1;
}

/* ---- what others call ---- */

/* Of generator 1 or 2. */
static inline double value_of(int generator, Pair sum)
{
    double shift = generator == 2 ? 1.05242 : 0.5, stretch = generator == 2 ? 0.48985582 : 1;
    return clamp((sum[0] + sum[1] + shift) * stretch);
}

typedef long long Mask __attribute__((vector_size(16)));

static inline Pair least(Pair a, double b)
{
    Pair all = { b, b };
    Mask below = a < all;
    return (Pair)(((Mask)a & below) | ((Mask)all & ~below));
}

/* Of two sums at once, with the same bits. */
static inline Pair values_of(int generator, Pair a, Pair b)
{
    double shift = generator == 2 ? 1.05242 : 0.5, stretch = generator == 2 ? 0.48985582 : 1;
    Pair v = (((Pair){ a[0], b[0] } + (Pair){ a[1], b[1] }) + shift) * stretch;
    return least((Pair)((Mask)v & (v > 0)), 1);
}

/* False: too far for any noise. */
AWAY static bool spot_of_far(Spots *spot, const Vec3 *p)
{
    if (is_far(*p))
        return false;
    spot_set(spot, 0, *p);
    return true;
}

static inline bool spot_of(Spots *spot, const Vec3 *p)
{
    return spots_set(spot, p, 1, 1, 1) || spot_of_far(spot, p);
}

AWAY static double value3(const Vec3 *p)
{
    return is_far(*p) ? 0.5 : clamp(0.5 * (1.59 * raw3(*p) + 0.985));
}

static double value(int generator, const Vec3 *p)
{
    Spots spot;
    if (generator == 3)
        return value3(p);
    return spot_of(&spot, p) ? value_of(generator, spot_noise(&spot, 0)) : 0.5;
}

AWAY static void octaves_one_by_one(int generator, const Vec3 *p, double first, double step, int n, double *out)
{
    for (int k = 0; k < n; k++, first *= step) {
        Vec3 q = scaled(*p, first);
        out[k] = value(generator, &q);
    }
}

static inline void octaves(int generator, const Vec3 *p, double first, double step, int n, double *out)
{
    Spots spots;
    Pair sum[MAX_OCTAVES];
    if (generator == 3 || !spots_set(&spots, p, first, step, n)) {
        octaves_one_by_one(generator, p, first, step, n, out);
        return;
    }
    for (int k = 0; k < n; k++)
        sum[k] = spot_noise(&spots, k);
    for (int k = 0; k + 2 <= n; k += 2) {
        Pair v = values_of(generator, sum[k], sum[k + 1]);
        memcpy(&out[k], &v, sizeof v);         /* in one piece, as ridges load it */
    }
    if (n % 2 != 0)
        out[n - 1] = value_of(generator, sum[n - 1]);
}

/* By two octaves at once, added in their order. */
static double ridges(int generator, const Vec3 *p)
{
    enum { N = 6 };
    const long long no_sign = 0x7fffffffffffffff;
    Pair v[N / 2];
    double sum = 0, weight = 1;
    octaves(generator, p, 4, 2, N, (double *)v);
#pragma GCC unroll 3
    for (int i = 0; i < N / 2; i++) {
        Pair ridge = (Pair)((Mask)(0.5 - v[i]) & no_sign);
        if (generator >= 2)
            ridge = least(2 * ridge, 0.5);
        sum += weight * ridge[0];
        sum += weight * 0.5 * ridge[1];
        weight *= 0.25;
    }
    return sum;
}

/* Generators 2 and 3 are stretched about the middle; only the first term is clamped. */
static double turbulence(int generator, const Vec3 *p, int n, double omega, double lambda)
{
    double v[MAX_OCTAVES];
    octaves(generator, p, 1, lambda, n, v);
    bool stretched = generator >= 2;
    double sum = stretched ? clamp(2 * v[0] - 0.5) : v[0], weight = omega;
    for (int k = 1; k < n; k++, weight *= omega)
        sum += weight * (stretched ? 2 * v[k] - 0.5 : v[k]);
    return sum;
}

static inline Quad vector_at(const Vec3 *p)
{
    Spots spot;
    return spot_of(&spot, p) ? spot_vector(&spot, 0) : (Quad){ 0 };
}

static Vec3 vector(const Vec3 *p)
{
    return vector_stored(vector_at(p));
}

AWAY static void vectors_one_by_one(const Vec3 *p, double first, double step, int n, Vec3 *out)
{
    for (int k = 0; k < n; k++, first *= step) {
        Vec3 q = scaled(*p, first);
        out[k] = vector(&q);
    }
}

static void vector_octaves(const Vec3 *p, double first, double step, int n, Vec3 *out)
{
    Spots spots;
    if (spots_set(&spots, p, first, step, n))
        for (int k = 0; k < n; k++)
            out[k] = vector_stored(spot_vector(&spots, k));
    else
        vectors_one_by_one(p, first, step, n, out);
}

AWAY static Vec3 far_turbulence(const Vec3 *p, int n, double omega, double lambda)
{
    Vec3 v[MAX_OCTAVES], sum;
    double weight = omega;
    vectors_one_by_one(p, 1, lambda, n, v);
    sum = v[0];
    for (int k = 1; k < n; k++, weight *= omega)
        sum = add(sum, scaled(v[k], weight));
    return sum;
}

static inline Quad turbulence_of(const Spots *spots, int n, double omega)
{
    Quad sum = spot_vector(spots, 0);
    double weight = omega;
    for (int k = 1; k < n; k++, weight *= omega)
        sum += spot_vector(spots, k) * weight;
    return sum;
}

static Vec3 vector_turbulence(const Vec3 *p, int n, double omega, double lambda)
{
    Spots spots;
    return spots_set(&spots, p, 1, lambda, n) ? vector_stored(turbulence_of(&spots, n, omega)) : far_turbulence(p, n, omega, lambda);
}

AWAY static Vec3 displaced_far(const Vec3 *p, const Vec3 *amount, int n, double omega, double lambda)
{
    return add(*p, mul(*amount, far_turbulence(p, n, omega, lambda)));
}

static void displace(Vec3 *p, const Vec3 *amount, int n, double omega, double lambda)
{
    Spots spots;
    if (spots_set(&spots, p, 1, lambda, n))
        *p = vector_stored((Quad){ p->x, p->y, p->z, 0 } + (Quad){ amount->x, amount->y, amount->z, 0 } * turbulence_of(&spots, n, omega));
    else
        *p = displaced_far(p, amount, n, omega, lambda);
}

/* x and y of a vector: two thirds of the work. */
static inline Pair spot_pair(const Spots *spots, int k)
{
    Quad dx, dy;
    FOR_CORNERS(spots, k, dx = factors * load(table); dy = factors * load(table + 4);
                , dx += factors * load(table); dy += factors * load(table + 4);)
    Pair x = halves(dx), y = halves(dy);
    return (Pair){ x[0], y[0] } + (Pair){ x[1], y[1] };
}

static Vec2 pair_turbulence(const Vec3 *p, int n, double omega, double lambda)
{
    Spots spots;
    if (!spots_set(&spots, p, 1, lambda, n)) {
        Vec3 v = far_turbulence(p, n, omega, lambda);
        return (Vec2){ v.x, v.y };
    }
    Pair sum = spot_pair(&spots, 0);
    double weight = omega;
    for (int k = 1; k < n; k++, weight *= omega)
        sum += spot_pair(&spots, k) * weight;
    return (Vec2){ sum[0], sum[1] };
}

/* ---- random points ---- */

#ifdef __AVX2__

static inline Quad fewer(Quad a, Quad b) { return _mm256_min_pd(a, b); }
static inline Quad more(Quad a, Quad b) { return _mm256_max_pd(a, b); }

/* Row by row along z, whose three points are lanes; the fourth is infinitely far. No point is passed over, and nothing branches. */
static bool two_nearest(const Vec3 *p, double shift, double square[2])
{
    const uint16_t *h = noise_tables.hash;
    const double *random = noise_tables.random;
    const double near = 1e6;
    Quad px = quad(p->x), py = quad(p->y), pz = quad(p->z);
    Quad low = _mm256_floor_pd(_mm256_blend_pd(px, _mm256_blend_pd(py, pz, 12), 14) - shift);
    if (_mm256_movemask_pd((Quad)((low < near) & (low > -near))) != 15)
        return false;
    __m128i cube = _mm256_cvttpd_epi32(low);
    int cx = _mm_cvtsi128_si32(cube), cy = _mm_extract_epi32(cube, 1), cz = _mm_extract_epi32(cube, 2);
    unsigned before = (cz - 1) & 4095, at = cz & 4095, behind = (cz + 1) & 4095;
    Quad x0 = _mm256_permute4x64_pd(low, 0x00), y0 = _mm256_permute4x64_pd(low, 0x55);
    Quad z = _mm256_permute4x64_pd(low, 0xff) + (Quad){ -1, 0, 1, INFINITY };
    Quad first = quad(INFINITY), second = first;
    for (int i = -1; i <= 1; i++) {
        unsigned slice = h[(cx + i) & 4095];
        Quad x = x0 + i;
        for (int j = -1; j <= 1; j++) {
            unsigned row = h[slice ^ ((cy + j) & 4095)];
            Quad y = y0 + j;
            Quad a = load(random + h[row ^ before]), b = load(random + h[row ^ at]), c = load(random + h[row ^ behind]);
            Quad even = __builtin_shufflevector(a, b, 0, 4, 2, 6), odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
            Quad dx = px - (x + __builtin_shufflevector(even, c, 0, 1, 4, 5));
            Quad dy = py - (y + __builtin_shufflevector(odd, c, 0, 1, 5, 5));
            Quad dz = pz - (z + __builtin_shufflevector(even, c, 2, 3, 6, 7));
            Quad s = dx * dx + dy * dy + dz * dz;
            second = fewer(second, more(first, s));
            first = fewer(first, s);
        }
    }
    /* Half by half, all lanes fall into the lowest. */
    Quad other = _mm256_permute4x64_pd(first, 0xee);
    second = fewer(fewer(second, _mm256_permute4x64_pd(second, 0xee)), more(first, other));
    first = fewer(first, other);
    other = _mm256_permute_pd(first, 1);
    second = fewer(fewer(second, _mm256_permute_pd(second, 1)), more(first, other));
    square[0] = fewer(first, other)[0];
    square[1] = second[0];
    return true;
}

#define TWO_NEAREST two_nearest

#else

#define TWO_NEAREST 0                          /* by twos it is faster to pass over far points */

#endif

const NoiseKernel ISA_NAME(noise_kernel)[1] = { {
    .value = value, .vector = vector, .octaves = octaves, .vector_octaves = vector_octaves,
    .two_nearest = TWO_NEAREST, .ridges = ridges, .turbulence = turbulence, .vector_turbulence = vector_turbulence,
    .pair_turbulence = pair_turbulence, .displace = displace,
} };
