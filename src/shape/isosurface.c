/* isosurface.c - isosurface { function { f } ... }: where f of x, y, z has a given value, within a container.
 *
 * The first root along a ray is sought as the reference does (08-shapes, section 22): an interval is halved, near half first, until it
 * is shorter than the accuracy, and passed over as soon as the ends and the greatest gradient say that no root fits. What is
 * found lies up to the accuracy behind the true surface, and pictures show it, so here comes out the very same smallest interval; but
 * most halvings on the way are skipped. Calculus tells how steep and how curved f is at most on each eighth of the ray (func_pieces):
 * where it cannot come down to 0 nothing is asked, and where it falls all the way its root is closed in directly. Halvings that
 * remain are done three levels at a time, in the lanes of one evaluation, where that costs little. */
#include "func/func.h"
#include "shape/container.h"
#include "shape/shape.h"

enum { MAX_LEVELS = 3, MAX_POINTS = (1 << MAX_LEVELS) + 1, MAX_HALVINGS = 64, MAX_TRACE = 10 };

typedef struct {
    const Function *f;
    Container container;
    double threshold, accuracy, max_gradient;
    int max_trace;
    bool evaluates;
    double evaluate[3];
    bool open;
    int levels;                                /* of halving done in one evaluation */
    double scene_unit;                         /* of compiled ones: world lengths per scene length */
    Affine place;
} Isosurface;

static void parse(Parser *p, void *params)
{
    static const char *const names[] = { "x", "y", "z" };
    Isosurface *s = params;
    *s = (Isosurface){ .container = container_default(), .accuracy = 0.001, .max_gradient = 1.1, .max_trace = 1 };
    parse_expect(p, KW_FUNCTION);
    s->f = parse_function(p, names, 3);
    if (func_terms(s->f) != 1 || func_parameters(s->f) != 3)
        parse_fail(p, "an isosurface needs a function of x, y and z with a float value");
}

static double positive(Parser *p, const char *what, double otherwise)
{
    double v = parse_float(p);
    if (v > 0)
        return v;
    parse_warn(p, "%s of an isosurface must be positive; using %g.", what, otherwise);
    return otherwise;
}

static bool item(Parser *p, void *params)
{
    Isosurface *s = params;
    if (parse_accept(p, KW_CONTAINED_BY)) {
        s->container = container_parse(p);
    } else if (parse_accept(p, KW_THRESHOLD)) {
        s->threshold = parse_float(p);
    } else if (parse_accept(p, KW_ACCURACY)) {
        s->accuracy = positive(p, "accuracy", 0.001);
    } else if (parse_accept(p, KW_MAX_GRADIENT)) {
        s->max_gradient = positive(p, "max_gradient", 1.1);
    } else if (parse_accept(p, KW_MAX_TRACE)) {
        int n = parse_int(p);
        if (n < 1 || n > MAX_TRACE)
            parse_warn(p, "max_trace of an isosurface must be 1 to %d.", MAX_TRACE);
        s->max_trace = n < 1 ? 1 : n > MAX_TRACE ? MAX_TRACE : n;
    } else if (parse_accept(p, KW_ALL_INTERSECTIONS)) {
        s->max_trace = MAX_TRACE;
    } else if (parse_accept(p, KW_EVALUATE)) {
        s->evaluates = true;
        s->evaluate[0] = parse_float(p);
        s->evaluate[1] = parse_next_float(p);
        s->evaluate[2] = parse_next_float(p);
        if (s->evaluate[0] <= 0 || s->evaluate[1] <= 1 || s->evaluate[2] <= 0)
            s->evaluates = false;
    } else {
        return false;
    }
    return true;
}

/* A ray on its way through an isosurface. Times are the ray's own. */
typedef struct Search {
    const Isosurface *s;
    const Ray *ray;
    const HitSink *sink;
    double sign;                               /* +1 outside, -1 inside */
    double accuracy;                           /* as a time */
    double speed;                              /* local length per time */
    double gradient;
    double start, end;                         /* of the halvings */
    bool measured;                             /* are the pieces known? They are the third halvings */
    FuncPieces pieces;
} Search;

static double value_at(const Search *q, double t)
{
    Vec3 p = ray_at(q->ray, t);
    return func_call(q->s->f, (const double[]){ p.x, p.y, p.z }) - q->s->threshold;
}

/* Points in order along the ray, 0 and `n` the ends of an interval, the others its repeated midpoints; what f has above the
 * threshold there. */
typedef struct Samples { int n; double t[MAX_POINTS], v[MAX_POINTS]; } Samples;

static void fill(Search *q, Samples *s, int first, int n)
{
    double x[MAX_POINTS], y[MAX_POINTS], z[MAX_POINTS];
    for (int i = 0; i < n; i++) {
        Vec3 p = ray_at(q->ray, s->t[first + i]);
        x[i] = p.x;
        y[i] = p.y;
        z[i] = p.z;
    }
    func_eval(q->s->f, (const double *const[]){ x, y, z }, s->v + first, (uint32_t)n);
    for (int i = 0; i < n; i++)
        s->v[first + i] -= q->s->threshold;
}

static void divide(const Search *q, Samples *s, double a, double b, int levels)
{
    double length = b - a;
    while (levels > 1 && length <= 2 * q->accuracy) {
        levels--;
        length *= 2;
    }
    s->n = 1 << levels;
    s->t[0] = a;
    s->t[s->n] = b;
    for (int step = s->n; step > 1; step /= 2)
        for (int i = step / 2; i < s->n; i += step)
            s->t[i] = (s->t[i - step / 2] + s->t[i + step / 2]) / 2;
}

/* A first look from a to b; where functions are dear, at the ends only. */
static void look(Search *q, Samples *s, double a, double b)
{
    divide(q, s, a, b, q->s->levels > 1 ? q->s->levels : 0);
    fill(q, s, 0, s->n + 1);
}

/* Between two samples whose values are known. */
static void look_closer(Search *q, Samples *s, const Samples *from, int i)
{
    int levels = 1;
    double length = from->t[i + 1] - from->t[i];
    for (; levels < q->s->levels && length > 2 * q->accuracy; length /= 2)
        levels++;
    divide(q, s, from->t[i], from->t[i + 1], levels);
    s->v[s->n] = from->v[i + 1];
    if (s->n == 2) {
        s->v[0] = from->v[i];
        s->v[1] = value_at(q, s->t[1]);
    } else {
        fill(q, s, 0, s->n);                   /* the first again: full rows are handled faster */
    }
}

typedef enum Found { NONE, ROOT, BEYOND } Found;               /* BEYOND: what could still come lies too far away to count */

static bool may_hold_root(Search *q, double length, double va, double vb)
{
    const Isosurface *s = q->s;
    if (s->evaluates) {
        double steepest = fabs(vb - va) / (q->speed * length) * s->evaluate[1];
        if (q->gradient < steepest)
            q->gradient = s->evaluate[1] * steepest;
    }
    return va + vb < q->gradient * q->speed * length;
}

/* What calculus says of each eighth of the way: paid for by fewer halvings once the first two have not settled the matter. */
static void measure(Search *q)
{
    const Ray *ray = q->ray;
    const double start[3] = { ray->o.x, ray->o.y, ray->o.z }, speed[3] = { ray->d.x, ray->d.y, ray->d.z };
    double at[FUNC_PIECES + 1];
    at[0] = q->start;
    at[FUNC_PIECES] = q->end;
    for (int step = FUNC_PIECES; step > 1; step /= 2)
        for (int i = step / 2; i < FUNC_PIECES; i += step)
            at[i] = (at[i - step / 2] + at[i + step / 2]) / 2;
    func_pieces(q->s->f, start, speed, at, &q->pieces);
    q->measured = true;
}

/* Bounds of the derivatives of f on a halving, whose first piece is given. */
typedef struct Shape { double steep, bend; } Shape;

static Shape shape_of(const Search *q, int piece, int depth)
{
    Shape most = { 0, 0 };
    for (int i = piece, n = depth < 3 ? FUNC_PIECES >> depth : 1; n > 0; i++, n--) {
        most.steep = q->pieces.first[i] > most.steep ? q->pieces.first[i] : most.steep;
        most.bend = q->pieces.second[i] > most.bend ? q->pieces.second[i] : most.bend;
    }
    return most;
}

/* Positive at both ends: also between them? The lowest that the bounds allow is above 0. */
static bool stays_positive(const Shape *m, double length, double va, double vb)
{
    if (va + vb > m->steep * length)
        return true;
    double sag = m->bend * length * length / 2, rise = fabs(vb - va);
    return rise > sag || (va + vb) / 2 - sag / 4 > rise * rise / (4 * sag);
}

/* Does f fall all the way from a to b, nowhere steeper than the greatest gradient? Then the halvings find the one root. */
static bool falls(const Search *q, const Shape *m, double length, double va, double vb)
{
    double slope = (va - vb) / length, change = m->bend * length / 2;
    return slope > change && slope + change <= q->gradient * q->speed;
}

/* A root between a and b, where f has been asked: va >= 0 > vb. Its neighbours' values and the bend say that it is between lo and hi. */
typedef struct Bracket { double a, va, b, vb, lo, hi; } Bracket;

static void bracket_put(Bracket *k, double t, double v)
{
    if (v < 0) {
        k->b = t;
        k->vb = v;
    } else {
        k->a = t;
        k->va = v;
    }
}

/* One point: in turn where a line through both ends meets 0, and the far end of what is left. */
static void ask_one(const Search *q, Bracket *k, bool far_end)
{
    double t = k->a + k->va * ((k->b - k->a) / (k->va - k->vb));
    if (far_end)
        t = k->va < -k->vb ? k->hi : k->lo;
    t = t < k->lo ? k->lo : t > k->hi ? k->hi : t;
    bracket_put(k, t, q->sign * value_at(q, t));
}

static void ask_row(Search *q, Bracket *k)
{
    enum { N = 8 };
    Samples s = { .n = N };
    for (int i = 0; i < N; i++)
        s.t[i] = k->lo + (k->hi - k->lo) * ((i + 1) / (N + 1.0));
    fill(q, &s, 0, N);
    int i = 0;
    while (i < N - 1 && q->sign * s.v[i] >= 0)
        i++;
    if (i > 0)
        bracket_put(k, s.t[i - 1], q->sign * s.v[i - 1]);
    bracket_put(k, s.t[i], q->sign * s.v[i]);
}

/* Where f falls from a to b: the end of the smallest halving with the root, as if all had been looked at. Halvings ask f only
 * while their middle is not on a known side of it. */
static double fall(Search *q, double a, double va, double b, double vb, double bend, int depth)
{
    enum { TURNS = 8 };
    Bracket k = { a, va, b, vb, a, b };
    for (int turn = 0; turn < TURNS; turn++) {
        double slope = (k.va - k.vb) / (k.b - k.a), change = bend * (k.b - k.a) / 2, steep = slope + change, flat = slope - change;
        k.lo = greater(k.lo, greater(k.a + k.va / steep, k.b + k.vb / flat));
        k.hi = lesser(k.hi, lesser(k.a + k.va / flat, k.b + k.vb / steep));
        if (!(k.hi - k.lo > q->accuracy / 4))
            break;
        if (q->s->levels > 1)
            ask_row(q, &k);
        else
            ask_one(q, &k, turn % 2 != 0);
    }
    for (; b - a >= q->accuracy && depth < MAX_HALVINGS; depth++) {
        double middle = (a + b) / 2;
        if (middle <= k.lo || (middle < k.hi && q->sign * value_at(q, middle) >= 0))
            k.lo = greater(k.lo, a = middle);
        else
            k.hi = lesser(k.hi, b = middle);
    }
    return b;
}

static Found search(Search *q, const Samples *s, int i, int j, int depth, int piece, double *root)
{
    double a = s->t[i], b = s->t[j], va = q->sign * s->v[i], vb = q->sign * s->v[j];
    if (b - a < q->accuracy || depth == MAX_HALVINGS) {
        *root = b;
        return vb < 0 ? ROOT : NONE;
    }
    if (q->sink != NULL && a > hit_limit(q->sink))
        return BEYOND;
    if (!may_hold_root(q, b - a, va, vb))
        return NONE;
    Samples closer;
    if (j - i == 1) {
        if (!q->measured && depth >= 2 && !q->s->evaluates)
            measure(q);
        if (q->measured && va > 0) {
            Shape most = shape_of(q, piece, depth);
            if (vb > 0 && stays_positive(&most, b - a, va, vb))
                return NONE;
            if (vb < 0 && falls(q, &most, b - a, va, vb)) {
                *root = fall(q, a, va, b, vb, most.bend, depth);
                return ROOT;
            }
        }
        look_closer(q, &closer, s, i);
        s = &closer;
        i = 0;
        j = closer.n;
    }
    int middle = (i + j) / 2, half = depth < 3 ? FUNC_PIECES / 2 >> depth : 0;
    Found found = search(q, s, i, middle, depth + 1, piece, root);
    return found != NONE ? found : search(q, s, middle, j, depth + 1, piece + half, root);
}

static void report_roots(Search *q, Samples *s, int left, HitSink *sink)
{
    double end = s->t[s->n], root;
    for (; left > 0; left--) {
        if (q->s->evaluates && q->gradient > q->s->evaluate[0])
            q->gradient *= q->s->evaluate[2];
        q->start = s->t[0];
        q->end = end;
        q->measured = false;
        if (search(q, s, 0, s->n, 0, 0, &root) != ROOT)
            return;
        hit_add(sink, root, 0);
        double next = root + 5 * q->accuracy;
        if (left == 1 || end - next < q->accuracy)
            return;
        q->sign = -q->sign;
        look(q, s, next, end);
    }
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Isosurface *s = shape;
    double t0, t1;
    uint32_t enter, leave;
    if (!container_span(&s->container, ray, &t0, &t1, &enter, &leave) || t1 <= 0)
        return;
    double scene_speed = length(affine_vector(&s->place, ray->d)) / s->scene_unit;
    Search q = { .s = s, .ray = ray, .sink = sink, .sign = 1, .accuracy = s->accuracy / scene_speed, .speed = length(ray->d),
                 .gradient = s->max_gradient };
    double near = 4 * s->max_gradient * s->accuracy;
    int left = s->max_trace;
    t0 = fmax(t0, 0);
    bool starts_outside = t0 > q.accuracy;
    if (!starts_outside) {                     /* on the surface that the ray has just left, perhaps: not within the accuracy of it */
        double v = value_at(&q, t0);
        if ((s->open ? fabs(v) : v) < near)
            t0 = 5 * q.accuracy;
    }
    if (t1 - t0 < q.accuracy)
        return;
    Samples samples;
    look(&q, &samples, t0, t1);
    bool starts_inside = samples.v[0] < 0;
    if (starts_inside)
        q.sign = -1;
    if (!s->open && starts_outside && starts_inside) {
        hit_add(sink, t0, enter);
        left--;
    } else if (!s->open && !starts_outside && samples.v[samples.n] < 0) {
        hit_add(sink, t1, leave);
    }
    report_roots(&q, &samples, left, sink);
}

static bool inside(const void *shape, Vec3 p)
{
    const Isosurface *s = shape;
    return container_holds(&s->container, p) && func_call(s->f, (const double[]){ p.x, p.y, p.z }) - s->threshold <= 0;
}

/* POV: one-sided differences with steps of the accuracy, so a coarse one tilts the normals. */
static void surface(const void *shape, const Hit *hit, Surface *out)
{
    const Isosurface *s = shape;
    if (hit->part != 0) {
        out->normal = container_normal(&s->container, hit->part, out->p);
        return;
    }
    double a = s->accuracy, v[4];
    Vec3 p = out->p;
    const double x[] = { p.x, p.x + a, p.x, p.x }, y[] = { p.y, p.y, p.y + a, p.y }, z[] = { p.z, p.z, p.z, p.z + a };
    func_eval(s->f, (const double *const[]){ x, y, z }, v, 4);
    out->normal = vec3(v[1] - v[0], v[2] - v[0], v[3] - v[0]);
    if (out->normal.x == 0 && out->normal.y == 0 && out->normal.z == 0)
        out->normal = vec3(1, 0, 0);
}

static void compile(ShapeBuild *b, const void *params)
{
    Isosurface *s = build_data(b, sizeof *s);
    *s = *(const Isosurface *)params;
    s->open = (b->object->flags & OBJECT_OPEN) != 0;
    s->place = b->place;
    s->scene_unit = b->unit;
    s->levels = func_is_cheap(s->f) ? MAX_LEVELS : 1;
    build_prim(b, s, &b->place, shape_padded(s->container.box));
}

static Bounds extent(const void *params, const Affine *place)
{
    return bounds_transformed(((const Isosurface *)params)->container.box, place);
}

const ShapeOps shape_isosurface = {
    .keyword = "isosurface", .params_size = sizeof(Isosurface), .flags = SHAPE_HAS_OPEN | SHAPE_FIRST_HITS, .parse = parse, .item = item,
    .compile = compile, .hits = hits, .inside = inside, .surface = surface, .extent = extent,
};
