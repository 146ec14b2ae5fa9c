/* sor.c - sor { n, points [open] }: about the y axis, the square of the radius a cubic in the height.
 *
 * A segment keeps that cubic in Bernstein form over its own heights: its ends are the squares of the points' radii exactly,
 * so neighbours agree where they meet. Parts: the segment; n: base, n + 1: cap. (08-shapes, section 16.3) */
#include "math/bernstein.h"
#include "sdl/parse.h"
#include "shape/shape.h"

typedef struct { const Vec2 *point; uint32_t n; } Params;
typedef struct { double y0, y1, b[4], least2, most2; } Segment;    /* radius^2 over [y0, y1]; its bounds */
typedef struct { uint32_t n; bool open; double most, y0, y1, end2[2]; Segment segment[]; } Sor;

static void parse(Parser *p, void *params)
{
    Params *s = params;
    int n = parse_int(p);
    if (n < 4)
        parse_fail(p, "a sor needs at least 4 points, found %d", n);
    if (n > 1000000)
        parse_fail(p, "a sor has at most 1000000 points, found %d", n);
    Vec2 *v = arena_array(parse_arena(p), Vec2, (size_t)n);
    for (int i = 0; i < n; i++) {
        parse_comma(p);
        v[i] = parse_vec2(p);
        if (v[i].u < 0 || (i > 1 && i < n - 1 && !(v[i].v > v[i - 1].v)))
            parse_fail(p, "Incorrect point in surface of revolution.");
    }
    if (v[0].v == v[2].v || v[n - 3].v == v[n - 1].v)
        parse_fail(p, "points of a surface of revolution two apart must differ in height");
    parse_stray_comma(p);
    s->point = v;
    s->n = (uint32_t)n;
}

/* d(radius^2)/dy at point i, from its neighbours. */
static double slope_at(const Vec2 *p, uint32_t i)
{
    return 2 * p[i].u * (p[i + 1].u - p[i - 1].u) / (p[i + 1].v - p[i - 1].v);
}

static Segment segment_of(const Params *s, uint32_t k, double unit)
{
    Vec2 p[4];
    for (uint32_t i = 0; i < 4; i++)
        p[i] = (Vec2){ s->point[k + i].u / unit, s->point[k + i].v / unit };
    double third = (p[2].v - p[1].v) / 3;
    Segment g = { .y0 = p[1].v, .y1 = p[2].v };
    g.b[0] = p[1].u * p[1].u;
    g.b[3] = p[2].u * p[2].u;
    g.b[1] = g.b[0] + third * slope_at(p, 1);
    g.b[2] = g.b[3] - third * slope_at(p, 2);
    double d[3] = { g.b[1] - g.b[0], g.b[2] - g.b[1], g.b[3] - g.b[2] }, root[2];
    g.most2 = fmax(g.b[0], g.b[3]);
    g.least2 = fmin(g.b[0], g.b[3]);
    int n = bernstein_roots(d, 2, root);
    for (int i = 0; i < n; i++) {
        g.most2 = fmax(g.most2, bernstein_value(g.b, 3, root[i]));
        g.least2 = fmin(g.least2, bernstein_value(g.b, 3, root[i]));
    }
    return g;
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *s = params;
    double size = 0;
    for (uint32_t i = 0; i < s->n; i++)
        size = fmax(size, fmax(s->point[i].u, fabs(s->point[i].v)));
    double unit = shape_unit(b, size);
    Sor *out = build_data(b, sizeof *out + (s->n - 3) * sizeof(Segment));
    out->n = s->n - 3;
    out->open = b->object->flags & OBJECT_OPEN;
    for (uint32_t k = 0; k < out->n; k++) {
        out->segment[k] = segment_of(s, k, unit);
        out->most = fmax(out->most, sqrt(out->segment[k].most2));
    }
    out->y0 = out->segment[0].y0;
    out->y1 = out->segment[out->n - 1].y1;
    out->end2[0] = out->segment[0].b[0];
    out->end2[1] = out->segment[out->n - 1].b[3];
    Affine place = build_place(b, unit);
    build_prim(b, out, &place, shape_padded((Bounds){ vec3(-out->most, out->y0, -out->most), vec3(out->most, out->y1, out->most) }));
}

/* The ray with its origin near the shape, its direction of unit length. */
typedef struct { Vec3 o, u; double middle; } Line;         /* middle: nearest to the axis */

/* The first segment that reaches up to y, or the last. */
static uint32_t segment_index(const Sor *s, double y)
{
    uint32_t lo = 0, hi = s->n - 1;
    while (lo < hi) {
        uint32_t middle = (lo + hi) / 2;
        if (y <= s->segment[middle].y1)
            hi = middle;
        else
            lo = middle + 1;
    }
    return lo;
}

static double rho2_at(const Line *l, double s)
{
    double x = l->o.x + s * l->u.x, z = l->o.z + s * l->u.z;
    return x * x + z * z;
}

/* radius^2 - rho^2 along the ray as a cubic in Bernstein form over [s0, s1]: blossoms at the ends. */
static void cubic_along(const Segment *g, const Line *l, double s0, double s1, double f[4])
{
    double h = g->y1 - g->y0, w[2] = { (l->o.y + s0 * l->u.y - g->y0) / h, (l->o.y + s1 * l->u.y - g->y0) / h };
    double across = (l->o.x + s0 * l->u.x) * (l->o.x + s1 * l->u.x) + (l->o.z + s0 * l->u.z) * (l->o.z + s1 * l->u.z);
    double q[3] = { rho2_at(l, s0), across, rho2_at(l, s1) };
    const double rho2[4] = { q[0], (q[0] + 2 * q[1]) / 3, (2 * q[1] + q[2]) / 3, q[2] };
    for (int k = 0; k < 4; k++) {              /* k of the three arguments at the far end */
        double b[4] = { g->b[0], g->b[1], g->b[2], g->b[3] };
        for (int j = 0; j < 3; j++) {
            double a = w[j < k];
            for (int i = 0; i < 3 - j; i++)
                b[i] = b[i] * (1 - a) + b[i + 1] * a;
        }
        f[k] = b[0] - rho2[k];
    }
}

static void sides(const Sor *s, uint32_t k, const Line *l, double near, double far, double shift, double len, HitSink *sink)
{
    const Segment *g = &s->segment[k];
    double s0 = near, s1 = far, at0 = -1, at1 = -1, f[4], root[4];
    if (l->u.y != 0) {                         /* the ends of the segment: the same numbers in both neighbours */
        double ya = (g->y0 - l->o.y) / l->u.y, yb = (g->y1 - l->o.y) / l->u.y;
        double a2 = g->b[0] - rho2_at(l, ya), b2 = g->b[3] - rho2_at(l, yb);
        if (ya > yb) {
            double t = ya, t2 = a2;
            ya = yb, yb = t;
            a2 = b2, b2 = t2;
        }
        if (ya > s0)
            s0 = ya, at0 = a2;
        if (yb < s1)
            s1 = yb, at1 = b2;
    } else if (l->o.y < g->y0 || l->o.y >= g->y1)
        return;
    if (!(s0 < s1))
        return;
    /* The ray's squared distance from the axis is least at `middle` and greatest at an end. */
    double lo = rho2_at(l, lesser(greater(l->middle, s0), s1)), hi = greater(rho2_at(l, s0), rho2_at(l, s1));
    double room = 1e-9 * s->most * s->most;
    if (lo > g->most2 + room || (hi < g->least2 - room && s0 != near && s1 != far))
        return;
    cubic_along(g, l, s0, s1, f);
    f[0] = s0 == near ? -fabs(f[0]) : at0;     /* beyond the greatest radius one is outside */
    f[3] = s1 == far ? -fabs(f[3]) : at1;
    int n = bernstein_roots(f, 3, root);
    for (int i = 0; i < n; i++)
        hit_add(sink, shift + (s0 + (s1 - s0) * root[i]) / len, k);
}

/* The part of the ray within the greatest radius; beyond it there is only outside. */
static bool reach(const Sor *s, Line *l, double *near, double *far)
{
    double size = 4 * (s->most + (s->y1 - s->y0)), r = l->u.x * l->u.x + l->u.z * l->u.z;
    *near = -size;                             /* the origin is the point nearest to the middle */
    *far = size;
    if (r < 1e-9)                              /* nearly along the axis: the ends of the segments bound it */
        return true;
    double middle = l->middle = -(l->o.x * l->u.x + l->o.z * l->u.z) / r;
    double h2 = s->most * s->most * (1 + 1e-12) - rho2_at(l, middle);
    if (h2 < 0)
        return false;
    *near = fmax(*near, middle - sqrt(h2 / r));
    *far = fmin(*far, middle + sqrt(h2 / r));
    return true;
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Sor *s = shape;
    double len = length(ray->d), centre = 0.5 * (s->y0 + s->y1), near, far;
    Line l = { .u = scaled(ray->d, 1 / len) };
    double shift = -dot(vec3(ray->o.x, ray->o.y - centre, ray->o.z), l.u) / len;
    l.o = ray_at(ray, shift);
    if (!reach(s, &l, &near, &far))
        return;
    double ya = l.o.y + near * l.u.y, yb = l.o.y + far * l.u.y, room = 1e-9 * (s->most + s->y1 - s->y0);
    uint32_t first = segment_index(s, lesser(ya, yb) - room), last = segment_index(s, greater(ya, yb) + room);
    for (uint32_t k = first; k <= last; k++)
        sides(s, k, &l, near, far, shift, len, sink);
    /* POV leaves ends of a radius below 0.01 open, whatever the size; here a closed end is closed. */
    for (uint32_t i = 0; i < 2 && !s->open && l.u.y != 0; i++) {
        double t = ((i ? s->y1 : s->y0) - l.o.y) / l.u.y;
        if (rho2_at(&l, t) <= s->end2[i] && s->end2[i] > 0)
            hit_add(sink, shift + t / len, s->n + i);
    }
}

static bool inside(const void *shape, Vec3 p)
{
    const Sor *s = shape;
    if (!(s->y0 <= p.y && p.y <= s->y1))
        return false;
    const Segment *g = &s->segment[segment_index(s, p.y)];
    return p.x * p.x + p.z * p.z <= bernstein_value(g->b, 3, (p.y - g->y0) / (g->y1 - g->y0));
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    const Sor *s = shape;
    double rho2 = out->p.x * out->p.x + out->p.z * out->p.z, v;
    if (hit->part >= s->n) {
        bool cap = hit->part > s->n;
        out->p.y = cap ? s->y1 : s->y0;
        out->normal = vec3(0, cap ? 1 : -1, 0);
        double r = sqrt(rho2 / s->end2[cap]);
        v = cap ? 2 - r : r - 1;
    } else {
        const Segment *g = &s->segment[hit->part];
        double h = g->y1 - g->y0, w = (out->p.y - g->y0) / h;
        out->normal = vec3(out->p.x, -0.5 * bernstein_slope(g->b, 3, w) / h, out->p.z);
        if (max_abs(out->normal) == 0)
            out->normal = vec3(0, hit->part == 0 && s->n > 1 ? -1 : 1, 0);
        v = (hit->part + w) / s->n;
    }
    if (out->want_uv)
        out->uv = (Vec2){ shape_longitude(out->p.x, out->p.z), v };
}

static Bounds extent(const void *params, const Affine *place)
{
    const Params *s = params;
    double most2 = 0;
    for (uint32_t k = 0; k + 3 < s->n; k++)
        most2 = fmax(most2, segment_of(s, k, 1).most2);
    double r = sqrt(most2);
    return bounds_transformed((Bounds){ vec3(-r, s->point[1].v, -r), vec3(r, s->point[s->n - 2].v, r) }, place);
}

const ShapeOps shape_sor = {
    .keyword = "sor", .params_size = sizeof(Params), .flags = SHAPE_HAS_OPEN | SHAPE_HAS_STURM | SHAPE_HAS_UV, .parse = parse,
    .compile = compile, .hits = hits, .inside = inside, .surface = surface, .extent = extent,
};
