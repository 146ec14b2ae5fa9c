/* sphere_sweep.c - sphere_sweep { linear_spline | cubic_spline | b_spline n, centre, radius, ... }: all balls of a moving,
 * growing ball together.
 *
 * A ray is within the ball of time w from s-(w) to s+(w) = b(w) -+ sqrt(h(w)), where h is the square of half the chord. While h
 * stays positive these intervals move without a jump, so together they are one interval, from the least s- to the
 * greatest s+: ends of the time, or places where the derivative is zero. Intervals of the pieces that overlap are
 * joined, so nothing inside shows. A least value hardly depends on the errors of its place, hence no tolerance is
 * needed. Where POV-Ray counts the inside of several overlapping balls as outside (08-shapes, section 17), this does not.
 * Parts: pieces; u: the time of the ball that is touched. */
#include "math/bernstein.h"
#include "sdl/parse.h"
#include "shape/shape.h"

typedef enum { LINEAR, CUBIC, B_SPLINE } Kind;

typedef struct { Vec3 centre; double radius; } Ball;
typedef struct { Kind kind; uint32_t n; const Ball *ball; } Params;

typedef struct {
    Ball ball[4];                              /* Bezier control points of degree 1 or 3 */
    Vec3 middle;                               /* of a ball around it all */
    double reach;
} Piece;

typedef struct {
    int degree;
    uint32_t n;
    Vec3 middle;
    const AccelOps *accel_ops;
    const void *accel;                         /* over the pieces, when there are many */
    Piece piece[];
} Sweep;

enum { FEW = 6, MOST_SPANS = 128 };

static void parse(Parser *p, void *params)
{
    Params *s = params;
    if (parse_accept(p, KW_LINEAR_SPLINE))
        s->kind = LINEAR;
    else if (parse_accept(p, KW_CUBIC_SPLINE))
        s->kind = CUBIC;
    else if (parse_accept(p, KW_B_SPLINE))
        s->kind = B_SPLINE;
    else
        parse_fail(p, "Invalid type of interpolation.");
    parse_comma(p);
    int n = parse_int(p), least = s->kind == LINEAR ? 2 : 4;
    if (n < least)
        parse_fail(p, "this sphere_sweep needs at least %d spheres, found %d", least, n);
    if (n > 10000000)
        parse_fail(p, "a sphere_sweep has at most 10000000 spheres, found %d", n);
    Ball *ball = arena_array(parse_arena(p), Ball, (size_t)n);
    for (int i = 0; i < n; i++) {
        parse_comma(p);
        ball[i].centre = parse_vec3(p);
        ball[i].radius = parse_next_float(p);
    }
    parse_stray_comma(p);
    s->n = (uint32_t)n;
    s->ball = ball;
}

/* POV: the accuracy of its solver. */
static bool item(Parser *p, void *params)
{
    (void)params;
    if (!parse_accept(p, KW_TOLERANCE))
        return false;
    parse_float(p);
    return true;
}

static Ball weighed(const Ball *b, double w0, double w1, double w2)
{
    return (Ball){ add(add(scaled(b[0].centre, w0), scaled(b[1].centre, w1)), scaled(b[2].centre, w2)),
                   b[0].radius * w0 + b[1].radius * w1 + b[2].radius * w2 };
}

static uint32_t n_pieces(const Params *s) { return s->kind == LINEAR ? s->n - 1 : s->n - 3; }

/* Lengths divided by `unit`. Neighbours get the same bits where they meet. */
static void piece_of(const Params *s, uint32_t k, double unit, Piece *out)
{
    Ball b[4];
    int used = s->kind == LINEAR ? 2 : 4;
    for (int i = 0; i < used; i++)
        b[i] = (Ball){ scaled(s->ball[k + (uint32_t)i].centre, 1 / unit), s->ball[k + (uint32_t)i].radius / unit };
    if (s->kind == LINEAR) {
        out->ball[0] = (Ball){ b[0].centre, fabs(b[0].radius) };
        out->ball[1] = (Ball){ b[1].centre, fabs(b[1].radius) };
    } else if (s->kind == CUBIC) {
        out->ball[0] = b[1];
        out->ball[1] = weighed(b, -1 / 6.0, 1, 1 / 6.0);
        out->ball[2] = weighed(b + 1, 1 / 6.0, 1, -1 / 6.0);
        out->ball[3] = b[2];
    } else {
        out->ball[0] = weighed(b, 1 / 6.0, 4 / 6.0, 1 / 6.0);
        out->ball[1] = weighed(b, 0, 4 / 6.0, 2 / 6.0);
        out->ball[2] = weighed(b, 0, 2 / 6.0, 4 / 6.0);
        out->ball[3] = weighed(b + 1, 1 / 6.0, 4 / 6.0, 1 / 6.0);
    }
}

static Bounds box_of(const Piece *p, int degree)
{
    Bounds b = bounds_empty();
    for (int i = 0; i <= degree; i++) {
        Bounds ball = bounds_grown((Bounds){ p->ball[i].centre, p->ball[i].centre }, fabs(p->ball[i].radius));
        b = bounds_union(b, ball);
    }
    return b;
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *s = params;
    uint32_t n = n_pieces(s);
    double size = 0;
    for (uint32_t i = 0; i < s->n; i++)
        size = fmax(size, max_abs(s->ball[i].centre) + fabs(s->ball[i].radius));
    double unit = shape_unit(b, size);
    Sweep *out = build_data(b, sizeof *out + n * sizeof(Piece));
    Bounds *boxes = arena_array(b->arena, Bounds, n), all = bounds_empty();
    out->degree = s->kind == LINEAR ? 1 : 3;
    out->n = n;
    for (uint32_t k = 0; k < n; k++) {
        Piece *p = &out->piece[k];
        piece_of(s, k, unit, p);
        boxes[k] = shape_padded(box_of(p, out->degree));
        all = bounds_union(all, boxes[k]);
        p->middle = lerp(boxes[k].lo, boxes[k].hi, 0.5);
        for (int i = 0; i <= out->degree; i++)
            p->reach = fmax(p->reach, length(sub(p->ball[i].centre, p->middle)) + fabs(p->ball[i].radius));
        p->reach *= 1 + 1e-9;
    }
    out->middle = lerp(all.lo, all.hi, 0.5);
    out->accel_ops = b->accel;
    out->accel = n > FEW ? b->accel->build(b->arena, boxes, n) : NULL;
    Affine place = build_place(b, unit);
    build_prim(b, out, &place, all);
}

/* Where the ray is inside, from ball w0 of piece p0 to ball w1 of piece p1. */
typedef struct { double s0, s1, w0, w1; uint32_t p0, p1; } Span;

typedef struct {
    const Sweep *sweep;
    Vec3 o, u;                                 /* from the point nearest to the middle; unit length */
    double shift, len;
    HitSink *sink;
    uint32_t n;
    Span span[MOST_SPANS];                     /* disjoint */
} Line;

static void report(const Line *l, const Span *x)
{
    hit_add_uv(l->sink, l->shift + x->s0 / l->len, x->p0, x->w0, 0);
    if (x->s1 > x->s0)
        hit_add_uv(l->sink, l->shift + x->s1 / l->len, x->p1, x->w1, 0);
}

/* Equal ends belong to the first piece, whatever the order in which they come. */
static void join(Line *l, Span x)
{
    for (uint32_t i = 0; i < l->n;) {
        Span *e = &l->span[i];
        if (e->s0 > x.s1 || e->s1 < x.s0) {
            i++;
            continue;
        }
        if (e->s0 < x.s0 || (e->s0 == x.s0 && e->p0 < x.p0))
            x.s0 = e->s0, x.w0 = e->w0, x.p0 = e->p0;
        if (e->s1 > x.s1 || (e->s1 == x.s1 && e->p1 < x.p1))
            x.s1 = e->s1, x.w1 = e->w1, x.p1 = e->p1;
        *e = l->span[--l->n];
    }
    if (l->n == MOST_SPANS)                    /* more than a picture can show apart: walls inside may stay */
        report(l, &x);
    else
        l->span[l->n++] = x;
}

static Ball ball_at(const Piece *p, int degree, double w)
{
    double x[4], y[4], z[4], r[4];
    for (int i = 0; i <= degree; i++) {
        x[i] = p->ball[i].centre.x;
        y[i] = p->ball[i].centre.y;
        z[i] = p->ball[i].centre.z;
        r[i] = p->ball[i].radius;
    }
    return (Ball){ vec3(bernstein_value(x, degree, w), bernstein_value(y, degree, w), bernstein_value(z, degree, w)),
                   bernstein_value(r, degree, w) };
}

/* The ball of time w, if the ray meets it, widens the span. */
static void widen(const Line *l, const Piece *p, double w, Span *x)
{
    int degree = l->sweep->degree;
    Ball ball = w == 0 ? p->ball[0] : w == 1 ? p->ball[degree] : ball_at(p, degree, w);
    Vec3 v = sub(ball.centre, l->o);
    double b = dot(v, l->u), h2 = ball.radius * ball.radius - length2(sub(v, scaled(l->u, b)));
    if (!(h2 >= 0))
        return;
    double h = sqrt(h2);
    if (b - h < x->s0)
        x->s0 = b - h, x->w0 = w;
    if (b + h > x->s1)
        x->s1 = b + h, x->w1 = w;
}

static void linear_spans(Line *l, uint32_t k)
{
    const Piece *p = &l->sweep->piece[k];
    Vec3 v = sub(p->ball[0].centre, l->o), e = sub(p->ball[1].centre, p->ball[0].centre);
    double along = dot(e, l->u), r = p->ball[0].radius, q = p->ball[1].radius - r;
    v = sub(v, scaled(l->u, dot(v, l->u)));
    e = sub(e, scaled(l->u, along));
    /* h(w) = a w^2 + 2 b w + c; s-+ is least and greatest where a w + b = -+ along sqrt((b^2 - a c) / f). */
    double a = q * q - length2(e), b = r * q - dot(v, e), c = r * r - length2(v), f = along * along - a;
    Span x = { INFINITY, -INFINITY, 0, 0, k, k };
    widen(l, p, 0, &x);
    widen(l, p, 1, &x);
    if (f > 0) {                               /* else one ball holds the other */
        double turn = fabs(along) * sqrt(fmax(0, b * b - a * c) / f);
        for (int sign = -1; sign <= 1; sign += 2) {
            double g = sign * turn;
            double w = g * b > 0 ? (b * b - along * along * c) / (f * (g + b)) : (g - b) / a;
            if (w > 0 && w < 1)
                widen(l, p, w, &x);
        }
    }
    if (x.s0 <= x.s1)
        join(l, x);
}

/* h = the square of half the chord of the ball of time w: r^2 - |(c - o) x u|^2, degree 6. */
static void half_chord(const Line *l, const Piece *p, double h[7])
{
    double m[4][4], square[7];
    for (int i = 0; i < 4; i++) {
        Vec3 x = cross(sub(p->ball[i].centre, l->o), l->u);
        m[0][i] = p->ball[i].radius;
        m[1][i] = x.x;
        m[2][i] = x.y;
        m[3][i] = x.z;
    }
    bernstein_product(m[0], 3, m[0], 3, h);
    for (int j = 1; j < 4; j++) {
        bernstein_product(m[j], 3, m[j], 3, square);
        for (int i = 0; i < 7; i++)
            h[i] -= square[i];
    }
}

static void cubic_spans(Line *l, uint32_t k)
{
    const Piece *p = &l->sweep->piece[k];
    double h[7], dh[6], db[3], left[11], right[11], b2[5], zero[8], turn[15];
    half_chord(l, p, h);
    int n = 1, turns = 0;
    zero[0] = 0;
    n += bernstein_roots(h, 6, zero + 1);
    if (n == 1 && h[0] < 0)
        return;
    zero[n] = 1;
    for (int i = 0; i < 3; i++)
        db[i] = 3 * dot(sub(p->ball[i + 1].centre, p->ball[i].centre), l->u);
    for (int i = 0; i < 6; i++)
        dh[i] = 6 * (h[i + 1] - h[i]);
    bernstein_product(db, 2, db, 2, b2);
    bernstein_product(b2, 4, h, 6, left);
    bernstein_product(dh, 5, dh, 5, right);
    for (int i = 0; i <= 10; i++)
        left[i] = 4 * left[i] - right[i];
    turns = bernstein_roots(left, 10, turn);
    /* Across the path the least and the greatest fall together where h is greatest, and are not found as two. */
    turns += bernstein_roots(dh, 5, turn + turns);
    bool outside = h[0] < 0;
    for (int i = 0; i < n; i++, outside = !outside) {
        if (outside)
            continue;
        Span x = { INFINITY, -INFINITY, 0, 0, k, k };
        widen(l, p, zero[i], &x);
        widen(l, p, zero[i + 1], &x);
        for (int j = 0; j < turns; j++)
            if (turn[j] > zero[i] && turn[j] < zero[i + 1])
                widen(l, p, turn[j], &x);
        if (x.s0 <= x.s1)
            join(l, x);
    }
}

static void piece_spans(Line *l, uint32_t k)
{
    const Piece *p = &l->sweep->piece[k];
    Vec3 v = sub(p->middle, l->o);
    if (length2(sub(v, scaled(l->u, dot(v, l->u)))) > p->reach * p->reach)
        return;
    if (l->sweep->degree == 1)
        linear_spans(l, k);
    else
        cubic_spans(l, k);
}

static bool visit(void *user, uint32_t piece, double *t_max)
{
    (void)t_max;
    piece_spans(user, piece);
    return false;
}

/* Pieces beyond the best hit so far are left out: they cannot hide what lies before them. */
static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Sweep *sweep = shape;
    Line l;
    l.sweep = sweep;
    l.len = length(ray->d);
    l.u = scaled(ray->d, 1 / l.len);
    l.shift = -dot(sub(ray->o, sweep->middle), l.u) / l.len;
    l.o = ray_at(ray, l.shift);
    l.sink = sink;
    l.n = 0;
    if (sweep->accel != NULL) {
        double t_max = hit_limit(sink);
        sweep->accel_ops->walk(sweep->accel, ray, &t_max, visit, &l);
    } else
        for (uint32_t k = 0; k < sweep->n; k++)
            piece_spans(&l, k);
    for (uint32_t i = 0; i < l.n; i++)
        report(&l, &l.span[i]);
}

static bool inside_piece(const Piece *p, int degree, Vec3 q)
{
    double m[4][4], f[7], square[7], root[6];
    for (int i = 0; i <= degree; i++) {
        Vec3 x = sub(p->ball[i].centre, q);
        m[0][i] = p->ball[i].radius;
        m[1][i] = x.x;
        m[2][i] = x.y;
        m[3][i] = x.z;
    }
    bernstein_product(m[0], degree, m[0], degree, f);
    for (int j = 1; j < 4; j++) {
        bernstein_product(m[j], degree, m[j], degree, square);
        for (int i = 0; i <= 2 * degree; i++)
            f[i] -= square[i];
    }
    return f[0] > 0 || f[2 * degree] > 0 || bernstein_roots(f, 2 * degree, root) > 1;
}

typedef struct { const Sweep *sweep; Vec3 p; } Question;

static bool ask(void *user, uint32_t piece, double *t_max)
{
    (void)t_max;
    const Question *q = user;
    return inside_piece(&q->sweep->piece[piece], q->sweep->degree, q->p);
}

static bool inside(const void *shape, Vec3 p)
{
    const Sweep *s = shape;
    Question q = { s, p };
    if (s->accel != NULL)
        return s->accel_ops->around(s->accel, p, ask, &q);
    for (uint32_t k = 0; k < s->n; k++)
        if (inside_piece(&s->piece[k], s->degree, p))
            return true;
    return false;
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    const Sweep *s = shape;
    Ball ball = ball_at(&s->piece[hit->part], s->degree, hit->u);
    out->normal = normalized(sub(out->p, ball.centre));
    out->p = add(ball.centre, scaled(out->normal, fabs(ball.radius)));
}

/* POV: cubic splines with twice the radius; transforms that keep balls round move the balls, others the box. */
static Bounds extent(const void *params, const Affine *place)
{
    const Params *s = params;
    double k;
    bool round = shape_keeps_balls(place, &k);
    Bounds b = bounds_empty();
    for (uint32_t i = 0; i < s->n; i++) {
        double r = fabs(s->ball[i].radius) * (s->kind == CUBIC ? 2 : 1) * (round ? k : 1);
        Vec3 c = round ? affine_point(place, s->ball[i].centre) : s->ball[i].centre;
        b = bounds_union(b, bounds_grown((Bounds){ c, c }, r));
    }
    return round ? b : bounds_transformed(b, place);
}

const ShapeOps shape_sphere_sweep = {
    .keyword = "sphere_sweep", .params_size = sizeof(Params), .parse = parse, .item = item, .compile = compile, .hits = hits,
    .inside = inside, .surface = surface, .extent = extent,
};
