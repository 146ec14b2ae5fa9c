/* crackle.c - distances to random points, one in every unit cube (Worley 1996), and cells, one number for every cube.
 *
 * Cubes are visited from the near to the far; those farther away than the points found so far are passed over, which leaves about
 * ten of the 81. */
#include <stdint.h>

#include "math/noise_tables.h"
#include "pattern/wave.h"
#include "sdl/parse.h"

/* The search is built once for any metric and once for squares, where all of `part` folds away. */
#define INLINE static inline __attribute__((always_inline))

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
        c->solid = true;
    else
        return false;
    return true;
}

/* A cube of the grid of whole numbers. */
typedef struct Cube {
    long long x, y, z;
    Vec3 low;                                  /* the corner */
} Cube;

static inline Cube cube_of(Vec3 p)
{
    Vec3 q = vec3(p.x - PATTERN_TINY, p.y - PATTERN_TINY, p.z - PATTERN_TINY);
    if (!(max_abs(q) < 9e15))                  /* beyond, cubes cannot be told apart anyway */
        return (Cube){ 0, 0, 0, vec3(floor(q.x), floor(q.y), floor(q.z)) };
    long long x = (long long)q.x, y = (long long)q.y, z = (long long)q.z;
    x -= q.x < (double)x;
    y -= q.y < (double)y;
    z -= q.z < (double)z;
    return (Cube){ x, y, z, vec3((double)x, (double)y, (double)z) };
}

/* Of the cube (x, y, z) steps from the first; row: the hash of its first two coordinates. */
static inline Vec3 point_in(const Cube *g, unsigned row, int x, int y, int z)
{
    const double *t = noise_tables.random + noise_tables.hash[row ^ (unsigned)((g->z + z) & 4095)];
    return vec3(g->low.x + x + t[0], g->low.y + y + t[1], g->low.z + z + t[2]);
}

static inline unsigned row_of(const Cube *g, int x, int y)
{
    return noise_tables.hash[noise_tables.hash[(g->x + x) & 4095] ^ (unsigned)((g->y + y) & 4095)];
}

/* |x|^metric, the part of one axis. */
INLINE double part(double x, double metric)
{
    if (metric == 2)
        return x * x;
    x = fabs(x);
    if (metric == 1)
        return x;
    if (!(metric > 0 && metric <= 8 && metric * 2 == floor(metric * 2)))
        return pow(x, metric);
    double v = metric == floor(metric) ? 1 : sqrt(x);          /* several times faster */
    for (double n = metric; n >= 1; n--)
        v *= x;
    return v;
}

/* Of two points; a sum that has passed `enough` need not be finished. */
INLINE double measure(Vec3 p, Vec3 q, double metric, double enough)
{
    double s = part(p.x - q.x, metric) + part(p.y - q.y, metric);
    return metric != 2 && s > enough ? s : s + part(p.z - q.z, metric);
}

typedef struct Near {
    double s[3];                               /* the smallest sums of |d|^metric */
    Vec3 nearest;
} Near;

/* Sums after the one that is wanted last need not be right. */
INLINE void offer(Near *near, double s, Vec3 q, int last)
{
    if (s < near->s[0]) {
        near->s[2] = near->s[1];
        near->s[1] = near->s[0];
        near->s[0] = s;
        near->nearest = q;
    } else if (s < near->s[1]) {
        near->s[2] = near->s[1];
        near->s[1] = s;
    } else if (last == 2 && s < near->s[2]) {
        near->s[2] = s;
    }
}

/* The nine cubes two steps away along one axis, to one side. */
INLINE void offer_face(Near *near, Vec3 p, const Cube *g, int axis, int step, double metric, int last)
{
    for (int i = -1; i <= 1; i++)
        for (int j = -1; j <= 1; j++) {
            int x = axis == 0 ? step : i, y = axis == 1 ? step : axis == 0 ? i : j, z = axis == 2 ? step : j;
            Vec3 q = point_in(g, row_of(g, x, y), x, y, z);
            offer(near, measure(p, q, metric, near->s[last]), q, last);
        }
}

/* Of the 54 cubes two steps away along one axis those that may matter. Seldom any. */
static __attribute__((noinline)) void offer_beyond(Near *near, Vec3 p, const Cube *g, double metric, int last)
{
    Vec3 f = sub(p, g->low);
    for (int axis = 0; axis < 3; axis++)
        for (int step = -2; step <= 2; step += 4) {
            double x = vec3_at(f, axis), gap = step < 0 ? 1 + x : 2 - x;
            if (part((gap > 1 ? gap : 1) * (1 - 1e-9), metric) <= near->s[last])
                offer_face(near, p, g, axis, step, metric, last);
        }
}

/* The three cubes along one axis, near ones first. */
typedef struct Axis {
    double gap[3];                             /* the least part of each in the distance */
    double low[3];                             /* the low side of each */
    unsigned cell[3];                          /* the number of each, for the hash */
} Axis;

/* x: from the low side of the point's own cube. The slack covers the rounding of the points' coordinates. */
INLINE Axis axis_of(double x, double low, long long cell, double metric)
{
    double before = (x > 0 ? x : 0) * (1 - 1e-9), behind = (x < 1 ? 1 - x : 0) * (1 - 1e-9);
    int side = x > 0.5 ? 1 : -1;
    return (Axis){ { 0, part(side > 0 ? behind : before, metric), part(side > 0 ? before : behind, metric) },
                   { low, low + side, low - side },
                   { cell & 4095, (cell + side) & 4095, (cell - side) & 4095 } };
}

/* `last`: which of the three smallest is wanted last. What lies farther away than that one so far is passed over; metric > 0. */
INLINE Near near_of(Vec3 p, double metric, int last)
{
    const uint16_t *hash = noise_tables.hash;
    Cube g = cube_of(p);
    Axis ax = axis_of(p.x - g.low.x, g.low.x, g.x, metric), ay = axis_of(p.y - g.low.y, g.low.y, g.y, metric),
         az = axis_of(p.z - g.low.z, g.low.z, g.z, metric);
    Near near = { .s = { INFINITY, INFINITY, INFINITY } };
    for (int i = 0; i < 3 && ax.gap[i] <= near.s[last]; i++) {
        unsigned slice = hash[ax.cell[i]];
        for (int j = 0; j < 3; j++) {
            double gap = ax.gap[i] + ay.gap[j];
            if (gap > near.s[last])
                break;
            unsigned row = hash[slice ^ ay.cell[j]];
            for (int k = 0; k < 3 && gap + az.gap[k] <= near.s[last]; k++) {
                const double *t = noise_tables.random + hash[row ^ az.cell[k]];
                Vec3 q = vec3(ax.low[i] + t[0], ay.low[j] + t[1], az.low[k] + t[2]);
                offer(&near, measure(p, q, metric, near.s[last]), q, last);
            }
        }
    }
    if (near.s[last] > 1 - 1e-9)
        offer_beyond(&near, p, &g, metric, last);
    return near;
}

/* Metrics that are not positive turn near and far round: all 81 cubes count. */
static Near near_of_all(Vec3 p, double metric)
{
    Cube g = cube_of(p);
    Near near = { .s = { INFINITY, INFINITY, INFINITY } };
    for (int i = 0; i < 27; i++) {
        int x = i % 3 - 1, y = i / 3 % 3 - 1, z = i / 9 - 1;
        Vec3 q = point_in(&g, row_of(&g, x, y), x, y, z);
        offer(&near, measure(p, q, metric, near.s[2]), q, 2);
    }
    for (int axis = 0; axis < 3; axis++) {
        offer_face(&near, p, &g, axis, -2, metric, 2);
        offer_face(&near, p, &g, axis, 2, metric, 2);
    }
    return near;
}

static Near nearest(Vec3 p, double metric, int last)
{
    if (metric == 2)
        return near_of(p, 2, last);
    return metric > 0 ? near_of(p, metric, last) : near_of_all(p, metric);
}

static double distance(double s, double metric)
{
    return metric == 2 ? sqrt(s) : metric == 1 ? s : pow(s, 1 / metric);
}

static double of_all(const Crackle *c, const PatternPoint *at)
{
    Near near = nearest(at->p, c->metric, c->form.z != 0 ? 2 : 1);
    if (c->solid)
        return noise_value(at->pattern->noise_generator, &near.nearest);
    double extra = 0, v = 0;
    if (c->offset != 0)
        extra = c->metric == 2 ? c->offset * c->offset : c->metric == 1 ? c->offset : pow(c->offset, c->metric);
    const double form[3] = { c->form.x, c->form.y, c->form.z };
    for (int i = 0; i < 3; i++)
        if (form[i] != 0)
            v += form[i] * distance(near.s[i] + extra, c->metric);
    return wave_clamp(v);
}

/* The most frequent case has no use for anything but the two least sums. Not so far out that the slack of axes says less than the
 * points' coordinates, so that both ways give the same; and not where cubes farther away may count. */
static double value(const void *params, const PatternPoint *at)
{
    const Crackle *c = params;
    double s[2], extra = c->offset * c->offset, v = 0;
    if (c->metric != 2 || c->form.z != 0 || c->solid)
        return of_all(c, at);
    if (!noise_two_nearest(&at->p, PATTERN_TINY, s) || s[1] > 1 - 1e-9)
        return of_all(c, at);
    if (c->form.x != 0)
        v += c->form.x * sqrt(s[0] + extra);
    if (c->form.y != 0)
        v += c->form.y * sqrt(s[1] + extra);
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
