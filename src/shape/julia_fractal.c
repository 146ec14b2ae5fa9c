/* julia_fractal.c - julia_fractal { c [quaternion | hypercomplex] [function] ... }: a slice of a four-dimensional Julia set.
 *
 * A point is inside when its orbit z -> f(z) + c stays small. A ray marches through the ball that holds the set, by
 * an estimate of the distance and at least by 1 / precision, and closes in where inside and outside change. The set has a
 * size of its own, so lengths here are as written, and the accuracy of 1e-7 is one of the set (08-shapes, section 15).
 * Sets of powers are marched through by julia_kernel.c, several points at a time, and no farther than clearance.c says. */
#include <complex.h>
#undef I

#include "base/cpu.h"
#include "sdl/parse.h"
#include "shape/clearance.h"
#include "shape/julia.h"
#include "shape/shape.h"

#ifndef CMPLX                                  /* clang with glibc before 2.36 */
#define CMPLX(re, im) __builtin_complex((double)(re), (double)(im))
#endif

typedef double complex Complex;
typedef Complex Map(Complex z, Complex exponent);

typedef struct {
    Vec4 c, slice;                             /* slice: normalised */
    double slice_distance;
    bool hypercomplex, cube;
    Map *map;                                  /* hypercomplex: NULL is the square */
    Complex exponent;                          /* of pwr */
    int n;
    double precision;
} Params;

typedef struct {
    JuliaSet set;
    Map *map;
    Complex exponent;
    const JuliaKernel *kernel;                 /* of sets of powers; NULL for other functions */
    Clearance air;                             /* around those */
} Julia;

enum { MOST_ITERATIONS = 10000 };

/* POV: rays leave a hit from its inner end. One that meets the surface again nearer than this goes through: that is dropped as the
 * surface that it left, and nothing else is looked for. It makes ragged surfaces lighter than shadows would. */
static const double NEAREST = 1e-3;

/* ---- the functions ---- */

static Complex map_exp(Complex z, Complex e) { (void)e; return cexp(z); }
static Complex map_reciprocal(Complex z, Complex e) { (void)e; return 1 / z; }
static Complex map_sin(Complex z, Complex e) { (void)e; return csin(z); }
static Complex map_asin(Complex z, Complex e) { (void)e; return casin(z); }
static Complex map_sinh(Complex z, Complex e) { (void)e; return csinh(z); }
static Complex map_asinh(Complex z, Complex e) { (void)e; return casinh(z); }
static Complex map_cos(Complex z, Complex e) { (void)e; return ccos(z); }
static Complex map_acos(Complex z, Complex e) { (void)e; return cacos(z); }
static Complex map_cosh(Complex z, Complex e) { (void)e; return ccosh(z); }
static Complex map_acosh(Complex z, Complex e) { (void)e; return clog(z + csqrt(z * z - 1)); }     /* POV: this branch */
static Complex map_tan(Complex z, Complex e) { (void)e; return ctan(z); }
static Complex map_atan(Complex z, Complex e) { (void)e; return catan(z); }
static Complex map_tanh(Complex z, Complex e) { (void)e; return ctanh(z); }
static Complex map_atanh(Complex z, Complex e) { (void)e; return catanh(z); }
static Complex map_ln(Complex z, Complex e) { (void)e; return clog(z); }
static Complex map_pwr(Complex z, Complex e) { return z == 0 ? 0 : cexp(e * clog(z)); }

static const struct { int keyword; Map *map; } maps[] = {
    { KW_EXP, map_exp }, { KW_RECIPROCAL, map_reciprocal }, { KW_SIN, map_sin }, { KW_ASIN, map_asin }, { KW_SINH, map_sinh },
    { KW_ASINH, map_asinh }, { KW_COS, map_cos }, { KW_ACOS, map_acos }, { KW_COSH, map_cosh }, { KW_ACOSH, map_acosh },
    { KW_TAN, map_tan }, { KW_ATAN, map_atan }, { KW_TANH, map_tanh }, { KW_ATANH, map_atanh }, { KW_LN, map_ln },
    { KW_PWR, map_pwr },
};

static Complex complex_of(double re, double im)
{
    return CMPLX(re, im);
}

/* ---- parsing ---- */

static void parse_slice(Parser *p, Params *j)
{
    Vec4 s = parse_vec4(p);
    parse_comma(p);
    double d = parse_float(p), len = sqrt(s.x * s.x + s.y * s.y + s.z * s.z + s.t * s.t);
    if (!(len > 0))
        parse_fail(p, "the slice of a julia_fractal needs a vector that is not zero");
    j->slice = (Vec4){ s.x / len, s.y / len, s.z / len, s.t / len };
    if (!(fabs(j->slice.t) > 1e-10))
        parse_fail(p, "the fourth number of the slice of a julia_fractal must not be zero");
    j->slice_distance = d;                     /* POV: not divided with it */
}

static bool item(Parser *p, void *params)
{
    Params *j = params;
    if (parse_accept(p, KW_MAX_ITERATION)) {
        int n = parse_int(p);
        j->n = n < 1 ? 1 : n < MOST_ITERATIONS ? n : MOST_ITERATIONS;
        return true;
    }
    if (parse_accept(p, KW_PRECISION)) {
        j->precision = fmax(1, parse_float(p));
        return true;
    }
    if (parse_accept(p, KW_SLICE)) {
        parse_slice(p, j);
        return true;
    }
    if (parse_accept(p, KW_QUATERNION)) {
        j->hypercomplex = false;
        return true;
    }
    if (parse_accept(p, KW_HYPERCOMPLEX)) {
        j->hypercomplex = true;
        return true;
    }
    if (parse_accept(p, KW_SQR) || (parse_peek(p) == KW_CUBE && (parse_skip(p), j->cube = true))) {
        j->map = NULL;
        return true;
    }
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++)
        if (parse_accept(p, maps[i].keyword)) {
            j->map = maps[i].map;
            if (maps[i].keyword == KW_PWR) {
                parse_expect(p, TOK_LPAREN);
                double x = parse_float(p), y = parse_next_float(p);
                parse_expect(p, TOK_RPAREN);
                j->exponent = complex_of(x, y);
            }
            return true;
        }
    return false;
}

static void parse(Parser *p, void *params)
{
    Params *j = params;
    j->c = parse_vec4(p);
    j->slice = (Vec4){ 0, 0, 0, 1 };
    j->n = 20;
    j->precision = 20;
    while (item(p, j))
        ;
}

static void finish(Parser *p, void *params)
{
    const Params *j = params;
    if (!j->hypercomplex && j->map != NULL)
        parse_fail(p, "a quaternion julia_fractal takes sqr or cube; other functions need the word hypercomplex");
}

static void bound(const Params *p, double *radius, double *escape)
{
    double c = sqrt(p->c.x * p->c.x + p->c.y * p->c.y + p->c.z * p->c.z + p->c.t * p->c.t);
    *radius = p->hypercomplex ? 4 : fmin(2, 1 + c + JULIA_ACCURACY);
    *escape = p->hypercomplex ? 16 : *radius * *radius + JULIA_ACCURACY;
}

static Bounds box_of(double r)
{
    return (Bounds){ vec3(-r, -r, -r), vec3(r, r, r) };
}

/* ---- orbits ---- */

static double norm2(Vec4 a) { return a.x * a.x + a.y * a.y + a.z * a.z + a.t * a.t; }

/* s + v to s^2 - |v|^2 + 2 s v, or to s^3 - 3 s |v|^2 + (3 s^2 - |v|^2) v: a power stays in the plane of 1 and v. */
static Vec4 quaternion_next(const Julia *j, Vec4 z)
{
    Vec4 c = j->set.c;
    double ss = z.x * z.x, vv = z.y * z.y + z.z * z.z + z.t * z.t, real = ss - vv, f = 2 * z.x;
    if (j->set.cube) {
        real = z.x * (ss - 3 * vv);
        f = 3 * ss - vv;
    }
    return (Vec4){ real + c.x, f * z.y + c.y, f * z.z + c.z, f * z.t + c.t };
}

static bool quaternion_holds(const Julia *j, Vec4 z)
{
    int k = 0;
    for (; k < j->set.n && norm2(z) <= j->set.escape; k++)
        z = quaternion_next(j, z);
    return k == j->set.n;
}

/* Two complex numbers on which everything hypercomplex acts alike: (x - w, y + z) and (x + w, y - z). */
typedef struct { Complex a, b; } Pair;

static Pair pair_of(Vec4 v)
{
    return (Pair){ complex_of(v.x - v.t, v.y + v.z), complex_of(v.x + v.t, v.y - v.z) };
}

static Vec4 of_pair(Pair p)
{
    return (Vec4){ 0.5 * (creal(p.a) + creal(p.b)), 0.5 * (cimag(p.a) + cimag(p.b)), 0.5 * (cimag(p.a) - cimag(p.b)),
                   0.5 * (creal(p.b) - creal(p.a)) };
}

/* Without C99's care for infinities: those are lost at the next test. */
static Complex times(Complex a, Complex b)
{
    return complex_of(creal(a) * creal(b) - cimag(a) * cimag(b), creal(a) * cimag(b) + cimag(a) * creal(b));
}

static Pair pair_times(Pair p, Pair q)
{
    return (Pair){ times(p.a, q.a), times(p.b, q.b) };
}

static double pair_norm2(Pair p)
{
    return 0.5 * (creal(p.a) * creal(p.a) + cimag(p.a) * cimag(p.a) + creal(p.b) * creal(p.b) + cimag(p.b) * cimag(p.b));
}

/* f(z), without the c. */
static Pair mapped(const Julia *j, Pair z)
{
    Map *map = j->map;
    return map == NULL ? pair_times(z, z) : (Pair){ map(z.a, j->exponent), map(z.b, j->exponent) };
}

/* What the orbit's normal takes for the derivative at z, up to a factor. POV: the value itself, but for square and reciprocal. */
static Pair slope_like(const Julia *j, Pair z, Pair f)
{
    if (j->map == map_reciprocal) {
        Pair s = pair_times(f, f);
        return (Pair){ -s.a, -s.b };
    }
    return j->map == NULL ? z : f;
}

/* hyper_orbit of the square, by far the commonest, in numbers that fit the registers. */
static int square_orbit(const Julia *j, double escape, Pair *z, double *norm, Pair *product)
{
    Pair c = pair_of(j->set.c);
    double ar = creal(z->a), ai = cimag(z->a), br = creal(z->b), bi = cimag(z->b), limit = 2 * escape, n2 = 0;
    double pr = 1, pi = 0, qr = 1, qi = 0, cr = creal(c.a), ci = cimag(c.a), dr = creal(c.b), di = cimag(c.b);
    int k = 0, n = j->set.n;
    for (; k < n; k++) {
        double aa = ar * ar, ai2 = ai * ai, bb = br * br, bi2 = bi * bi;
        n2 = aa + ai2 + (bb + bi2);
        if (!(n2 <= limit))
            break;
        double p = pr * ar - pi * ai, q = qr * br - qi * bi;
        pi = pr * ai + pi * ar;
        qi = qr * bi + qi * br;
        pr = p;
        qr = q;
        ai = 2 * ar * ai + ci;
        ar = aa - ai2 + cr;
        bi = 2 * br * bi + di;
        br = bb - bi2 + dr;
    }
    *norm = 0.5 * n2;
    *z = (Pair){ complex_of(ar, ai), complex_of(br, bi) };
    *product = (Pair){ complex_of(pr, pi), complex_of(qr, qi) };
    return k;
}

/* How many of n steps before |z|^2, in *norm, exceeds the limit. *z becomes the last point, *product that of the slopes. */
static int hyper_orbit(const Julia *j, double escape, Pair *z, double *norm, Pair *product)
{
    if (j->map == NULL)
        return square_orbit(j, escape, z, norm, product);
    Pair c = pair_of(j->set.c);
    int k = 0, n = j->set.n;
    *product = (Pair){ 1, 1 };
    for (; k < n && (*norm = pair_norm2(*z)) <= escape; k++) {
        Pair f = mapped(j, *z);
        *product = k == 0 ? *z : pair_times(*product, slope_like(j, *z, f));
        *z = (Pair){ f.a + c.a, f.b + c.b };
    }
    return k;
}

/* POV: for all functions but the square and the reciprocal the plain test, and so the normal, takes y for z as well. */
static Pair plain_start(const Julia *j, Vec3 p)
{
    bool odd = j->map != NULL && j->map != map_reciprocal;
    return pair_of(julia_start(&j->set, odd ? vec3(p.x, p.y, p.y) : p));
}

static bool holds(const Julia *j, Vec3 p)
{
    double norm;
    if (!j->set.hypercomplex)
        return quaternion_holds(j, julia_start(&j->set, p));
    Pair z = plain_start(j, p), c = pair_of(j->set.c), product;
    if (j->map == NULL)
        return square_orbit(j, j->set.escape, &z, &norm, &product) == j->set.n;
    for (int k = 0; k < j->set.n; k++) {
        if (!(pair_norm2(z) <= j->set.escape))
            return false;
        Pair f = mapped(j, z);
        z = (Pair){ f.a + c.a, f.b + c.b };
    }
    return true;
}

/* The gradient of |z_k|^2 / 2 along the orbit from z0, as the reference has it; for the square, up to a factor of 2^k. */
static Vec3 hyper_gradient(Pair product, Pair last)
{
    Vec4 m = of_pair(product), z = of_pair(last);
    return vec3(m.x * z.x + m.y * z.y + m.z * z.z + m.t * z.t, -m.y * z.x + m.x * z.y - m.t * z.z + m.z * z.t,
                -m.z * z.x - m.t * z.y + m.x * z.z + m.y * z.t);
}

/* Of a function other than the square: is p inside? If not, `step` is what the ray may go on by. */
static bool hyper_step(const Julia *j, Vec3 p, Vec3 d, double *step)
{
    Pair z = pair_of(julia_start(&j->set, p)), product;
    double n = 0;
    int k = hyper_orbit(j, j->set.escape, &z, &n, &product);
    *step = j->set.step;
    if (k == j->set.n)
        return true;
    double slope = dot(hyper_gradient(product, z), d);
    if (slope < -1e-8) {
        double estimate = n / (-2 * slope);
        if (estimate > j->set.step && estimate < 30 * j->set.step)
            *step = estimate;
    }
    return false;
}

/* ---- compiling ---- */

#define DECLARE(isa) \
    JuliaRun julia_ahead_##isa(const JuliaSet *, const JuliaLine *, double, bool); \
    double julia_closed_in_##isa(const JuliaSet *, const JuliaLine *, double, double, bool); \
    Vec3 julia_normal_##isa(const JuliaSet *, Vec3); \
    uint32_t julia_may_hold_##isa(const JuliaSet *, const Vec3 *, double); \
    static const JuliaKernel kernel_##isa = { julia_ahead_##isa, julia_closed_in_##isa, julia_normal_##isa, julia_may_hold_##isa };
CPU_ISAS(DECLARE)

static const JuliaKernel *kernel_of_machine(void)
{
    static const JuliaKernel *const kernel[] = CPU_TABLE(&kernel);
    return kernel[cpu_isa()];
}

static uint32_t may_hold(const void *solid, const Vec3 centre[8], double radius)
{
    const Julia *j = solid;
    return j->kernel->may_hold(&j->set, centre, radius);
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *p = params;
    Julia *out = build_data(b, sizeof *out);
    out->set = (JuliaSet){ .c = p->c, .slice = p->slice, .slice_distance = p->slice_distance, .hypercomplex = p->hypercomplex,
                           .cube = p->cube, .n = p->n, .step = 1 / p->precision };
    out->set.level = p->slice.x == 0 && p->slice.y == 0 && p->slice.z == 0;
    out->set.fourth = p->slice_distance / p->slice.t;
    bound(p, &out->set.radius, &out->set.escape);
    out->map = p->map;
    out->exponent = p->exponent;
    if (p->map == NULL) {
        out->kernel = kernel_of_machine();
        clearance_build(&out->air, may_hold, out, out->set.radius);
    }
    build_prim(b, out, &b->place, shape_padded(box_of(out->set.radius)));
}

/* ---- along a ray ---- */

static inline JuliaRun ahead(const Julia *j, const JuliaLine *l, double s, bool alone)
{
    if (j->kernel != NULL)
        return j->kernel->ahead(&j->set, l, s, alone);
    JuliaRun run = { .n = 1 };
    run.inside = hyper_step(j, add(l->o, scaled(l->u, s)), l->u, &run.step);
    return run;
}

static double closed_in(const Julia *j, const JuliaLine *l, double lo, double hi, bool inside_lo)
{
    if (j->kernel != NULL)
        return j->kernel->closed_in(&j->set, l, lo, hi, inside_lo);
    while (hi - lo > JULIA_ACCURACY) {
        double middle = 0.5 * (lo + hi);
        if (middle <= lo || middle >= hi)
            break;
        if (holds(j, add(l->o, scaled(l->u, middle))) == inside_lo)
            lo = middle;
        else
            hi = middle;
    }
    return inside_lo ? lo : hi;                /* the inner end */
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Julia *j = shape;
    double len = length(ray->d), shift = shape_nearest_t(ray);
    JuliaLine l = { ray_at(ray, shift), scaled(ray->d, 1 / len) };
    double h2 = j->set.radius * j->set.radius - length2(l.o);
    if (!(h2 > 0))
        return;
    double out = sqrt(h2), start = -shift * len, s = greater(-out, start + JULIA_ACCURACY);
    double air = j->kernel != NULL ? clearance_from(&j->air, l.o, l.u) : out;
    if (!(s < out) || s > air)
        return;
    double near = start > -out ? start + NEAREST : -INFINITY, limit = (hit_limit(sink) - shift) * len;
    JuliaRun run = ahead(j, &l, s, true);
    bool inside_now = run.inside & 1;
    if (inside_now) {
        s += 2 * JULIA_ACCURACY;
        run = ahead(j, &l, s, true);
        inside_now = run.inside & 1;
    }
    for (int i = 0;;) {
        double previous = s;
        s += i + 1 < run.n ? j->set.step : run.step;
        if (s > out || previous > limit || (previous > air && !inside_now))
            return;
        if (++i == run.n) {
            run = ahead(j, &l, s, run.step != j->set.step);
            i = 0;
        }
        bool now = run.inside >> i & 1;
        if (now == inside_now)
            continue;
        double hit = closed_in(j, &l, previous, s, inside_now);
        if (hit < near)
            return;
        hit_add(sink, shift + hit / len, 0);
        limit = (hit_limit(sink) - shift) * len;
        inside_now = now;
    }
}

static bool inside(const void *shape, Vec3 p)
{
    const Julia *j = shape;
    return length2(p) <= j->set.radius * j->set.radius && holds(j, p);
}

/* ---- at a point ---- */

/* All steps, also where the orbit would be lost at the last. */
static Vec3 hyper_normal(const Julia *j, Vec3 p)
{
    Pair z = plain_start(j, p), product;
    double norm;
    hyper_orbit(j, INFINITY, &z, &norm, &product);
    return hyper_gradient(product, z);
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    (void)hit;
    const Julia *j = shape;
    Vec3 n = j->set.hypercomplex ? hyper_normal(j, out->p) : j->kernel->normal(&j->set, out->p);
    out->normal = vec3_finite(n) && max_abs(n) > 0 ? scaled(n, 1 / max_abs(n)) : vec3(0, 0, 0);
}

static Bounds extent(const void *params, const Affine *place)
{
    double radius, escape;
    bound(params, &radius, &escape);
    return bounds_transformed(box_of(radius), place);
}

const ShapeOps shape_julia_fractal = {
    .keyword = "julia_fractal", .params_size = sizeof(Params), .flags = SHAPE_SHARED | SHAPE_NORMAL_STAYS, .parse = parse,
    .item = item, .finish = finish, .compile = compile, .hits = hits, .inside = inside, .surface = surface, .extent = extent,
};
