/* julia_kernel.c - orbits of Julia sets, as many points at once as there are lanes, built once per instruction set with the same bits.
 *
 * One orbit is a chain of dependent operations, so that a second point costs next to nothing. A ray in small steps asks several points
 * ahead at once, and a bisection those of its next levels. (08-shapes, section 15.) */
#include "shape/julia.h"

#include <string.h>

#include "base/cpu.h"
#include "base/wide.h"

typedef double LanesInMemory __attribute__((vector_size(8 * WIDTH), aligned(8), may_alias));

enum { ALL = (1 << WIDTH) - 1 };

INLINE Lanes load(const double *from) { return *(const LanesInMemory *)from; }
INLINE void store(double *to, Lanes a) { *(LanesInMemory *)to = a; }
INLINE Lanes least_of(Lanes a, Lanes b) { return chosen(a < b, a, b); }
INLINE Lanes most_of(Lanes a, Lanes b) { return chosen(a > b, a, b); }

INLINE Lanes root(Lanes a)
{
    Lanes out;
    for (int i = 0; i < WIDTH; i++)
        out[i] = __builtin_sqrt(a[i]);
    return out;
}

typedef struct { Lanes x, y, z, t; } Points;   /* t: the fourth coordinate */

INLINE Points started(const JuliaSet *j, Lanes x, Lanes y, Lanes z)
{
    if (j->level)
        return (Points){ x, y, z, all(j->fourth) };
    return (Points){ x, y, z, (j->slice_distance - (j->slice.x * x + j->slice.y * y + j->slice.z * z)) / j->slice.t };
}

INLINE Points on_line(const JuliaSet *j, const JuliaLine *l, Lanes s)
{
    return started(j, l->o.x + l->u.x * s, l->o.y + l->u.y * s, l->o.z + l->u.z * s);
}

/* ---- quaternions ---- */

INLINE Lanes norm2(Points a) { return a.x * a.x + a.y * a.y + a.z * a.z + a.t * a.t; }

/* s + v to s^2 - |v|^2 + 2 s v, or to s^3 - 3 s |v|^2 + (3 s^2 - |v|^2) v: a power stays in the plane of 1 and v. */
INLINE Points quaternion_next(Vec4 c, bool cube, Points p)
{
    Lanes ss = p.x * p.x, vv = p.y * p.y + p.z * p.z + p.t * p.t, real = ss - vv, f = 2 * p.x;
    if (cube) {
        real = p.x * (ss - 3 * vv);
        f = 3 * ss - vv;
    }
    return (Points){ real + c.x, f * p.y + c.y, f * p.z + c.z, f * p.t + c.t };
}

INLINE uint32_t quaternion_holds(const JuliaSet *j, Points p, bool cube)
{
    Mask alive = (Mask)all(0) == 0;
    uint32_t left = ALL;
    for (int k = 0; k < j->n && left != 0; k++) {
        alive &= norm2(p) <= j->escape;
        left = bits(alive);
        p = quaternion_next(j->c, cube, p);
    }
    return left;
}

/* 2^-k, or 0 far down where it does not matter. */
INLINE double halved(int k)
{
    uint64_t bits_of = k < 1023 ? (uint64_t)(1023 - k) << 52 : 0;
    double out;
    memcpy(&out, &bits_of, sizeof out);
    return out;
}

/* The distance from a point that is lost after k steps, about. */
INLINE double estimated(double norm, double product, int k, bool cube)
{
    double estimate = log(norm) / sqrt(product);
    if (cube)
        for (int i = 0; i <= k; i++)
            estimate *= 1 / 3.0;
    else
        estimate *= halved(k + 1);
    return isfinite(estimate) ? estimate : 0;
}

/* quaternion_ahead for one point. */
INLINE JuliaRun quaternion_at(const JuliaSet *j, Vec3 p, bool cube)
{
    Vec4 c = j->c, z = julia_start(j, p);
    double product = 1;
    for (int k = 0; k < j->n; k++) {
        double ss = z.x * z.x, yy = z.y * z.y, zz = z.z * z.z, tt = z.t * z.t, norm = ss + yy + zz + tt;
        if (!(norm <= j->escape)) {
            double step = estimated(norm, product, k, cube);
            return (JuliaRun){ 1, 0, step > j->step ? step : j->step };
        }
        product *= norm;
        double vv = yy + zz + tt, real = ss - vv, f = 2 * z.x;
        if (cube) {
            real = z.x * (ss - 3 * vv);
            f = 3 * ss - vv;
        }
        z = (Vec4){ real + c.x, f * z.y + c.y, f * z.z + c.z, f * z.t + c.t };
    }
    return (JuliaRun){ 1, 1, j->step };
}

/* Of the points beyond the first, those are good to which the ray goes by least steps. Few need their estimates: log x is at most
 * x / e and 1 + x / e^2. */
INLINE JuliaRun quaternion_ahead(const JuliaSet *j, Points p, bool cube)
{
    static const double e = 2.7182, tolerance = 1 - 1e-6;
    Mask alive = (Mask)all(0) == 0;
    Lanes norm = all(0), product = all(1), steps = all(-1), scale = all(cube ? 3 : 2);
    uint32_t left = ALL;
    bool first_is_near = false;
    int k = 0;
    for (; k < j->n; k++) {
        Lanes n2 = norm2(p);
        norm = chosen(alive, n2, norm);
        alive &= n2 <= j->escape;
        left = bits(alive);
        if (!(left & 1) && !first_is_near) {
            double step = estimated(norm[0], product[0], k, cube);
            if (step > j->step)
                return (JuliaRun){ 1, 0, step };
            first_is_near = true;
        }
        if (left == 0)
            break;
        product = chosen(alive, product * n2, product);
        scale = chosen(alive, scale * (cube ? 3.0 : 2.0), scale);
        steps = chosen(alive, all(k), steps);
        p = quaternion_next(j->c, cube, p);
    }
    Lanes most = least_of(norm / e, 1 + norm / (e * e));
    uint32_t far = ~(bits(most <= tolerance * j->step * root(product) * scale) | left) & ALL & ~1u;
    for (; far != 0; far &= far - 1) {
        int i = __builtin_ctz(far);
        double step = estimated(norm[i], product[i], (int)steps[i] + 1, cube);
        if (step > j->step)
            return (JuliaRun){ i + 1, left, step };
    }
    return (JuliaRun){ WIDTH, left, j->step };
}

/* z_n and its derivatives by x, y and z, side by side: d(z^2) = dz z + z dz. */
typedef double Quad __attribute__((vector_size(32)));
typedef struct { Quad x, y, z, t; } Quads;

INLINE Quads quads_times(Quads a, Quads b)
{
    return (Quads){ a.x * b.x - a.y * b.y - a.z * b.z - a.t * b.t, a.x * b.y + a.y * b.x + a.z * b.t - a.t * b.z,
                    a.x * b.z - a.y * b.t + a.z * b.x + a.t * b.y, a.x * b.t + a.y * b.z - a.z * b.y + a.t * b.x };
}

INLINE Quads quads_plus(Quads a, Quads b)
{
    return (Quads){ a.x + b.x, a.y + b.y, a.z + b.z, a.t + b.t };
}

INLINE Quads quads_of(Vec4 a)
{
    const Quad zero = { 0 };
    return (Quads){ zero + a.x, zero + a.y, zero + a.z, zero + a.t };
}

INLINE Vec3 quaternion_normal(const JuliaSet *j, Vec3 p, bool cube)
{
    Quads z = quads_of(julia_start(j, p)), c = quads_of(j->c), d = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 0 } };
    for (int i = 0; i < j->n; i++) {
        Quads slope = quads_plus(quads_times(d, z), quads_times(z, d));
        if (cube)
            slope = quads_plus(quads_times(slope, z), quads_times(quads_times(z, z), d));
        d = slope;
        Quad ss = z.x * z.x, vv = z.y * z.y + z.z * z.z + z.t * z.t, real = ss - vv, f = 2 * z.x;
        if (cube) {
            real = z.x * (ss - 3 * vv);
            f = 3 * ss - vv;
        }
        z = (Quads){ real + c.x, f * z.y + c.y, f * z.z + c.z, f * z.t + c.t };
    }
    Quad n = d.x * z.x + d.y * z.y + d.z * z.z + d.t * z.t;
    return vec3(n[0], n[1], n[2]);
}

/* ---- the square of hypercomplex numbers ---- */

/* Two complex numbers on which everything acts alike: (x - t, y + z) and (x + t, y - z). */
typedef struct { Lanes ar, ai, br, bi; } Pairs;

INLINE Pairs pairs_of(Points p)
{
    return (Pairs){ p.x - p.t, p.y + p.z, p.x + p.t, p.y - p.z };
}

INLINE Points of_pairs(Pairs p)
{
    return (Points){ 0.5 * (p.ar + p.br), 0.5 * (p.ai + p.bi), 0.5 * (p.ai - p.bi), 0.5 * (p.br - p.ar) };
}

INLINE Pairs chosen_pairs(Mask m, Pairs p, Pairs q)
{
    return (Pairs){ chosen(m, p.ar, q.ar), chosen(m, p.ai, q.ai), chosen(m, p.br, q.br), chosen(m, p.bi, q.bi) };
}

INLINE Pairs pairs_times(Pairs p, Pairs q)
{
    return (Pairs){ p.ar * q.ar - p.ai * q.ai, p.ar * q.ai + p.ai * q.ar, p.br * q.br - p.bi * q.bi, p.br * q.bi + p.bi * q.br };
}

/* Twice |p|^2. */
INLINE Lanes pairs_norm2(Pairs p)
{
    return p.ar * p.ar + p.ai * p.ai + (p.br * p.br + p.bi * p.bi);
}

INLINE Pairs square_next(Vec4 c, Pairs p)
{
    return (Pairs){ p.ar * p.ar - p.ai * p.ai + (c.x - c.t), 2 * p.ar * p.ai + (c.y + c.z),
                    p.br * p.br - p.bi * p.bi + (c.x + c.t), 2 * p.br * p.bi + (c.y - c.z) };
}

INLINE uint32_t square_holds(const JuliaSet *j, Points start)
{
    Pairs p = pairs_of(start);
    Mask alive = (Mask)all(0) == 0;
    uint32_t left = ALL;
    for (int k = 0; k < j->n && left != 0; k++) {
        alive &= pairs_norm2(p) <= 2 * j->escape;
        left = bits(alive);
        p = square_next(j->c, p);
    }
    return left;
}

/* d . gradient of |z_k|^2 / 2 along the orbit, as the reference has it. */
INLINE Lanes square_slope(Pairs product, Pairs last, Lanes factor, Vec3 d)
{
    Points m = of_pairs(product), z = of_pairs(last);
    Lanes x = factor * (m.x * z.x + m.y * z.y + m.z * z.z + m.t * z.t),
          y = factor * (-m.y * z.x + m.x * z.y - m.t * z.z + m.z * z.t),
          w = factor * (-m.z * z.x - m.t * z.y + m.x * z.z + m.y * z.t);
    return x * d.x + y * d.y + w * d.z;
}

INLINE JuliaRun square_ahead(const JuliaSet *j, Points start, Vec3 u)
{
    Pairs p = pairs_of(start), product = { all(1), all(0), all(1), all(0) };
    Mask alive = (Mask)all(0) == 0;
    Lanes factor = all(1);                     /* 2^k */
    uint32_t left = ALL;
    for (int k = 0; k < j->n; k++) {
        alive &= pairs_norm2(p) <= 2 * j->escape;
        left = bits(alive);
        if (left == 0)
            break;
        product = chosen_pairs(alive, pairs_times(product, p), product);
        p = chosen_pairs(alive, square_next(j->c, p), p);
        factor = chosen(alive, factor * 2, factor);
    }
    Lanes slope = square_slope(product, p, factor, u), estimate = 0.5 * pairs_norm2(p) / (-2 * slope);
    uint32_t far = bits((slope < -1e-8) & (estimate > j->step) & (estimate < 30 * j->step)) & ~left;
    if (far == 0)
        return (JuliaRun){ WIDTH, left, j->step };
    int i = __builtin_ctz(far);
    double step[WIDTH];
    store(step, estimate);
    return (JuliaRun){ i + 1, left, step[i] };
}

/* ---- both ---- */

INLINE uint32_t holds(const JuliaSet *j, Points p)
{
    return j->hypercomplex ? square_holds(j, p) : j->cube ? quaternion_holds(j, p, true) : quaternion_holds(j, p, false);
}

JuliaRun ISA_NAME(julia_ahead)(const JuliaSet *j, const JuliaLine *l, double s, bool alone)
{
    if (alone && !j->hypercomplex) {
        Vec3 p = add(l->o, scaled(l->u, s));
        return j->cube ? quaternion_at(j, p, true) : quaternion_at(j, p, false);
    }
    double at[WIDTH];
    for (int i = 0; i < WIDTH; i++, s += j->step)
        at[i] = s;
    Points p = on_line(j, l, load(at));
    return j->hypercomplex ? square_ahead(j, p, l->u) : j->cube ? quaternion_ahead(j, p, true) : quaternion_ahead(j, p, false);
}

/* A tree of middles: those of [lo, middle i] and [middle i, hi] are the numbers 2 i and 2 i + 1. */
double ISA_NAME(julia_closed_in)(const JuliaSet *j, const JuliaLine *l, double lo, double hi, bool inside_lo)
{
    double from[2 * WIDTH], to[2 * WIDTH], middle[WIDTH];
    for (;;) {
        from[1] = lo;
        to[1] = hi;
        for (int i = 1; i < WIDTH; i++) {
            middle[i] = 0.5 * (from[i] + to[i]);
            from[2 * i] = from[i];
            to[2 * i] = from[2 * i + 1] = middle[i];
            to[2 * i + 1] = to[i];
        }
        middle[0] = middle[1];
        uint32_t inside = holds(j, on_line(j, l, load(middle)));
        for (int i = 1; i < WIDTH;) {
            if (!(hi - lo > JULIA_ACCURACY) || middle[i] <= lo || middle[i] >= hi)
                return inside_lo ? lo : hi;
            bool is_lo = (inside >> i & 1) == inside_lo;
            *(is_lo ? &lo : &hi) = middle[i];
            i = 2 * i + is_lo;
        }
    }
}

Vec3 ISA_NAME(julia_normal)(const JuliaSet *j, Vec3 p)
{
    return j->cube ? quaternion_normal(j, p, true) : quaternion_normal(j, p, false);
}

/* ---- balls ---- */

/* The ball around a point of this size, a step on: |(z + d)^n - z^n| <= (|z| + |d|)^n - |z|^n. */
INLINE Lanes grown(Lanes size, Lanes r, bool cube)
{
    return cube ? r * (3 * size * (size + r) + r * r) : r * (2 * size + r);
}

/* Balls grow: one that has grown beyond this tells nothing more, and no point of the others is so far off that squares overflow. */
static const double WIDE = 1e3;
enum { ENOUGH = 50 };                          /* steps; those that still shrink then lie inside */

/* Which balls have a point that might not be lost? */
INLINE uint32_t quaternion_may_hold(const JuliaSet *j, Points p, Lanes r, double limit)
{
    Mask alive = (Mask)all(0) == 0, wide = ~alive;
    for (int k = 0; k < j->n && k < ENOUGH && bits(alive & ~wide) != 0; k++) {
        Lanes size = root(norm2(p));
        alive &= wide | ~(size - r > limit);
        r = grown(size, r, j->cube);
        wide |= r > WIDE;
        p = quaternion_next(j->c, j->cube, p);
    }
    return bits(alive);
}

INLINE uint32_t square_may_hold(const JuliaSet *j, Points start, Lanes r, double limit)
{
    Pairs p = pairs_of(start);
    Lanes ra = r, rb = r;
    Mask alive = (Mask)all(0) == 0, wide = ~alive;
    for (int k = 0; k < j->n && k < ENOUGH && bits(alive & ~wide) != 0; k++) {
        Lanes a = root(p.ar * p.ar + p.ai * p.ai), b = root(p.br * p.br + p.bi * p.bi);
        Lanes least_a = most_of(a - ra, all(0)), least_b = most_of(b - rb, all(0));
        alive &= wide | ~(0.5 * (least_a * least_a + least_b * least_b) > limit * limit);
        ra = grown(a, ra, false);
        rb = grown(b, rb, false);
        wide |= (ra > WIDE) | (rb > WIDE);
        p = square_next(j->c, p);
    }
    return bits(alive);
}

/* The fourth coordinate follows the slope of the slice; each number of a pair moves by up to sqrt(2) times as much. */
uint32_t ISA_NAME(julia_may_hold)(const JuliaSet *j, const Vec3 centre[8], double radius)
{
    double x[8], y[8], z[8], r = radius / fabs(j->slice.t), limit = sqrt(j->escape) * (1 + 1e-6);
    uint32_t out = 0;
    for (int i = 0; i < 8; i++) {
        x[i] = centre[i].x;
        y[i] = centre[i].y;
        z[i] = centre[i].z;
    }
    for (int i = 0; i < 8; i += WIDTH) {
        Points p = started(j, load(x + i), load(y + i), load(z + i));
        out |= (j->hypercomplex ? square_may_hold(j, p, all(sqrt(2) * r), limit) : quaternion_may_hold(j, p, all(r), limit)) << i;
    }
    return out;
}
