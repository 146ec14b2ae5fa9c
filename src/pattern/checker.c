/* checker.c - lists over simple lattices: checker, square, triangular, hexagon, cubic. */
#include "pattern/map.h"
#include "pattern/wave.h"
#include "scene/ops.h"

static const double SQRT3 = 1.73205080756887729353;

static const MapEntry checker_map[] = { MAP_RGB(0, 0, 0, 1), MAP_RGB(1, 0, 1, 0) };
static const MapEntry hexagon_map[] = { MAP_RGB(0, 0, 0, 1), MAP_RGB(1, 0, 1, 0), MAP_RGB(2, 1, 0, 0) };
static const MapEntry six_map[] = {
    MAP_RGB(0, 1, 0, 0), MAP_RGB(1, 0, 1, 0), MAP_RGB(2, 0, 0, 1), MAP_RGB(3, 1, 1, 0), MAP_RGB(4, 0, 1, 1), MAP_RGB(5, 1, 0, 1),
};

/* Of a whole number; beyond 2^62 all are even. */
static bool is_odd(double whole)
{
    return fabs(whole) < 0x1p62 && ((long long)whole & 1) != 0;
}

/* What is left of x above a multiple of n: 0 <= remainder < n. */
static double remainder_of(double x, double n)
{
    double r = x - n * floor(x / n);
    return r >= n || r < 0 ? 0 : r;
}

static double checker(const void *params, const PatternPoint *at)
{
    (void)params;
    Vec3 p = at->p;
    return is_odd(floor(p.x + PATTERN_TINY) + floor(p.y + PATTERN_TINY) + floor(p.z + PATTERN_TINY));
}

static double square(const void *params, const PatternPoint *at)
{
    (void)params;
    bool x = is_odd(floor(at->p.x)), z = is_odd(floor(at->p.z));
    return x ? (z ? 2 : 3) : (z ? 1 : 0);
}

static double triangular(const void *params, const PatternPoint *at)
{
    (void)params;
    double x = remainder_of(at->p.x, 3), z = remainder_of(at->p.z, SQRT3);
    int a = (int)x;
    double f = x - a;
    bool upper = z >= SQRT3 / 2;
    if (upper)
        z = SQRT3 - z;
    int k = 1;
    if (f != 0) {
        bool left = z / f < SQRT3, right = z / (1 - f) < SQRT3;
        k = left && right ? 0 : right ? 1 : 3;
    }
    int colour = k % 2 ? (k + 2 * a) % 6 : (6 + k - 2 * a) % 6;
    return upper ? 5 - colour : colour;
}

/* POV: the plane x = 0 is a mirror. */
static double hexagon(const void *params, const PatternPoint *at)
{
    static const char outer[] = { 0, 1, 1, 2, 2, 0 }, inner[] = { 2, 2, 0, 0, 1, 1 };
    static const char below[] = { 0, 2, 1, 0, 2, 1 }, above[] = { 2, 1, 0, 2, 1, 0 };
    (void)params;
    double z = at->p.z >= 0 ? at->p.z : 5.196152424 - fabs(at->p.z);
    double u = remainder_of(fabs(at->p.x) / 0.5, 6), w = remainder_of(z / 0.866025404, 6);
    int a = (int)u, b = (int)w;
    if (a == 0 || a == 5)
        return outer[b];
    if (a == 2 || a == 3)
        return inner[b];
    double l = u - a;
    if ((a + b) % 2)
        l = 1 - l;
    if (l == 0)
        l = 0.0001;
    return (w - b) / l < 1 ? below[b] : above[b];
}

static double cubic(const void *params, const PatternPoint *at)
{
    (void)params;
    double x = at->p.x, y = at->p.y, z = at->p.z, ax = fabs(x), ay = fabs(y), az = fabs(z);
    if (x >= 0 && x >= ay && x >= az)
        return 0;
    if (y >= 0 && y >= ax && y >= az)
        return 1;
    if (z >= 0 && z >= ax && z >= ay)
        return 2;
    if (x < 0 && x <= -ay && x <= -az)
        return 3;
    if (y < 0 && y <= -ax && y <= -az)
        return 4;
    return 5;
}

#define LIST(n) .flags = PATTERN_LIST | PATTERN_NO_WAVE, .n_items = (n)

const PatternOps pattern_checker = { .keyword = "checker", LIST(2), MAP_OF(checker_map), .value = checker };
const PatternOps pattern_square = { .keyword = "square", LIST(4), .default_map = six_map, .n_default_map = 4, .value = square };
const PatternOps pattern_triangular = { .keyword = "triangular", LIST(6), MAP_OF(six_map), .value = triangular };
const PatternOps pattern_hexagon = { .keyword = "hexagon", LIST(3), MAP_OF(hexagon_map), .value = hexagon };
const PatternOps pattern_cubic = { .keyword = "cubic", LIST(6), MAP_OF(six_map), .value = cubic };
