/* noise_kernel.c - the arithmetic of noise, built once per instruction set with the same bits.
 *
 * Each of the eight corners of a lattice cell gives w (R0/2 + R1 dx + R2 dy + R3 dz): four neighbouring numbers of the table
 * times (1/2, dx, dy, dz). Those four products are the lanes of a vector and the sum over corners runs lane by lane, so
 * that a corner costs one load and three operations.
 *
 * The octaves of a turbulence do not depend on each other, but one octave alone fills the processor's window. So first all
 * points find their cells (Spot), then all sums are made: each of the two steps is short enough for several to overlap. */
#include <string.h>

#include "base/cpu.h"
#include "math/noise_tables.h"

#ifdef __AVX2__
#include <immintrin.h>
#endif

enum { MAX_OCTAVES = 10 };

typedef double Pair __attribute__((vector_size(16)));
typedef double Quad __attribute__((vector_size(32)));
typedef double QuadInMemory __attribute__((vector_size(32), aligned(8), may_alias));

static inline Quad load(const double *from)
{
    return *(const QuadInMemory *)from;
}

/* ---- spots: where a point lies in the lattice ---- */

typedef struct Spot {
    Quad low;                                  /* 1/2 and the way from the low corner: x, y, z */
    double weight[8];                          /* of the corners */
    int cell[4];                               /* -, x, y, z: 0..4095 */
} Spot;

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

static inline void spot_set(Spot *spot, Vec3 p)
{
    long long mx = low_corner(p.x), my = low_corner(p.y), mz = low_corner(p.z);
    double x = p.x - (double)mx, y = p.y - (double)my, z = p.z - (double)mz;
    double sx = x * x * (3 - 2 * x), sy = y * y * (3 - 2 * y), sz = z * z * (3 - 2 * z);
    double tx = 1 - sx, ty = 1 - sy, tz = 1 - sz;
    double w00 = tx * ty, w10 = sx * ty, w01 = tx * sy, w11 = sx * sy;
    *spot = (Spot){ .low = { 0.5, x, y, z },
                    .weight = { w00 * tz, w10 * tz, w01 * tz, w11 * tz, w00 * sz, w10 * sz, w01 * sz, w11 * sz },
                    .cell = { 0, (mx + 10000) & 4095, (my + 10000) & 4095, (mz + 10000) & 4095 } };
}

#ifdef __AVX2__

static inline Quad quad(double x)
{
    return (Quad){ x, x, x, x };
}

/* The same for p = (1/2, x, y, z). */
static inline void spot_set_quad(Spot *spot, Quad p)
{
    typedef long long Lanes __attribute__((vector_size(32)));
    Quad shifted = p - (Quad)((Lanes)quad(1 - 1e-10) & (Lanes)(p < 0));
    __m128i corner = _mm256_cvttpd_epi32(shifted), cell = _mm_and_si128(_mm_add_epi32(corner, _mm_set1_epi32(10000)), _mm_set1_epi32(4095));
    Quad low = p - _mm256_cvtepi32_pd(corner), s = low * low * (3 - 2 * low), t = 1 - s;
    Quad x = _mm256_permute4x64_pd(_mm256_unpackhi_pd(t, s), 0x44), y = _mm256_permute4x64_pd(_mm256_unpacklo_pd(t, s), 0xfa);
    spot->low = low;
    *(QuadInMemory *)spot->weight = x * y * _mm256_permute4x64_pd(t, 0xff);
    *(QuadInMemory *)(spot->weight + 4) = x * y * _mm256_permute4x64_pd(s, 0xff);
    _mm_storeu_si128((__m128i_u *)(void *)spot->cell, cell);
}

/* Of p * first * step^k; false if one of them is too far for this. */
static inline bool spots_set(Spot *spot, Vec3 p, double first, double step, int n)
{
    const double near = 2e9;                   /* cells are numbered in 32 bits */
    /* Blended, as one load of y and z together would have to wait for two stores. */
    Quad from = _mm256_blend_pd(_mm256_blend_pd(quad(0.5), quad(p.x), 2), _mm256_blend_pd(quad(p.y), quad(p.z), 8), 12);
    Quad scale = { 1, first, first, first }, by = { 1, step, step, step }, last = scale;
    for (int k = 0; k < n; k++, scale *= by) {
        spot_set_quad(&spot[k], from * scale);
        last = scale;
    }
    Quad farthest = from * quad(fabs(first) > fabs(last[1]) ? first : last[1]);
    return _mm256_movemask_pd((Quad)((farthest < near) & (farthest > -near))) == 15;
}

#else

static inline bool spots_set(Spot *spot, Vec3 p, double first, double step, int n)
{
    for (int k = 0; k < n; k++, first *= step) {
        Vec3 q = scaled(p, first);
        if (is_far(q))
            return false;
        spot_set(&spot[k], q);
    }
    return true;
}

#endif

/* ---- sums over the corners ---- */

/* Does `each` with the corner's numbers in R (`table`) and w (1/2, dx, dy, dz) (`factors`). Points with a whole z, most often 0 as
 * in the images that functions make, have no part in the upper layer: its weights are 0. */
#define FOR_CORNERS(spot, each)                                                                                        \
    const uint16_t *h = noise_tables.hash;                                                                             \
    const uint8_t *last = noise_tables.corner;                                                                         \
    unsigned ix = (unsigned)(spot)->cell[1], iy = (unsigned)(spot)->cell[2], iz = (unsigned)(spot)->cell[3];           \
    unsigned h0 = h[ix], h1 = h[ix + 1];                                                                               \
    unsigned h00 = h[h0 ^ iy], h10 = h[h1 ^ iy], h01 = h[h0 ^ (iy + 1)], h11 = h[h1 ^ (iy + 1)];                       \
    CORNER(spot, h00 ^ iz, 0, 0, 0, each)                                                                              \
    CORNER(spot, h10 ^ iz, 1, 0, 0, each)                                                                              \
    CORNER(spot, h01 ^ iz, 0, 1, 0, each)                                                                              \
    CORNER(spot, h11 ^ iz, 1, 1, 0, each)                                                                              \
    if ((spot)->low[3] != 0) {                                                                                         \
        CORNER(spot, h00 ^ (iz + 1), 0, 0, 1, each)                                                                    \
        CORNER(spot, h10 ^ (iz + 1), 1, 0, 1, each)                                                                    \
        CORNER(spot, h01 ^ (iz + 1), 0, 1, 1, each)                                                                    \
        CORNER(spot, h11 ^ (iz + 1), 1, 1, 1, each)                                                                    \
    }

#define CORNER(spot, hash, x, y, z, each)                                                                              \
    {                                                                                                                  \
        const double *table = noise_gradients + last[hash];                                                            \
        Quad factors = ((spot)->low - (Quad){ 0, x, y, z }) * (spot)->weight[(x) + 2 * (y) + 4 * (z)];                 \
        each                                                                                                           \
    }

/* The lanes of a sum are added crosswise, (0 + 2) + (1 + 3); this is the first half of that. */
static inline Pair halves(Quad v)
{
    return (Pair){ v[0], v[1] } + (Pair){ v[2], v[3] };
}

static inline Pair spot_noise(const Spot *spot)
{
    Quad sum = { 0 };
    FOR_CORNERS(spot, sum += factors * load(table);)
    return halves(sum);
}

typedef struct PairAndOne { Pair xy; double z; } PairAndOne;

static inline PairAndOne vector_of(Quad dx, Quad dy, Quad dz)
{
    Pair x = halves(dx), y = halves(dy), z = halves(dz);
    return (PairAndOne){ (Pair){ x[0], y[0] } + (Pair){ x[1], y[1] }, z[0] + z[1] };
}

/* Stored as it will be loaded: in two parts. */
static inline Vec3 vector_stored(PairAndOne v)
{
    Vec3 out;
    memcpy(&out, &v.xy, sizeof v.xy);
    out.z = v.z;
    return out;
}

static inline PairAndOne spot_vector(const Spot *spot)
{
    Quad dx = { 0 }, dy = { 0 }, dz = { 0 };
    FOR_CORNERS(spot, dx += factors * load(table); dy += factors * load(table + 4); dz += factors * load(table + 8);)
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
static inline bool spot_of(Spot *spot, Vec3 p)
{
    if (spots_set(spot, p, 1, 1, 1))
        return true;
    if (is_far(p))
        return false;
    spot_set(spot, p);
    return true;
}

static inline double value_at(int generator, Vec3 p)
{
    Spot spot;
    if (generator == 3)
        return is_far(p) ? 0.5 : clamp(0.5 * (1.59 * raw3(p) + 0.985));
    return spot_of(&spot, p) ? value_of(generator, spot_noise(&spot)) : 0.5;
}

static double value(int generator, const Vec3 *p)
{
    return value_at(generator, *p);
}

static inline void octaves(int generator, const Vec3 *p, double first, double step, int n, double *out)
{
    Spot spot[MAX_OCTAVES];
    Pair sum[MAX_OCTAVES];
    if (generator == 3 || !spots_set(spot, *p, first, step, n)) {
        for (int k = 0; k < n; k++, first *= step)
            out[k] = value_at(generator, scaled(*p, first));
        return;
    }
    for (int k = 0; k < n; k++)
        sum[k] = spot_noise(&spot[k]);
    for (int k = 0; k + 2 <= n; k += 2) {
        Pair v = values_of(generator, sum[k], sum[k + 1]);
        out[k] = v[0];
        out[k + 1] = v[1];
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

static inline PairAndOne vector_at(Vec3 p)
{
    Spot spot;
    return spot_of(&spot, p) ? spot_vector(&spot) : (PairAndOne){ { 0 }, 0 };
}

static Vec3 vector(const Vec3 *p)
{
    return vector_stored(vector_at(*p));
}

static void vector_octaves(const Vec3 *p, double first, double step, int n, Vec3 *out)
{
    Spot spot[MAX_OCTAVES];
    if (spots_set(spot, *p, first, step, n))
        for (int k = 0; k < n; k++)
            out[k] = vector_stored(spot_vector(&spot[k]));
    else
        for (int k = 0; k < n; k++, first *= step)
            out[k] = vector_stored(vector_at(scaled(*p, first)));
}

static Vec3 vector_turbulence(const Vec3 *p, int n, double omega, double lambda)
{
    Spot spot[MAX_OCTAVES];
    double weight = omega, scale = lambda;
    bool near = spots_set(spot, *p, 1, lambda, n);
    PairAndOne sum = near ? spot_vector(&spot[0]) : vector_at(*p);
    for (int k = 1; k < n; k++, weight *= omega, scale *= lambda) {
        PairAndOne v = near ? spot_vector(&spot[k]) : vector_at(scaled(*p, scale));
        sum.xy += v.xy * weight;
        sum.z += v.z * weight;
    }
    return vector_stored(sum);
}

/* x and y of a vector: two thirds of the work. */
static inline Pair spot_pair(const Spot *spot)
{
    Quad dx = { 0 }, dy = { 0 };
    FOR_CORNERS(spot, dx += factors * load(table); dy += factors * load(table + 4);)
    Pair x = halves(dx), y = halves(dy);
    return (Pair){ x[0], y[0] } + (Pair){ x[1], y[1] };
}

static Vec2 pair_turbulence(const Vec3 *p, int n, double omega, double lambda)
{
    Spot spot[MAX_OCTAVES];
    if (!spots_set(spot, *p, 1, lambda, n)) {
        Vec3 v = vector_turbulence(p, n, omega, lambda);
        return (Vec2){ v.x, v.y };
    }
    Pair sum = spot_pair(&spot[0]);
    double weight = omega;
    for (int k = 1; k < n; k++, weight *= omega)
        sum += spot_pair(&spot[k]) * weight;
    return (Vec2){ sum[0], sum[1] };
}

/* ---- random points ---- */

#ifdef __AVX2__

/* Row by row along z, whose three points are lanes; the fourth is infinitely far. No point is passed over, and nothing branches. */
static void two_nearest(const NoiseCube *cube, const Vec3 *p, double square[2])
{
    const uint16_t *h = noise_tables.hash;
    const double *random = noise_tables.random;
    unsigned before = (cube->z - 1) & 4095, at = cube->z & 4095, behind = (cube->z + 1) & 4095;
    Quad px = quad(p->x), py = quad(p->y), pz = quad(p->z);
    Quad z = { cube->low.z - 1, cube->low.z, cube->low.z + 1, INFINITY };
    Quad first = quad(INFINITY), second = first;
    for (int i = -1; i <= 1; i++) {
        unsigned slice = h[(cube->x + i) & 4095];
        Quad x = quad(cube->low.x + i);
        for (int j = -1; j <= 1; j++) {
            unsigned row = h[slice ^ ((cube->y + j) & 4095)];
            Quad y = quad(cube->low.y + j);
            Quad a = load(random + h[row ^ before]), b = load(random + h[row ^ at]), c = load(random + h[row ^ behind]);
            Quad even = __builtin_shufflevector(a, b, 0, 4, 2, 6), odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
            Quad dx = px - (x + __builtin_shufflevector(even, c, 0, 1, 4, 5));
            Quad dy = py - (y + __builtin_shufflevector(odd, c, 0, 1, 5, 5));
            Quad dz = pz - (z + __builtin_shufflevector(even, c, 2, 3, 6, 7));
            Quad s = dx * dx + dy * dy + dz * dz;
            second = _mm256_min_pd(second, _mm256_max_pd(first, s));
            first = _mm256_min_pd(first, s);
        }
    }
    double least = first[0], next = second[0];
    for (int k = 1; k < 3; k++) {
        double a = first[k], b = second[k], more = least > a ? least : a;
        least = least < a ? least : a;
        next = next < b ? next : b;
        next = next < more ? next : more;
    }
    square[0] = least;
    square[1] = next;
}

#define TWO_NEAREST two_nearest

#else

#define TWO_NEAREST 0                          /* by twos it is faster to pass over far points */

#endif

const NoiseKernel ISA_NAME(noise_kernel)[1] = { {
    .value = value, .vector = vector, .octaves = octaves, .vector_octaves = vector_octaves,
    .two_nearest = TWO_NEAREST, .ridges = ridges, .turbulence = turbulence, .vector_turbulence = vector_turbulence,
    .pair_turbulence = pair_turbulence,
} };
