/* parametric.c - parametric { function { x } function { y } function { z } <u0,v0>, <u1,v1> ... }: the points (x, y, z) of u and v.
 *
 * The rectangle of u and v is sampled once, as a grid; boxes over its cells, padded by what the second differences say of the bulge
 * between samples, form a pyramid. A ray goes down the pyramid, and in each cell it meets Newton's method finds where it
 * cuts the surface itself. The reference divides the rectangle anew for every ray until a cell is as small as the accuracy, and takes
 * the near end of that cell: its points lie up to the accuracy before the surface. */
#include <string.h>

#include "func/func.h"
#include "shape/container.h"
#include "shape/shape.h"

enum { LEVELS = 7, SIDE = 1 << LEVELS, ROW = SIDE + 1, MAX_STEPS = 12 };

typedef struct {
    const Function *f[3];
    Vec2 lo, hi;
    Container container;
    double accuracy;
} Params;

typedef struct Parametric {                    /* lengths in units of `unit`, a power of two near the size of the container */
    Params p;
    Affine place;
    double unit, scene_unit;                   /* scene_unit: world lengths per scene length */
    double size;                               /* of the surface */
    Vec2 cell;                                 /* steps of u and v */
    Vec3 *point;                               /* ROW x ROW */
    Bounds *box[LEVELS + 1];                   /* of level k: 2^k x 2^k cells, u fastest */
} Parametric;

static void parse(Parser *p, void *params)
{
    static const char *const names[] = { "u", "v" };
    Params *s = params;
    *s = (Params){ .container = container_default(), .accuracy = 0.001 };
    for (int i = 0; i < 3; i++) {
        s->f[i] = parse_function(p, names, 2);
        if (func_terms(s->f[i]) != 1 || func_parameters(s->f[i]) != 2)
            parse_fail(p, "a parametric needs functions of u and v with float values");
        parse_comma(p);
    }
    Vec2 a = parse_vec2(p);
    parse_comma(p);
    Vec2 b = parse_vec2(p);
    s->lo = (Vec2){ fmin(a.u, b.u), fmin(a.v, b.v) };
    s->hi = (Vec2){ fmax(a.u, b.u), fmax(a.v, b.v) };
}

static bool item(Parser *p, void *params)
{
    Params *s = params;
    if (parse_accept(p, KW_CONTAINED_BY)) {
        s->container = container_parse(p);
    } else if (parse_accept(p, KW_ACCURACY)) {
        s->accuracy = parse_float(p);
        if (!(s->accuracy > 0))
            parse_fail(p, "the accuracy of a parametric must be positive");
    } else if (parse_accept(p, KW_MAX_GRADIENT)) {
        parse_float(p);                        /* the bulge is measured instead */
    } else if (parse_accept(p, KW_PRECOMPUTE)) {
        int depth = parse_int(p);
        if (depth < 1 || depth > 20)
            parse_fail(p, "the depth of precompute must be 1 to 20");
        static const int axes[] = { KW_X, KW_Y, KW_Z };
        for (int i = 0; i < 3; i++) {
            parse_comma(p);
            parse_accept(p, axes[i]);
        }
    } else {
        return false;
    }
    return true;
}

/* Points of the surface for n <= ROW pairs. */
static void points_at(const Parametric *s, const double *u, const double *v, Vec3 *out, uint32_t n)
{
    double x[ROW], y[ROW], z[ROW];
    const double *const arguments[] = { u, v };
    func_eval(s->p.f[0], arguments, x, n);
    func_eval(s->p.f[1], arguments, y, n);
    func_eval(s->p.f[2], arguments, z, n);
    for (uint32_t i = 0; i < n; i++)
        out[i] = scaled(vec3(x[i], y[i], z[i]), 1 / s->unit);
}

/* How far the surface may bulge out of the hull of its samples near sample (i, j). */
static Vec3 bulge_at(const Parametric *s, int i, int j)
{
    int iu = i == 0 ? 1 : i == SIDE ? SIDE - 1 : i, jv = j == 0 ? 1 : j == SIDE ? SIDE - 1 : j;
    const Vec3 *row = s->point + j * ROW, *column = s->point + i;
    Vec3 a = sub(add(row[iu - 1], row[iu + 1]), scaled(row[iu], 2));
    Vec3 b = sub(add(column[(jv - 1) * ROW], column[(jv + 1) * ROW]), scaled(column[jv * ROW], 2));
    Vec3 sum = vec3(fabs(a.x) + fabs(b.x), fabs(a.y) + fabs(b.y), fabs(a.z) + fabs(b.z));
    return vec3_finite(sum) ? scaled(sum, 0.5) : vec3(0, 0, 0);
}

static Bounds cell_box(const Parametric *s, int i, int j)
{
    Bounds box = bounds_empty();
    Vec3 bulge = { 0, 0, 0 };
    for (int k = 0; k < 4; k++) {
        int u = i + (k & 1), v = j + (k >> 1);
        Vec3 p = s->point[v * ROW + u];
        if (vec3_finite(p))
            box = bounds_include(box, p);
        bulge = shape_max(bulge, bulge_at(s, u, v));
    }
    if (bounds_is_empty(box))
        return box;
    return (Bounds){ sub(box.lo, bulge), add(box.hi, bulge) };
}

static void build_pyramid(ShapeBuild *b, Parametric *s)
{
    for (int level = LEVELS; level >= 0; level--) {
        int side = 1 << level;
        s->box[level] = build_data(b, sizeof(Bounds) * (size_t)side * (size_t)side);
        for (int j = 0; j < side; j++)
            for (int i = 0; i < side; i++) {
                Bounds *to = &s->box[level][j * side + i];
                if (level == LEVELS) {
                    *to = cell_box(s, i, j);
                    continue;
                }
                const Bounds *from = &s->box[level + 1][4 * j * side + 2 * i];
                *to = bounds_union(bounds_union(from[0], from[1]), bounds_union(from[2 * side], from[2 * side + 1]));
            }
    }
}

static void compile(ShapeBuild *b, const void *params)
{
    Parametric *s = build_data(b, sizeof *s);
    s->p = *(const Params *)params;
    Container *c = &s->p.container;
    s->unit = build_unit(fmax(max_abs(c->box.lo), max_abs(c->box.hi)));
    double k = 1 / s->unit;
    c->box = (Bounds){ scaled(c->box.lo, k), scaled(c->box.hi, k) };
    c->centre = scaled(c->centre, k);
    c->radius *= k;
    s->place = build_place(b, s->unit);
    s->scene_unit = b->unit;
    s->cell = (Vec2){ (s->p.hi.u - s->p.lo.u) / SIDE, (s->p.hi.v - s->p.lo.v) / SIDE };
    s->point = build_data(b, sizeof(Vec3) * ROW * ROW);
    double u[ROW], v[ROW];
    for (int j = 0; j < ROW; j++) {
        for (int i = 0; i < ROW; i++) {
            u[i] = s->p.lo.u + i * s->cell.u;
            v[i] = s->p.lo.v + j * s->cell.v;
        }
        points_at(s, u, v, s->point + j * ROW, ROW);
    }
    build_pyramid(b, s);
    Bounds all = s->box[0][0];
    if (bounds_is_empty(all))
        return;
    s->size = fmax(max_abs(all.lo), max_abs(all.hi));
    Bounds seen = bounds_intersection(shape_padded(all), shape_padded(s->p.container.box));
    if (!bounds_is_empty(seen))
        build_prim(b, s, &s->place, seen);
}

typedef struct Search {
    const Parametric *s;
    const Ray *ray;
    Vec3 inverse;                              /* 1 / ray->d */
    double enter, best;                        /* roots in (enter, best) count */
    double u, v;
} Search;

static inline void slab(double o, double inverse, double lo, double hi, double *near, double *far)
{
    double a = (lo - o) * inverse, b = (hi - o) * inverse;
    *near = greater(*near, lesser(a, b));
    *far = lesser(*far, greater(a, b));
}

static bool meets(const Search *q, const Bounds *box)
{
    Vec3 o = q->ray->o;
    double near = q->enter, far = q->best;
    slab(o.x, q->inverse.x, box->lo.x, box->hi.x, &near, &far);
    slab(o.y, q->inverse.y, box->lo.y, box->hi.y, &near, &far);
    slab(o.z, q->inverse.z, box->lo.z, box->hi.z, &near, &far);
    return near <= far;
}

/* Huge instead of infinite: no NaN on the side of a box. */
static double inverse(double d)
{
    return fabs(d) < 1e-290 ? copysign(1e290, d) : 1 / d;
}

/* The point and its two derivatives, by steps small beside a cell. */
static void frame_at(const Parametric *s, double u, double v, Vec3 out[3])
{
    double hu = s->cell.u * 1e-4, hv = s->cell.v * 1e-4;
    if (u + hu > s->p.hi.u)
        hu = -hu;
    if (v + hv > s->p.hi.v)
        hv = -hv;
    points_at(s, (const double[]){ u, u + hu, u }, (const double[]){ v, v, v + hv }, out, 3);
    out[1] = scaled(sub(out[1], out[0]), 1 / hu);
    out[2] = scaled(sub(out[2], out[0]), 1 / hv);
}

static double kept(double x, double lo, double hi)
{
    return x < lo ? lo : x > hi ? hi : x;
}

/* Newton's method from (u, v): solves p(u,v) = o + t d. */
static void refine(Search *q, double u, double v)
{
    const Parametric *s = q->s;
    Vec3 d = q->ray->d, f[3];
    double enough = s->size * 0x1p-40 + s->p.accuracy / s->unit * 0x1p-20;
    for (int step = 0; step < MAX_STEPS; step++) {
        frame_at(s, u, v, f);
        Vec3 normal = cross(f[1], f[2]), away = sub(f[0], q->ray->o);
        double slope = dot(normal, d);
        if (slope == 0 || !isfinite(slope))
            return;
        double t = dot(normal, away) / slope;
        Vec3 rest = sub(ray_at(q->ray, t), f[0]);              /* in the tangent plane: a f[1] + b f[2] */
        double n2 = length2(normal);
        double du = dot(cross(rest, f[2]), normal) / n2, dv = dot(cross(f[1], rest), normal) / n2;
        if (max_abs(rest) <= enough) {
            if (t > q->enter && t < q->best) {
                q->best = t;
                q->u = u;
                q->v = v;
            }
            return;
        }
        du = kept(du, -2 * s->cell.u, 2 * s->cell.u);
        dv = kept(dv, -2 * s->cell.v, 2 * s->cell.v);
        double nu = kept(u + du, s->p.lo.u, s->p.hi.u), nv = kept(v + dv, s->p.lo.v, s->p.hi.v);
        if (nu == u && nv == v)
            return;
        u = nu;
        v = nv;
    }
}

/* Where the ray cuts the two triangles of a cell; the middle if it misses both, as the surface may bulge between them. */
static void try_cell(Search *q, int i, int j)
{
    const Parametric *s = q->s;
    const Vec3 *p = s->point + j * ROW + i;
    bool any = false;
    for (int k = 0; k < 2; k++) {
        Vec3 o = k ? p[ROW + 1] : p[0], a = sub(k ? p[ROW] : p[1], o), b = sub(k ? p[1] : p[ROW], o), n = cross(a, b);
        double slope = dot(n, q->ray->d), n2 = length2(n);
        if (slope == 0 || !(n2 > 0))
            continue;
        Vec3 at = sub(ray_at(q->ray, dot(n, sub(o, q->ray->o)) / slope), o);
        double x = dot(cross(at, b), n) / n2, y = dot(cross(a, at), n) / n2;
        if (x < -0.5 || y < -0.5 || x + y > 1.5)
            continue;
        any = true;
        refine(q, kept(s->p.lo.u + (k ? i + 1 - x : i + x) * s->cell.u, s->p.lo.u, s->p.hi.u),
               kept(s->p.lo.v + (k ? j + 1 - y : j + y) * s->cell.v, s->p.lo.v, s->p.hi.v));
    }
    if (!any)
        refine(q, s->p.lo.u + (i + 0.5) * s->cell.u, s->p.lo.v + (j + 0.5) * s->cell.v);
}

static void descend(Search *q, int level, int i, int j)
{
    if (!meets(q, &q->s->box[level][(j << level) + i]))
        return;
    if (level == LEVELS) {
        try_cell(q, i, j);
        return;
    }
    for (int k = 0; k < 4; k++)
        descend(q, level + 1, 2 * i + (k & 1), 2 * j + (k >> 1));
}

/* POV: only the nearest hit is known, and none within four accuracies of where the ray enters the container. */
static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Parametric *s = shape;
    double enter, leave;
    uint32_t side[2];
    if (!container_span(&s->p.container, ray, &enter, &leave, &side[0], &side[1]))
        return;
    double scene_speed = length(affine_vector(&s->place, ray->d)) / s->scene_unit;
    Search q = { .s = s, .ray = ray, .inverse = vec3(inverse(ray->d.x), inverse(ray->d.y), inverse(ray->d.z)),
                 .enter = greater(enter, 0) + 4 * s->p.accuracy / scene_speed, .best = leave };
    descend(&q, 0, 0, 0);
    if (q.best < leave)
        hit_add_uv(sink, q.best, 0, q.u, q.v);
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    const Parametric *s = shape;
    Vec3 f[3];
    frame_at(s, hit->u, hit->v, f);
    out->normal = cross(f[1], f[2]);
    out->error = greater(out->error, s->size * 0x1p-38);
    if (out->want_uv)
        out->uv = (Vec2){ hit->u, hit->v };
}

static Bounds extent(const void *params, const Affine *place)
{
    return bounds_transformed(((const Params *)params)->container.box, place);
}

const ShapeOps shape_parametric = {
    .keyword = "parametric", .params_size = sizeof(Params), .flags = SHAPE_PATCH | SHAPE_HAS_UV | SHAPE_FIRST_HITS, .parse = parse, .item = item,
    .compile = compile, .hits = hits, .surface = surface, .extent = extent,
};
