/* crackle.c - distances to random points, one in every unit cube (Worley 1996), and cells, one number for every cube.
 *
 * Cubes are visited from the near to the far; one that is farther away than the third nearest point so far is passed over, which
 * leaves a dozen of the 81. */
#include "pattern/crackle.h"

#include <stdint.h>

#include "math/noise.h"
#include "pattern/wave.h"
#include "sdl/parse.h"

typedef struct { Vec3 form; double metric, offset; bool solid; } Crackle;

static void parse(Parser *p, void *params)
{
    (void)p;
    *(Crackle *)params = (Crackle){ .form = { -1, 1, 0 }, .metric = 2 };
}

static bool item(Parser *p, void *params)
{
    Crackle *c = params;
    if (parse_accept(p, KW_FORM))
        c->form = parse_vec3(p);
    else if (parse_accept(p, KW_METRIC))
        c->metric = parse_vec3(p).x;
    else if (parse_accept(p, KW_OFFSET))
        c->offset = parse_float(p);
    else if (parse_accept(p, KW_SOLID))
        c->solid = parse_optional_bool(p, true);
    else
        return false;
    return true;
}

/* The 27 cubes around, then the 54 beyond: near ones first. */
static const int8_t cubes[81][3] = {
    { 0, 0, 0 },
    { -1, 0, 0 }, { 1, 0, 0 }, { 0, -1, 0 }, { 0, 1, 0 }, { 0, 0, -1 }, { 0, 0, 1 },
    { -1, -1, 0 }, { -1, 1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 0, -1 }, { -1, 0, 1 }, { 1, 0, -1 }, { 1, 0, 1 }, { 0, -1, -1 },
    { 0, -1, 1 }, { 0, 1, -1 }, { 0, 1, 1 },
    { -1, -1, -1 }, { -1, -1, 1 }, { -1, 1, -1 }, { -1, 1, 1 }, { 1, -1, -1 }, { 1, -1, 1 }, { 1, 1, -1 }, { 1, 1, 1 },
#define BEYOND(a) \
    { a, 0, 0 }, { 0, a, 0 }, { 0, 0, a }, { a, -1, 0 }, { a, 1, 0 }, { a, 0, -1 }, { a, 0, 1 }, { -1, a, 0 }, { 1, a, 0 }, \
    { 0, a, -1 }, { 0, a, 1 }, { -1, 0, a }, { 1, 0, a }, { 0, -1, a }, { 0, 1, a }, { a, -1, -1 }, { a, -1, 1 }, { a, 1, -1 }, \
    { a, 1, 1 }, { -1, a, -1 }, { -1, a, 1 }, { 1, a, -1 }, { 1, a, 1 }, { -1, -1, a }, { -1, 1, a }, { 1, -1, a }, { 1, 1, a }
    BEYOND(-2), BEYOND(2),
};

typedef struct Grid { long long x, y, z; Vec3 low; } Grid;

static Grid grid_of(Vec3 p)
{
    Grid g = { .low = vec3(floor(p.x - PATTERN_TINY), floor(p.y - PATTERN_TINY), floor(p.z - PATTERN_TINY)) };
    if (max_abs(g.low) < 9e15) {               /* beyond, cubes cannot be told apart anyway */
        g.x = (long long)g.low.x;
        g.y = (long long)g.low.y;
        g.z = (long long)g.low.z;
    }
    return g;
}

static Vec3 point_in(const Grid *g, const int8_t cube[3])
{
    unsigned k = noise_cell(g->x + cube[0], g->y + cube[1], g->z + cube[2]);
    return vec3(g->low.x + cube[0] + noise_random(k), g->low.y + cube[1] + noise_random(k + 1),
                g->low.z + cube[2] + noise_random(k + 2));
}

static inline double measure(double x, double y, double z, double metric)
{
    if (metric == 2)
        return x * x + y * y + z * z;
    if (metric == 1)
        return fabs(x) + fabs(y) + fabs(z);
    return pow(fabs(x), metric) + pow(fabs(y), metric) + pow(fabs(z), metric);
}

/* How far p, at f from the low corner of its cube, is at least from a cube `a` steps along. */
static inline double gap(double f, int a)
{
    return a == 0 ? 0 : a > 0 ? a - f : f - (a + 1);
}

CrackleNear crackle_near(Vec3 p, double metric)
{
    Grid g = grid_of(p);
    Vec3 f = sub(p, g.low);
    double axis[3][5];                         /* the part of each axis in the distance to a cube, -2..2 */
    bool prune = metric > 0;
    for (int a = -2; prune && a <= 2; a++) {
        axis[0][a + 2] = measure(fmax(0, gap(f.x, a)), 0, 0, metric);
        axis[1][a + 2] = measure(fmax(0, gap(f.y, a)), 0, 0, metric);
        axis[2][a + 2] = measure(fmax(0, gap(f.z, a)), 0, 0, metric);
    }
    CrackleNear near = { .s = { INFINITY, INFINITY, INFINITY } };
    for (int i = 0; i < 81; i++) {
        const int8_t *cube = cubes[i];
        /* The slack covers the rounding of the point's own coordinates. */
        if (prune && (axis[0][cube[0] + 2] + axis[1][cube[1] + 2] + axis[2][cube[2] + 2]) * (1 - 1e-9) > near.s[2])
            continue;
        Vec3 q = point_in(&g, cube);
        double s = measure(p.x - q.x, p.y - q.y, p.z - q.z, metric);
        if (s < near.s[0]) {
            near = (CrackleNear){ { s, near.s[0], near.s[1] }, q };
        } else if (s < near.s[1]) {
            near.s[2] = near.s[1];
            near.s[1] = s;
        } else if (s < near.s[2]) {
            near.s[2] = s;
        }
    }
    return near;
}

Vec3 crackle_lowest(Vec3 p)
{
    Grid g = grid_of(p);
    Vec3 lowest = p;
    double best = INFINITY;
    for (int i = 0; i < 81; i++) {
        Vec3 q = point_in(&g, cubes[i]);
        double s = (q.x - p.x) + (q.y - p.y) + (q.z - p.z);
        if (s < best) {
            best = s;
            lowest = q;
        }
    }
    return lowest;
}

static double distance(double s, double metric)
{
    return metric == 2 ? sqrt(s) : metric == 1 ? s : pow(s, 1 / metric);
}

static double value(const void *params, const PatternPoint *at)
{
    const Crackle *c = params;
    CrackleNear near = crackle_near(at->p, c->metric);
    if (c->solid)
        return noise_value(at->pattern->noise_generator, near.nearest);
    double extra = 0, v = 0;
    if (c->offset != 0)
        extra = c->metric == 2 ? c->offset * c->offset : c->metric == 1 ? c->offset : pow(c->offset, c->metric);
    const double form[3] = { c->form.x, c->form.y, c->form.z };
    for (int i = 0; i < 3; i++)
        if (form[i] != 0)
            v += form[i] * distance(near.s[i] + extra, c->metric);
    return wave_clamp(v);
}

static double cells(const void *params, const PatternPoint *at)
{
    (void)params;
    Vec3 p = vec3(floor(at->p.x + PATTERN_TINY), floor(at->p.y + PATTERN_TINY), floor(at->p.z + PATTERN_TINY));
    if (!(max_abs(p) < 9e15))
        p = vec3(0, 0, 0);
    return fmin(noise_random(noise_cell((long long)p.x, (long long)p.y, (long long)p.z)), 1);
}

const PatternOps pattern_crackle = {
    .keyword = "crackle", .params_size = sizeof(Crackle), .parse = parse, .item = item, .value = value,
};
const PatternOps pattern_cells = { .keyword = "cells", .value = cells };
