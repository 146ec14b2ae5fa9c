/* roots.h - real roots of polynomials with real coefficients: c[k] belongs to x^k, lowest power first. */
#ifndef MATH_ROOTS_H
#define MATH_ROOTS_H

#include <math.h>
#include <stdbool.h>

enum { ROOTS_MAX_DEGREE = 35 };

/* a x^2 + 2 h x + c = 0, ascending, without cancellation; a double root counts once. Linear if a is 0. */
static inline int roots_quadratic(double a, double h, double c, double root[2])
{
    if (a == 0) {
        if (h == 0)
            return 0;
        root[0] = -c / (2 * h);
        return 1;
    }
    double d = h * h - a * c;
    if (d < 0)
        return 0;
    if (d == 0) {
        root[0] = -h / a;
        return 1;
    }
    double q = -(h + copysign(sqrt(d), h)), r0 = q / a, r1 = c / q;
    root[0] = r0 < r1 ? r0 : r1;               /* fmin would be a call */
    root[1] = r0 < r1 ? r1 : r0;
    return 2;
}

/* Roots in [lo, hi], ascending, at most n of them; a root of even order (a touch) once, an odd one once. The whole of
 * [lo, hi] is looked at, so pass the interval in which the shape can be, and put the origin of x near it.
 * A polynomial that vanishes throughout has none. */
int roots_between(const double *c, int n, double lo, double hi, double *root);

/* The same, one by one in ascending order, leaving out those below `from` (perhaps not all of them). A visit that returns
 * false ends it. A root's value does not depend on `from`. */
typedef bool RootVisit(void *user, double x);
void roots_visit(const double *c, int n, double lo, double hi, double from, RootVisit *visit, void *user);

/* Roots on the whole line, ascending. */
int roots_all(const double *c, int n, double *root);
void roots_visit_all(const double *c, int n, double from, RootVisit *visit, void *user);

#endif
