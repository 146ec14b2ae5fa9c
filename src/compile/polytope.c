/* polytope.c - gems, bevels and prisms are intersections of planes: no plane has a box, but together they do.
 *
 * Every corner lies on three planes, so all triples are tried: n^3 / 6 for at most 32 planes. */
#include "compile/polytope.h"

#include <string.h>

/* A direction in which all half spaces go on, or nearly so, makes it endless. Nearly must mean much more than what makes three
 * planes count as having no common point, or a sharp corner would be overlooked. */
static const double ENDLESS = 1e-6, PARALLEL = 1e-12;

static bool goes_on(const HalfSpace *h, uint32_t n, Vec3 d)
{
    for (uint32_t k = 0; k < n; k++)
        if (dot(h[k].normal, d) > ENDLESS)
            return false;
    return true;
}

static bool is_endless(const HalfSpace *h, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < i; j++) {
            Vec3 edge = cross(h[i].normal, h[j].normal);
            if (length(edge) < PARALLEL)
                continue;
            edge = normalized(edge);
            if (goes_on(h, n, edge) || goes_on(h, n, negated(edge)))
                return true;
        }
    return false;
}

static bool corner(const HalfSpace *a, const HalfSpace *b, const HalfSpace *c, Vec3 *out)
{
    Vec3 bc = cross(b->normal, c->normal), ca = cross(c->normal, a->normal), ab = cross(a->normal, b->normal);
    double det = dot(a->normal, bc);
    if (fabs(det) < PARALLEL)
        return false;
    *out = scaled(add(add(scaled(bc, a->distance), scaled(ca, b->distance)), scaled(ab, c->distance)), 1 / det);
    return true;
}

Bounds polytope_box(const HalfSpace *h, uint32_t n)
{
    Bounds box = bounds_empty();
    double size = 0;
    if (n < 4 || n > POLYTOPE_MAX || is_endless(h, n))
        return bounds_everything();
    for (uint32_t i = 0; i < n; i++)
        size = fmax(size, fabs(h[i].distance));
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < i; j++)
            for (uint32_t k = 0; k < j; k++) {
                Vec3 p;
                if (!corner(&h[i], &h[j], &h[k], &p))
                    continue;
                bool in = true;
                for (uint32_t m = 0; m < n && in; m++)
                    in = dot(h[m].normal, p) <= h[m].distance + 1e-8 * fmax(size, max_abs(p));
                if (in)
                    box = bounds_include(box, p);
            }
    if (bounds_is_empty(box))
        return bounds_everything();
    return bounds_grown(box, 1e-7 * fmax(max_abs(box.lo), max_abs(box.hi)));
}

/* ---- faces ---- */

/* How far outside a half space a point may lie that counts as inside, relative to the lengths at hand: many times the rounding of
 * hits and the tolerances of inside tests. */
static const double LOOSE = 0x1p-28;

enum { CORNERS = 4 + 6 + POLYTOPE_MAX };       /* four, and one for each cut */

typedef struct Polygon {
    uint32_t n;
    Vec3 corner[2 * CORNERS];                  /* a cut adds one, but for roundings, and never doubles them */
} Polygon;

/* What a half space leaves of it (Sutherland and Hodgman, Reentrant polygon clipping, 1974); or more, which does no harm. */
static void polygon_cut(Polygon *p, HalfSpace h)
{
    Vec3 from[CORNERS];
    uint32_t n = p->n;
    if (n > CORNERS)
        return;
    memcpy(from, p->corner, n * sizeof *from);
    p->n = 0;
    for (uint32_t i = 0; i < n; i++) {
        Vec3 a = from[i], b = from[(i + 1) % n];
        double out_a = dot(h.normal, a) - h.distance, out_b = dot(h.normal, b) - h.distance;
        if (out_a <= 0)
            p->corner[p->n++] = a;
        if ((out_a <= 0) != (out_b <= 0))
            p->corner[p->n++] = lerp(a, b, out_a / (out_a - out_b));
    }
}

static HalfSpace side_of(Bounds box, int side)
{
    HalfSpace h = { vec3(0, 0, 0), side < 3 ? -vec3_at(box.lo, side) : vec3_at(box.hi, side - 3) };
    vec3_set(&h.normal, side % 3, side < 3 ? -1 : 1);
    return h;
}

/* The part of a plane that lies in the box and in all n half spaces. */
static Bounds face(HalfSpace plane, Bounds box, const HalfSpace *h, uint32_t n)
{
    Vec3 middle = lerp(box.lo, box.hi, 0.5);
    middle = add(middle, scaled(plane.normal, plane.distance - dot(plane.normal, middle)));
    double size = 2 * length(sub(box.hi, box.lo));
    Vec3 aside = cross(plane.normal, fabs(plane.normal.x) < 0.5 ? vec3(size, 0, 0) : vec3(0, size, 0));
    Vec3 up = cross(plane.normal, aside);
    Polygon p = { 4, { add(middle, aside), add(middle, up), sub(middle, aside), sub(middle, up) } };
    for (int side = 0; side < 6; side++)
        polygon_cut(&p, side_of(box, side));
    for (uint32_t i = 0; i < n; i++)
        polygon_cut(&p, h[i]);
    return bounds_of_points(p.corner, p.n);
}

static double size_of(Bounds box, const HalfSpace *h, uint32_t n)
{
    double size = fmax(max_abs(box.lo), max_abs(box.hi));
    for (uint32_t i = 0; i < n; i++)
        size = fmax(size, fabs(h[i].distance));
    return size;
}

static void loosened(const HalfSpace *h, uint32_t n, double by, HalfSpace *out)
{
    for (uint32_t i = 0; i < n; i++)
        out[i] = (HalfSpace){ h[i].normal, h[i].distance + by };
}

Bounds polytope_face(HalfSpace plane, Bounds box, const HalfSpace *h, uint32_t n)
{
    double margin = LOOSE * size_of(box, h, n);
    HalfSpace loose[POLYTOPE_MAX];
    loosened(h, n, margin, loose);
    Bounds b = face(plane, bounds_grown(box, margin), loose, n);
    return bounds_is_empty(b) ? b : bounds_grown(b, margin);
}

/* Faces stand a margin outside, and are cut another margin further outside, where rounding cannot cut them by themselves. */
Bounds polytope_within(Bounds box, const HalfSpace *h, uint32_t n)
{
    double margin = LOOSE * size_of(box, h, n);
    HalfSpace outer[POLYTOPE_MAX], further[POLYTOPE_MAX];
    loosened(h, n, margin, outer);
    loosened(h, n, 2 * margin, further);
    Bounds all = bounds_empty(), outer_box = bounds_grown(box, margin), further_box = bounds_grown(box, 2 * margin);
    for (int side = 0; side < 6; side++)
        all = bounds_union(all, face(side_of(outer_box, side), further_box, further, n));
    for (uint32_t i = 0; i < n; i++)
        all = bounds_union(all, face(outer[i], further_box, further, n));
    return all;
}
