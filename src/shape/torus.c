/* torus.c - torus { major, minor }, about the y axis: a quartic along the ray. */
#include "math/roots.h"
#include "sdl/parse.h"
#include "shape/shape.h"

typedef struct { double major, minor; } Params;
typedef struct { double major, minor, ball2; bool thin; } Torus;      /* ball2: radius^2 of a ball around it */

static void parse(Parser *p, void *params)
{
    Params *t = params;
    t->major = parse_float(p);
    t->minor = parse_next_float(p);
}

static Bounds box_of(const Params *t)
{
    double r = t->major + t->minor;
    return (Bounds){ vec3(-r, -t->minor, -r), vec3(r, t->minor, r) };
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *t = params;
    if (!(t->minor > 0))                       /* POV: not an error, and nothing to see */
        return;
    double unit = shape_unit(b, fabs(t->major) + t->minor);
    Torus *out = build_data(b, sizeof *out);
    double R = fabs(t->major) / unit, r = t->minor / unit;
    *out = (Torus){ R, r, (R + r) * (R + r) * (1 + 1e-9), r < 0.1 * R };
    Affine place = build_place(b, unit);
    build_prim(b, out, &place, shape_padded(box_of(&(Params){ out->major, out->minor })));
}

/* Where the ray o + s u is within the solid cylinder around the torus. */
static bool reach(const Torus *t, Vec3 o, Vec3 u, double *in, double *out)
{
    double r = t->major + t->minor, a = u.x * u.x + u.z * u.z;
    *in = -4 * r;                              /* o is the point nearest to the centre */
    *out = 4 * r;
    if (a > 0) {
        double middle = -(o.x * u.x + o.z * u.z) / a, x = o.x + middle * u.x, z = o.z + middle * u.z;
        double h2 = r * r - (x * x + z * z);
        if (h2 < 0)
            return false;
        double half = sqrt(h2 / a);
        *in = greater(*in, middle - half);
        *out = lesser(*out, middle + half);
    } else if (o.x * o.x + o.z * o.z > r * r)
        return false;
    if (u.y != 0) {
        double t0 = (-t->minor - o.y) / u.y, t1 = (t->minor - o.y) / u.y;
        *in = greater(*in, lesser(t0, t1));
        *out = lesser(*out, greater(t0, t1));
    } else if (fabs(o.y) > t->minor)
        return false;
    /* A little more on both sides: a root at the very edge must not be rounded away. */
    *in -= 1e-9 * r;
    *out += 1e-9 * r;
    return *in < *out;
}

/* The signed radius of the ring as seen from a point of the surface: a spindle's inner sheet belongs to its far side. */
static double ring_at(const Torus *t, double rho, double y)
{
    double near = rho - t->major, far = rho + t->major, r2 = t->minor * t->minor - y * y;
    return fabs(near * near - r2) <= fabs(far * far - r2) ? t->major : -t->major;
}

/* Newton's steps on the distance from the ring, which keeps the digits that the quartic of a thin torus loses. */
static double polished(const Torus *t, Vec3 o, Vec3 u, double s)
{
    for (int i = 0; i < 2; i++) {
        Vec3 p = add(o, scaled(u, s));
        double rho = sqrt(p.x * p.x + p.z * p.z);
        if (rho == 0)
            return s;
        double off = rho - ring_at(t, rho, p.y), f = off * off + p.y * p.y - t->minor * t->minor;
        double slope = 2 * (off * (p.x * u.x + p.z * u.z) / rho + p.y * u.y), step = f / slope;
        if (!(fabs(step) < 1e-4 * t->minor))
            return s;
        s -= step;
    }
    return s;
}

typedef struct { const Torus *torus; Vec3 o, u; double shift, len; HitSink *sink; } Walk;

static bool visit(void *user, double s)
{
    const Walk *w = user;
    double t = w->shift + (w->torus->thin ? polished(w->torus, w->o, w->u, s) : s) / w->len;
    hit_add(w->sink, t, 0);
    return t < hit_limit(w->sink);
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Torus *t = shape;
    double shift = shape_nearest_t(ray), in, out;
    Vec3 o = ray_at(ray, shift);
    if (length2(o) > t->ball2)
        return;
    double len = length(ray->d);
    Vec3 u = scaled(ray->d, 1 / len);
    if (!reach(t, o, u, &in, &out))
        return;
    double margin = 1e-6 * t->minor, from = (ray->t_min - shift) * len - margin, to = (hit_limit(sink) - shift) * len + margin;
    if (out < from || in > to)
        return;
    double R2 = t->major * t->major, r2 = t->minor * t->minor, k1 = length2(o) - R2 - r2, k2 = dot(o, u);
    const double c[5] = { k1 * k1 + 4 * R2 * (o.y * o.y - r2), 4 * (k1 * k2 + 2 * R2 * o.y * u.y),
                          2 * (k1 + 2 * k2 * k2 + 2 * R2 * u.y * u.y), 4 * k2, 1 };
    Walk w = { t, o, u, shift, len, sink };
    roots_visit(c, 4, in, out, from, visit, &w);
}

static bool inside(const void *shape, Vec3 p)
{
    const Torus *t = shape;
    double off = sqrt(p.x * p.x + p.z * p.z) - t->major;
    return off * off + p.y * p.y <= t->minor * t->minor;
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    (void)hit;
    const Torus *t = shape;
    Vec3 p = out->p;
    double rho = sqrt(p.x * p.x + p.z * p.z);
    if (rho > 0) {
        double f = t->major / rho, ring = ring_at(t, rho, p.y) / rho;
        Vec3 centre = vec3(p.x * ring, 0, p.z * ring);
        out->p = add(centre, scaled(normalized(sub(p, centre)), t->minor));
        out->normal = vec3(p.x - p.x * f, p.y, p.z - p.z * f);     /* POV: also on the inner sheet */
    } else
        out->normal = vec3(0, p.y, 0);
    if (out->want_uv)
        out->uv = (Vec2){ 1 - (atan2(p.z, p.x) + PI) / (2 * PI), (atan2(p.y, rho - t->major) + PI) / (2 * PI) };
}

static Bounds extent(const void *params, const Affine *place)
{
    return bounds_transformed(box_of(params), place);
}

const ShapeOps shape_torus = {
    .keyword = "torus", .params_size = sizeof(Params), .flags = SHAPE_HAS_STURM | SHAPE_HAS_UV, .parse = parse,
    .compile = compile, .hits = hits, .inside = inside, .surface = surface, .extent = extent,
};
