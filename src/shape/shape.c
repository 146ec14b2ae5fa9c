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

double shape_longitude(double x, double z)
{
    double a = atan2(z, x) / (2 * PI);
    return a < 0 ? a + 1 : a;
}
