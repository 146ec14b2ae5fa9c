/* prism.c - prism { [spline] [sweep] h1, h2, n, points [open] }: closed curves in the xz plane, swept along y.
 *
 * In a conic sweep the curve is that at height 1, and shrinks to the origin. Along the ray a side is met where the
 * curve crosses a line in its plane. Parts: pieces of the curve, then the base and the cap (08-shapes, section 16.4). */
#include "base/array.h"
#include "math/bernstein.h"
#include "sdl/parse.h"
#include "shape/curve.h"
#include "shape/shape.h"

typedef struct { Curve curve; double h1, h2; bool conic, bezier; } Params;

typedef struct {
    Curve curve;                               /* conic: without unit, as the heights carry it */
    double h1, h2, slack;
    bool conic, open;
    const AccelOps *accel_ops;
    const void *accel;                         /* over the pieces, when there are many */
} Prism;

enum { FEW = 8 };

typedef ARRAY(CurvePiece) Pieces;

static bool same(Vec2 a, Vec2 b)
{
    double size = fmax(fabs(a.u) + fabs(a.v), fabs(b.u) + fabs(b.v));
    return fabs(a.u - b.u) <= 1e-10 * size && fabs(a.v - b.v) <= 1e-10 * size;
}

/* Straight contours: a point equal to the first closes one. */
static void linear_contours(Parser *p, const Vec2 *v, int n, Pieces *out)
{
    for (int first = 0; first < n;) {
        int last = first + 1;
        while (last < n && !same(v[last], v[first]))
            last++;
        if (last == n)
            parse_warn(p, "the prism is not closed; a side from its last to its first point was added");
        for (int i = first; i < last; i++) {
            const Vec2 ends[2] = { v[i], i + 1 == last ? v[first] : v[i + 1] };
            array_push(parse_arena(p), out, curve_piece(ends, 1));
        }
        first = last + 1;
    }
}

/* Splines: the contour runs from its second point to one equal to that, with a control point before, and in a cubic
 * spline one behind. */
static bool spline_contours(Parser *p, CurveKind kind, const Vec2 *v, int n, Pieces *out)
{
    int behind = kind == CURVE_CUBIC;
    for (int first = 0; first + 2 < n;) {      /* POV: a point or two left over say nothing */
        int last = first + 2;
        while (last < n && !same(v[last], v[first + 1]))
            last++;
        if (last + behind >= n)
            return false;
        for (int i = first; i + 1 < last; i++) {
            CurvePiece c = curve_spline_piece(kind, &v[i]);
            if (i + 2 == last) {               /* ends exactly where it began */
                c.p[c.degree] = v[first + 1];
                c = curve_piece(c.p, c.degree);
            }
            array_push(parse_arena(p), out, c);
        }
        first = last + behind + 1;
    }
    return true;
}

/* POV: the pieces run backwards, which turns their normals. */
static bool bezier_contours(Parser *p, const Vec2 *v, int n, Pieces *out)
{
    for (int i = 0, first = 0; i < n; i += 4) {
        bool closes = same(v[i + 3], v[first]);
        if (!closes && (i + 4 >= n || !same(v[i + 3], v[i + 4])))
            return false;
        const Vec2 back[4] = { closes ? v[first] : v[i + 4], v[i + 2], v[i + 1], v[i] };
        array_push(parse_arena(p), out, curve_piece(back, 3));
        if (closes)
            first = i + 4;
    }
    return true;
}

static CurveKind parse_kind(Parser *p, bool *conic)
{
    CurveKind kind = CURVE_LINEAR;
    for (;;) {                                 /* spline and sweep in any order */
        if (parse_accept(p, KW_LINEAR_SPLINE))
            kind = CURVE_LINEAR;
        else if (parse_accept(p, KW_QUADRATIC_SPLINE))
            kind = CURVE_QUADRATIC;
        else if (parse_accept(p, KW_CUBIC_SPLINE))
            kind = CURVE_CUBIC;
        else if (parse_accept(p, KW_BEZIER_SPLINE))
            kind = CURVE_BEZIER;
        else if (parse_accept(p, KW_CONIC_SWEEP))
            *conic = true;
        else if (parse_accept(p, KW_LINEAR_SWEEP))
            *conic = false;
        else
            return kind;
    }
}

static void parse(Parser *p, void *params)
{
    static const struct { const char *name; int least; } kinds[] = {
        [CURVE_LINEAR] = { "linear", 3 }, [CURVE_QUADRATIC] = { "quadratic", 5 }, [CURVE_CUBIC] = { "cubic", 6 },
        [CURVE_BEZIER] = { "bezier", 4 },
    };
    Params *a = params;
    CurveKind kind = parse_kind(p, &a->conic);
    double h1 = parse_float(p), h2 = parse_next_float(p);
    parse_comma(p);
    int n = parse_int(p), least = kinds[kind].least;
    a->bezier = kind == CURVE_BEZIER;
    a->h1 = fmin(h1, h2);
    a->h2 = fmax(h1, h2);
    if (n < least)
        parse_fail(p, "a prism with a %s spline needs at least %d points, found %d", kinds[kind].name, least, n);
    if (n > 1000000)
        parse_fail(p, "a prism has at most 1000000 points, found %d", n);
    if (kind == CURVE_BEZIER && n % 4 != 0)
        parse_fail(p, "a prism with a bezier spline needs a multiple of 4 points, found %d", n);
    Vec2 *v = arena_array(parse_arena(p), Vec2, (size_t)n);
    for (int i = 0; i < n; i++) {
        parse_comma(p);
        v[i] = parse_vec2(p);
    }
    parse_stray_comma(p);
    Pieces pieces = { 0 };
    bool closed = true;
    if (kind == CURVE_LINEAR)
        linear_contours(p, v, n, &pieces);
    else if (kind == CURVE_BEZIER)
        closed = bezier_contours(p, v, n, &pieces);
    else
        closed = spline_contours(p, kind, v, n, &pieces);
    if (!closed) {
        parse_warn(p, "Prism not closed. Ignoring it.");
        pieces.n = 0;
    }
    a->curve = (Curve){ .piece = pieces.data, .n = pieces.n };
}

/* A piece swept from h1 to h2. */
static Bounds swept(Vec2 lo, Vec2 hi, double h1, double h2, bool conic)
{
    if (!conic)
        return (Bounds){ vec3(lo.u, h1, lo.v), vec3(hi.u, h2, hi.v) };
    const Vec3 corners[4] = { { lo.u * h1, h1, lo.v * h1 }, { hi.u * h1, h1, hi.v * h1 },
                              { lo.u * h2, h2, lo.v * h2 }, { hi.u * h2, h2, hi.v * h2 } };
    return bounds_of_points(corners, 4);
}

/* `hull`: of the control points, as POV-Ray bounds beziers. */
static Bounds box_of(const Curve *c, double h1, double h2, bool conic, bool hull)
{
    Bounds b = bounds_empty();
    for (uint32_t i = 0; i < c->n; i++) {
        Vec2 lo = c->piece[i].lo, hi = c->piece[i].hi;
        if (!hull)
            curve_extent(&c->piece[i], &lo, &hi);
        b = bounds_union(b, swept(lo, hi, h1, h2, conic));
    }
    return b;
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *a = params;
    if (a->curve.n == 0)
        return;
    Bounds box = box_of(&a->curve, a->h1, a->h2, a->conic, false);
    double unit = shape_unit(b, fmax(max_abs(box.lo), max_abs(box.hi)));
    Prism *out = build_data(b, sizeof *out);
    *out = (Prism){ .curve = curve_scaled(b->arena, a->curve, a->conic ? 1 : 1 / unit), .h1 = a->h1 / unit, .h2 = a->h2 / unit,
                    .conic = a->conic, .open = b->object->flags & OBJECT_OPEN, .accel_ops = b->accel };
    out->slack = 4 * DBL_EPSILON * fmax(fabs(out->h1), fabs(out->h2));
    if (out->curve.n > FEW) {
        Bounds *boxes = arena_array(b->arena, Bounds, out->curve.n);
        for (uint32_t i = 0; i < out->curve.n; i++)
            boxes[i] = shape_padded(swept(out->curve.piece[i].lo, out->curve.piece[i].hi, out->h1, out->h2, out->conic));
        out->accel = b->accel->build(b->arena, boxes, out->curve.n);
    }
    Affine place = build_place(b, unit);
    build_prim(b, out, &place, shape_padded(box_of(&out->curve, out->h1, out->h2, out->conic, false)));
}

/* The ray from its point nearest to the middle of the shape, direction of unit length. */
typedef struct { const Prism *prism; Vec3 o, u; double shift, len; HitSink *sink; } Line;

static void side_hits(const Line *l, uint32_t part)
{
    const Prism *a = l->prism;
    const CurvePiece *c = &a->curve.piece[part];
    Vec3 o = l->o, u = l->u, k = cross(o, u);  /* conic: the plane through ray and tip is that of (X, 1, Z) . k = 0 */
    double f[4], root[4];
    for (int i = 0; i <= c->degree; i++) {
        Vec2 q = c->p[i];
        f[i] = a->conic ? q.u * k.x + k.y + q.v * k.z : (q.u - o.x) * u.z - (q.v - o.z) * u.x;
    }
    int n = bernstein_roots(f, c->degree, root);
    for (int i = 0; i < n; i++) {
        Vec2 q = curve_at(c, root[i]);
        double ax = u.x, az = u.z, bx = q.u - o.x, bz = q.v - o.z;
        if (a->conic) {
            ax = u.x - q.u * u.y, az = u.z - q.v * u.y;
            bx = q.u * o.y - o.x, bz = q.v * o.y - o.z;
        }
        double s = (ax * bx + az * bz) / (ax * ax + az * az), y = o.y + s * u.y;
        if (a->h1 - a->slack <= y && y <= a->h2 + a->slack)
            hit_add_uv(l->sink, l->shift + s / l->len, part, root[i], 0);
    }
}

static bool visit(void *user, uint32_t item, double *t_max)
{
    const Line *l = user;
    side_hits(l, item);
    *t_max = fmin(*t_max, hit_limit(l->sink));
    return false;
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Prism *a = shape;
    double len = length(ray->d), centre = 0.5 * (a->h1 + a->h2);
    Line l = { .prism = a, .u = scaled(ray->d, 1 / len), .len = len, .sink = sink };
    l.shift = -dot(vec3(ray->o.x, ray->o.y - centre, ray->o.z), l.u) / len;
    l.o = ray_at(ray, l.shift);
    for (uint32_t i = 0; i < 2 && !a->open && l.u.y != 0; i++) {
        double y = i ? a->h2 : a->h1, s = (y - l.o.y) / l.u.y, f = a->conic ? 1 / y : 1;
        double t = l.shift + s / len;
        bool counts = t > sink->t_min && t <= sink->limit && !(a->conic && y == 0);
        if (counts && curve_inside(&a->curve, (l.o.x + s * l.u.x) * f, (l.o.z + s * l.u.z) * f))
            hit_offer(sink, t, a->curve.n + i, 0, 0);
    }
    if (!a->conic && l.u.x == 0 && l.u.z == 0)
        return;
    if (a->accel != NULL) {
        double t_max = hit_limit(sink);
        a->accel_ops->walk(a->accel, ray, &t_max, visit, &l);
    } else
        for (uint32_t i = 0; i < a->curve.n; i++)
            side_hits(&l, i);
}

static bool inside(const void *shape, Vec3 p)
{
    const Prism *a = shape;
    if (!(a->h1 <= p.y && p.y < a->h2) || (a->conic && p.y == 0))
        return false;
    return a->conic ? curve_inside(&a->curve, p.x / p.y, p.z / p.y) : curve_inside(&a->curve, p.x, p.z);
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    const Prism *a = shape;
    if (hit->part >= a->curve.n) {
        out->p.y = hit->part > a->curve.n ? a->h2 : a->h1;
        out->normal = vec3(0, 1, 0);           /* POV: the base's points inward */
        return;
    }
    const CurvePiece *c = &a->curve.piece[hit->part];
    Vec2 d = curve_slope(c, hit->u);
    out->normal = vec3(d.v, 0, -d.u);
    if (a->conic) {
        Vec2 q = curve_at(c, hit->u);
        out->normal.y = -(q.u * d.v - q.v * d.u);
    }
    if (max_abs(out->normal) == 0)             /* a cusp, or points upon each other */
        out->normal = vec3(0, 1, 0);
}

static Bounds extent(const void *params, const Affine *place)
{
    const Params *a = params;
    return bounds_transformed(box_of(&a->curve, a->h1, a->h2, a->conic, a->bezier), place);
}

const ShapeOps shape_prism = {
    .keyword = "prism", .params_size = sizeof(Params), .flags = SHAPE_HAS_OPEN | SHAPE_HAS_STURM, .parse = parse,
    .compile = compile, .hits = hits, .inside = inside, .surface = surface, .extent = extent,
};
