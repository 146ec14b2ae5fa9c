/* warp.c - takes a point through the transforms and warps of a pattern (07-textures, section 3). */
#include "math/noise.h"
#include "pattern/pattern.h"
#include "pattern/wave.h"

static inline void turbulent(const Turbulence *t, Vec3 *p)
{
    if (t->amount.x != 0 || t->amount.y != 0 || t->amount.z != 0)
        noise_displace(p, &t->amount, t->octaves, (double)t->omega, (double)t->lambda);
}

static Vec3 repeat(const Warp *w, Vec3 p)
{
    int axis = w->repeat.axis;
    double width = (double)w->repeat.width, x = vec3_at(p, axis);
    double block = floor(x / width);
    x -= (double)(float)(block * width);       /* POV: the product is single precision */
    vec3_set(&p, axis, x);
    if (fmod(fabs(block), 2) == 1) {
        p = mul(p, w->repeat.flip);
        if (vec3_at(w->repeat.flip, axis) < 0)
            vec3_set(&p, axis, vec3_at(p, axis) + width);
    }
    return add(p, scaled(w->repeat.offset, block));
}

static double cell_of(double x, double size)
{
    return size < PATTERN_TINY ? 0 : floor(x / size);
}

static long long whole(double x)
{
    return fabs(x) < 9e15 ? (long long)x : 0;
}

static Vec3 black_hole(const Warp *w, Vec3 p)
{
    if (w->hole.type != 0)
        return p;
    Vec3 centre = w->hole.centre;
    if (w->hole.repeats) {
        Vec3 size = w->hole.repeat;
        Vec3 cell = vec3(cell_of(p.x, size.x), cell_of(p.y, size.y), cell_of(p.z, size.z));
        if (w->hole.jitters) {
            unsigned k = noise_cell(whole(cell.x), whole(cell.y), whole(cell.z));
            centre = add(centre, mul(w->hole.jitter, vec3(noise_random(k), noise_random(k + 1), noise_random(k + 2))));
        }
        centre = add(centre, mul(cell, size));
    }
    Vec3 d = sub(p, centre);
    double far = length(d), radius = w->hole.radius;
    if (far >= radius)
        return p;
    double pull = pow((radius - far) / radius, w->hole.falloff) * w->hole.strength;
    if (pull > 1)
        pull = 1;
    return add(p, scaled(d, w->hole.inverse ? -pull : pull));
}

/* The angle of (x, z) in turns: 0 along x, growing toward z. `far` is the length of (x, z). */
static double turn(double x, double z, double far)
{
    if (z == 0)
        return x > 0 ? 0 : 0.5;
    double c = x / far;
    double angle = acos(c < -1 ? -1 : c > 1 ? 1 : c) / (2 * PI);
    return z < 0 ? 1 - angle : angle;
}

static Vec3 orient(Vec3 o, double a, double b, double c)
{
    if (o.x == 0 && o.y == 0 && o.z == 1)
        return vec3(a, b, c);
    return vec3(o.x * c + o.y * a + o.z * a, o.x * b - o.y * c + o.z * b, -o.x * a + o.y * b + o.z * c);
}

static double stretched(double x, double far, double exponent)
{
    return exponent == 0 ? x : exponent == 1 ? x * far : x * pow(far, exponent);
}

static Vec3 cylindrical(const Warp *w, Vec3 p)
{
    double far = sqrt(p.x * p.x + p.z * p.z);
    if (far == 0)
        return p;
    double u = stretched(turn(p.x, p.z, far), far, w->mapped.dist_exp);
    return orient(w->mapped.orientation, u, p.y, far);
}

static Vec3 spherical(const Warp *w, Vec3 p)
{
    double far = length(p);
    if (far == 0)
        return p;
    double ring = sqrt(p.x * p.x + p.z * p.z), e = w->mapped.dist_exp;
    double u = ring == 0 ? 0 : turn(p.x, p.z, ring), v = 0.5 + asin(p.y / far) / PI;
    return orient(w->mapped.orientation, stretched(u, far, e), stretched(v, far, e), far);
}

static Vec3 toroidal(const Warp *w, Vec3 p)
{
    double ring = sqrt(p.x * p.x + p.z * p.z);
    if (ring == 0)
        return p;
    double u = turn(p.x, p.z, ring), away = ring - w->mapped.major_radius;
    double far = sqrt(away * away + p.y * p.y);
    double v = far == 0 ? 0 : acos(-away / far) / (2 * PI);
    if (p.y > 0)
        v = 1 - v;
    double e = w->mapped.dist_exp;
    return orient(w->mapped.orientation, stretched(u, far, e), stretched(v, far, e), far);
}

static double middle(double t)
{
    return (t + 1) / 2;
}

/* An unfolded cube. The order of the faces decides on its edges. */
static Vec3 cubic(Vec3 p)
{
    double x = p.x, y = p.y, z = p.z, ax = fabs(x), ay = fabs(y), az = fabs(z);
    if (ax == 0 && ay == 0 && az == 0)
        return p;
    if (x >= 0 && x >= ay && x >= az)
        return vec3(0.75 - middle(z / x) / 4, 1.0 / 3 + middle(y / x) / 3, x);
    if (y >= 0 && y >= ax && y >= az)
        return vec3(0.25 + middle(x / y) / 4, 1 - middle(z / y) / 3, y);
    if (z >= 0 && z >= ax && z >= ay)
        return vec3(0.25 + middle(x / z) / 4, 1.0 / 3 + middle(y / z) / 3, z);
    if (x < 0 && x <= -ay && x <= -az)
        return vec3(middle(z / ax) / 4, 1.0 / 3 + middle(y / ax) / 3, ax);
    if (y < 0 && y <= -ax && y <= -az)
        return vec3(0.25 + middle(x / ay) / 4, middle(z / ay) / 3, ay);
    return vec3(1 - middle(x / az) / 4, 1.0 / 3 + middle(y / az) / 3, az);
}

static Vec3 warped(const Warp *w, Vec3 p)
{
    switch (w->kind) {
    case WARP_TRANSFORM: return affine_point_back(&w->transform, p);
    case WARP_TURBULENCE: turbulent(&w->turbulence, &p); break;
    case WARP_REPEAT: return repeat(w, p);
    case WARP_BLACK_HOLE: return black_hole(w, p);
    case WARP_PLANAR: return orient(w->mapped.orientation, p.x, p.y, w->mapped.distance);
    case WARP_CYLINDRICAL: return cylindrical(w, p);
    case WARP_SPHERICAL: return spherical(w, p);
    case WARP_TOROIDAL: return toroidal(w, p);
    case WARP_CUBIC: return cubic(p);
    }
    return p;
}

static double limited(double x)
{
    return x > PATTERN_FAR ? PATTERN_FAR : x < -PATTERN_FAR ? -PATTERN_FAR : x;
}

static inline void keep_within_limits(Vec3 *p)
{
    if (!pattern_reaches(*p))
        *p = vec3(limited(p->x), limited(p->y), limited(p->z));
}

static __attribute__((noinline)) void warp(const Warp *w, Vec3 *p)
{
    *p = warped(w, *p);
}

/* The point is read number by number and stays in registers for its transforms: a pair just stored as two cannot soon be loaded as one. */
void chain_apply(const WarpChain *chain, bool turbulence, const Vec3 *from, Vec3 *to)
{
    Vec3 p = vec3(from->x, from->y, from->z);
    for (uint32_t i = 0; i < chain->n; i++) {
        const Warp *w = &chain->warp[i];
        if (w->kind == WARP_TRANSFORM) {
            p = affine_point_back(&w->transform, p);
        } else {
            *to = p;
            warp(w, to);
            p = *to;
        }
    }
    *to = p;
    if (turbulence && chain->has_turbulence)
        turbulent(&chain->turbulence, to);
    keep_within_limits(to);
}

/* Warp by warp: what each one needs is loaded once for all points. */
void chain_apply_many(const WarpChain *chain, bool turbulence, Vec3 *p, int n)
{
    for (uint32_t k = 0; k < chain->n; k++) {
        const Warp *w = &chain->warp[k];
        if (w->kind == WARP_TRANSFORM && !w->transform.identity)
            for (int i = 0; i < n; i++)
                p[i] = affine_apply(w->transform.inv, p[i]);
        else
            for (int i = 0; i < n; i++)
                p[i] = warped(w, p[i]);
    }
    for (int i = 0; i < n; i++) {
        if (turbulence && chain->has_turbulence)
            turbulent(&chain->turbulence, &p[i]);
        keep_within_limits(&p[i]);
    }
}
