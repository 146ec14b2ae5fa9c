/* noise_kernel.c - the arithmetic of noise, built once per instruction set with the same bits.
 *
 * Each of the eight corners of a lattice cell gives w (R0/2 + R1 dx + R2 dy + R3 dz): four neighbouring numbers of the table
 * times (1/2, dx, dy, dz). Those four products are the lanes of a vector and the sum over corners runs lane by lane, so
 * that a corner costs one load and three operations. The octaves of a turbulence do not depend on each other and
 * overlap in the processor by themselves. */
#include "base/cpu.h"
#include "math/noise_tables.h"

typedef double Quad __attribute__((vector_size(32)));
typedef double QuadInMemory __attribute__((vector_size(32), aligned(8), may_alias));

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

static inline Quad load(const double *from)
{
    return *(const QuadInMemory *)from;
}

/* Finds the cell of p and does `each` with the corner's numbers in R (`table`) and w (1/2, dx, dy, dz) (`factors`). All in
 * named values: arrays would pass through memory and stall. */
#define FOR_CORNERS(p, each)                                                                                           \
    const uint16_t *h = noise_tables.hash;                                                                             \
    const uint8_t *last = noise_tables.corner;                                                                         \
    long long mx = low_corner(p.x), my = low_corner(p.y), mz = low_corner(p.z);                                        \
    double x = p.x - (double)mx, y = p.y - (double)my, z = p.z - (double)mz;                                           \
    unsigned ix = (mx + 10000) & 4095, iy = (my + 10000) & 4095, iz = (mz + 10000) & 4095;                             \
    double sx = x * x * (3 - 2 * x), sy = y * y * (3 - 2 * y), sz = z * z * (3 - 2 * z);                               \
    double tx = 1 - sx, ty = 1 - sy, tz = 1 - sz;                                                                      \
    unsigned h0 = h[ix], h1 = h[ix + 1];                                                                               \
    unsigned h00 = h[h0 ^ iy], h10 = h[h1 ^ iy], h01 = h[h0 ^ (iy + 1)], h11 = h[h1 ^ (iy + 1)];                       \
    double w00 = tx * ty, w10 = sx * ty, w01 = tx * sy, w11 = sx * sy;                                                 \
    Quad low = { 0.5, x, y, z };                                                                                       \
    CORNER(h00 ^ iz, 0, 0, 0, w00 * tz, each)                                                                          \
    CORNER(h10 ^ iz, 1, 0, 0, w10 * tz, each)                                                                          \
    CORNER(h01 ^ iz, 0, 1, 0, w01 * tz, each)                                                                          \
    CORNER(h11 ^ iz, 1, 1, 0, w11 * tz, each)                                                                          \
    CORNER(h00 ^ (iz + 1), 0, 0, 1, w00 * sz, each)                                                                    \
    CORNER(h10 ^ (iz + 1), 1, 0, 1, w10 * sz, each)                                                                    \
    CORNER(h01 ^ (iz + 1), 0, 1, 1, w01 * sz, each)                                                                    \
    CORNER(h11 ^ (iz + 1), 1, 1, 1, w11 * sz, each)

#define CORNER(hash, a, b, c, weight, each)                                                                            \
    {                                                                                                                  \
        const double *table = noise_gradients + last[hash];                                                            \
        Quad factors = (low - (Quad){ 0, a, b, c }) * (weight);                                                        \
        each                                                                                                           \
    }

static inline double sum_of(Quad v)
{
    return (v[0] + v[2]) + (v[1] + v[3]);
}

static inline double raw(Vec3 p)
{
    Quad sum = { 0 };
    FOR_CORNERS(p, sum += factors * load(table);)
    return sum_of(sum);
}

static inline Vec3 vector(Vec3 p)
{
    if (is_far(p))
        return vec3(0, 0, 0);
    Quad dx = { 0 }, dy = { 0 }, dz = { 0 };
    FOR_CORNERS(p, dx += factors * load(table); dy += factors * load(table + 4); dz += factors * load(table + 8);)
    return vec3(sum_of(dx), sum_of(dy), sum_of(dz));
}

static inline void axis3(double x, unsigned *low, unsigned *high, double *r)
{
    double t = x + 10000000.023157213, k = floor(t);
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
    return sum_of(layer[0] + (layer[1] - layer[0]) * sz);
}

/* Written so that it becomes two instructions without a branch. */
static inline double clamp(double v)
{
    v = v > 0 ? v : 0;
    return v < 1 ? v : 1;
}

static inline double value(int generator, Vec3 p)
{
    if (is_far(p))
        return 0.5;
    switch (generator) {
    case 2: return clamp((raw(p) + 1.05242) * 0.48985582);
    case 3: return clamp(0.5 * (1.59 * raw3(p) + 0.985));
    default: return clamp(raw(p) + 0.5);
    }
}

static void octaves(int generator, Vec3 p, double first, double step, int n, double *out)
{
    for (int k = 0; k < n; k++, first *= step)
        out[k] = value(generator, scaled(p, first));
}

/* Generators 2 and 3 are stretched about the middle; only the first term is clamped. */
static double turbulence(int generator, Vec3 p, int n, double omega, double lambda)
{
    bool stretched = generator >= 2;
    double first = value(generator, p);
    double sum = stretched ? clamp(2 * first - 0.5) : first;
    double weight = omega, l = lambda;
    for (int k = 1; k < n; k++, weight *= omega, l *= lambda) {
        double v = value(generator, scaled(p, l));
        sum += weight * (stretched ? 2 * v - 0.5 : v);
    }
    return sum;
}

static Vec3 vector_turbulence(Vec3 p, int n, double omega, double lambda)
{
    Vec3 sum = vector(p);
    double weight = omega, l = lambda;
    for (int k = 1; k < n; k++, weight *= omega, l *= lambda)
        sum = add(sum, scaled(vector(scaled(p, l)), weight));
    return sum;
}

const NoiseKernel ISA_NAME(noise_kernel)[1] = { {
    .value = value, .vector = vector, .octaves = octaves, .turbulence = turbulence, .vector_turbulence = vector_turbulence,
} };
