/* curve.c - see curve.h. */
#include "shape/curve.h"

#include "math/bernstein.h"
#include "shape/shape.h"

CurvePiece curve_piece(const Vec2 *p, int degree)
{
    CurvePiece c = { .degree = degree, .lo = p[0], .hi = p[0] };
    for (int i = 0; i <= degree; i++) {
        c.p[i] = p[i];
        c.lo = (Vec2){ fmin(c.lo.u, p[i].u), fmin(c.lo.v, p[i].v) };
        c.hi = (Vec2){ fmax(c.hi.u, p[i].u), fmax(c.hi.v, p[i].v) };
    }
    return c;
}

/* a + (c - b) * f */
static Vec2 along(Vec2 a, Vec2 b, Vec2 c, double f)
{
    return (Vec2){ a.u + (c.u - b.u) * f, a.v + (c.v - b.v) * f };
}

CurvePiece curve_spline_piece(CurveKind kind, const Vec2 *p)
{
    switch (kind) {
    case CURVE_QUADRATIC: {
        const Vec2 q[3] = { p[1], along(p[1], p[0], p[2], 0.25), p[2] };
        return curve_piece(q, 2);
    }
    case CURVE_CUBIC: {
        const Vec2 q[4] = { p[1], along(p[1], p[0], p[2], 1 / 6.0), along(p[2], p[3], p[1], 1 / 6.0), p[2] };
        return curve_piece(q, 3);
    }
    case CURVE_BEZIER:
        return curve_piece(p, 3);
    case CURVE_LINEAR:
        break;
    }
    return curve_piece(p, 1);
}

static void components(const CurvePiece *c, double *u, double *v)
{
    for (int i = 0; i <= c->degree; i++) {
        u[i] = c->p[i].u;
        v[i] = c->p[i].v;
    }
}

static Vec2 between(Vec2 a, Vec2 b, double w)
{
    return (Vec2){ a.u + w * (b.u - a.u), a.v + w * (b.v - a.v) };
}

/* De Casteljau. */
Vec2 curve_at(const CurvePiece *c, double w)
{
    Vec2 a = between(c->p[0], c->p[1], w);
    if (c->degree == 1)
        return a;
    Vec2 b = between(c->p[1], c->p[2], w), ab = between(a, b, w);
    return c->degree == 2 ? ab : between(ab, between(b, between(c->p[2], c->p[3], w), w), w);
}

static Vec2 step(Vec2 a, Vec2 b, double by)
{
    return (Vec2){ by * (b.u - a.u), by * (b.v - a.v) };
}

Vec2 curve_slope(const CurvePiece *c, double w)
{
    Vec2 a = c->p[0], b = c->p[1];
    if (c->degree == 1)
        return step(a, b, 1);
    Vec2 ab = between(a, b, w), bc = between(b, c->p[2], w);
    if (c->degree == 2)
        return step(ab, bc, 2);
    return step(between(ab, bc, w), between(bc, between(c->p[2], c->p[3], w), w), 3);
}

static bool odd_beyond(const CurvePiece *c, double u, double v)
{
    double height[4], root[4];
    for (int i = 0; i <= c->degree; i++)
        height[i] = c->p[i].v - v;
    if (u <= c->lo.u)
        return (height[0] < 0) != (height[c->degree] < 0);
    int n = bernstein_roots(height, c->degree, root);
    bool odd = false;
    for (int i = 0; i < n; i++)
        odd ^= curve_at(c, root[i]).u >= u;
    return odd;
}

/* Pieces are named by so many rows at most on average; a curve of tall ones has a single row. */
enum { ROWS_MAX = 64, ROWS_PER_PIECE = 8 };

/* How often the pieces are named: by row k, and by rows before it, count[k] times. */
static uint32_t count_rows(const Curve *c, const CurveRows *r, uint32_t *count)
{
    for (uint32_t i = 0; i < c->n; i++)
        for (uint32_t k = curve_row(r, c->piece[i].lo.v); k <= curve_row(r, c->piece[i].hi.v); k++)
            count[k]++;
    for (uint32_t k = 1; k <= r->n; k++)
        count[k] += count[k - 1];
    return count[r->n];
}

void curve_sort(Arena *arena, Curve *c)
{
    double lo = INFINITY, hi = -INFINITY;
    for (uint32_t i = 0; i < c->n; i++) {
        lo = lesser(lo, c->piece[i].lo.v);
        hi = greater(hi, c->piece[i].hi.v);
    }
    CurveRows r = { .lo = lo, .n = c->n < 2 * ROWS_MAX ? c->n / 2 + 1 : ROWS_MAX };
    r.scale = hi > lo ? r.n / (hi - lo) : 0;
    uint32_t *first = arena_array(arena, uint32_t, r.n + 1), total = count_rows(c, &r, first);
    if (total / ROWS_PER_PIECE > c->n) {
        r.n = 1;
        first[0] = first[1] = total = c->n;
    }
    uint32_t *piece = arena_array(arena, uint32_t, total);
    for (uint32_t i = c->n; i-- > 0;)          /* from the end of each row to its beginning */
        for (uint32_t k = curve_row(&r, c->piece[i].lo.v), last = curve_row(&r, c->piece[i].hi.v); k <= last; k++)
            piece[--first[k]] = i;
    r.first = first;
    r.piece = piece;
    c->rows = r;
}

bool curve_inside(const Curve *c, double u, double v)
{
    bool odd = false;
    uint32_t row = curve_row(&c->rows, v);
    for (uint32_t i = c->rows.first[row]; i < c->rows.first[row + 1]; i++) {
        const CurvePiece *piece = &c->piece[c->rows.piece[i]];
        if (piece->lo.v <= v && v <= piece->hi.v && u <= piece->hi.u)
            odd ^= odd_beyond(piece, u, v);
    }
    return odd;
}

static void extent_of(const double *b, int n, double *lo, double *hi)
{
    double d[4], root[4];
    *lo = fmin(b[0], b[n]);
    *hi = fmax(b[0], b[n]);
    for (int i = 0; i < n; i++)
        d[i] = b[i + 1] - b[i];
    int found = n > 1 ? bernstein_roots(d, n - 1, root) : 0;
    for (int i = 0; i < found; i++) {
        double x = bernstein_value(b, n, root[i]);
        *lo = fmin(*lo, x);
        *hi = fmax(*hi, x);
    }
}

void curve_extent(const CurvePiece *c, Vec2 *lo, Vec2 *hi)
{
    double u[4], v[4];
    components(c, u, v);
    extent_of(u, c->degree, &lo->u, &hi->u);
    extent_of(v, c->degree, &lo->v, &hi->v);
}

Curve curve_scaled(Arena *arena, Curve c, double by)
{
    Curve out = { .piece = arena_array(arena, CurvePiece, c.n), .n = c.n };
    for (uint32_t i = 0; i < c.n; i++) {
        Vec2 p[4];
        for (int k = 0; k <= c.piece[i].degree; k++)
            p[k] = (Vec2){ c.piece[i].p[k].u * by, c.piece[i].p[k].v * by };
        out.piece[i] = curve_piece(p, c.piece[i].degree);
    }
    curve_sort(arena, &out);
    return out;
}
