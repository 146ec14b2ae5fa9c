/* quadric.c - quadric { <A,B,C>, <D,E,F>, <G,H,I>, J }: A x^2 + B y^2 + C z^2 + D xy + E xz + F yz + G x + H y + I z + J = 0. */
#include "math/roots.h"
#include "sdl/parse.h"
#include "shape/shape.h"

typedef struct { Vec3 square, mixed, linear; double constant; } Params;
typedef Params Quadric;

static void parse(Parser *p, void *params)
{
    Params *q = params;
    q->square = parse_vec3(p);
    q->mixed = parse_next_vec3(p);
    q->linear = parse_next_vec3(p);
    q->constant = parse_next_float(p);
}

/* Half the gradient without the linear part: the symmetric matrix times v. */
static Vec3 times(const Quadric *q, Vec3 v)
{
    return vec3(q->square.x * v.x + 0.5 * (q->mixed.x * v.y + q->mixed.y * v.z),
                q->square.y * v.y + 0.5 * (q->mixed.x * v.x + q->mixed.z * v.z),
                q->square.z * v.z + 0.5 * (q->mixed.y * v.x + q->mixed.z * v.y));
}

static double value(const Quadric *q, Vec3 p)
{
    return dot(p, add(times(q, p), q->linear)) + q->constant;
}

/* Of the solid where it is an ellipsoid, possibly infinitely long along an axis that the equation does not name: by the
 * inverse of the matrix of the other axes. */
static Bounds box_of(const Quadric *q)
{
    double m[3][3] = { { q->square.x, 0.5 * q->mixed.x, 0.5 * q->mixed.y },
                       { 0.5 * q->mixed.x, q->square.y, 0.5 * q->mixed.z },
                       { 0.5 * q->mixed.y, 0.5 * q->mixed.z, q->square.z } };
    Bounds box = bounds_everything();
    bool named[3];
    for (int i = 0; i < 3; i++) {
        named[i] = m[i][0] != 0 || m[i][1] != 0 || m[i][2] != 0;
        if (!named[i] && vec3_at(q->linear, i) != 0)
            return box;
        if (!named[i])
            m[i][i] = 1;
    }
    Vec3 r0 = vec3(m[0][0], m[0][1], m[0][2]), r1 = vec3(m[1][0], m[1][1], m[1][2]), r2 = vec3(m[2][0], m[2][1], m[2][2]);
    Vec3 c0 = cross(r1, r2), c1 = cross(r2, r0), c2 = cross(r0, r1);
    double det = dot(r0, c0);
    if (!(m[0][0] > 0 && c2.z > 0 && det > 0))             /* not positive definite */
        return box;
    Vec3 half = scaled(q->linear, 0.5);
    Vec3 centre = scaled(vec3(dot(c0, half), dot(c1, half), dot(c2, half)), -1 / det);
    double k = -(dot(half, centre) + q->constant);
    if (!(k >= 0))
        return bounds_empty();
    for (int i = 0; i < 3; i++)
        if (named[i]) {
            double reach = sqrt(k * vec3_at(i == 0 ? c0 : i == 1 ? c1 : c2, i) / det) * (1 + 1e-9);
            vec3_set(&box.lo, i, vec3_at(centre, i) - reach);
            vec3_set(&box.hi, i, vec3_at(centre, i) + reach);
        }
    return box;
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *q = params;
    const double by_degree[3] = { fabs(q->constant), max_abs(q->linear), fmax(max_abs(q->square), max_abs(q->mixed)) };
    double unit = shape_unit(b, shape_algebraic_unit(by_degree, 2));
    double most = fmax(by_degree[0], fmax(by_degree[1] * unit, by_degree[2] * unit * unit)), factor = 1 / build_unit(most);
    Quadric *out = build_data(b, sizeof *out);
    *out = (Quadric){ scaled(q->square, unit * unit * factor), scaled(q->mixed, unit * unit * factor),
                      scaled(q->linear, unit * factor), q->constant * factor };
    Bounds box = box_of(out);
    if (bounds_is_empty(box))
        return;
    Affine place = build_place(b, unit);
    build_prim(b, out, &place, bounds_is_finite(box) ? shape_padded(box) : box);
}

/* The least of a u^2 + b u over [lo, hi]; the ends may be infinite. */
static double least(double a, double b, double lo, double hi)
{
    if (a > 0) {
        double u = fmin(fmax(-b / (2 * a), lo), hi);
        return (a * u + b) * u;
    }
    if (a == 0 && b == 0)
        return 0;
    if (!isfinite(lo) && (a < 0 || b > 0))
        return -INFINITY;
    if (!isfinite(hi) && (a < 0 || b < 0))
        return -INFINITY;
    double at_lo = isfinite(lo) ? (a * lo + b) * lo : INFINITY, at_hi = isfinite(hi) ? (a * hi + b) * hi : INFINITY;
    return fmin(at_lo, at_hi);
}

/* Where a u^2 + b u + c <= 0 can be, for a > 0; nothing is known otherwise. */
static void limit(double a, double b, double c, double *lo, double *hi)
{
    if (!(a > 0) || !isfinite(c))
        return;
    double middle = -b / (2 * a), reach2 = middle * middle - c / a;
    double reach = reach2 > 0 ? sqrt(reach2) * (1 + 1e-9) + fabs(middle) * 1e-9 : fabs(middle) * 1e-9;
    *lo = fmax(*lo, middle - reach);
    *hi = fmin(*hi, middle + reach);
}

/* Axis by axis: the other two terms are at least so much within the box, so this one is at most so much. */
static Bounds within(const void *shape, Bounds box)
{
    const Quadric *q = shape;
    if (max_abs(q->mixed) > 0)
        return box;
    Bounds out = box;
    for (int i = 0; i < 3; i++) {
        double rest = q->constant;
        for (int j = 0; j < 3; j++)
            if (j != i)
                rest += least(vec3_at(q->square, j), vec3_at(q->linear, j), vec3_at(box.lo, j), vec3_at(box.hi, j));
        double lo = vec3_at(box.lo, i), hi = vec3_at(box.hi, i);
        limit(vec3_at(q->square, i), vec3_at(q->linear, i), rest, &lo, &hi);
        vec3_set(&out.lo, i, lo);
        vec3_set(&out.hi, i, hi);
    }
    return out;
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Quadric *q = shape;
    double shift = shape_nearest_t(ray), root[2];
    Vec3 o = ray_at(ray, shift), md = times(q, ray->d);
    double a = dot(ray->d, md);
    int n = roots_quadratic(a, dot(o, md) + 0.5 * dot(q->linear, ray->d), value(q, o), root);
    if (n == 1 && a != 0)
        return;                                /* POV: a touch is no hit */
    for (int i = 0; i < n; i++)
        hit_add(sink, shift + root[i], 0);
}

static bool inside(const void *shape, Vec3 p)
{
    return value(shape, p) <= 0;
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    (void)hit;
    const Quadric *q = shape;
    Vec3 g = add(scaled(times(q, out->p), 2), q->linear);
    out->normal = max_abs(g) > 0 ? g : vec3(1, 0, 0);      /* POV: x at the tip of a cone */
}

/* POV: mixed terms make it unbounded. */
static Bounds extent(const void *params, const Affine *place)
{
    const Params *q = params;
    Bounds box = max_abs(q->mixed) > 0 ? bounds_everything() : box_of(q);
    return bounds_is_finite(box) && !bounds_is_empty(box) ? bounds_transformed(box, place) : bounds_everything();
}

const ShapeOps shape_quadric = {
    .keyword = "quadric", .params_size = sizeof(Params), .flags = SHAPE_NORMAL_STAYS | SHAPE_BOUND_STAYS, .parse = parse, .compile = compile,
    .within = within, .hits = hits, .inside = inside, .surface = surface, .extent = extent,
};
