/* bounds.c - box arithmetic; see bounds.h. */
#include "math/bounds.h"

#include <float.h>

Bounds bounds_empty(void)
{
    return (Bounds){ { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
}

Bounds bounds_everything(void)
{
    return (Bounds){ { -INFINITY, -INFINITY, -INFINITY }, { INFINITY, INFINITY, INFINITY } };
}

/* b where it is less, else a: what is not a number in b is passed over. */
static inline Vec3 least(Vec3 a, Vec3 b)
{
    return vec3(b.x < a.x ? b.x : a.x, b.y < a.y ? b.y : a.y, b.z < a.z ? b.z : a.z);
}

static inline Vec3 greatest(Vec3 a, Vec3 b)
{
    return vec3(b.x > a.x ? b.x : a.x, b.y > a.y ? b.y : a.y, b.z > a.z ? b.z : a.z);
}

Bounds bounds_include(Bounds a, Vec3 p)
{
    return (Bounds){ least(a.lo, p), greatest(a.hi, p) };
}

Bounds bounds_of_points(const Vec3 *p, size_t n)
{
    Bounds b = bounds_empty();
    for (size_t i = 0; i < n; i++)
        b = (Bounds){ least(b.lo, p[i]), greatest(b.hi, p[i]) };
    return b;
}

Bounds bounds_union(Bounds a, Bounds b)
{
    return (Bounds){ least(a.lo, b.lo), greatest(a.hi, b.hi) };
}

Bounds bounds_intersection(Bounds a, Bounds b)
{
    return (Bounds){ greatest(a.lo, b.lo), least(a.hi, b.hi) };
}

Bounds bounds_grown(Bounds a, double by)
{
    return (Bounds){ sub(a.lo, vec3(by, by, by)), add(a.hi, vec3(by, by, by)) };
}

/* Interval arithmetic per axis (Arvo, Transforming Axis-Aligned Bounding Boxes, Graphics Gems, 1990); the pad covers
 * the rounding of the three products and sums. Unbounded sides meet zero entries as 0, not NaN. */
Bounds bounds_transformed(Bounds a, const Affine *place)
{
    if (place->identity || bounds_is_empty(a))
        return a;
    Bounds out;
#pragma GCC unroll 3
    for (int j = 0; j < 3; j++) {
        double lo = place->m[3][j], hi = lo, size = fabs(lo);
#pragma GCC unroll 3
        for (int i = 0; i < 3; i++) {
            double m = place->m[i][j];
            if (m == 0)
                continue;
            double p = m * vec3_at(a.lo, i), q = m * vec3_at(a.hi, i);
            lo += p < q ? p : q;
            hi += p < q ? q : p;
            size += fabs(p) < fabs(q) ? fabs(q) : fabs(p);
        }
        double pad = isfinite(size) ? size * 8 * DBL_EPSILON : 0;
        vec3_set(&out.lo, j, lo - pad);
        vec3_set(&out.hi, j, hi + pad);
    }
    return out;
}

bool bounds_is_empty(Bounds a)
{
    return !(a.lo.x <= a.hi.x && a.lo.y <= a.hi.y && a.lo.z <= a.hi.z);
}

bool bounds_is_finite(Bounds a)
{
    Vec3 sums = add(scaled(a.lo, 0), scaled(a.hi, 0));     /* 0 times what is not finite is no number */
    return sums.x + sums.y + sums.z == 0;
}

double bounds_area(Bounds a)
{
    if (bounds_is_empty(a))
        return 0;
    Vec3 d = sub(a.hi, a.lo);
    return 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
}
