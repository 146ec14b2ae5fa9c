/* shape.c - see shape.h. */
#include "shape/shape.h"

double shape_algebraic_unit(const double *by_degree, int n)
{
    while (n > 0 && by_degree[n] == 0)
        n--;
    double most = -INFINITY;
    for (int k = 0; k < n; k++)
        if (by_degree[k] > 0)
            most = fmax(most, (double)(ilogb(by_degree[k]) - ilogb(by_degree[n])) / (n - k));
    return isfinite(most) ? ldexp(1, (int)floor(most)) : 1;
}

Bounds shape_hull(Bounds local, const Affine *frame, const Affine *place)
{
    Affine all = affine_then(*frame, *place);
    return bounds_transformed(local, &all);
}

bool shape_keeps_balls(const Affine *place, double *by)
{
    Vec3 x = affine_vector(place, vec3(1, 0, 0)), y = affine_vector(place, vec3(0, 1, 0)), z = affine_vector(place, vec3(0, 0, 1));
    double k2 = length2(x), even = 1e-12 * k2;
    *by = sqrt(k2);
    return fabs(length2(y) - k2) < even && fabs(length2(z) - k2) < even && fabs(dot(x, y)) < even && fabs(dot(y, z)) < even &&
           fabs(dot(z, x)) < even;
}

double shape_longitude(double x, double z)
{
    double a = atan2(z, x) / (2 * PI);
    return a < 0 ? a + 1 : a;
}
