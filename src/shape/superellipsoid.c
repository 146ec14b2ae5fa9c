/* superellipsoid.c - superellipsoid { <e, n> }: (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) = 1.
 *
 * Traced by the norm g(g(|x|, |y|; 2/e), |z|; 2/n) - 1 with g(a, b; p) = (a^p + b^p)^(1/p), which grows in proportion to the
 * distance from the origin whatever the exponents. If it is convex, Newton's steps find it. If not, the planes x = +-y, y = +-z,
 * z = +-x and those of the axes cut a ray into pieces on which it is smooth and seldom turns more than once; each piece is searched
 * by the signs at its ends and of its slopes. */
#include "sdl/parse.h"
#include "shape/shape.h"

typedef struct { double e, n; } Params;
/* p may be infinite; p = 2^doublings, or -1; the mean is at least share (a + b). */
typedef struct { double p; int doublings; double share; } Exponent;
typedef struct { Exponent p, q; } Super;                   /* 2/e, 2/n */
typedef struct { double f, slope; } Sample;                /* along the ray */

static void parse(Parser *p, void *params)
{
    Vec2 v = parse_vec2(p);
    *(Params *)params = (Params){ v.u, v.v };
    if (v.u < 0 || v.v < 0)
        parse_fail(p, "the exponents of a superellipsoid cannot be negative");
}

/* Small powers of two are squared and rooted: many are e = 1, 0.5 or 0.25. */
static Exponent exponent(double p)
{
    int e;
    return (Exponent){ p, isfinite(p) && frexp(p, &e) == 0.5 && e >= 1 && e <= 5 ? e - 1 : -1, p < 1 ? 1 : pow(2, 1 / p - 1) };
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *s = params;
    Super *out = build_data(b, sizeof *out);
    *out = (Super){ exponent(2 / s->e), exponent(2 / s->n) };
    Affine place = build_place(b, 1);
    build_prim(b, out, &place, shape_padded((Bounds){ vec3(-1, -1, -1), vec3(1, 1, 1) }));
}

typedef double Power(double x, double y);

/* For the way to the surface, where six digits will do: a third of the time. */
static double rough_pow(double x, double y)
{
    return (double)powf((float)x, (float)y);
}

static const double ROUGH = 1e-4, EXACT = 1e-13;   /* values larger than this have the right sign */

/* (a^p + b^p)^(1/p) for a, b >= 0, and its derivatives. */
static inline double mean(Power *power, double a, double b, Exponent e, double *da, double *db)
{
    double most = greater(a, b), least = lesser(a, b);
    *da = a >= b;
    *db = a < b;
    if (most == 0 || least == 0 || e.p > 1e300)
        return most;
    double r = least / most, rp = r, k;
    if (e.doublings >= 0) {
        for (int i = 0; i < e.doublings; i++)
            rp *= rp;
        k = 1 + rp;
        for (int i = 0; i < e.doublings; i++)
            k = sqrt(k);
    } else {
        rp = power(r, e.p);
        k = power(1 + rp, 1 / e.p);
    }
    double d_most = k / (1 + rp), d_least = d_most * rp / r;
    *da = a >= b ? d_most : d_least;
    *db = a >= b ? d_least : d_most;
    return most * k;
}

static inline Sample sample_with(Power *power, const Super *s, Vec3 o, Vec3 d, double t)
{
    Vec3 p = add(o, scaled(d, t));
    double dx, dy, du, dz;
    double u = mean(power, fabs(p.x), fabs(p.y), s->p, &dx, &dy);
    double f = mean(power, u, fabs(p.z), s->q, &du, &dz);
    double side_x = p.x > 0 || (p.x == 0 && d.x > 0) ? d.x : -d.x, side_y = p.y > 0 || (p.y == 0 && d.y > 0) ? d.y : -d.y,
           side_z = p.z > 0 || (p.z == 0 && d.z > 0) ? d.z : -d.z;
    return (Sample){ f - 1, du * (dx * side_x + dy * side_y) + dz * side_z };
}

static Sample sample(const Super *s, Vec3 o, Vec3 d, double t)
{
    return sample_with(pow, s, o, d, t);
}

static Sample rough_sample(const Super *s, Vec3 o, Vec3 d, double t)
{
    return sample_with(rough_pow, s, o, d, t);
}

/* A lower bound of the norm that is linear between the planes of the axes. */
static double at_least(const Super *s, Vec3 p)
{
    return s->q.share * (s->p.share * (fabs(p.x) + fabs(p.y)) + fabs(p.z));
}

static bool is_above(const Super *s, Vec3 o, Vec3 d, double t)
{
    if (at_least(s, add(o, scaled(d, t))) > 1 + 1e-9)
        return true;
    double f = rough_sample(s, o, d, t).f;
    return (fabs(f) > ROUGH ? f : sample(s, o, d, t).f) > 0;
}

static bool is_rising(const Super *s, Vec3 o, Vec3 d, double t)
{
    double slope = rough_sample(s, o, d, t).slope;
    return (fabs(slope) > ROUGH ? slope : sample(s, o, d, t).slope) > 0;
}

/* The root between a and b, where f changes its sign: Newton's steps inside a bracket. */
static double closed_in(const Super *s, Vec3 o, Vec3 d, double a, double b, bool falling)
{
    double t = 0.5 * (a + b), last = b - a;
    for (int i = 0; i < 100; i++) {
        Sample at = sample(s, o, d, t);
        if (at.f == 0)
            return t;
        if ((at.f > 0) == falling)
            a = t;
        else
            b = t;
        double next = t - at.f / at.slope;
        if (!(next > a && next < b) || fabs(next - t) > 0.5 * last)
            next = 0.5 * (a + b);
        last = fabs(next - t);
        if (last <= DBL_EPSILON * fmax(1, fabs(t)))
            return next;
        t = next;
    }
    return t;
}

/* Where the slope changes its sign between a and b, as far as needed: up to a value of the other sign than that of the ends. */
static bool turning_point(const Super *s, Vec3 o, Vec3 d, double a, double b, bool above, double *t)
{
    for (int i = 0; i < 60 && b - a > DBL_EPSILON; i++) {
        *t = 0.5 * (a + b);
        Sample at = sample(s, o, d, *t);
        if ((at.f > 0) != above && at.f != 0)
            return true;
        if ((at.slope < 0) == above)
            a = *t;
        else
            b = *t;
    }
    return false;
}

/* Neighbouring pieces are given the same signs where they meet, so that no root falls between them. */
static void search(const Super *s, Vec3 o, Vec3 d, const double end[2], const bool above[2], double start, double shift, double len,
                   HitSink *sink)
{
    double a = end[0], b = end[1], turn;
    if (above[0] != above[1]) {
        if (s->p.p <= 1 && s->q.p <= 1 && a < start && start < b) {      /* concave: one root, and most rays have just left it */
            double f = sample(s, o, d, start).f;
            if (fabs(f) > EXACT && (f > 0) == above[1])
                return;
        }
        hit_add(sink, shift + closed_in(s, o, d, a, b, above[0]) / len, 0);
        return;
    }
    if (above[0] && lesser(at_least(s, add(o, scaled(d, a))), at_least(s, add(o, scaled(d, b)))) > 1 + 1e-9)
        return;
    double step = 1e-12 * (b - a);             /* slopes are those on this side of the planes */
    bool leaving = is_rising(s, o, d, a + step) == above[0], coming = is_rising(s, o, d, b - step) == above[0];
    if (!leaving && coming && turning_point(s, o, d, a, b, above[0], &turn)) {
        hit_add(sink, shift + closed_in(s, o, d, a, turn, above[0]) / len, 0);
        hit_add(sink, shift + closed_in(s, o, d, turn, b, !above[0]) / len, 0);
    }
}

/* Where the line is within the cube around the shape. */
static bool clip(Vec3 o, Vec3 d, double *in, double *out)
{
    const double edge = 1 + 1e-9;              /* a root on the very face must not be rounded away */
    *in = -INFINITY;
    *out = INFINITY;
    for (int i = 0; i < 3; i++) {
        double x = vec3_at(o, i), dx = vec3_at(d, i);
        if (dx == 0) {
            if (fabs(x) > edge)
                return false;
            continue;
        }
        double t0 = (-edge - x) / dx, t1 = (edge - x) / dx;
        *in = greater(*in, lesser(t0, t1));
        *out = lesser(*out, greater(t0, t1));
    }
    return *in < *out;
}

/* Both exponents at most 2: the norm is convex, and along a ray it falls, then rises. Newton's steps from an end of the cube
 * towards the surface never step over it, and turn uphill only if there is nothing to hit. */
static bool downhill(const Super *s, Vec3 o, Vec3 d, double t, double way, double *root)
{
    Sample at;
    for (int i = 0; i < 100; i++) {
        at = rough_sample(s, o, d, t);
        if (at.f < 20 * ROUGH)
            break;
        double step = -at.f / at.slope;
        if (!(step * way > 0))
            return false;
        t += step;
    }
    double before = 0;
    for (int i = 0; i < 100; i++) {
        at = sample(s, o, d, t);
        double step = -at.f / at.slope, size = fabs(step);
        if (at.f > 0 && !(step * way > 0))
            return false;
        if (at.f == 0 || !(at.slope * way < 0))
            break;                             /* on it, or rounding has led past the lowest point: a touch */
        t += step;
        if (size * size * size <= 1e-14 * before * before)   /* the coming step, as steps shrink as their squares */
            break;
        before = size;
    }
    *root = t;
    return true;
}

static void convex_hits(const Super *s, Vec3 o, Vec3 d, double in, double out, double shift, double len, const Ray *ray,
                        HitSink *sink)
{
    double start = (ray->t_min - shift) * len, root;
    bool within = false;
    if (out < start)
        return;
    if (in < start) {                          /* the ray starts in the cube: on its way out, or in the body? */
        Sample at = sample(s, o, d, start);
        within = at.f < -1e-9;
        if (at.f > EXACT && at.slope >= 0)     /* most have just left it */
            return;
    }
    if (!within) {
        if (!downhill(s, o, d, in, 1, &root))
            return;
        hit_add(sink, shift + root / len, 0);
        if (shift + root / len >= hit_limit(sink))
            return;
    }
    if (downhill(s, o, d, out, -1, &root))
        hit_add(sink, shift + root / len, 0);
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Super *s = shape;
    double shift = shape_nearest_t(ray), cut[11];
    Vec3 o = ray_at(ray, shift);
    if (length2(o) > 3.000001)                 /* outside the ball around the cube */
        return;
    double len = length(ray->d);
    Vec3 d = scaled(ray->d, 1 / len);
    int n = 0;
    if (!clip(o, d, &cut[0], &cut[10]))
        return;
    if (s->p.p >= 1 && s->q.p >= 1) {
        convex_hits(s, o, d, cut[0], cut[10], shift, len, ray, sink);
        return;
    }
    const double height[9] = { o.x, o.y, o.z, o.x - o.y, o.x + o.y, o.y - o.z, o.y + o.z, o.z - o.x, o.z + o.x };
    const double slope[9] = { d.x, d.y, d.z, d.x - d.y, d.x + d.y, d.y - d.z, d.y + d.z, d.z - d.x, d.z + d.x };
    double last = cut[10];
    for (int i = 0; i < 9; i++) {
        double t = -height[i] / slope[i];
        if (!(t > cut[0] && t < last))
            continue;
        int at = ++n;
        for (; cut[at - 1] > t; at--)
            cut[at] = cut[at - 1];
        cut[at] = t;
    }
    cut[++n] = last;
    double start = (ray->t_min - shift) * len;
    int i = 0;
    while (i < n && cut[i + 1] < start - 1e-9)
        i++;
    bool above[2] = { i == 0 || i == n || is_above(s, o, d, cut[i]) };   /* the surface, as the ends of the cube are */
    for (; i < n && shift + cut[i] / len <= hit_limit(sink); i++) {
        above[1] = i + 1 == n || is_above(s, o, d, cut[i + 1]);
        search(s, o, d, &cut[i], above, start, shift, len, sink);
        above[0] = above[1];
    }
}

static bool inside(const void *shape, Vec3 p)
{
    const Super *s = shape;
    double ignored[4];
    double u = mean(pow, fabs(p.x), fabs(p.y), s->p, &ignored[0], &ignored[1]);
    return mean(pow, u, fabs(p.z), s->q, &ignored[2], &ignored[3]) - 1 < 1e-10;
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    (void)hit;
    const Super *s = shape;
    Vec3 p = out->p;
    double dx, dy, du, dz, u = mean(pow, fabs(p.x), fabs(p.y), s->p, &dx, &dy), f = mean(pow, u, fabs(p.z), s->q, &du, &dz);
    out->normal = vec3(copysign(du * dx, p.x), copysign(du * dy, p.y), copysign(dz, p.z));
    out->p = scaled(p, 1 / f);                 /* the norm is proportional to the distance */
}

static Bounds extent(const void *params, const Affine *place)
{
    (void)params;
    const double edge = 1.0001;                /* POV */
    return bounds_transformed((Bounds){ vec3(-edge, -edge, -edge), vec3(edge, edge, edge) }, place);
}

const ShapeOps shape_superellipsoid = {
    .keyword = "superellipsoid", .params_size = sizeof(Params), .parse = parse, .compile = compile,
    .hits = hits, .inside = inside, .surface = surface, .extent = extent,
};
