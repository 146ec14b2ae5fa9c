/* lathe.c - lathe { [spline] n, points }: a plane curve (radius, height) turned about the y axis.
 *
 * With the ray o + s u, the curve (X, Y)(w) is met where |u_xz|^2 (Y - oy)^2 + 2 m uy (Y - oy) + uy^2 (|o_xz|^2 - X^2) = 0, a
 * polynomial in w of twice the curve's degree. It tells where the roots are; w and s are then polished together, so that
 * a nearly horizontal ray, for which the polynomial is nearly a square, loses nothing (08-shapes, section 16.2).
 * Parts: pieces of the curve. */
#include "math/bernstein.h"
#include "sdl/parse.h"
#include "shape/curve.h"
#include "shape/shape.h"

typedef struct { Curve curve; CurveKind kind; } Params;
typedef struct { double b[7]; } Square;        /* of a piece's radius, in Bernstein form */
typedef struct { Curve curve; const Square *square; double least, most, y0, y1; } Lathe;       /* radii, heights */

/* Below this |uy| a root of the polynomial cannot be told from its twin. */
static const double LEVEL = 1e-7;

static CurveKind spline_kind(Parser *p)
{
    return parse_accept(p, KW_QUADRATIC_SPLINE) ? CURVE_QUADRATIC
           : parse_accept(p, KW_CUBIC_SPLINE)   ? CURVE_CUBIC
           : parse_accept(p, KW_BEZIER_SPLINE)  ? CURVE_BEZIER
           : (parse_accept(p, KW_LINEAR_SPLINE), CURVE_LINEAR);
}

static void parse(Parser *p, void *params)
{
    static const struct { const char *name; int least; } kinds[] = {
        [CURVE_LINEAR] = { "linear", 2 }, [CURVE_QUADRATIC] = { "quadratic", 3 }, [CURVE_CUBIC] = { "cubic", 4 },
        [CURVE_BEZIER] = { "bezier", 4 },
    };
    Params *l = params;
    l->kind = spline_kind(p);
    int n = parse_int(p), least = kinds[l->kind].least;
    if (n < least)
        parse_fail(p, "a lathe with a %s spline needs at least %d points, found %d", kinds[l->kind].name, least, n);
    if (n > 1000000)
        parse_fail(p, "a lathe has at most 1000000 points, found %d", n);
    if (l->kind == CURVE_BEZIER && n % 4 != 0)
        parse_fail(p, "a lathe with a bezier spline needs a multiple of 4 points, found %d", n);
    Arena *arena = parse_arena(p);
    Vec2 *v = arena_array(arena, Vec2, (size_t)n);
    for (int i = 0; i < n; i++) {
        parse_comma(p);
        v[i] = parse_vec2(p);
        if (i > 0 && i < n - 1 && v[i].u < 0)
            parse_fail(p, "Incorrect point in lathe.");
    }
    parse_stray_comma(p);
    int step = l->kind == CURVE_BEZIER ? 4 : 1;
    l->curve.n = (uint32_t)(l->kind == CURVE_BEZIER ? n / 4 : n - least + 1);
    l->curve.piece = arena_array(arena, CurvePiece, l->curve.n);
    for (uint32_t k = 0; k < l->curve.n; k++)
        l->curve.piece[k] = curve_spline_piece(l->kind, &v[k * (uint32_t)step]);
}

/* The least and the largest distance from the axis and the heights, of the curve or, as POV-Ray bounds a bezier, of its control points. */
static void measure(const Curve *c, bool hull, double *least, double *most, double *y0, double *y1)
{
    *least = INFINITY;
    *most = 0;
    *y0 = INFINITY;
    *y1 = -INFINITY;
    for (uint32_t k = 0; k < c->n; k++) {
        Vec2 lo = c->piece[k].lo, hi = c->piece[k].hi;
        if (!hull)
            curve_extent(&c->piece[k], &lo, &hi);
        *least = fmin(*least, lo.u);
        *most = fmax(*most, fmax(fabs(lo.u), fabs(hi.u)));
        *y0 = fmin(*y0, lo.v);
        *y1 = fmax(*y1, hi.v);
    }
}

static void square_radius(const CurvePiece *c, Square *out)
{
    double x[4];
    for (int i = 0; i <= c->degree; i++)
        x[i] = c->p[i].u;
    bernstein_product(x, c->degree, x, c->degree, out->b);
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *l = params;
    double least, most, y0, y1;
    measure(&l->curve, false, &least, &most, &y0, &y1);
    double unit = shape_unit(b, fmax(most, fmax(fabs(y0), fabs(y1))));
    Lathe *out = build_data(b, sizeof *out);
    out->curve = curve_scaled(b->arena, l->curve, 1 / unit);
    Square *square = build_data(b, out->curve.n * sizeof *square);
    for (uint32_t k = 0; k < out->curve.n; k++)
        square_radius(&out->curve.piece[k], &square[k]);
    out->square = square;
    measure(&out->curve, false, &out->least, &out->most, &out->y0, &out->y1);
    Affine place = build_place(b, unit);
    build_prim(b, out, &place, shape_padded((Bounds){ vec3(-out->most, out->y0, -out->most), vec3(out->most, out->y1, out->most) }));
}

/* The ray from its point nearest to the shape: r = |u_xz|^2, m = u_xz . o_xz, o2 = |o_xz|^2. */
typedef struct { Vec3 o, u; double r, m, o2, shift, len; HitSink *sink; } Line;

/* Newton on height and squared radius at once, for w and s. */
static void polish(const CurvePiece *c, const Line *l, double *w, double *s)
{
    for (int i = 0; i < 3; i++) {
        Vec2 q = curve_at(c, *w), d = curve_slope(c, *w);
        double f1 = q.v - l->o.y - *s * l->u.y, f2 = q.u * q.u - (l->o2 + *s * (2 * l->m + *s * l->r));
        double a = d.v, b = -l->u.y, e = 2 * q.u * d.u, g = -2 * (l->m + *s * l->r), det = a * g - b * e;
        double dw = (f1 * g - b * f2) / det, ds = (a * f2 - e * f1) / det;
        if (!(fabs(dw) < 1e-3 && fabs(ds) < 1))
            return;                            /* a tangent: the root is as good as it gets */
        *w -= dw;
        *s -= ds;
    }
}

/* The places on the ray with this distance from the axis: 0 or 2. */
static int at_radius(const Line *l, double radius, double s[2])
{
    double d = l->m * l->m - l->r * (l->o2 - radius * radius);
    if (!(l->r > 0))
        return 0;
    double root = sqrt(fmax(d, 0));
    s[0] = (-l->m - root) / l->r;
    s[1] = (-l->m + root) / l->r;
    return d < -1e-12 * radius * radius ? 0 : 2;
}

static void offer(const CurvePiece *c, uint32_t part, const Line *l, double w, double s)
{
    polish(c, l, &w, &s);
    hit_add_uv(l->sink, l->shift + s / l->len, part, fmin(1, fmax(0, w)), 0);
}

static void level_hits(const CurvePiece *c, uint32_t part, const Line *l)
{
    double height[4], root[4], s[2];
    for (int i = 0; i <= c->degree; i++)
        height[i] = c->p[i].v - l->o.y;
    int n = bernstein_roots(height, c->degree, root);
    for (int i = 0; i < n; i++) {
        int found = at_radius(l, curve_at(c, root[i]).u, s);
        for (int k = 0; k < found; k++)
            offer(c, part, l, root[i], s[k]);
    }
}

static void piece_hits(const CurvePiece *c, const Square *x2, uint32_t part, const Line *l)
{
    double y[4], y2[4], f[7], root[7], s[2];
    int n = c->degree;
    for (int i = 0; i <= n; i++) {             /* r y^2 + 2 m uy y as one product */
        y[i] = c->p[i].v - l->o.y;
        y2[i] = l->r * y[i] + 2 * l->m * l->u.y;
    }
    bernstein_product(y, n, y2, n, f);
    for (int i = 0; i <= 2 * n; i++)
        f[i] += l->u.y * l->u.y * (l->o2 - x2->b[i]);
    int found = bernstein_roots(f, 2 * n, root);
    for (int i = 0; i < found; i++) {
        Vec2 q = curve_at(c, root[i]);
        double by_height = (q.v - l->o.y) / l->u.y;
        if (fabs(l->u.y) < 0.1 && at_radius(l, q.u, s))
            by_height = fabs(s[0] - by_height) < fabs(s[1] - by_height) ? s[0] : s[1];
        offer(c, part, l, root[i], by_height);
    }
}

static double rho2_at(const Line *l, double s)
{
    return l->o2 + s * (2 * l->m + s * l->r);
}

/* While the ray is at the heights of the piece, is it ever as far from the axis as the piece is? */
static bool may_meet(const CurvePiece *c, const Line *l, double near, double far, double room)
{
    double s0 = near, s1 = far;
    if (fabs(l->u.y) > LEVEL) {
        double a = (c->lo.v - room - l->o.y) / l->u.y, b = (c->hi.v + room - l->o.y) / l->u.y;
        s0 = greater(s0, lesser(a, b));
        s1 = lesser(s1, greater(a, b));
    }
    double most = greater(fabs(c->lo.u), fabs(c->hi.u)) + room, least = greater(c->lo.u - room, 0);
    double nearest = l->r > 1e-9 ? rho2_at(l, lesser(greater(-l->m / l->r, s0), s1)) : 0;
    return s0 <= s1 + room && nearest <= most * most && greater(rho2_at(l, s0), rho2_at(l, s1)) >= least * least;
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Lathe *a = shape;
    double len = length(ray->d), centre = 0.5 * (a->y0 + a->y1), size = 4 * (a->most + a->y1 - a->y0), near = -size, far = size;
    Line l = { .u = scaled(ray->d, 1 / len), .len = len, .sink = sink };
    l.shift = -dot(vec3(ray->o.x, ray->o.y - centre, ray->o.z), l.u) / len;
    l.o = ray_at(ray, l.shift);
    l.r = l.u.x * l.u.x + l.u.z * l.u.z;
    l.m = l.u.x * l.o.x + l.u.z * l.o.z;
    l.o2 = l.o.x * l.o.x + l.o.z * l.o.z;
    double margin = 1e-9 * a->most, cross = l.o.x * l.u.z - l.o.z * l.u.x;
    if (l.r > 1e-9) {
        double h2 = (a->most + margin) * (a->most + margin) - cross * cross / l.r;
        if (h2 < 0)
            return;
        near = fmax(near, (-l.m - sqrt(h2 * l.r)) / l.r);
        far = fmin(far, (-l.m + sqrt(h2 * l.r)) / l.r);
    }
    bool level = fabs(l.u.y) < LEVEL;
    double ya = l.o.y + near * l.u.y, yb = l.o.y + far * l.u.y;
    double lo = lesser(ya, yb) - 1e-9 * size, hi = greater(ya, yb) + 1e-9 * size;
    for (uint32_t k = 0; k < a->curve.n; k++) {
        const CurvePiece *c = &a->curve.piece[k];
        if (c->hi.v < lo || c->lo.v > hi || !may_meet(c, &l, near, far, 1e-9 * size))
            continue;
        if (level)
            level_hits(c, k, &l);
        else
            piece_hits(c, &a->square[k], k, &l);
    }
}

/* POV: a core as wide as the curve is near to the axis anywhere counts as outside at every height. */
static bool inside(const void *shape, Vec3 p)
{
    const Lathe *a = shape;
    double rho = sqrt(p.x * p.x + p.z * p.z);
    return rho >= a->least && curve_inside(&a->curve, rho, p.y);
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    const Lathe *a = shape;
    const CurvePiece *c = &a->curve.piece[hit->part];
    Vec2 q = curve_at(c, hit->u), d = curve_slope(c, hit->u);
    double rho = sqrt(out->p.x * out->p.x + out->p.z * out->p.z);
    out->normal = rho > 0 ? vec3(d.v * out->p.x, -d.u * (q.u < 0 ? -rho : rho), d.v * out->p.z) : vec3(0, 1, 0);
    if (out->want_uv)
        out->uv = (Vec2){ shape_longitude(out->p.x, out->p.z), fmin(1, (hit->part + hit->u) / a->curve.n) };
}

static Bounds extent(const void *params, const Affine *place)
{
    const Params *l = params;
    double least, most, y0, y1;
    measure(&l->curve, l->kind == CURVE_BEZIER, &least, &most, &y0, &y1);
    return bounds_transformed((Bounds){ vec3(-most, y0, -most), vec3(most, y1, most) }, place);
}

const ShapeOps shape_lathe = {
    .keyword = "lathe", .params_size = sizeof(Params), .flags = SHAPE_HAS_STURM | SHAPE_HAS_UV, .parse = parse,
    .compile = compile, .hits = hits, .inside = inside, .surface = surface, .extent = extent,
};
