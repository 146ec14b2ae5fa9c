/* shape.c - see shape.h. */
#include "shape/shape.h"

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
