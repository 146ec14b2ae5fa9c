/* chi_square.c - see chi_square.h. Bisection: it is asked a few hundred times per picture at most. */
#include "math/chi_square.h"

#include <math.h>

/* Regularised lower incomplete gamma function P(a, x); series and continued fraction as in Abramowitz and Stegun, 6.5. */
static double gamma_p(double a, double x)
{
    if (x <= 0)
        return 0;
    double scale = exp(a * log(x) - x - lgamma(a));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (double n = a + 1; term > sum * 1e-17; n++)
            sum += term *= x / n;
        return sum * scale;
    }
    double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
    for (int i = 1; i < 10000; i++) {
        double an = -i * (i - a);
        b += 2;
        d = 1 / (an * d + b);
        c = b + an / c;
        double change = c * d;
        h *= change;
        if (fabs(change - 1) < 1e-16)
            break;
    }
    return 1 - scale * h;
}

/* The share above x. `excess` is added to ln gamma(a). */
static double share_above(double a, double x, double excess)
{
    double below = gamma_p(a, x);
    return x < 1 || x < a ? 1 - below * exp(-excess) : (1 - below) * exp(-excess);
}

static double quantile(uint32_t degrees, double p, double excess)
{
    double a = degrees / 2.0, low = 0, high = 1;
    while (share_above(a, high / 2, excess) > p)
        high *= 2;
    for (int i = 0; i < 200 && low < high; i++) {
        double middle = (low + high) / 2;
        if (middle <= low || middle >= high)
            break;
        if (share_above(a, middle / 2, excess) > p)
            low = middle;
        else
            high = middle;
    }
    return (low + high) / 2;
}

double chi_square_quantile(uint32_t degrees, double p)
{
    return quantile(degrees, p, 0);
}

/* POV: its logarithm of gamma(a) is too large by this for half-integers below 13 (fitted to where it stops). */
double chi_square_quantile_pov(uint32_t degrees, double p)
{
    return quantile(degrees, p, degrees % 2 == 1 && degrees < 26 ? 0.0395696 : 0);
}
