/* polygon.c - polygon { n, points }: closed rings in a plane, filled where an odd number of them lies around. */
#include "base/array.h"
#include "sdl/parse.h"
#include "shape/shape.h"


typedef struct { Vec3 *point; uint32_t n; } Params;

typedef struct { double x0, y0, x1, y1; } Edge;

typedef struct Polygon {
    Vec3 origin, u, v, normal;                 /* unit vectors */
    const Edge *edge;                          /* by strips of equal height: those of strip i are first[i] to first[i + 1] */
    const uint32_t *first;
    uint32_t n_strips;
    double low, per_height;                    /* strip = (y - low) * per_height */
} Polygon;

static const double SAME = 1e-10;              /* relative to the size of the polygon */

static void parse(Parser *p, void *params)
{
    Params *polygon = params;
    int n = parse_int(p);
    if (n < 3)
        parse_fail(p, "Polygon needs at least three points.");
    uint32_t capacity = n < 1 << 16 ? (uint32_t)n : 1 << 16;
    polygon->point = arena_array(parse_arena(p), Vec3, capacity);
    for (uint32_t i = 0; i < (uint32_t)n; i++) {
        if (i == capacity)
            polygon->point = array_grow(parse_arena(p), polygon->point, i, &capacity, sizeof *polygon->point);
        polygon->point[i] = parse_next_vec3(p);
    }
    polygon->n = (uint32_t)n;
}

static bool same(Vec3 a, Vec3 b, double size)
{
    return max_abs(sub(a, b)) <= SAME * size;
}

/* The frame of the first edges that span a plane; false if none do, or a point is off it. */
static bool find_plane(const Vec3 *p, uint32_t n, double size, Polygon *out)
{
    uint32_t i = 1;
    while (i < n && length2(sub(p[i], p[0])) <= SAME * size * size)
        i++;
    if (i == n)
        return false;
    Vec3 u = sub(p[i], p[0]), w = vec3(0, 0, 0);
    for (i++; i < n; i++) {
        w = cross(u, sub(p[i], p[0]));
        if (length2(w) > SAME * size * size * size * size)
            break;
    }
    if (i >= n)
        return false;
    out->origin = p[0];
    out->u = normalized(u);
    out->normal = normalized(w);
    out->v = cross(out->normal, out->u);
    for (i = 0; i < n; i++)
        if (fabs(dot(out->normal, sub(p[i], p[0]))) > SAME * size)
            return false;
    return true;
}

static int strip_of(const Polygon *g, double y)
{
    double i = (y - g->low) * g->per_height;
    return i >= 0 ? i < g->n_strips ? (int)i : (int)g->n_strips - 1 : 0;
}

/* Every edge goes to all strips that it touches: about twice as many as there are edges, when they are short. */
static void sort_into_strips(ShapeBuild *b, Polygon *g, const Edge *edge, uint32_t n)
{
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < n; i++) {
        low = fmin(low, fmin(edge[i].y0, edge[i].y1));
        high = fmax(high, fmax(edge[i].y0, edge[i].y1));
    }
    g->n_strips = n < 16 ? 1 : n < 4096 ? n / 4 : 1024;
    g->low = low;
    g->per_height = high > low ? g->n_strips / (high - low) : 0;
    uint32_t *first = build_data(b, (g->n_strips + (size_t)2) * sizeof *first);
    for (uint32_t i = 0; i < n; i++)
        for (int s = strip_of(g, fmin(edge[i].y0, edge[i].y1)); s <= strip_of(g, fmax(edge[i].y0, edge[i].y1)); s++)
            first[s + 2]++;
    for (uint32_t s = 0; s < g->n_strips; s++)
        first[s + 2] += first[s + 1];
    Edge *sorted = build_data(b, first[g->n_strips + 1] * sizeof *sorted);
    for (uint32_t i = 0; i < n; i++)
        for (int s = strip_of(g, fmin(edge[i].y0, edge[i].y1)); s <= strip_of(g, fmax(edge[i].y0, edge[i].y1)); s++)
            sorted[first[s + 1]++] = edge[i];
    g->first = first;
    g->edge = sorted;
}

/* The edges of all rings, in the frame of the plane; returns how many. */
static uint32_t find_edges(const Polygon *g, const Vec3 *p, uint32_t n, double size, Edge *edge)
{
    uint32_t n_edges = 0, first = 0;
    for (uint32_t i = 0; i < n; i++) {
        bool closes = i > first && same(p[i], p[first], size), open = i + 1 == n && !closes;
        for (int k = 0; k < (open ? 2 : 1) && i > first; k++) {        /* a ring left open by the author gets its last edge */
            Vec3 a = sub(p[k ? i : i - 1], g->origin), z = sub(p[k || closes ? first : i], g->origin);
            edge[n_edges++] = (Edge){ dot(a, g->u), dot(a, g->v), dot(z, g->u), dot(z, g->v) };
        }
        if (closes)
            first = i + 1;
    }
    return n_edges;
}

static void compile(ShapeBuild *b, const void *params)
{
    const Params *polygon = params;
    Bounds box = bounds_of_points(polygon->point, polygon->n);
    double unit = shape_unit(b, fmax(max_abs(box.lo), max_abs(box.hi))), size = max_abs(sub(box.hi, box.lo)) / unit;
    Polygon *out = build_data(b, sizeof *out);
    Vec3 *p = build_data(b, polygon->n * sizeof *p);
    for (uint32_t i = 0; i < polygon->n; i++)
        p[i] = scaled(polygon->point[i], 1 / unit);
    if (!find_plane(p, polygon->n, size, out))
        return;
    Edge *edge = build_data(b, (polygon->n + (size_t)1) * sizeof *edge);
    sort_into_strips(b, out, edge, find_edges(out, p, polygon->n, size, edge));
    Affine place = build_place(b, unit);
    Bounds own = shape_padded((Bounds){ scaled(box.lo, 1 / unit), scaled(box.hi, 1 / unit) });
    build_prim(b, out, &place, bounds_grown(own, SAME * size));
}

static void finish(Parser *p, void *params)
{
    const Params *polygon = params;
    Bounds box = bounds_of_points(polygon->point, polygon->n);
    double size = max_abs(sub(box.hi, box.lo));
    uint32_t first = 0;
    for (uint32_t i = 0; i < polygon->n; i++)
        if (i > first && same(polygon->point[i], polygon->point[first], size))
            first = i + 1;
    if (first < polygon->n)
        parse_warn(p, "Polygon not closed. Closing it.");
}

static void hits(const void *shape, const Ray *ray, HitSink *sink)
{
    const Polygon *g = shape;
    double slope = dot(g->normal, ray->d);
    if (slope == 0)
        return;
    Vec3 v = sub(ray->o, g->origin);
    double t = -dot(g->normal, v) / slope;
    if (!(t > sink->t_min && t <= sink->limit))
        return;
    Vec3 at = add(v, scaled(ray->d, t));
    double x = dot(at, g->u), y = dot(at, g->v);
    bool in = false;
    int strip = strip_of(g, y);
    for (const Edge *e = g->edge + g->first[strip]; e < g->edge + g->first[strip + 1]; e++) {
        if ((e->y0 >= y) == (e->y1 >= y))
            continue;
        double side = (e->y1 - y) * (e->x0 - e->x1) - (e->x1 - x) * (e->y0 - e->y1);
        in ^= (side >= 0) == (e->y1 >= y);
    }
    if (in)
        hit_offer(sink, t, 0, 0, 0);
}

static void surface(const void *shape, const Hit *hit, Surface *out)
{
    (void)hit;
    const Polygon *g = shape;
    out->normal = g->normal;
    out->p = sub(out->p, scaled(g->normal, dot(g->normal, sub(out->p, g->origin))));
}

/* POV: an edge of the box shorter than 0.001 grows by that on both sides. */
static Bounds extent(const void *params, const Affine *place)
{
    const Params *polygon = params;
    Bounds box = bounds_empty();
    for (uint32_t i = 0; i < polygon->n; i++)
        box = bounds_include(box, affine_point(place, polygon->point[i]));
    for (int i = 0; i < 3; i++)
        if (vec3_at(box.hi, i) - vec3_at(box.lo, i) < 0.001) {
            vec3_set(&box.lo, i, vec3_at(box.lo, i) - 0.001);
            vec3_set(&box.hi, i, vec3_at(box.hi, i) + 0.001);
        }
    return box;
}

const ShapeOps shape_polygon = {
    .keyword = "polygon", .params_size = sizeof(Params), .parse = parse, .finish = finish, .compile = compile,
    .hits = hits, .surface = surface, .extent = extent,
};
