/* gradient.c - distances: gradient, planar, spherical, cylindrical, boxed, onion, radial, leopard. */
#include "pattern/map.h"
#include "sdl/parse.h"

static const MapEntry radial_map[] = { MAP_RGB(0, 0, 1, 1), MAP_RGB(0.333f, 1, 1, 0), MAP_RGB(0.666f, 1, 0, 1), MAP_RGB(1, 0, 1, 1) };

static void gradient_parse(Parser *p, void *params)
{
    Vec3 d = parse_vec3(p);
    if (d.x == 0 && d.y == 0 && d.z == 0)
        parse_fail(p, "the vector of a gradient needs a length");
    *(Vec3 *)params = normalized(d);
}

static double gradient(const void *params, const PatternPoint *at)
{
    double v = dot(at->p, *(const Vec3 *)params);
    return v > 1 ? v - floor(v) : v;
}

static double from_one(double distance)
{
    return distance <= 1 ? 1 - distance : 0;
}

static double planar(const void *params, const PatternPoint *at)
{
    (void)params;
    return from_one(fabs(at->p.y));
}

static double spherical(const void *params, const PatternPoint *at)
{
    (void)params;
    return from_one(length(at->p));
}

static double cylindrical(const void *params, const PatternPoint *at)
{
    (void)params;
    return from_one(sqrt(at->p.x * at->p.x + at->p.z * at->p.z));
}

static double boxed(const void *params, const PatternPoint *at)
{
    (void)params;
    return from_one(max_abs(at->p));
}

static double onion(const void *params, const PatternPoint *at)
{
    (void)params;
    double v = length(at->p);
    return v - floor(v);
}

static double radial(const void *params, const PatternPoint *at)
{
    (void)params;
    /* POV: near the axis the angle counts as 0. */
    if (fabs(at->p.x) < 0.001 && fabs(at->p.z) < 0.001)
        return 0.25;
    return 0.25 + (atan2(at->p.x, at->p.z) + PI) / (2 * PI);
}

static double leopard(const void *params, const PatternPoint *at)
{
    (void)params;
    double s = (sin(at->p.x) + sin(at->p.y) + sin(at->p.z)) / 3;
    return s * s;
}

const PatternOps pattern_gradient = { .keyword = "gradient", .params_size = sizeof(Vec3), .parse = gradient_parse, .value = gradient };
const PatternOps pattern_planar = { .keyword = "planar", .value = planar };
const PatternOps pattern_spherical = { .keyword = "spherical", .value = spherical };
const PatternOps pattern_cylindrical = { .keyword = "cylindrical", .value = cylindrical };
const PatternOps pattern_boxed = { .keyword = "boxed", .value = boxed };
const PatternOps pattern_onion = { .keyword = "onion", .value = onion };
const PatternOps pattern_radial = { .keyword = "radial", MAP_OF(radial_map), .value = radial };
const PatternOps pattern_leopard = { .keyword = "leopard", .value = leopard };
