/* roots.c - real roots: between turning points up to degree four, by Descartes' rule in the Bernstein basis above; see roots.h.
 *
 * Between two turning points there is at most one root, and it shows in the signs of the values there. The turning points
 * are the roots of the derivative, down to a quadratic.
 *
 * Higher degrees: on an interval mapped to [0, 1] the polynomial is written as a weighted mean of n + 1 coefficients. The number of their
 * sign changes is the number of roots, or more by an even number: none means none, one means one, and otherwise de
 * Casteljau's halving makes two smaller problems (Lane and Riesenfeld, Bounds on a Polynomial, 1981). All steps are
 * means, so rounding stays at the size of the coefficients: a Sturm chain, which divides remainders, loses everything
 * at these degrees. A single root is then closed in by Newton's steps kept inside a shrinking bracket.
 *
 * Two roots closer than about the square root of the rounding error cannot be told from a touch: they count as one. */
#include "math/roots.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "math/vec.h"

enum { MAX = ROOTS_MAX_DEGREE, DEPTH = 56, BUDGET = 4096 };

typedef struct Search {
    double a[MAX + 1];                         /* on [0, 1], power basis */
    int n;
    double noise;                              /* values below are rounding */
    double lo, width;                          /* x = lo + width u */
    double *root, last;                        /* last: the newest root, as u */
    int found, budget;
} Search;

static double value(const double *a, int n, double u)
{
    double f = a[n];
    for (int k = n - 1; k >= 0; k--)
        f = f * u + a[k];
    return f;
}

/* Roots between which there is nothing but rounding are one. */
static void report(Search *s, double u)
{
    if (s->found == s->n || (s->found > 0 && fabs(value(s->a, s->n, 0.5 * (u + s->last))) <= s->noise))
        return;
    s->root[s->found++] = s->lo + s->width * u;
    s->last = u;
}

static int sign_changes(const double *b, int n)
{
    int changes = 0;
    bool known = false, negative = false;
    for (int i = 0; i <= n; i++) {
        if (b[i] == 0)
            continue;
        bool now = b[i] < 0;
        changes += known && now != negative;
        known = true;
        negative = now;
    }
    return changes;
}

typedef struct Tolerance { double absolute, relative; } Tolerance;     /* of a root; the larger of the two */

/* The root between u0 and u1, sought from a guess, where falling says on which side of it the values are positive. */
static double closed_in(const double *a, int n, double u0, double u1, bool falling, double guess, Tolerance wanted)
{
    double u = guess > u0 && guess < u1 ? guess : 0.5 * (u0 + u1), last = u1 - u0;
    bool steady = false;                       /* was the last step one of Newton's? */
    for (int i = 0; i < 120; i++) {
        double f = a[n], slope = 0;
        for (int k = n - 1; k >= 0; k--) {
            slope = slope * u + f;
            f = f * u + a[k];
        }
        if (f == 0)
            return u;
        if ((f > 0) == falling)
            u0 = u;
        else
            u1 = u;
        double next = u - f / slope, before = last, limit = wanted.absolute + wanted.relative * fabs(u);
        bool newton = next > u0 && next < u1 && fabs(next - u) <= 0.5 * last;
        if (!newton)
            next = 0.5 * (u0 + u1);            /* Newton leaves the bracket or dawdles: halve it */
        last = fabs(next - u);
        /* Newton's steps shrink as their squares: the coming one would be about last^3 / before^2. */
        if (last <= limit || (newton && steady && last * last * last <= before * before * limit))
            return next;
        steady = newton;
        u = next;
    }
    return u;
}

/* ---- degrees up to four: between the turning points there is at most one root ---- */

/* Is the value at x no more than the rounding of its terms? */
static bool is_zero(const double *c, int n, double x, double *f)
{
    double size = fabs(c[n]), ax = fabs(x);
    *f = c[n];
    for (int k = n - 1; k >= 0; k--) {
        *f = *f * x + c[k];
        size = size * ax + fabs(c[k]);
    }
    return fabs(*f) <= 4 * DBL_EPSILON * size;
}

typedef struct Small {                         /* a search for degrees up to four */
    double lo, hi, from;
    Tolerance wanted;
    RootVisit *visit;
    void *user;
} Small;

static bool collect(void *user, double x)
{
    double **next = user;
    *(*next)++ = x;
    return true;
}

static bool small(const double *c, int n, const Small *s);

static bool small_quadratic(const double *c, int n, const Small *s)
{
    double r[2];
    int found = n == 2 ? roots_quadratic(c[2], 0.5 * c[1], c[0], r) : n == 1 ? roots_quadratic(0, 0.5 * c[1], c[0], r) : 0;
    for (int i = 0; i < found; i++)
        if (r[i] >= s->lo && r[i] <= s->hi && !s->visit(s->user, r[i]))
            return false;
    return true;
}

/* 0 is a root: the others are those of c(x) / x. */
static bool small_with_zero(const double *c, int n, const Small *s)
{
    double root[5], *next = root;
    Small all = *s;
    all.visit = collect;
    all.user = &next;
    all.from = s->lo;
    small(c + 1, n - 1, &all);
    bool done = !(s->lo <= 0 && s->hi >= 0);
    for (double *r = root; r < next; r++) {
        if (!done && *r > 0 && !s->visit(s->user, 0))
            return false;
        done |= *r >= 0;
        if (!s->visit(s->user, *r))
            return false;
    }
    return done || s->visit(s->user, 0);
}

typedef struct Climb {                         /* from turning point to turning point */
    const double *c;
    int n;
    const Small *s;
    double x, f;                               /* where it is */
    bool known, zero, turned, ended;           /* is f known, and 0; is x a turning point; was the last visit the last */
} Climb;

/* Where a parabola with its top at the turning point meets zero; between two turning points, a straight line. */
static double guess_between(const Climb *k, double x, double f, bool turns)
{
    double w = x - k->x;
    if (k->turned == turns)
        return k->x + w * (k->f / (k->f - f));
    return turns ? x - w * sqrt(f / (f - k->f)) : k->x + w * sqrt(k->f / (k->f - f));
}

/* On to x, reporting the root on the way, if there is one. False: no more are wanted. */
static bool climb_to(Climb *k, double x, bool turns)
{
    if (x < k->s->from) {                      /* what lies before is not wanted */
        k->x = x;
        k->known = false;
        k->turned = turns;
        return true;
    }
    if (!k->known) {
        k->zero = is_zero(k->c, k->n, k->x, &k->f);
        k->known = true;
        if (k->zero && !k->s->visit(k->s->user, k->x))
            return !(k->ended = true);
    }
    double f;
    bool zero = is_zero(k->c, k->n, x, &f);
    if (zero && x > k->x)
        k->ended = !k->s->visit(k->s->user, x);
    else if (!zero && !k->zero && (k->f > 0) != (f > 0))
        k->ended = !k->s->visit(k->s->user, closed_in(k->c, k->n, k->x, x, k->f > 0, guess_between(k, x, f, turns),
                                                      k->s->wanted));
    k->x = x;
    k->f = f;
    k->zero = zero;
    k->turned = turns;
    return !k->ended;
}

static bool turn(void *user, double x)
{
    return climb_to(user, x, true);
}

/* Turning points are wanted loosely: a mistake of theirs enters the values there as its square. */
static const double LOOSE = 4e6;

static bool small(const double *c, int n, const Small *s)
{
    while (n > 0 && c[n] == 0)
        n--;
    if (n > 0 && c[0] == 0)
        return small_with_zero(c, n, s);
    if (n <= 2)
        return small_quadratic(c, n, s);
    double slope[4];
    for (int k = 1; k <= n; k++)
        slope[k - 1] = k * c[k];
    Climb climb = { .c = c, .n = n, .s = s, .x = s->lo };
    Small loose = { s->lo, s->hi, s->lo, { LOOSE * s->wanted.absolute, LOOSE * s->wanted.relative }, turn, &climb };
    small(slope, n - 1, &loose);
    if (!climb.ended)
        climb_to(&climb, s->hi, false);
    return !climb.ended;
}

static Tolerance precise(double lo, double hi)
{
    return (Tolerance){ DBL_EPSILON * greater(fabs(lo), fabs(hi)), DBL_EPSILON };
}

/* ---- higher degrees ---- */

static void halve(const double *b, int n, double *left, double *right)
{
    memcpy(right, b, (size_t)(n + 1) * sizeof *b);
    for (int j = 0; j <= n; j++) {
        left[j] = right[0];
        for (int i = 0; i < n - j; i++)
            right[i] = 0.5 * (right[i] + right[i + 1]);
    }
}

static bool is_noise(const Search *s, const double *b)
{
    for (int i = 0; i <= s->n; i++)
        if (fabs(b[i]) > s->noise)
            return false;
    return true;
}

/* Roots in [u0, u0 + size), and at 1 if the interval ends there. */
static void isolate(Search *s, const double *b, double u0, double size, int depth)
{
    int changes = sign_changes(b, s->n);
    if (b[0] == 0)
        report(s, u0);
    if (changes > 0 && is_noise(s, b))
        report(s, u0 + 0.5 * size);
    else if (changes == 1) {
        int first = 0;
        while (b[first] == 0)
            first++;
        report(s, closed_in(s->a, s->n, u0, u0 + size, b[first] > 0, u0 + 0.5 * size,
                            (Tolerance){ 0.5 * DBL_EPSILON, DBL_EPSILON }));
    } else if (changes > 1) {
        if (depth == DEPTH || --s->budget < 0)
            report(s, u0 + 0.5 * size);
        else {
            double left[MAX + 1], right[MAX + 1];
            halve(b, s->n, left, right);
            isolate(s, left, u0, 0.5 * size, depth + 1);
            isolate(s, right, u0 + 0.5 * size, 0.5 * size, depth + 1);
        }
    }
    if (b[s->n] == 0 && u0 + size == 1)
        report(s, 1);
}

/* s->a holds the polynomial on [0, 1]. */
static void search(Search *s)
{
    double b[MAX + 1], choose = 1, largest = 0, total = 0;
    int n = s->n;
    for (int k = 0; k <= n; k++) {             /* divided by n over k, then summed as Pascal's triangle */
        b[k] = s->a[k] / choose;
        total += fabs(s->a[k]);
        choose = choose * (n - k) / (k + 1);
    }
    for (int j = 1; j <= n; j++)
        for (int i = n; i >= j; i--)
            b[i] += b[i - 1];
    for (int i = 0; i <= n; i++)
        largest = fmax(largest, fabs(b[i]));
    s->noise = 4 * DBL_EPSILON * total;
    s->budget = BUDGET;
    if (largest <= s->noise)
        return;                                /* vanishes throughout, or cannot be told from that */
    isolate(s, b, 0, 1, 0);
}

int roots_between(const double *c, int n, double lo, double hi, double *root)
{
    while (n > 0 && c[n] == 0)
        n--;
    if (n < 1 || n > MAX || !(lo <= hi))
        return 0;
    if (n <= 4) {
        double *next = root;
        small(c, n, &(Small){ lo, hi, lo, precise(lo, hi), collect, &next });
        return (int)(next - root);
    }
    Search s = { .n = n, .lo = lo, .width = hi - lo, .root = root };
    memcpy(s.a, c, (size_t)(n + 1) * sizeof *c);
    if (lo != 0)                               /* shifted to lo by repeated division */
        for (int j = 0; j < n; j++)
            for (int k = n - 1; k >= j; k--)
                s.a[k] += lo * s.a[k + 1];
    double power = s.width;
    for (int k = 1; k <= n; k++) {
        s.a[k] *= power;
        power *= s.width;
    }
    search(&s);
    return s.found;
}

/* Appends the roots y in (0, 1] of the polynomial with coefficients first[k * step], as x = sign * y or sign / y. */
static int append(const double *first, int step, int n, bool inverse, double sign, double *found, int total)
{
    Search s = { .n = n, .width = 1 };
    double root[MAX];
    s.root = root;
    for (int k = 0; k <= n; k++)
        s.a[k] = first[k * step];
    search(&s);
    for (int i = 0; i < s.found; i++)
        if (root[i] > 0)
            found[total++] = sign * (inverse ? 1 / root[i] : root[i]);
    return total;
}

void roots_visit(const double *c, int n, double lo, double hi, double from, RootVisit *visit, void *user)
{
    if (n <= 4) {
        if (lo <= hi)
            small(c, n, &(Small){ lo, hi, from, precise(lo, hi), visit, user });
        return;
    }
    double root[MAX];
    int found = roots_between(c, n, lo, hi, root);
    for (int i = 0; i < found; i++)
        if (root[i] >= from && !visit(user, root[i]))
            return;
}

static bool all_finite(const double *c, int n)
{
    double sum = 0;
    for (int k = 0; k <= n; k++)
        sum += c[k] * 0;                       /* 0, or NaN for good */
    return sum == 0;
}

/* floor(log2) of half a bound of the roots (Fujiwara); needs c[n] != 0. */
static int reach_exponent(const double *c, int n)
{
    double most = -INFINITY;
    int top = ilogb(c[n]);
    for (int k = 0; k < n; k++)
        if (c[k] != 0)
            most = greater(most, (double)(ilogb(c[k]) - top) / (n - k));
    return isfinite(most) ? (int)floor(most) : 0;
}

/* The line in four pieces: [-B, 0] and [0, B] as they are, and beyond by x -> 1/x, where B is a power of two at which the
 * coefficients balance. All four use the same numbers, so nothing is shifted and nothing is lost. */
int roots_all(const double *c, int n, double *root)
{
    while (n > 0 && c[n] == 0)
        n--;
    if (n < 1 || n > MAX || !all_finite(c, n))
        return 0;
    if (n <= 4) {
        double *next = root;
        roots_visit_all(c, n, -INFINITY, collect, &next);
        return (int)(next - root);
    }
    int e = reach_exponent(c, n), top = INT_MIN, total = 0;
    double a[MAX + 1], mirrored[MAX + 1], found[4 * MAX + 1];
    for (int k = 0; k <= n; k++)
        if (c[k] != 0 && ilogb(c[k]) + e * k > top)
            top = ilogb(c[k]) + e * k;
    for (int k = 0; k <= n; k++) {
        a[k] = ldexp(c[k], e * k - top);
        mirrored[k] = k & 1 ? -a[k] : a[k];
    }
    if (a[0] == 0)
        found[total++] = 0;
    total = append(mirrored, 1, n, false, -1, found, total);
    total = append(mirrored + n, -1, n, true, -1, found, total);
    total = append(a, 1, n, false, 1, found, total);
    total = append(a + n, -1, n, true, 1, found, total);
    int kept = 0;
    for (int i = 0; i < total; i++) {          /* sorted by insertion; -1 and 1 were in two pieces */
        double x = ldexp(found[i], e);
        int at = kept;
        while (at > 0 && root[at - 1] > x)
            at--;
        if ((at > 0 && root[at - 1] == x) || kept == n)
            continue;
        memmove(root + at + 1, root + at, (size_t)(kept - at) * sizeof *root);
        root[at] = x;
        kept++;
    }
    return kept;
}

void roots_visit_all(const double *c, int n, double from, RootVisit *visit, void *user)
{
    while (n > 0 && c[n] == 0)
        n--;
    if (n >= 1 && n <= 4) {
        if (!all_finite(c, n))
            return;
        int e = reach_exponent(c, n);
        double reach = ldexp(1, e < 1000 ? e + 3 : 1003);
        small(c, n, &(Small){ -reach, reach, from, { 0, DBL_EPSILON }, visit, user });
        return;
    }
    double root[MAX];
    int found = roots_all(c, n, root);
    for (int i = 0; i < found; i++)
        if (root[i] >= from && !visit(user, root[i]))
            return;
}
