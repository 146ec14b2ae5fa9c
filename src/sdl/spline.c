/* spline.c - curves through given values, asked at parse time and from functions (01-language, section 9). */
#include <math.h>
#include <string.h>

#include "sdl/parser.h"

bool spline_kind(int keyword, SplineKind *kind)
{
    switch (keyword) {
    case KW_LINEAR_SPLINE: *kind = SPLINE_LINEAR; return true;
    case KW_QUADRATIC_SPLINE: *kind = SPLINE_QUADRATIC; return true;
    case KW_CUBIC_SPLINE: *kind = SPLINE_CUBIC; return true;
    case KW_NATURAL_SPLINE: *kind = SPLINE_NATURAL; return true;
    default: return false;
    }
}

/* The second derivatives of the natural cubic spline: a tridiagonal system (Press et al., Numerical Recipes, 3.3). */
void spline_prepare(Spline *s, SplineEntry *e)
{
    uint32_t n = s->n;
    for (int k = 0; k < 5 && n > 0; k++) {
        e[0].bend[k] = e[n - 1].bend[k] = 0;
        e[0].work = 0;
        for (uint32_t i = 1; i + 1 < n; i++) {
            double left = e[i].t - e[i - 1].t, right = e[i + 1].t - e[i].t, share = left / (left + right);
            double pivot = share * e[i - 1].work + 2;
            double chords = (e[i + 1].v[k] - e[i].v[k]) / right - (e[i].v[k] - e[i - 1].v[k]) / left;
            e[i].work = (share - 1) / pivot;
            e[i].bend[k] = (6 * chords / (left + right) - share * e[i - 1].bend[k]) / pivot;
        }
        for (uint32_t i = n - 1; i-- > 1;)
            e[i].bend[k] += e[i].work * e[i + 1].bend[k];
    }
    s->entry = e;
}

static double chord(const SplineEntry *a, const SplineEntry *b, int k)
{
    return (b->v[k] - a->v[k]) / (b->t - a->t);
}

static double linear(const SplineEntry *a, const SplineEntry *b, double t, int k)
{
    return a->v[k] + (b->v[k] - a->v[k]) * (t - a->t) / (b->t - a->t);
}

static double quadratic(const SplineEntry *e, double t, int k)
{
    double first = chord(&e[0], &e[1], k), second = (chord(&e[1], &e[2], k) - first) / (e[2].t - e[0].t);
    return e[0].v[k] + (t - e[0].t) * (first + (t - e[1].t) * second);
}

static double natural(const SplineEntry *a, const SplineEntry *b, double t, int k)
{
    double h = b->t - a->t, p = (b->t - t) / h, q = (t - a->t) / h;
    return p * a->v[k] + q * b->v[k] + ((p * p * p - p) * a->bend[k] + (q * q * q - q) * b->bend[k]) * h * h / 6;
}

/* Hermite, with slopes that are means of the chords on both sides; e[1] to e[2] is the segment. */
static double cubic(const SplineEntry *e, double t, int k)
{
    double middle = chord(&e[1], &e[2], k);
    double m0 = (chord(&e[0], &e[1], k) + middle) / 2, m1 = (middle + chord(&e[2], &e[3], k)) / 2;
    double h = e[2].t - e[1].t, u = (t - e[1].t) / h, u2 = u * u, u3 = u2 * u;
    return (2 * u3 - 3 * u2 + 1) * e[1].v[k] + (u3 - 2 * u2 + u) * h * m0 + (3 * u2 - 2 * u3) * e[2].v[k] + (u3 - u2) * h * m1;
}

/* POV: a cubic spline exists only from its second entry to the last but one, and of two entries it is the mean. */
static double cubic_outside(const Spline *s, uint32_t i, int k)
{
    const SplineEntry *e = s->entry;
    if (s->n == 2)
        return (e[0].v[k] + e[1].v[k]) / 2;
    return i <= 1 ? e[1].v[k] : e[s->n - 2].v[k];
}

void spline_at(const Spline *s, SplineKind kind, double t, double out[5])
{
    const SplineEntry *e = s->entry;
    uint32_t n = s->n, i = 0, high = n;
    while (i < high) {                         /* the first entry that is not before t */
        uint32_t middle = i + (high - i) / 2;
        if (t <= e[middle].t)
            high = middle;
        else
            i = middle + 1;
    }
    for (int k = 0; k < 5; k++) {
        if (k >= s->terms)
            out[k] = 0;
        else if (n == 1)
            out[k] = e[0].v[k];
        else if (kind == SPLINE_CUBIC)
            out[k] = i <= 1 || i + 1 >= n ? cubic_outside(s, i, k) : cubic(e + i - 2, t, k);
        else if (i == 0 || i == n)
            out[k] = i == 0 ? e[0].v[k] : e[n - 1].v[k];
        else if (kind == SPLINE_NATURAL)
            out[k] = natural(&e[i - 1], &e[i], t, k);
        else if (kind == SPLINE_QUADRATIC && n > 2)
            out[k] = quadratic(i > 1 ? e + i - 2 : e, t, k);
        else
            out[k] = linear(&e[i - 1], &e[i], t, k);
    }
}

typedef struct Draft { ARRAY(SplineEntry) entry; } Draft;

/* Sorted by t; a second entry at the same place takes the place of the first. */
static void insert(Parser *p, Draft *d, SplineEntry e)
{
    uint32_t i = d->entry.n;
    while (i > 0 && d->entry.data[i - 1].t > e.t)
        i--;
    if (i > 0 && d->entry.data[i - 1].t == e.t) {
        d->entry.data[i - 1] = e;
        return;
    }
    array_push(p->arena, &d->entry, e);
    memmove(d->entry.data + i + 1, d->entry.data + i, (d->entry.n - 1 - i) * sizeof e);
    d->entry.data[i] = e;
}

void spline_parse(Parser *p, Value *out)
{
    Loc loc = parse_loc(p);
    parse_skip(p);
    parse_open(p);
    Spline *s = arena_new(p->arena, Spline);
    Draft d = { 0 };
    s->terms = 2;
    parse_peek(p);
    if (p->token.kind == TOK_NAME && p->value && p->value->kind == VALUE_SPLINE) {
        const Spline *from = p->value->spline;
        parse_skip(p);
        s->kind = from->kind;
        s->terms = from->terms;
        for (uint32_t i = 0; i < from->n; i++)
            array_push(p->arena, &d.entry, from->entry[i]);
    }
    if (spline_kind(parse_peek(p), &s->kind))
        parse_skip(p);
    while (parse_peek(p) != TOK_CLOSE) {
        SplineEntry e = { .t = expr_float(p) };
        Num v;
        if (e.t != e.t)
            fail(p->diag, loc, "a spline cannot have an entry at a place that is not a number");
        parse_comma(p);
        expr_full(p, &v);
        num_promote(&v, 2);
        memcpy(e.v, v.v, (size_t)v.terms * sizeof *v.v);
        s->terms = v.terms > s->terms ? v.terms : s->terms;
        insert(p, &d, e);
        parse_comma(p);
    }
    parse_close(p);
    if (d.entry.n == 0)
        fail(p->diag, loc, "Spline must have at least one entry.");
    s->n = d.entry.n;
    spline_prepare(s, d.entry.data);
    *out = (Value){ .kind = VALUE_SPLINE, .spline = s };
}
