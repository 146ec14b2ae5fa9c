/* isosurface.c - isosurface { function { f } ... }: where f of x, y, z has a given value, within a container.
 *
 * The first root along a ray is sought as the reference does (08-shapes, section 22): an interval is halved, near half first, until it
 * is shorter than the accuracy, and passed over as soon as the ends and the greatest gradient say that no root fits. What is
 * found lies up to the accuracy behind the true surface, and pictures show it, so here comes out the very same smallest interval; but
 * most halvings on the way are skipped. Calculus tells the range of f on each eighth of the ray and how steep and how curved it is
 * at most (func_pieces): where it cannot come down to 0 nothing is asked, and where it falls all the way its root is closed in
 * directly. Halvings that remain are done three levels at a time, in the lanes of one evaluation, where that costs little. */
#include "func/func.h"
#include "shape/container.h"
#include "shape/shape.h"

enum { GRID = FUNC_PIECES, ALL_PIECES = (1 << GRID) - 1, MAX_HALVINGS = 64, MAX_TRACE = 10 };

typedef struct {
    const Function *f;
    Container container;
    double threshold, accuracy, max_gradient;
    int max_trace;
    bool evaluates;
    double evaluate[3];
    bool open;
    bool cheap;                                /* are eight values as quickly found as one? */
    bool bounded;                              /* is there something to learn from calculus? */
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

/* A ray on its way through an isosurface. Times are the ray's own; values are what f has above the threshold, times the sign. */
typedef struct Search {
    const Isosurface *s;
    const HitSink *sink;
    FuncLine line;                             /* the ray */
    double sign;                               /* +1 outside, -1 inside */
    double accuracy;                           /* as a time */
    double speed;                              /* local length per time */
    double gradient;
    /* The first three halvings, done at once. */
    double t[GRID + 1], v[GRID + 1];
    unsigned known;                            /* bits: of v */
    bool plain;                                /* only halvings */
    bool measured;                             /* are the pieces of this grid known? */
    FuncPieces pieces;
    unsigned clear;                            /* bits: pieces where all values are positive */
    double top[GRID];                          /* no value of the piece is above */
} Search;

static double value_at(const Search *q, double t)
{
    return q->sign * (func_on_line(q->s->f, &q->line, t) - q->s->threshold);
}

static void values_at(const Search *q, const double *t, double *v, int n)
{
    func_along_line(q->s->f, &q->line, t, v, n);
    for (int i = 0; i < n; i++)
        v[i] = q->sign * (v[i] - q->s->threshold);
}

static double grid_value(Search *q, int i)
{
    if (!(q->known >> i & 1)) {
        q->v[i] = value_at(q, q->t[i]);
        q->known |= 1u << i;
    }
    return q->v[i];
}

/* t[0] and t[n] are given, the others are repeated midpoints. */
static void divide(double *t, int n)
{
    for (int step = n; step > 1; step /= 2)
        for (int i = step / 2; i < n; i += step)
            t[i] = (t[i - step / 2] + t[i + step / 2]) / 2;
}

static void judge_pieces(Search *q)
{
    q->clear = 0;
    for (int i = 0; i < GRID; i++) {
        double lo = q->pieces.lo[i] - q->s->threshold, hi = q->pieces.hi[i] - q->s->threshold;
        q->clear |= (unsigned)(q->sign > 0 ? lo > 0 : hi < 0) << i;
        q->top[i] = q->sign > 0 ? hi : -lo;
    }
}

/* What calculus says of each eighth of the way. */
static void measure(Search *q)
{
    func_pieces(q->s->f, &q->line, q->t, &q->pieces);
    q->measured = true;
    judge_pieces(q);
}

static void turn_sides(Search *q)
{
    q->sign = -q->sign;
    for (int i = 0; i <= GRID; i++)
        q->v[i] = q->known >> i & 1 ? -q->v[i] : 0;
    if (q->measured)
        judge_pieces(q);
}

static void ask_ends(Search *q, int i, int j)
{
    if ((q->known >> i & 1) != 0 || (q->known >> j & 1) != 0) {
        grid_value(q, i);
        grid_value(q, j);
        return;
    }
    double t[2] = { q->t[i], q->t[j] }, v[2];
    values_at(q, t, v, 2);
    q->v[i] = v[0];
    q->v[j] = v[1];
    q->known |= 1u << i | 1u << j;
}

/* A first look from a to b. Lanes are filled where values are cheap; else calculus goes first, which may make values unnecessary. */
static void look(Search *q, double a, double b)
{
    q->t[0] = a;
    q->t[GRID] = b;
    q->plain = !q->s->bounded || b - a < 2 * GRID * q->accuracy;
    q->measured = false;
    q->clear = 0;
    q->known = 0;
    if (q->plain) {
        ask_ends(q, 0, GRID);
        return;
    }
    divide(q->t, GRID);
    if (q->s->cheap) {
        values_at(q, q->t, q->v, GRID + 1);
        q->known = 2 * ALL_PIECES + 1;
    } else {
        measure(q);
        if ((q->clear & 1) == 0)
            ask_ends(q, 0, (q->clear & 2) != 0 ? 1 : 2);
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

/* Bounds of the derivatives of f. */
typedef struct Shape { double steep, bend; } Shape;

static Shape shape_of(const Search *q, int first, int end)
{
    Shape most = { 0, 0 };
    for (int i = first; i < end; i++) {
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
    return rise > sag || (2 * (va + vb) - sag) * sag > rise * rise;
}

/* Does f fall all the way from a to b, nowhere steeper than the greatest gradient? Then the halvings find the one root. */
static bool falls(const Search *q, const Shape *m, double length, double va, double vb)
{
    double drop = va - vb, change = m->bend * length * length / 2;
    return drop > change && drop + change <= q->gradient * q->speed * length;
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
    bracket_put(k, t, value_at(q, t));
}

static void ask_row(const Search *q, Bracket *k)
{
    enum { N = 8 };
    double t[N], v[N];
    for (int i = 0; i < N; i++)
        t[i] = k->lo + (k->hi - k->lo) * ((i + 1) / (N + 1.0));
    values_at(q, t, v, N);
    int i = 0;
    while (i < N - 1 && v[i] >= 0)
        i++;
    if (i > 0)
        bracket_put(k, t[i - 1], v[i - 1]);
    bracket_put(k, t[i], v[i]);
}

/* Where f falls from a to b: the end of the smallest halving with the root, as if all had been looked at. Halvings ask f only
 * while their middle is not on a known side of it. */
static double fall(const Search *q, double a, double va, double b, double vb, double bend, int depth)
{
    enum { TURNS = 8 };
    Bracket k = { a, va, b, vb, a, b };
    for (int turn = 0; turn < TURNS; turn++) {
        double slope = (k.va - k.vb) / (k.b - k.a), change = bend * (k.b - k.a) / 2, steep = slope + change, flat = slope - change;
        k.lo = greater(k.lo, greater(k.a + k.va / steep, k.b + k.vb / flat));
        k.hi = lesser(k.hi, lesser(k.a + k.va / flat, k.b + k.vb / steep));
        if (!(k.hi - k.lo > q->accuracy / 4))
            break;
        if (q->s->cheap)
            ask_row(q, &k);
        else
            ask_one(q, &k, turn % 2 != 0);
    }
    for (; b - a >= q->accuracy && depth < MAX_HALVINGS; depth++) {
        double middle = (a + b) / 2;
        if (middle <= k.lo || (middle < k.hi && value_at(q, middle) >= 0))
            k.lo = greater(k.lo, a = middle);
        else
            k.hi = lesser(k.hi, b = middle);
    }
    return b;
}

/* Do the bounds of the derivatives settle what is between a and b? */
static bool settled(const Search *q, const Shape *m, double a, double va, double b, double vb, int depth, Found *found, double *root)
{
    *found = NONE;
    if (!q->measured || !(va > 0))
        return false;
    if (vb > 0)
        return stays_positive(m, b - a, va, vb);
    if (!(vb < 0 && falls(q, m, b - a, va, vb)))
        return false;
    *root = fall(q, a, va, b, vb, m->bend, depth);
    *found = ROOT;
    return true;
}

/* Values at midpoints to come; `step` from that of a halving to those of its halves. Returns the first step. */
static int ask_ahead(const Search *q, double a, double b, double *v)
{
    if (!q->s->cheap) {
        v[0] = value_at(q, (a + b) / 2);
        return 0;
    }
    double t[GRID + 1] = { [0] = a, [GRID] = b };
    divide(t, GRID);
    values_at(q, t, v, GRID);                  /* the first again: full rows are handled faster */
    return GRID / 2;
}

/* Within one piece, whose bounds are m. v and step: values asked ahead, if step is not 0. */
static Found halve(Search *q, const Shape *m, double a, double va, double b, double vb, int depth, const double *v, int step, double *root)
{
    Found found;
    if (b - a < q->accuracy || depth == MAX_HALVINGS) {
        *root = b;
        return vb < 0 ? ROOT : NONE;
    }
    if (a > hit_limit(q->sink))
        return BEYOND;
    if (!may_hold_root(q, b - a, va, vb))
        return NONE;
    if (settled(q, m, a, va, b, vb, depth, &found, root))
        return found;
    double row[GRID], middle = (a + b) / 2;
    if (step == 0) {
        step = ask_ahead(q, a, b, row);
        v = row + step;
    }
    double vm = *v;
    step /= 2;
    found = halve(q, m, a, va, middle, vm, depth + 1, v - step, step, root);
    return found != NONE ? found : halve(q, m, middle, vm, b, vb, depth + 1, v + step, step, root);
}

/* Pieces that may hold a root, by values alone. */
static unsigned open_pieces(Search *q)
{
    unsigned open = ALL_PIECES;
    for (int n = GRID; n > 0 && open != 0; n /= 2)
        for (int i = 0; i < GRID; i += n)
            if ((open >> i & 1) != 0 && !may_hold_root(q, q->t[i + n] - q->t[i], grid_value(q, i), grid_value(q, i + n)))
                open &= ~((1u << (i + n)) - (1u << i));
    return open;
}

/* Do the halvings come to the n pieces from i on? If not, *next is where they go on. */
static bool comes_to(Search *q, int i, int n, int *next)
{
    for (; n <= GRID; n *= 2) {
        int first = i - i % n, end = first + n;
        double length = q->t[end] - q->t[first];
        *next = end;
        if (!(q->top[first] + q->top[end - 1] < q->gradient * q->speed * length)
            && !may_hold_root(q, length, grid_value(q, first), grid_value(q, end)))
            return false;
    }
    return true;
}

/* Piece i or, if that settles it, i and the next: *n tells. */
static Found search_pieces(Search *q, unsigned open, int i, int *n, double *root)
{
    Found found;
    if (i % 2 == 0 && (open >> i & 2) != 0) {
        const Shape most = shape_of(q, i, i + 2);
        ask_ends(q, i, i + 2);
        if (settled(q, &most, q->t[i], q->v[i], q->t[i + 2], q->v[i + 2], 2, &found, root)) {
            *n = 2;
            return found;
        }
    }
    const Shape most = shape_of(q, i, i + 1);
    ask_ends(q, i, i + 1);
    *n = 1;
    return halve(q, &most, q->t[i], q->v[i], q->t[i + 1], q->v[i + 1], 3, NULL, 0, root);
}

/* Calculus says which pieces are worth a look. Whether a root would have been passed over is asked when there is one. */
static Found search_grid(Search *q, double *root)
{
    unsigned open = q->s->cheap ? open_pieces(q) : ALL_PIECES;
    if (open != 0 && !q->measured)
        measure(q);
    open &= ~q->clear;
    for (int i = 0, n, next; i < GRID; i = next) {
        next = i + 1;
        if (!(open >> i & 1))
            continue;
        if (q->t[i] > hit_limit(q->sink))
            return BEYOND;
        Found found = search_pieces(q, open, i, &n, root);
        if (found == BEYOND || (found == ROOT && comes_to(q, i, n, &next)))
            return found;
        if (found == NONE)
            next = i + n;
    }
    return NONE;
}

static Found search(Search *q, double *root)
{
    static const Shape unknown;
    if (q->plain)
        return halve(q, &unknown, q->t[0], q->v[0], q->t[GRID], q->v[GRID], 0, NULL, 0, root);
    return search_grid(q, root);
}

static void report_roots(Search *q, int left, HitSink *sink)
{
    double end = q->t[GRID], root;
    for (; left > 0; left--) {
        if (q->s->evaluates && q->gradient > q->s->evaluate[0])
            q->gradient *= q->s->evaluate[2];
        if (search(q, &root) != ROOT)
            return;
        hit_add(sink, root, 0);
        double next = root + 5 * q->accuracy;
        if (left == 1 || end - next < q->accuracy)
            return;
        q->sign = -q->sign;
        look(q, next, end);
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
    Search q;                                  /* not cleared: it is large */
    q.s = s;
    q.line = (FuncLine){ { ray->o.x, ray->o.y, ray->o.z }, { ray->d.x, ray->d.y, ray->d.z } };
    q.sink = sink;
    q.sign = 1;
    q.accuracy = s->accuracy / scene_speed;
    q.speed = length(ray->d);
    q.gradient = s->max_gradient;
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
    look(&q, t0, t1);
    bool starts_inside = (q.clear & 1) == 0 && grid_value(&q, 0) < 0;
    if (!s->open && starts_outside && starts_inside) {
        hit_add(sink, t0, enter);
        left--;
    } else if (!s->open && !starts_outside && (q.clear >> (GRID - 1) & 1) == 0 && grid_value(&q, GRID) < 0) {
        hit_add(sink, t1, leave);
    }
    if (starts_inside)
        turn_sides(&q);
    report_roots(&q, left, sink);
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
    s->cheap = func_is_cheap(s->f);
    s->bounded = !s->evaluates && func_is_bounded(s->f);
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
