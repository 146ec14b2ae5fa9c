/* bernstein.c - roots by the rule of signs and de Casteljau's halving; see bernstein.h.
 *
 * After Lane and Riesenfeld, Bounds on a Polynomial (1981). Every step is a mean of two numbers, so errors stay at the
 * size of the coefficients' rounding; a single root is closed in by Newton's steps kept inside a bracket. */
#include "math/bernstein.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "math/vec.h"

enum { DEPTH = 44 };

static const double choose[BERNSTEIN_MAX + 1][BERNSTEIN_MAX + 1] = {
    { 1 },
    { 1, 1 },
    { 1, 2, 1 },
    { 1, 3, 3, 1 },
    { 1, 4, 6, 4, 1 },
    { 1, 5, 10, 10, 5, 1 },
    { 1, 6, 15, 20, 15, 6, 1 },
    { 1, 7, 21, 35, 35, 21, 7, 1 },
    { 1, 8, 28, 56, 70, 56, 28, 8, 1 },
    { 1, 9, 36, 84, 126, 126, 84, 36, 9, 1 },
    { 1, 10, 45, 120, 210, 252, 210, 120, 45, 10, 1 },
    { 1, 11, 55, 165, 330, 462, 462, 330, 165, 55, 11, 1 },
    { 1, 12, 66, 220, 495, 792, 924, 792, 495, 220, 66, 12, 1 },
};

double bernstein_value(const double *b, int n, double u)
{
    double left = 1 - u, power = 1, sum = b[0];
    for (int k = 1; k <= n; k++) {
        power *= u;
        sum = sum * left + choose[n][k] * power * b[k];
    }
    return sum;
}

double bernstein_slope(const double *b, int n, double u)
{
    double d[BERNSTEIN_MAX + 1] = { 0 };
    if (n == 0)
        return 0;
    for (int k = 0; k < n; k++)
        d[k] = n * (b[k + 1] - b[k]);
    return bernstein_value(d, n - 1, u);
}

static inline __attribute__((always_inline)) void product(const double *a, int n, const double *b, int m, double *out)
{
#pragma GCC unroll 8
    for (int k = 0; k <= n + m; k++) {
        double sum = 0;
#pragma GCC unroll 4
        for (int i = k > m ? k - m : 0; i <= n && i <= k; i++)
            sum += choose[n][i] * choose[m][k - i] * a[i] * b[k - i];
        out[k] = sum / choose[n + m][k];
    }
}

/* Cubics are the rule: a quarter of the work when the weights are known beforehand. */
void bernstein_product(const double *a, int n, const double *b, int m, double *out)
{
    if (n == 3 && m == 3)
        product(a, 3, b, 3, out);
    else
        product(a, n, b, m, out);
}

typedef struct Search {
    int n;
    double noise;                              /* values below are rounding */
    double *root;
    int found;
} Search;


static double largest_of(const double *b, int n)
{
    double largest = 0;
    for (int i = 0; i <= n; i++)
        largest = greater(largest, fabs(b[i]));
    return largest;
}

static int sign_changes(const double *b, int n)
{
    int changes = 0;
    for (int i = 0; i < n; i++)
        changes += (b[i] < 0) != (b[i + 1] < 0);
    return changes;
}

/* The one root in (0, 1): Newton on the power form of this piece, kept inside a shrinking bracket. */
static inline __attribute__((always_inline)) double closed_in_by(const double *b, int n)
{
    double a[BERNSTEIN_MAX + 1], lo = 0, hi = 1;
    memcpy(a, b, (size_t)(n + 1) * sizeof *b);
#pragma GCC unroll 6
    for (int j = 1; j <= n; j++)               /* differences, then times n over k */
#pragma GCC unroll 6
        for (int i = n; i >= j; i--)
            a[i] -= a[i - 1];
#pragma GCC unroll 6
    for (int k = 1; k <= n; k++)
        a[k] *= choose[n][k];
    bool rising = b[0] < 0;
    int cross = 0;
    while ((b[cross + 1] < 0) == rising)
        cross++;
    /* Where the control polygon crosses zero; not at an end: a zero there is no change of sign, and the power form rounds it to
     * anything. */
    double u = (cross + b[cross] / (b[cross] - b[cross + 1])) / n, last = 1;
    u = u < 0.01 ? 0.01 : u > 0.99 ? 0.99 : u;
    for (int i = 0; i < 80; i++) {
        double f = a[n], slope = 0;
#pragma GCC unroll 6
        for (int k = n - 1; k >= 0; k--) {
            slope = slope * u + f;
            f = f * u + a[k];
        }
        if (f == 0)
            return u;
        if ((f < 0) == rising)
            lo = u;
        else
            hi = u;
        double next = u - f / slope;
        if (!(next >= lo && next <= hi) || fabs(next - u) > 0.5 * last)
            next = 0.5 * (lo + hi);            /* Newton leaves the bracket or dawdles: halve it */
        else if (fabs(next - u) < 1e-10)
            return next;                       /* the next step would be the square of this one */
        last = fabs(next - u);
        if (last <= DBL_EPSILON * fabs(u))
            return next;
        u = next;
    }
    return u;
}

/* Quartics of blobs and sextics of lathes are the rule: their loops are unrolled. */
static double closed_in(const double *b, int n)
{
    return n == 4 ? closed_in_by(b, 4) : n == 6 ? closed_in_by(b, 6) : closed_in_by(b, n);
}

static void search(Search *s, const double *b, double u0, double size, int depth)
{
    int n = s->n, changes = sign_changes(b, n);
    if (changes == 0)
        return;
    if (changes == 1) {
        s->root[s->found++] = u0 + size * closed_in(b, n);
        return;
    }
    if (depth == DEPTH || largest_of(b, n) <= s->noise) {
        if ((b[0] < 0) != (b[n] < 0))
            s->root[s->found++] = u0 + 0.5 * size;
        return;
    }
    double left[BERNSTEIN_MAX + 1], right[BERNSTEIN_MAX + 1];
    memcpy(right, b, (size_t)(n + 1) * sizeof *b);
    for (int j = 0; j <= n; j++) {
        left[j] = right[0];
        for (int i = 0; i < n - j; i++)
            right[i] = 0.5 * (right[i] + right[i + 1]);
    }
    search(s, left, u0, 0.5 * size, depth + 1);
    search(s, right, u0 + 0.5 * size, 0.5 * size, depth + 1);
}

/* a u^2 + 2 h u + c written from the means, for the commonest degree; false where rounding decides. */
static bool quadratic(const double *b, double *root, int *found)
{
    int changes = sign_changes(b, 2);
    *found = 0;
    if (changes == 0)
        return true;
    double h = b[1] - b[0], a = b[2] - b[1] - h, c = b[0], d = b[1] * b[1] - b[0] * b[2];
    double noise = 8 * DBL_EPSILON * (b[1] * b[1] + fabs(b[0] * b[2]));
    if (changes == 1) {
        double q = -(h + copysign(sqrt(fmax(d, 0)), h)), r0 = q != 0 ? c / q : -1, r1 = a != 0 ? q / a : -1;
        double slack = 1e-14, r = r0 >= -slack && r0 <= 1 + slack ? r0 : r1;
        if (!(r >= -slack && r <= 1 + slack))
            return false;
        if (r1 >= -slack && r1 <= 1 + slack && r != r1)
            return false;                      /* both near an end: let the halving tell them apart */
        root[(*found)++] = fmin(fmax(r, 0), 1);
        return true;
    }
    if (d < -noise)
        return true;
    if (d <= noise || a == 0)
        return false;
    double q = -(h + copysign(sqrt(d), h)), r0 = c / q, r1 = q / a;
    if (!(r0 >= 0 && r0 <= 1 && r1 >= 0 && r1 <= 1))
        return false;
    root[0] = fmin(r0, r1);
    root[1] = fmax(r0, r1);
    *found = 2;
    return true;
}

int bernstein_search(const double *b, int n, double *root)
{
    if (n == 1) {
        if ((b[0] < 0) == (b[1] < 0))
            return 0;
        root[0] = b[0] / (b[0] - b[1]);
        return 1;
    }
    int found;
    if (n == 2 && quadratic(b, root, &found))
        return found;
    if (sign_changes(b, n) == 1) {
        root[0] = closed_in(b, n);
        return 1;
    }
    Search s = { .n = n, .noise = 4 * DBL_EPSILON * largest_of(b, n), .root = root };
    search(&s, b, 0, 1, 0);
    return s.found;
}
