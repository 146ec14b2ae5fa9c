/* height_field.c - height_field { image or function [water_level L] [smooth] }: two triangles over each cell of a grid.
 *
 * Rays descend a pyramid of lowest and highest heights, in which a node is a square of 2^level cells, nearest squares first.
 * In a cell the height over the ray is asked where it crosses the cell's sides and its diagonal: those numbers are the same
 * for the neighbour, and between two of them both ray and ground are straight, so no ray slips through. All is in map
 * units: x and z count points, y is 0 ... 65535 (08-shapes, section 14).
 * Parts: 0 and 1, the triangles of the cell (u, v). */
#include "base/simd.h"
#include "image/image.h"
#include "scene/image_map.h"
#include "sdl/parse.h"
#include "shape/shape.h"

enum { MOST_LEVELS = 17, TOP = 65536 };

typedef struct { uint16_t lo, hi; } Range;

/* Ranges of squares of a size; an even number of rows and columns, so that every square above has four: those off the map are empty. */
typedef struct { const Range *range; uint32_t w, h; } Level;

typedef struct {
    uint32_t w, h;                             /* points */
    const uint16_t *height;                    /* row z = 0 first */
    Level level[MOST_LEVELS + 1];              /* level[l]: squares of 2^l cells, l >= 1 */
    uint32_t top;                              /* the level that is one square */
    double water;                              /* 0 ... 65536 */
    bool smooth;
} Params;

typedef struct {
    Params map;
    double lowest, highest;                    /* what can be hit */
    Affine place;                              /* map units to the world, for smooth normals */
} Field;

/* POV: hits this far outside the heights' range still count, in map units. */
static const double SLACK = 0.001;

/* ---- the map ---- */

/* Raw samples count, also where the file says how they are encoded; with `gamma` they are decoded to the file's own depth. */
static uint32_t level_of(const Image *im, float value)
{
    double level = trunc((double)value * im->max_value * (1 + 1e-6));
    return level <= 0 ? 0 : level >= im->max_value ? im->max_value : (uint32_t)level;
}

static uint16_t clamped(double v)
{
    return v >= 65535 ? 65535 : v > 0 ? (uint16_t)v : 0;
}

static uint16_t height_of(const Image *im, int x, int y)
{
    if (im->indexed)
        return (uint16_t)(image_index(im, x, y) * 256);
    Colour c = image_pixel(im, x, y);
    if (im->depth != IMAGE_FLOAT && im->channels < 3)
        return (uint16_t)((uint64_t)level_of(im, c.r) * 65535 / im->max_value);
    if (im->depth == IMAGE_U8)                 /* POV: red is the high byte, green the low one */
        return (uint16_t)(level_of(im, c.r) * 255 / im->max_value * 256 + level_of(im, c.g) * 255 / im->max_value);
    float grey = 0.297f * c.r + 0.589f * c.g + 0.114f * c.b;
    return clamped((double)(grey * 65535.0f));
}

static Range joined(Range a, Range b)
{
    return (Range){ a.lo < b.lo ? a.lo : b.lo, a.hi > b.hi ? a.hi : b.hi };
}

static const Range EMPTY = { UINT16_MAX, 0 };

static Range of_points(const Params *f, uint32_t x, uint32_t z)
{
    Range r = EMPTY;
    for (uint32_t k = 2 * z; k <= 2 * z + 2 && k < f->h; k++)
        for (uint32_t i = 2 * x; i <= 2 * x + 2 && i < f->w; i++) {
            uint16_t y = f->height[(size_t)k * f->w + i];
            r = joined(r, (Range){ y, y });
        }
    return r;
}

static Range of_quarters(const Level *below, uint32_t x, uint32_t z)
{
    const Range *near = below->range + (size_t)2 * z * below->w + 2 * x, *far = near + below->w;
    return joined(joined(near[0], near[1]), joined(far[0], far[1]));
}

static uint32_t half(uint32_t n) { return (n + 1) / 2; }

static void build_pyramid(Arena *arena, Params *f)
{
    uint32_t level = 1, w = half(f->w - 1), h = half(f->h - 1);
    for (;; level++, w = half(w), h = half(h)) {
        uint32_t even_w = w + w % 2, even_h = h + h % 2;
        Range *range = arena_array(arena, Range, (size_t)even_w * even_h);
        for (uint32_t z = 0; z < even_h; z++)
            for (uint32_t x = 0; x < even_w; x++)
                range[(size_t)z * even_w + x] = x >= w || z >= h ? EMPTY : level == 1 ? of_points(f, x, z)
                                                                                      : of_quarters(&f->level[level - 1], x, z);
        f->level[level] = (Level){ range, even_w, even_h };
        if (w == 1 && h == 1)
            break;
    }
    f->top = level;
}

static void parse(Parser *p, void *params)
{
    Params *f = params;
    const Image *im = parse_image(p)->image;
    if (im->width < 2 || im->height < 2)
        parse_fail(p, "a height_field needs at least 2 by 2 points, the image has %d by %d", im->width, im->height);
    f->w = (uint32_t)im->width;
    f->h = (uint32_t)im->height;
    uint16_t *height = arena_array(parse_arena(p), uint16_t, (size_t)f->w * f->h);
    for (uint32_t z = 0; z < f->h; z++)
        for (uint32_t x = 0; x < f->w; x++)
            height[(size_t)z * f->w + x] = height_of(im, (int)x, (int)(f->h - 1 - z));
    f->height = height;
    build_pyramid(parse_arena(p), f);
    parse_stray_comma(p);
}

static bool item(Parser *p, void *params)
{
    Params *f = params;
    if (parse_accept(p, KW_WATER_LEVEL)) {
        double level = parse_float(p);
        f->water = TOP * (parse_version(p) < 200 ? level / 256 : level);
    } else if (parse_accept(p, KW_SMOOTH))
        f->smooth = true;
    else
        return false;
    parse_stray_comma(p);
    return true;
}

static Affine to_unit(const Params *f)
{
    return affine_scale(vec3(1.0 / (f->w - 1), 1.0 / TOP, 1.0 / (f->h - 1)));
}

static Bounds box_of(const Params *f)
{
    Range all = f->level[f->top].range[0];
    return (Bounds){ vec3(0, fmax(all.lo, f->water) - SLACK, 0), vec3(f->w - 1, all.hi + SLACK, f->h - 1) };
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *f = params;
    Bounds box = box_of(f);
    if (bounds_is_empty(box))
        return;                                /* all under water */
    Field *out = build_data(b, sizeof *out);
    out->map = *f;
    out->lowest = box.lo.y;
    out->highest = box.hi.y;
    out->place = affine_then(to_unit(f), b->place);
    build_prim(b, out, &out->place, shape_padded(box));
}

/* ---- along a ray ---- */

typedef struct {
    const Field *f;
    Vec3 o, d;                                 /* from where the line enters the box */
    double ix, iz;                             /* 1 / d, huge instead of infinite */
    double end, start, limit;                  /* leaves the box; the part that can matter */
    double shift;
    HitSink *sink;
} Line;

static double at(const Params *m, uint32_t x, uint32_t z)
{
    return m->height[(size_t)z * m->w + x];
}

static double fraction(double x)
{
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

/* Between two points of the map, always from the same one. */
static double along_edge(double a, double b, double f)
{
    return a + f * (b - a);
}

typedef struct { double h00, h10, h01, h11; } Corners;

/* On the triangle of the cell that holds (x, z), fractions. */
static double on_cell(const Corners *c, double x, double z)
{
    x = fraction(x);
    z = fraction(z);
    return x + z < 1 ? c->h00 + x * (c->h10 - c->h00) + z * (c->h01 - c->h00)
                     : c->h11 + (1 - x) * (c->h01 - c->h11) + (1 - z) * (c->h10 - c->h11);
}

static void straight(Line *l, double s0, double g0, double s1, double g1, uint32_t i, uint32_t k, uint32_t triangle)
{
    if ((g0 < 0) == (g1 < 0))
        return;
    double s = s0 + (s1 - s0) * (g0 / (g0 - g1));
    if (l->o.y + s * l->d.y < l->f->lowest)
        return;                                /* under water */
    hit_add_uv(l->sink, l->shift + s, triangle, i, k);
    l->limit = hit_limit(l->sink) - l->shift;
}

/* Where the line enters or leaves the cell: height over the ground. `on_x`: through a side of constant x. */
static double over_side(const Line *l, const Corners *c, double s, bool on_x, bool far_side, uint32_t i, uint32_t k)
{
    double ground;
    if (on_x) {
        double f = fraction(l->o.z + s * l->d.z - k);
        ground = far_side ? along_edge(c->h10, c->h11, f) : along_edge(c->h00, c->h01, f);
    } else {
        double f = fraction(l->o.x + s * l->d.x - i);
        ground = far_side ? along_edge(c->h01, c->h11, f) : along_edge(c->h00, c->h10, f);
    }
    return l->o.y + s * l->d.y - ground;
}

static double over_cell(const Line *l, const Corners *c, double s, uint32_t i, uint32_t k)
{
    return l->o.y + s * l->d.y - on_cell(c, l->o.x + s * l->d.x - i, l->o.z + s * l->d.z - k);
}

static void cell_hits(Line *l, uint32_t i, uint32_t k)
{
    const Params *m = &l->f->map;
    Vec3 o = l->o, d = l->d;
    bool px = l->ix > 0, pz = l->iz > 0;
    double x0 = (i + !px - o.x) * l->ix, x1 = (i + px - o.x) * l->ix, z0 = (k + !pz - o.z) * l->iz, z1 = (k + pz - o.z) * l->iz;
    double s0 = greater(x0, z0), s1 = lesser(x1, z1);
    if (!(s0 <= s1) || s1 < 0 || s0 > l->end)
        return;
    Corners c = { at(m, i, k), at(m, i + 1, k), at(m, i, k + 1), at(m, i + 1, k + 1) };
    /* Ends beyond the box would cost digits: the box, which depends on the line alone, cuts them. */
    double g0, g1;
    if (s0 < 0) {
        s0 = 0;
        g0 = over_cell(l, &c, 0, i, k);
    } else
        g0 = over_side(l, &c, s0, x0 >= z0, x0 >= z0 ? !px : !pz, i, k);
    if (s1 > l->end) {
        s1 = l->end;
        g1 = over_cell(l, &c, s1, i, k);
    } else
        g1 = over_side(l, &c, s1, x1 <= z1, x1 <= z1 ? px : pz, i, k);
    double across = d.x + d.z, cut = (i + k + 1 - (o.x + o.z)) / across;
    if (across != 0 && cut > s0 && cut < s1) {
        double g = o.y + cut * d.y - along_edge(c.h01, c.h10, fraction(o.x + cut * d.x - i));
        straight(l, s0, g0, cut, g, i, k, across < 0);
        straight(l, cut, g, s1, g1, i, k, across > 0);
        return;
    }
    double middle = 0.5 * (s0 + s1);
    straight(l, s0, g0, s1, g1, i, k, o.x + o.z + middle * across > i + k + 1);
}

/* A square, or at level 0 a cell, and the stretch of the line over it. */
typedef struct { double s0, s1; uint32_t level, x, z; } Square;

/* Could the line meet the ground in this square at heights from ya to yb? */
static inline bool may_meet(const Params *m, uint32_t level, uint32_t x, uint32_t z, double ya, double yb)
{
    static const double pad = 0.01;            /* covers the rounding of y */
    double lo = lesser(ya, yb) - pad, hi = greater(ya, yb) + pad;
    if (level > 0) {
        const Level *at_level = &m->level[level];
        Range r = at_level->range[(size_t)z * at_level->w + x];
        return lo <= r.hi && hi >= r.lo;
    }
    if (x >= m->w - 1 || z >= m->h - 1)
        return false;
    const uint16_t *near = m->height + (size_t)z * m->w + x, *far = near + m->w;
    int a = near[0] < near[1] ? near[0] : near[1], b = far[0] < far[1] ? far[0] : far[1];
    int c = near[0] < near[1] ? near[1] : near[0], d = far[0] < far[1] ? far[1] : far[0];
    return lo <= (c > d ? c : d) && hi >= (a < b ? a : b);
}

/* Those quarters of a square that the line may meet, the nearest last. The line is cut at the two middle lines; those are lines of
 * the grid, so the cuts are the numbers that cells use. */
static inline uint32_t quarters(const Line *l, const Square *q, Square *out)
{
    uint32_t level = q->level - 1, n = 0, far_x = l->ix > 0, far_z = l->iz > 0;
    double mx = (int)((2 * q->x + 1) << level) - l->o.x, mz = (int)((2 * q->z + 1) << level) - l->o.z;
    double sx = mx * l->ix, sz = mz * l->iz, first = lesser(sx, sz), last = greater(sx, sz), s1 = q->s1, y1 = l->o.y + s1 * l->d.y;
    const double from[3] = { q->s0, lesser(greater(first, q->s0), q->s1), lesser(greater(last, q->s0), q->s1) };
    for (int i = 2; i >= 0; i--) {
        double s0 = from[i];
        if (!(s0 < s1))
            continue;
        double y0 = l->o.y + s0 * l->d.y;
        uint32_t x = 2 * q->x + (far_x ^ (s0 < sx)), z = 2 * q->z + (far_z ^ (s0 < sz));
        if (may_meet(&l->f->map, level, x, z, y0, y1))
            out[n++] = (Square){ s0, s1, level, x, z };
        s1 = s0;
        y1 = y0;
    }
    return n;
}

/* The least square that holds the stretch from s0 to s1, with room for rounding. */
static Square first_square(const Line *l, double s0, double s1)
{
    static const double room = 1e-6;
    const Params *m = &l->f->map;
    double xa = l->o.x + s0 * l->d.x, xb = l->o.x + s1 * l->d.x, za = l->o.z + s0 * l->d.z, zb = l->o.z + s1 * l->d.z;
    uint32_t x0 = (uint32_t)greater(lesser(xa, xb) - room, 0), x1 = (uint32_t)lesser(greater(xa, xb) + room, m->w - 2);
    uint32_t z0 = (uint32_t)greater(lesser(za, zb) - room, 0), z1 = (uint32_t)lesser(greater(za, zb) + room, m->h - 2);
    uint32_t level = 1;
    x0 = x0 > x1 ? x1 : x0;                    /* along the far side */
    z0 = z0 > z1 ? z1 : z0;
    while (x0 >> level != x1 >> level || z0 >> level != z1 >> level)
        level++;
    return (Square){ s0, s1, level, x0 >> level, z0 >> level };
}

static void descend(Line *l)
{
    Square stack[2 * MOST_LEVELS + 3];
    uint32_t n = 1;
    double s0 = greater(0, l->start), s1 = lesser(l->end, l->limit);
    if (!(s0 <= s1))
        return;
    stack[0] = first_square(l, s0, s1);
    while (n > 0) {
        Square q = stack[--n];
        if (q.s0 > l->limit)
            return;                            /* what is left is farther */
        if (q.level > 0)
            n += quarters(l, &q, stack + n);
        else
            cell_hits(l, q.x, q.z);
    }
}

static inline bool between(double o, double d, double lo, double hi, double *in, double *out)
{
    if (d == 0)
        return lo <= o && o <= hi;
    double a = (lo - o) / d, b = (hi - o) / d;
    *in = greater(lesser(a, b), *in);
    *out = lesser(greater(a, b), *out);
    return true;
}

/* The whole line's part in the box. */
static bool enter(const Field *f, const Ray *ray, double *in, double *out)
{
    *in = -INFINITY;
    *out = INFINITY;
    return between(ray->o.x, ray->d.x, 0, f->map.w - 1, in, out) && between(ray->o.y, ray->d.y, f->lowest, f->highest, in, out) &&
           between(ray->o.z, ray->d.z, 0, f->map.h - 1, in, out) && *in <= *out;
}

static double inverse(double d)
{
    return fabs(d) < 1e-290 ? copysign(1e290, d) : 1 / d;
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Field *f = shape;
    double in, out;
    if (!enter(f, ray, &in, &out))
        return;
    Line l = { .f = f, .o = ray_at(ray, in), .d = ray->d, .ix = inverse(ray->d.x), .iz = inverse(ray->d.z), .end = out - in,
               .start = ray->t_min - in, .limit = hit_limit(sink) - in, .shift = in, .sink = sink };
    descend(&l);
}

/* ---- at a point ---- */

static Corners corners_at(const Params *m, uint32_t i, uint32_t k)
{
    return (Corners){ at(m, i, k), at(m, i + 1, k), at(m, i, k + 1), at(m, i + 1, k + 1) };
}

/* POV: down to minus infinity, also under water, and the far edges are not of it. There points are raised to the water for
 * this question alone, so that it and the surface disagree along the shore; here they agree. */
static bool inside(const void *shape, Vec3 p)
{
    const Field *f = shape;
    const Params *m = &f->map;
    if (!(p.x >= 0 && p.x < m->w - 1 && p.z >= 0 && p.z < m->h - 1) || p.y >= f->highest - SLACK)
        return false;
    if (p.y < f->lowest)
        return true;
    uint32_t i = (uint32_t)p.x, k = (uint32_t)p.z;
    Corners c = corners_at(m, i, k);
    return p.y < on_cell(&c, p.x - i, p.z - k);
}

/* The sum of the unit normals of the triangles between p and its neighbours in x and z, those within the map. POV: kept in
 * 16 bits, in map units. */
static Vec3 point_normal(const Params *m, uint32_t i, uint32_t k)
{
    bool left = i > 0, right = i + 1 < m->w, front = k > 0, back = k + 1 < m->h;
    double y = at(m, i, k);
    double x0 = left ? y - at(m, i - 1, k) : 0, x1 = right ? at(m, i + 1, k) - y : 0;
    double z0 = front ? y - at(m, i, k - 1) : 0, z1 = back ? at(m, i, k + 1) - y : 0;
    const double dx[4] = { x1, x0, x0, x1 }, dz[4] = { z1, z1, z0, z0 };
    const double there[4] = { right && back, left && back, left && front, right && front };
    double nx[4], ny[4], nz[4];
    d4 x = d4_load(dx), z = d4_load(dz), one = d4_set(1);
    d4 f = d4_div(d4_load(there), d4_sqrt(d4_add(d4_add(d4_mul(x, x), one), d4_mul(z, z))));
    d4_store(nx, d4_mul(x, f));
    d4_store(ny, f);
    d4_store(nz, d4_mul(z, f));
    Vec3 sum = vec3(0 - nx[0] - nx[1] - nx[2] - nx[3], ny[0] + ny[1] + ny[2] + ny[3], 0 - nz[0] - nz[1] - nz[2] - nz[3]);
    Vec3 n = scaled(normalized(sum), 32767);
    return vec3((int)n.x, (int)n.y, (int)n.z);
}

/* POV: the points' normals are brought to the world, each to unit length, and mixed there. */
static Vec3 smooth_normal(const Field *f, uint32_t i, uint32_t k, Vec3 p)
{
    double x = fraction(p.x - i), z = fraction(p.z - k);
    Vec3 mixed = vec3(0, 0, 0);
    for (uint32_t c = 0; c < 4; c++) {
        Vec3 n = normalized(affine_normal(&f->place, point_normal(&f->map, i + (c & 1), k + (c >> 1))));
        mixed = add(mixed, scaled(n, (c & 1 ? x : 1 - x) * (c >> 1 ? z : 1 - z)));
    }
    return affine_normal_back(&f->place, mixed);
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    const Field *f = shape;
    uint32_t i = (uint32_t)hit->u, k = (uint32_t)hit->v;
    Corners c = corners_at(&f->map, i, k);
    Vec3 flat = hit->part == 0 ? vec3(c.h00 - c.h10, 1, c.h00 - c.h01) : vec3(c.h01 - c.h11, 1, c.h10 - c.h11);
    out->normal = flat;
    if (f->map.smooth) {
        out->normal = smooth_normal(f, i, k, out->p);
        out->geometric = flat;
    }
}

static Bounds extent(const void *params, const Affine *place)
{
    Affine all = affine_then(to_unit(params), *place);
    return bounds_transformed(box_of(params), &all);
}

const ShapeOps shape_height_field = {
    .keyword = "height_field", .params_size = sizeof(Params), .flags = SHAPE_HAS_HIERARCHY | SHAPE_NO_BOX_IN_CSG | SHAPE_SMOOTH,
    .parse = parse, .item = item, .compile = compile, .hits = hits, .inside = inside, .surface = surface, .extent = extent,
};
