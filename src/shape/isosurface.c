/* isosurface.c - isosurface { function { f } ... }: where f of x, y, z has a given value, within a container.
 *
 * The first root along a ray is sought as the reference does (08-shapes, section 22): an interval is halved, near half first, until it
 * is shorter than the accuracy, and passed over as soon as the ends and the greatest gradient say that no root fits. What is
 * found lies up to the accuracy behind the true surface, and pictures show it, so the same points are asked here; but the midpoints of
 * up to three levels of halving are computed together, in the lanes of one evaluation. */
#include "func/func.h"
#include "math/noise.h"
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
    int ranged;                                /* halvings down to which ranges are asked; -1: never */
    double value_cost, row_cost, range_cost;
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
    double cost;                               /* of what was asked, for choose_ranged */
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
    q->cost += q->s->levels > 1 ? q->s->row_cost : n * q->s->value_cost;
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
        q->cost += q->s->value_cost;
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

/* Does f surely keep its sign from a to b? Then the search would find nothing. */
static bool keeps_sign(Search *q, double a, double b)
{
    Vec3 p = ray_at(q->ray, a), r = ray_at(q->ray, b);
    const FuncRange box[3] = { { fmin(p.x, r.x), fmax(p.x, r.x) }, { fmin(p.y, r.y), fmax(p.y, r.y) }, { fmin(p.z, r.z), fmax(p.z, r.z) } };
    FuncRange v;
    q->cost += q->s->range_cost;
    if (!func_range(q->s->f, box, &v))
        return false;
    return q->sign > 0 ? v.lo > q->s->threshold : v.hi < q->s->threshold;
}

static Found search(Search *q, const Samples *s, int i, int j, int depth, double *root)
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
        if (depth <= q->s->ranged && keeps_sign(q, a, b))
            return NONE;
        look_closer(q, &closer, s, i);
        s = &closer;
        i = 0;
        j = closer.n;
    }
    int middle = (i + j) / 2;
    Found found = search(q, s, i, middle, depth + 1, root);
    return found != NONE ? found : search(q, s, middle, j, depth + 1, root);
}

static void report_roots(Search *q, Samples *s, int left, HitSink *sink)
{
    double end = s->t[s->n], root;
    for (; left > 0; left--) {
        if (q->s->evaluates && q->gradient > q->s->evaluate[0])
            q->gradient *= q->s->evaluate[2];
        if (search(q, s, 0, s->n, 0, &root) != ROOT)
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

/* What the search along a chord of the container costs; k picks the chord. */
static double chord_cost(const Isosurface *s, unsigned k)
{
    const Bounds *box = &s->container.box;
    unsigned state = k * 7919 + 1;
    double f[6];
    for (int i = 0; i < 6; i++)
        f[i] = noise_sample(&state) / 32768.0;
    Vec3 size = sub(box->hi, box->lo);
    Vec3 middle = add(box->lo, mul(size, vec3(f[0], f[1], f[2]))), d = mul(size, vec3(f[3] - 0.5, f[4] - 0.5, f[5] - 0.5));
    Ray ray = { .o = middle, .d = d, .t_max = INFINITY };
    double t0, t1, root;
    uint32_t side[2];
    if (!container_span(&s->container, &ray, &t0, &t1, &side[0], &side[1]) || !(t1 > t0))
        return 0;
    Search q = { .s = s, .ray = &ray, .sign = 1, .speed = length(d), .gradient = s->max_gradient };
    q.accuracy = fmax(s->accuracy / length(affine_vector(&s->place, d)) * s->scene_unit, (t1 - t0) / 4096);
    Samples samples;
    look(&q, &samples, t0, t1);
    q.sign = samples.v[0] < 0 ? -1 : 1;
    search(&q, &samples, 0, samples.n, 0, &root);
    return q.cost;
}

/* Do ranges save time, and how deep? Counted on some chords; the answer changes no picture. */
static void choose_ranged(Isosurface *s)
{
    enum { CHORDS = 16, DEEPEST = 11 };
    double best = INFINITY;
    int chosen = -1;
    s->value_cost = func_cost(s->f);
    s->row_cost = 2 * s->value_cost;
    s->range_cost = 6 * func_length(s->f);
    for (s->ranged = -1; s->ranged <= DEEPEST && !s->evaluates; s->ranged += 3) {
        double cost = 0;
        for (unsigned k = 0; k < CHORDS && cost < best; k++)
            cost += chord_cost(s, k);
        if (cost < best * 0.9) {
            best = cost;
            chosen = s->ranged;
        }
    }
    s->ranged = chosen;
}

static void compile(ShapeBuild *b, const void *params)
{
    Isosurface *s = build_data(b, sizeof *s);
    *s = *(const Isosurface *)params;
    s->open = (b->object->flags & OBJECT_OPEN) != 0;
    s->place = b->place;
    s->scene_unit = b->unit;
    s->levels = func_is_cheap(s->f) ? MAX_LEVELS : 1;
    choose_ranged(s);
    build_prim(b, s, &b->place, shape_padded(s->container.box));
}

static Bounds extent(const void *params, const Affine *place)
{
    return bounds_transformed(((const Isosurface *)params)->container.box, place);
}

const ShapeOps shape_isosurface = {
    .keyword = "isosurface", .params_size = sizeof(Isosurface), .flags = SHAPE_HAS_OPEN, .parse = parse, .item = item,
    .compile = compile, .hits = hits, .inside = inside, .surface = surface, .extent = extent,
};
