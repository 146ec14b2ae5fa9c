/* polytope.c - gems, bevels and prisms are intersections of planes: no plane has a box, but together they do.
 *
 * Every corner lies on three planes, so all triples are tried: n^3 / 6 for at most 32 planes. */
#include "compile/polytope.h"

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
