/* bernstein.h - polynomials on [0, 1] as weighted means of their n + 1 Bernstein coefficients b[0] ... b[n].
 *
 * b[0] and b[n] are the values at the ends, exactly: pieces of a curve that share an end point agree on the sign there, so
 * no root is lost or found twice at a joint. That is why shapes made of pieces (curves, sweeps, blobs) use them. */
#ifndef MATH_BERNSTEIN_H
#define MATH_BERNSTEIN_H

enum { BERNSTEIN_MAX = 12 };

int bernstein_search(const double *b, int n, double *root);

/* Where the sign changes, ascending; zero counts as positive. An odd number of roots if and only if the ends differ. */
static inline int bernstein_roots(const double *b, int n, double *root)
{
    for (int i = 1; i <= n; i++)
        if ((b[i] < 0) != (b[0] < 0))
            return bernstein_search(b, n, root);
    return 0;
}

double bernstein_value(const double *b, int n, double u);
double bernstein_slope(const double *b, int n, double u);      /* derivative at u */

/* out, of degree n + m, = a (degree n) times b (degree m). */
void bernstein_product(const double *a, int n, const double *b, int m, double *out);

#endif
