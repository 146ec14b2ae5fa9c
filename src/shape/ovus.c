/* ovus.c - ovus { bottom radius, top radius }: an egg, two balls joined by the inner side of a spindle of circles.
 *
 * The body is convex, so whatever its three surfaces offer, a ray enters at the first hit and leaves at the last: no
 * gap can open at the joints (08-shapes, section 21). */
#include "sdl/parse.h"
#include "shape/shape.h"

typedef struct { double bottom, top; } Params;

typedef struct {
    double bottom, top;                        /* radii; the upper centre is <0, bottom, 0> */
    double ring, height, radius;               /* the meridian in between: (rho + ring)^2 + (y - height)^2 = radius^2 ... */
    double lower, upper;                       /* ... for y from lower to upper; lower > upper: a ball of radius top alone */
} Ovus;

static void parse(Parser *p, void *params)
{
    Params *o = params;
    o->bottom = parse_float(p);
    o->top = parse_next_float(p);
    if (!(o->bottom >= 0 && o->top >= 0))
        parse_fail(p, "the radii of an ovus must not be negative");
    if (o->top >= 2 * o->bottom && o->top > 0)
        parse_warn(p, "the top radius of this ovus is at least twice the bottom radius: it is a sphere");
}

static Ovus measures(const Params *p)
{
    double b = p->bottom, t = p->top;
    Ovus o = { .bottom = b, .top = t, .lower = INFINITY, .upper = -INFINITY };
    if (t >= 2 * b)
        return o;
    if (b > t) {
        o.radius = 2 * b;
        o.height = 2 * t - b - t * t / (2 * b);
        o.ring = sqrt(b * b - o.height * o.height);
        o.lower = -o.height;
        o.upper = (b - o.height) * t / (o.radius - t) + b;
    } else {
        o.radius = 2 * t;
        o.height = -2 * t + b + 1.5 * t * t / b;
        o.ring = sqrt(fmax(0, t * t - (o.height - b) * (o.height - b)));
        o.upper = 2 * b - o.height;
        o.lower = -o.height * b / (o.radius - b);
    }
    return o;
}

static bool is_ball(const Ovus *o) { return o->lower > o->upper; }

static Bounds box_of(const Ovus *o)
{
    if (is_ball(o))
        return (Bounds){ vec3(-o->top, o->bottom - o->top, -o->top), vec3(o->top, o->bottom + o->top, o->top) };
    double r = fmax(o->radius - o->ring, fmax(o->bottom, o->top));
    return (Bounds){ vec3(-r, -o->bottom, -r), vec3(r, o->bottom + o->top, r) };
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *p = params;
    double size = fmax(p->bottom, p->top), unit = shape_unit(b, size);
    if (size == 0)
        return;
    Ovus *out = build_data(b, sizeof *out);
    *out = measures(&(Params){ p->bottom / unit, p->top / unit });
    Affine place = build_place(b, unit);
    build_prim(b, out, &place, shape_padded(box_of(out)));
}

typedef struct { double first, last; } Span;

static void span_add(Span *s, double t)
{
    s->first = fmin(s->first, t);
    s->last = fmax(s->last, t);
}

/* Where o + s u meets the ball about <0, centre, 0> with lo <= y <= hi. */
static void ball(Vec3 o, Vec3 u, double centre, double radius, double lo, double hi, Span *span)
{
    o.y -= centre;
    double middle = -dot(o, u), h2 = radius * radius - length2(add(o, scaled(u, middle)));
    if (!(h2 > 0))
        return;
    double half = sqrt(h2);
    for (int i = -1; i <= 1; i += 2) {
        double s = middle + i * half, y = centre + o.y + s * u.y;
        if (lo <= y && y <= hi)
            span_add(span, s);
    }
}

/* The stretch of the ray at the heights of the joining part and near enough to the axis. */
static bool reach(const Ovus *e, Vec3 o, Vec3 u, double slack, double *in, double *out)
{
    double most = e->radius - e->ring + slack, a = u.x * u.x + u.z * u.z, size = 4 * (e->bottom + e->top);
    *in = -size;                               /* o is the point nearest to the middle */
    *out = size;
    if (u.y != 0) {
        double t0 = (e->lower - slack - o.y) / u.y, t1 = (e->upper + slack - o.y) / u.y;
        *in = greater(*in, lesser(t0, t1));
        *out = lesser(*out, greater(t0, t1));
    } else if (o.y < e->lower - slack || o.y > e->upper + slack)
        return false;
    if (a > 1e-9) {
        double b = o.x * u.x + o.z * u.z, cross = o.x * u.z - o.z * u.x, h2 = most * most - cross * cross / a;
        if (h2 < 0)
            return false;
        double half = sqrt(h2 / a);
        *in = greater(*in, -b / a - half);
        *out = lesser(*out, -b / a + half);
    }
    return *in < *out;
}

/* The distance to the meridian's circle through both, less its radius; along the ray it is convex. */
static double beyond(const Ovus *e, Vec3 o, Vec3 u, double s, double *slope)
{
    Vec3 p = add(o, scaled(u, s));
    double rho = sqrt(p.x * p.x + p.z * p.z), off = rho + e->ring, y = p.y - e->height, d = sqrt(off * off + y * y);
    double turn = rho > 0 ? (p.x * u.x + p.z * u.z) / rho : sqrt(u.x * u.x + u.z * u.z);
    *slope = (off * turn + y * u.y) / d;
    return ((off - e->radius) * (off + e->radius) + y * y) / (d + e->radius);
}

/* Newton's steps from outside a convex body never pass its surface. */
static void approach(const Ovus *e, Vec3 o, Vec3 u, double s, double end, double slack, Span *span)
{
    double way = end - s;
    for (int i = 0; i < 60; i++) {
        double slope, f = beyond(e, o, u, s, &slope);
        if (f < 0.25 * slack) {
            if (i > 0 || f > -slack)           /* else it begins within, behind a joint */
                span_add(span, s);
            return;
        }
        if (!(slope * way < 0))
            return;
        double next = s - f / slope;
        if ((end - next) * way < 0)
            return;
        if (next == s) {
            span_add(span, s);
            return;
        }
        s = next;
    }
}

static void between(const Ovus *e, Vec3 o, Vec3 u, double slack, Span *span)
{
    double in, out;
    if (!reach(e, o, u, slack, &in, &out))
        return;
    approach(e, o, u, in, out, slack, span);
    approach(e, o, u, out, in, slack, span);
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Ovus *e = shape;
    double len = length(ray->d), centre = 0.5 * e->bottom;
    Vec3 u = scaled(ray->d, 1 / len);
    double shift = -dot(vec3(ray->o.x, ray->o.y - centre, ray->o.z), u) / len;
    Vec3 o = ray_at(ray, shift);
    Span span = { INFINITY, -INFINITY };
    if (is_ball(e))
        ball(o, u, e->bottom, e->top, -INFINITY, INFINITY, &span);
    else {
        double slack = 16 * DBL_EPSILON * (e->bottom + e->top);
        ball(o, u, 0, e->bottom, -INFINITY, e->lower + slack, &span);
        ball(o, u, e->bottom, e->top, e->upper - slack, INFINITY, &span);
        if (!(span.first < span.last))         /* a convex body has two hits */
            between(e, o, u, slack, &span);
    }
    if (span.first > span.last)
        return;
    hit_add(sink, shift + span.first / len, 0);
    if (span.last > span.first)
        hit_add(sink, shift + span.last / len, 0);
}

static bool inside(const void *shape, Vec3 p)
{
    const Ovus *e = shape;
    double rho2 = p.x * p.x + p.z * p.z, y = p.y - e->bottom;
    if (rho2 + y * y < e->top * e->top)
        return true;
    if (is_ball(e))
        return false;
    if (rho2 + p.y * p.y < e->bottom * e->bottom)
        return true;
    double off = sqrt(rho2) + e->ring;
    y = p.y - e->height;
    return e->lower < p.y && p.y < e->upper && off * off + y * y < e->radius * e->radius;
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    (void)hit;
    const Ovus *e = shape;
    Vec3 p = out->p;
    double rho = sqrt(p.x * p.x + p.z * p.z);
    if (is_ball(e) || p.y > e->upper)
        out->normal = vec3(p.x, p.y - e->bottom, p.z);
    else if (p.y < e->lower)
        out->normal = p;
    else {
        double f = rho > 0 ? 1 + e->ring / rho : 1;
        out->normal = vec3(p.x * f, p.y - e->height, p.z * f);
    }
    if (out->want_uv) {
        double y = p.y - (is_ball(e) ? e->bottom : 0.5 * e->top), r = sqrt(rho * rho + y * y);
        out->uv = (Vec2){ shape_longitude(p.x, p.z), 0.5 + (r > 0 ? asin(y / r) / PI : 0) };
    }
}

static Bounds extent(const void *params, const Affine *place)
{
    Ovus o = measures(params);
    double k;
    Vec3 c = affine_point(place, vec3(0, o.bottom, 0));
    if (is_ball(&o) && shape_keeps_balls(place, &k))
        return bounds_grown((Bounds){ c, c }, k * o.top);
    return bounds_transformed(box_of(&o), place);
}

const ShapeOps shape_ovus = {
    .keyword = "ovus", .params_size = sizeof(Params), .flags = SHAPE_HAS_STURM | SHAPE_HAS_UV, .parse = parse,
    .compile = compile, .hits = hits, .inside = inside, .surface = surface, .extent = extent,
};
