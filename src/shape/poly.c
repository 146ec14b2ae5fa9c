/* poly.c - polynomials in x, y and z: cubic, quartic, poly { order, <coefficients> }, polynomial { order, xyz(i,j,k): c, ... }.
 *
 * Coefficients stand in falling powers of x, within these of y, within these of z: the order in which nested Horner
 * schemes use them. Along a ray the same scheme runs over polynomials in the ray's parameter, counted from the point
 * nearest to the origin, so that a far eye costs no digits. */
#include "math/roots.h"
#include "sdl/parse.h"
#include "shape/shape.h"

enum { MAX_ORDER = ROOTS_MAX_DEGREE };

typedef struct { int order; double *coefficient; } Params;

typedef struct {
    int order;
    const double *coefficient, *size;          /* size: without signs, to know what cancels */
    const signed char *top;                    /* for each power of x and y the highest of z with a coefficient; -1: none */
} Poly;

static int n_terms(int order)
{
    return (order + 1) * (order + 2) * (order + 3) / 6;
}

/* ---- parsing ---- */

static void coefficients(Parser *p, Params *params, int order)
{
    params->order = order;
    params->coefficient = arena_array(parse_arena(p), double, (size_t)n_terms(order));
    parse_expect(p, TOK_LESS);
    params->coefficient[0] = parse_float(p);
    for (int i = 1; i < n_terms(order); i++)
        params->coefficient[i] = parse_next_float(p);
    parse_expect(p, TOK_GREATER);
}

static void parse_cubic(Parser *p, void *params)
{
    coefficients(p, params, 3);
}

static void parse_quartic(Parser *p, void *params)
{
    coefficients(p, params, 4);
}

static int parse_order(Parser *p)
{
    int order = parse_int(p);
    if (order < 2 || order > MAX_ORDER)
        parse_fail(p, "Order of poly is out of range.");
    parse_comma(p);
    return order;
}

static void parse_poly(Parser *p, void *params)
{
    coefficients(p, params, parse_order(p));
}

/* Where x^i y^j z^k stands. */
static int term_index(int order, int i, int j, int k)
{
    int at = 0;
    for (int x = order; x > i; x--)
        at += (order - x + 1) * (order - x + 2) / 2;
    for (int y = order - i; y > j; y--)
        at += order - i - y + 1;
    return at + (order - i - j) - k;
}

static void parse_polynomial(Parser *p, void *params)
{
    Params *out = params;
    out->order = parse_order(p);
    out->coefficient = arena_array(parse_arena(p), double, (size_t)n_terms(out->order));
    while (parse_accept(p, KW_XYZ)) {
        parse_expect(p, TOK_LPAREN);
        int i = parse_int(p);
        parse_comma(p);
        int j = parse_int(p);
        parse_comma(p);
        int k = parse_int(p);
        parse_expect(p, TOK_RPAREN);
        parse_expect(p, TOK_COLON);
        if (i < 0 || j < 0 || k < 0 || i > out->order || j > out->order - i || k > out->order - i - j)
            parse_fail(p, "Coefficient of polynom is out of range.");
        out->coefficient[term_index(out->order, i, j, k)] = parse_float(p);
        parse_comma(p);
    }
}

/* ---- compiling ---- */

static void largest_by_degree(const Params *p, double *largest)
{
    int at = 0;
    for (int k = 0; k <= MAX_ORDER; k++)
        largest[k] = 0;
    for (int i = p->order; i >= 0; i--)
        for (int j = p->order - i; j >= 0; j--)
            for (int k = p->order - i - j; k >= 0; k--, at++)
                largest[i + j + k] = fmax(largest[i + j + k], fabs(p->coefficient[at]));
}

static const signed char *tops(ShapeBuild *b, const double *c, int order)
{
    signed char *top = build_data(b, (size_t)((order + 1) * (order + 2) / 2)), *at = top;
    for (int i = order; i >= 0; i--)
        for (int j = order - i; j >= 0; j--) {
            int k = order - i - j;
            const double *next = c + k + 1;
            while (k >= 0 && *c == 0) {
                c++;
                k--;
            }
            *at++ = (signed char)k;
            c = next;
        }
    return top;
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *p = params;
    double largest[MAX_ORDER + 1];
    largest_by_degree(p, largest);
    double unit = shape_algebraic_unit(largest, p->order), most = 0;
    if (p->order <= 4)
        unit = shape_unit(b, unit);            /* higher powers of a unit that does not fit might overflow */
    int e = ilogb(unit);
    for (int k = 0; k <= p->order; k++)
        most = fmax(most, ldexp(largest[k], e * k));
    if (!(most > 0) || !isfinite(most))
        return;
    int top = ilogb(most), at = 0;
    Poly *out = build_data(b, sizeof *out);
    double *c = build_data(b, (size_t)n_terms(p->order) * sizeof *c), *size = build_data(b, (size_t)n_terms(p->order) * sizeof *c);
    for (int i = p->order; i >= 0; i--)
        for (int j = p->order - i; j >= 0; j--)
            for (int k = p->order - i - j; k >= 0; k--, at++) {
                c[at] = ldexp(p->coefficient[at], e * (i + j + k) - top);
                size[at] = fabs(c[at]);
            }
    *out = (Poly){ .order = p->order, .coefficient = c, .size = size, .top = tops(b, c, p->order) };
    Affine place = build_place(b, unit);
    build_prim(b, out, &place, bounds_everything());
}

/* ---- tracing ---- */

/* p := p (o + d s); degree -1 is the zero polynomial. */
static inline int step(double *p, int degree, double o, double d)
{
    if (degree < 0)
        return -1;
    p[degree + 1] = p[degree] * d;
    for (int k = degree; k > 0; k--)
        p[k] = p[k] * o + p[k - 1] * d;
    p[0] *= o;
    return degree + 1;
}

static inline int plus(double *p, int degree, const double *q, int q_degree)
{
    for (int k = degree + 1; k <= q_degree; k++)
        p[k] = 0;
    for (int k = 0; k <= q_degree; k++)
        p[k] += q[k];
    return q_degree > degree ? q_degree : degree;
}

/* The terms of one power of x and y, from the highest power of z that has one; degree -1: none has. */
static inline int along_z(const double *c, int top, double o, double d, double *p)
{
    if (top < 0)
        return -1;
    p[0] = *c++;
    for (int k = 1; k <= top; k++) {
        step(p, k - 1, o, d);
        p[0] += *c++;
    }
    return top;
}

/* The polynomial in s at o + s d; returns its degree. */
static int along(const Poly *poly, const double *c, Vec3 o, Vec3 d, double *px)
{
    const signed char *top = poly->top;
    double py[MAX_ORDER + 1], pz[MAX_ORDER + 1];
    int n = poly->order, nx = -1;
    for (int i = n; i >= 0; i--) {
        int ny = -1;
        for (int j = n - i; j >= 0; j--) {
            int length_ = n - i - j + 1, nz = along_z(c + length_ - 1 - *top, *top, o.z, d.z, pz);
            ny = plus(py, step(py, ny, o.y, d.y), pz, nz);
            c += length_;
            top++;
        }
        nx = plus(px, step(px, nx, o.x, d.x), py, ny);
    }
    return nx;
}

/* Drops leading coefficients of which nothing is left but rounding: they would be roots at the end of the world. What is
 * small without having cancelled stays. */
static int without_noise(const Poly *poly, Vec3 o, Vec3 d, const double *c, int n)
{
    if (n < 2 || fabs(c[n]) > 1e-12 * fabs(c[n - 1]))
        return n;
    double most[MAX_ORDER + 1];
    along(poly, poly->size, vec3(fabs(o.x), fabs(o.y), fabs(o.z)), vec3(fabs(d.x), fabs(d.y), fabs(d.z)), most);
    while (n > 0 && fabs(c[n]) <= 16 * DBL_EPSILON * most[n])
        n--;
    return n;
}

typedef struct { double shift, len; HitSink *sink; } Walk;

static bool visit(void *user, double s)
{
    const Walk *w = user;
    double t = w->shift + s / w->len;
    hit_add(w->sink, t, 0);
    return t < hit_limit(w->sink);
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Poly *poly = shape;
    double len = length(ray->d), shift = shape_nearest_t(ray), c[MAX_ORDER + 1];
    Vec3 o = ray_at(ray, shift), d = scaled(ray->d, 1 / len);
    int n = without_noise(poly, o, d, c, along(poly, poly->coefficient, o, d, c));
    Walk w = { shift, len, sink };
    double from = (ray->t_min - shift) * len;
    roots_visit_all(c, n, from - 1e-6 * (1 + fabs(from)), visit, &w);
}

typedef struct { double value, size; Vec3 gradient; } Sample;          /* size: of the terms, for the rounding */

/* Horner's scheme for the value, and for its derivatives alongside. */
static Sample sample(const Poly *poly, Vec3 p)
{
    const double *c = poly->coefficient;
    double ax = fabs(p.x), ay = fabs(p.y), az = fabs(p.z);
    Sample s = { 0, 0, { 0, 0, 0 } };
    for (int i = poly->order; i >= 0; i--) {
        Sample y = { 0, 0, { 0, 0, 0 } };
        for (int j = poly->order - i; j >= 0; j--) {
            Sample z = { 0, 0, { 0, 0, 0 } };
            for (int k = poly->order - i - j; k >= 0; k--, c++) {
                z.gradient.z = z.gradient.z * p.z + z.value;
                z.value = z.value * p.z + *c;
                z.size = z.size * az + fabs(*c);
            }
            y.gradient.y = y.gradient.y * p.y + y.value;
            y.gradient.z = y.gradient.z * p.y + z.gradient.z;
            y.value = y.value * p.y + z.value;
            y.size = y.size * ay + z.size;
        }
        s.gradient.x = s.gradient.x * p.x + s.value;
        s.gradient.y = s.gradient.y * p.x + y.gradient.y;
        s.gradient.z = s.gradient.z * p.x + y.gradient.z;
        s.value = s.value * p.x + y.value;
        s.size = s.size * ax + y.size;
    }
    return s;
}

static bool inside(const void *shape, Vec3 p)
{
    Sample s = sample(shape, p);
    return s.value <= 1e-12 * s.size;
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    (void)hit;
    Sample s = sample(shape, out->p);
    double g2 = length2(s.gradient);
    if (!(g2 > 0)) {
        out->normal = vec3(1, 0, 0);           /* POV: a point where the surface has no tangent plane */
        return;
    }
    out->normal = s.gradient;
    out->error = fmax(out->error, 4 * fabs(s.value) / sqrt(g2));
}

static Bounds extent(const void *params, const Affine *place)
{
    (void)params;
    (void)place;
    return bounds_everything();
}

#define POLY_ROW(name)                                                                                             \
    const ShapeOps shape_##name = {                                                                                \
        .keyword = #name, .params_size = sizeof(Params), .flags = SHAPE_HAS_STURM | SHAPE_BOUND_STAYS,           \
        .parse = parse_##name,                                                                                    \
        .compile = compile, .hits = hits, .inside = inside, .surface = surface, .extent = extent,                  \
    }

POLY_ROW(cubic);
POLY_ROW(quartic);
POLY_ROW(poly);
POLY_ROW(polynomial);
