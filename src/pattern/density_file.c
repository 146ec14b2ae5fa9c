/* density_file.c - a block of voxels from a df3 file, over the unit cube. */
#include "base/simd.h"
#include "sdl/parse.h"

typedef struct {
    unsigned size[3];
    int interpolate;                           /* 0 none, 1 linear, 2 cubic */
    int bytes;                                 /* per voxel: 1, 2, 4, big-endian */
    double most;                               /* what they can say */
    const unsigned char *voxel;
} Density;

static void parse(Parser *p, void *params)
{
    Density d = { 0 };
    parse_expect(p, KW_DF3);
    Loc where = parse_loc(p);
    Str name = parse_file_name(p);
    Str file = parse_read_file(p, name, where);
    const unsigned char *b = (const unsigned char *)file.data;
    if (file.n < 6)
        fail(parse_diag(p), where, "the density file \"%.*s\" has no header", STR_ARGS(name));
    for (int i = 0; i < 3; i++)
        d.size[i] = (unsigned)b[2 * i] << 8 | b[2 * i + 1];
    uint64_t n = (uint64_t)d.size[0] * d.size[1] * d.size[2], have = file.n - 6;
    d.bytes = n == 0 ? 0 : have >= 4 * n ? 4 : have >= 2 * n ? 2 : have >= n ? 1 : 0;
    if (d.bytes == 0)
        fail(parse_diag(p), where, "the density file \"%.*s\" says %u x %u x %u voxels and holds %llu bytes", STR_ARGS(name),
             d.size[0], d.size[1], d.size[2], (unsigned long long)have);
    d.most = d.bytes == 1 ? 255 : d.bytes == 2 ? 65535 : 4294967295;
    d.voxel = b + 6;
    *(Density *)params = d;
}

static bool item(Parser *p, void *params)
{
    if (!parse_accept(p, KW_INTERPOLATE))
        return false;
    int kind = parse_int(p) % 10;
    ((Density *)params)->interpolate = kind == 0 || kind == 1 ? kind : 2;
    return true;
}

/* To be divided by `most`. */
static inline double number(const unsigned char *v, int bytes)
{
    switch (bytes) {
    case 1: return v[0];
    case 2: return v[0] << 8 | v[1];
    default: return (uint32_t)v[0] << 24 | (uint32_t)v[1] << 16 | (uint32_t)v[2] << 8 | v[3];
    }
}

static double voxel(const Density *d, unsigned x, unsigned y, unsigned z)
{
    uint64_t at = ((uint64_t)z * d->size[1] + y) * d->size[0] + x;
    return number(d->voxel + at * (unsigned)d->bytes, d->bytes) / d->most;
}

static unsigned wrapped(uint64_t i, unsigned size)
{
    return (unsigned)(i < size ? i : i % size);        /* mostly without a quotient */
}

/* Two neighbours along x, times their weights. */
static inline double add_pair(double sum, const unsigned char *row, const uint64_t x[2], int bytes, double most, d2 weight)
{
    d2 v = d2_mul(weight, d2_div(d2_of(number(row + x[0], bytes), number(row + x[1], bytes)), d2_set(most)));
    return sum + d2_low(v) + d2_high(v);
}

/* The sample sits at the voxel's low corner, and the last one blends into the first. */
static inline double blended(const Density *d, const unsigned cell[3], const double f[3], int bytes)
{
    uint64_t step[3][2], stride = (unsigned)bytes;
    for (int a = 0; a < 3; a++) {
        step[a][0] = cell[a] * stride;
        step[a][1] = wrapped((uint64_t)cell[a] + 1, d->size[a]) * stride;
        stride *= d->size[a];
    }
    const unsigned char *low = d->voxel + step[2][0], *high = d->voxel + step[2][1];
    d2 x = d2_of(1 - f[0], f[0]), near = d2_mul(x, d2_set(1 - f[1])), far = d2_mul(x, d2_set(f[1])), z0 = d2_set(1 - f[2]), z1 = d2_set(f[2]);
    double sum = add_pair(0, low + step[1][0], step[0], bytes, d->most, d2_mul(near, z0));
    sum = add_pair(sum, low + step[1][1], step[0], bytes, d->most, d2_mul(far, z0));
    sum = add_pair(sum, high + step[1][0], step[0], bytes, d->most, d2_mul(near, z1));
    return add_pair(sum, high + step[1][1], step[0], bytes, d->most, d2_mul(far, z1));
}

static double linear(const Density *d, const unsigned cell[3], const double f[3])
{
    return d->bytes == 1 ? blended(d, cell, f, 1) : blended(d, cell, f, d->bytes);     /* nearly always 1 */
}

static float cubic_through(const float v[4], float t)
{
    float slope = (v[2] - v[0]) / 2, next = (v[3] - v[1]) / 2;
    float e = 2 * (v[1] - v[2]) + slope + next, f = -3 * (v[1] - v[2]) - 2 * slope - next;
    return ((e * t + f) * t + slope) * t + v[1];
}

static double cubic(const Density *d, const unsigned cell[3], const double f[3])
{
    unsigned at[3][4];
    for (int a = 0; a < 3; a++)
        for (unsigned k = 0; k < 4; k++)
            /* POV: one before the first is (2^64 - 1) mod size, not the last. */
            at[a][k] = wrapped((uint64_t)cell[a] + k - 1, d->size[a]);
    float along_x[4];
    for (int i = 0; i < 4; i++) {
        float along_y[4];
        for (int j = 0; j < 4; j++) {
            float along_z[4];
            for (int k = 0; k < 4; k++)
                along_z[k] = (float)voxel(d, at[0][i], at[1][j], at[2][k]);
            along_y[j] = cubic_through(along_z, (float)f[2]);
        }
        along_x[i] = cubic_through(along_y, (float)f[1]);
    }
    float v = cubic_through(along_x, (float)f[0]);
    return v < 0 ? 0 : (double)v;
}

static double value(const void *params, const PatternPoint *at)
{
    const Density *d = params;
    const double p[3] = { at->p.x, at->p.y, at->p.z };
    unsigned cell[3];
    double f[3];
    for (int a = 0; a < 3; a++) {
        if (!(p[a] >= 0 && p[a] < 1))
            return 0;
        double u = p[a] * d->size[a];
        cell[a] = (unsigned)u;
        f[a] = u - cell[a];
        if (cell[a] >= d->size[a])
            cell[a] = d->size[a] - 1;
    }
    switch (d->interpolate) {
    case 0: return voxel(d, cell[0], cell[1], cell[2]);
    case 1: return linear(d, cell, f);
    default: return cubic(d, cell, f);
    }
}

const PatternOps pattern_density_file = {
    .keyword = "density_file", .params_size = sizeof(Density), .parse = parse, .item = item, .value = value,
};
