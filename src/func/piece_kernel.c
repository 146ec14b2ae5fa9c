/* piece_kernel.c - how steep and how curved a function can be on pieces of a line, as many pieces at once as there are lanes.
 *
 * Every register holds, per piece, the range of its values and bounds of its first and second derivative by the parameter of the
 * line; each instruction has its rule from calculus. INFINITY is what is not known, or a kink or a jump. Bounds are sums and products
 * of positive numbers, so their rounding is covered once, at the end; ranges are widened at every step. */
#include <math.h>
#include <string.h>

#include "func/code.h"

#define INLINE static inline __attribute__((always_inline))

/* As wide as the processor's own vectors: gcc takes comparisons of wider ones apart. */
#if defined(__AVX512F__)
enum { WIDTH = 8 };
#elif defined(__AVX2__)
enum { WIDTH = 4 };
#else
enum { WIDTH = 2 };
#endif
typedef double Lanes __attribute__((vector_size(8 * WIDTH)));
typedef int64_t Mask __attribute__((vector_size(8 * WIDTH)));

typedef struct Piece {
    Lanes lo, hi;                              /* of the value */
    Lanes first, second;                       /* |derivative| is not more; never NaN */
} Piece;

enum { MAX_REGISTERS = 200 };                  /* of functions looked at: up to 256 bytes each on the stack */

INLINE Lanes all(double v) { return (Lanes){ 0 } + v; }
INLINE Lanes chosen(Mask m, Lanes a, Lanes b) { return (Lanes)((m & (Mask)a) | (~m & (Mask)b)); }
INLINE Lanes lesser(Lanes a, Lanes b) { return chosen(a < b, a, b); }
INLINE Lanes greater(Lanes a, Lanes b) { return chosen(a > b, a, b); }
INLINE Lanes magnitude(Lanes a) { return (Lanes)((Mask)a & INT64_MAX); }
INLINE Lanes largest(const Piece *a) { return greater(magnitude(a->lo), magnitude(a->hi)); }
INLINE Lanes known(Lanes bound) { return chosen(bound == bound, bound, all(INFINITY)); }      /* 0 times INFINITY */

INLINE Lanes root(Lanes a)
{
    Lanes out;
    for (int i = 0; i < WIDTH; i++)
        out[i] = __builtin_sqrt(a[i]);
    return out;
}

INLINE Piece number(double v)
{
    return (Piece){ all(v), all(v), all(0), all(0) };
}

INLINE Piece unknown(double lo, double hi)
{
    return (Piece){ all(lo), all(hi), all(INFINITY), all(INFINITY) };
}

INLINE Piece picked(Mask m, Piece a, Piece b)
{
    return (Piece){ chosen(m, a.lo, b.lo), chosen(m, a.hi, b.hi), chosen(m, a.first, b.first), chosen(m, a.second, b.second) };
}

INLINE Piece negative(Piece a)
{
    return (Piece){ -a.hi, -a.lo, a.first, a.second };
}

INLINE Piece sum(Piece a, Piece b)
{
    return (Piece){ a.lo + b.lo, a.hi + b.hi, a.first + b.first, a.second + b.second };
}

INLINE Piece multiple(Piece a, double k)
{
    Lanes size = all(fabs(k));
    Piece v = { a.lo * k, a.hi * k, known(a.first * size), known(a.second * size) };
    return k < 0 ? (Piece){ v.hi, v.lo, v.first, v.second } : v;
}

INLINE Piece product(Piece a, Piece b)
{
    Lanes p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi, u = largest(&a), v = largest(&b), any = p + q + r + s;
    Piece out = { lesser(lesser(p, q), lesser(r, s)), greater(greater(p, q), greater(r, s)), known(u * b.first + a.first * v),
                  known(u * b.second + 2 * a.first * b.first + a.second * v) };
    return picked(any == any, out, unknown(-INFINITY, INFINITY));
}

INLINE Piece square(Piece a)
{
    Lanes least = chosen(a.lo > 0, a.lo, chosen(a.hi < 0, a.hi, all(0))), most = largest(&a);
    return (Piece){ least * least, most * most, known(2 * most * a.first), known(2 * (a.first * a.first + most * a.second)) };
}

/* g(a) where g' and g'' stay within first and second. */
INLINE Piece through(Piece a, Lanes lo, Lanes hi, Lanes first, Lanes second)
{
    return (Piece){ lo, hi, known(first * a.first), known(first * a.second + second * a.first * a.first) };
}

INLINE Piece reciprocal(Piece a)
{
    Lanes q = chosen(a.lo > 0, 1 / a.lo, -1 / a.hi);           /* the largest magnitude */
    Piece out = through(a, 1 / a.hi, 1 / a.lo, q * q, 2 * q * q * q);
    return picked((a.lo > 0) | (a.hi < 0), out, unknown(-INFINITY, INFINITY));
}

/* A sum of squares comes out a little below 0 at worst; what may really be negative gives NaN, which no range holds. */
INLINE Piece square_root(Piece a)
{
    Lanes lo = root(greater(a.lo, all(0))), hi = root(greater(a.hi, all(0))), m = 0.5 / lo;
    Piece out = through(a, lo, hi, m, m * 0.5 / greater(a.lo, all(0)));
    return picked(a.lo < -0x1p-40 * a.hi - 0x1p-900, unknown(-INFINITY, INFINITY), out);
}

INLINE Piece absolute(Piece a)
{
    Piece kinked = { all(0), largest(&a), a.first, all(INFINITY) };
    return picked(a.lo >= 0, a, picked(a.hi <= 0, negative(a), kinked));
}

/* The lesser of two, which may cross. */
INLINE Piece lesser_of(Piece a, Piece b)
{
    Piece either = { lesser(a.lo, b.lo), lesser(a.hi, b.hi), greater(a.first, b.first), all(INFINITY) };
    return picked(a.hi < b.lo, a, picked(b.hi < a.lo, b, either));
}

/* atan2(a, b); `turns`: of its value only sines and cosines of whole multiples are taken, so that the jump by a turn is none. */
INLINE Piece angle(Piece a, Piece b, bool turns)
{
    Piece u = square(a), v = square(b);
    Lanes r2 = u.lo + v.lo, p = largest(&a), q = largest(&b), across = p * b.first + q * a.first;
    Piece out = { all(-3.2), all(3.2), known(across / r2),
                  known((q * a.second + p * b.second) / r2 + 2 * across * (p * a.first + q * b.first) / (r2 * r2)) };
    Mask jumps = (b.lo < 0) & (a.lo <= 0) & (a.hi >= 0);
    return turns ? out : picked(jumps, unknown(-3.2, 3.2), out);
}

/* By the C library, piece by piece; g grows and is defined from `from` on. */
INLINE void ends(double (*g)(double), const Piece *a, double from, Lanes *lo, Lanes *hi)
{
    for (int i = 0; i < WIDTH; i++) {
        bool inside = a->lo[i] > from;
        (*lo)[i] = inside ? g(a->lo[i]) : -INFINITY;
        (*hi)[i] = inside ? g(a->hi[i]) : INFINITY;
    }
}

static Piece exponential(Piece a)
{
    Lanes lo, hi;
    ends(exp, &a, -INFINITY, &lo, &hi);
    return through(a, lo, hi, hi, hi);
}

static Piece logarithm(Piece a)
{
    Lanes lo, hi, m = 1 / greater(a.lo, all(0));
    ends(log, &a, 0, &lo, &hi);
    return through(a, lo, hi, m, m * m);
}

/* For positive a and a number b. */
static Piece power(Piece a, Piece b)
{
    double k = b.lo[0];
    if (!(k == b.hi[0]))
        return unknown(-INFINITY, INFINITY);
    Lanes u, v;
    for (int i = 0; i < WIDTH; i++) {
        u[i] = pow(a.lo[i], k);
        v[i] = pow(a.hi[i], k);
    }
    Lanes first = fabs(k) * greater(u / a.lo, v / a.hi), second = fabs(k * (k - 1)) * greater(u / (a.lo * a.lo), v / (a.hi * a.hi));
    return picked((a.lo > 0) & (a.hi < INFINITY), through(a, lesser(u, v), greater(u, v), first, second), unknown(-INFINITY, INFINITY));
}

/* floor and its kin: no slope while the whole number is one. */
INLINE Piece stepped(Piece a, double (*g)(double))
{
    Piece out = unknown(-INFINITY, INFINITY);
    for (int i = 0; i < WIDTH; i++) {
        out.lo[i] = g(a.lo[i]);
        out.hi[i] = g(a.hi[i]);
    }
    Mask same = out.lo == out.hi;
    out.first = chosen(same, all(0), out.first);
    out.second = out.first;
    return out;
}

static Piece remainder_of(Piece a, Piece b)
{
    double n = b.lo[0];
    if (!(n == b.hi[0] && n > 0))
        return unknown(-INFINITY, INFINITY);
    Piece turns = stepped(multiple(a, 1 / n), trunc);
    Piece moved = sum(a, multiple(turns, -n));
    return picked((turns.lo == turns.hi) & (magnitude(a.lo) < 1e9) & (magnitude(a.hi) < 1e9), moved, unknown(-n, n));
}

/* `holds` and `fails` say what is sure. */
INLINE Piece compared(Mask holds, Mask fails)
{
    return picked(holds, number(1), picked(fails, number(0), unknown(0, 1)));
}

/* Slope and curvature of noise: the greatest that any numbers of its table could give at the corners of a cell. Generators 1
 * and 3 are cut off at 0 and 1, where they have kinks; generator 2 hardly ever. Far out the lattice repeats with a jump. */
static Piece noise(const Piece *a, const Piece *b, const Piece *c, int generator)
{
    const double slope = generator == 2 ? 2.02 : generator == 3 ? 1.76 : 4.12, bend = generator == 2 ? 10.1 : INFINITY;
    Lanes speed = a->first * a->first + b->first * b->first + c->first * c->first;
    Lanes turn = a->second * a->second + b->second * b->second + c->second * c->second;
    Lanes far = greater(largest(a), greater(largest(b), largest(c)));
    Piece out = { all(0), all(1), slope * root(speed), known(bend * speed + slope * root(turn)) };
    return picked(far < 1800, out, unknown(0, 1));
}

INLINE Piece widened(Piece a)
{
    Lanes lo = a.lo - magnitude(a.lo) * 0x1p-50 - 0x1p-1000, hi = a.hi + magnitude(a.hi) * 0x1p-50 + 0x1p-1000;
    Mask sound = lo <= hi;                     /* not NaN */
    return (Piece){ chosen(sound, lo, all(-INFINITY)), chosen(sound, hi, all(INFINITY)), a.first, a.second };
}

static Piece unary(unsigned op, Piece a)
{
    const Lanes one = all(1);
    switch (op) {
    case FUNC_NEG: return negative(a);
    case FUNC_ABS: return absolute(a);
    case FUNC_FLOOR: return stepped(a, floor);
    case FUNC_CEIL: return stepped(a, ceil);
    case FUNC_INT: return stepped(a, trunc);
    case FUNC_SQRT: return square_root(a);
    case FUNC_EXP: return exponential(a);
    case FUNC_LN: return logarithm(a);
    case FUNC_LOG: return multiple(logarithm(a), 0.43429448190325182765);
    case FUNC_SIN: case FUNC_COS: return through(a, -one, one, one, one);
    case FUNC_ATAN: return through(a, -1.6 * one, 1.6 * one, one, one);
    case FUNC_TANH: return through(a, -one, one, one, one);
    case CODE_SQUARE: return square(a);
    default: return unknown(-INFINITY, INFINITY);
    }
}

static Piece binary(const Instr *i, Piece a, Piece b)
{
    switch (i->op) {
    case FUNC_ADD: return sum(a, b);
    case FUNC_SUB: return sum(a, negative(b));
    case FUNC_MUL: return product(a, b);
    case FUNC_DIV: return product(a, reciprocal(b));
    case FUNC_LT: return compared(a.hi < b.lo, a.lo >= b.hi);
    case FUNC_LE: return compared(a.hi <= b.lo, a.lo > b.hi);
    case FUNC_GT: return compared(a.lo > b.hi, a.hi <= b.lo);
    case FUNC_GE: return compared(a.lo >= b.hi, a.hi < b.lo);
    case FUNC_POW: return power(a, b);
    case FUNC_MOD: return remainder_of(a, b);
    case FUNC_ATAN2: return angle(a, b, i->n != 0);
    case FUNC_MIN: return lesser_of(a, b);
    case FUNC_MAX: return negative(lesser_of(negative(a), negative(b)));
    default: return unknown(-INFINITY, INFINITY);
    }
}

static Piece choice(unsigned op, Piece a, Piece b, Piece c)
{
    Mask always = op == FUNC_IF_NEGATIVE ? a.hi < 0 : (a.lo == 0) & (a.hi == 0);
    Mask never = op == FUNC_IF_NEGATIVE ? a.lo >= 0 : (a.lo > 0) | (a.hi < 0);
    Piece either = { lesser(b.lo, c.lo), greater(b.hi, c.hi), all(INFINITY), all(INFINITY) };
    return picked(always, b, picked(never, c, either));
}

static Piece value_of(const Function *f, Piece *r)
{
    for (const Instr *i = f->code; ; i++) {
        const Piece *a = &r[i->a / CODE_ROW], *b = &r[i->b / CODE_ROW], *c = &r[i->c / CODE_ROW];
        Piece v;
        switch (i->op) {
        case CODE_END: return *a;
        case FUNC_NUMBER:                      /* not widened: powers ask whether it is one number */
            r[i->dst / CODE_ROW] = isfinite(i->k) ? number(i->k) : unknown(-INFINITY, INFINITY);
            continue;
        case CODE_ADD_K: v = sum(*a, number(i->k)); break;
        case CODE_RSUB_K: v = sum(number(i->k), negative(*a)); break;
        case CODE_MUL_K: v = multiple(*a, i->k); break;
        case CODE_RDIV_K: v = multiple(reciprocal(*a), i->k); break;
        case CODE_MUL_ADD: v = sum(product(*a, *b), *c); break;
        case CODE_MUL_SUB: v = sum(product(*a, *b), negative(*c)); break;
        case CODE_SUB_MUL: v = sum(*c, negative(product(*a, *b))); break;
        case FUNC_IF_NEGATIVE: case FUNC_IF_ZERO: v = choice(i->op, *a, *b, *c); break;
        case FUNC_SUM: case FUNC_PROD: case FUNC_CALL: case FUNC_HOST: case FUNC_NATIVE: v = unknown(-INFINITY, INFINITY); break;
        case FUNC_NOISE: v = noise(a, b, c, *(const int *)i->callee); break;
        default: v = i->op == CODE_SQUARE || i->op < FUNC_ADD ? unary(i->op, *a) : binary(i, *a, *b); break;
        }
        r[i->dst / CODE_ROW] = widened(v);
    }
}

static Piece along(const Function *f, const double *start, const double *speed, const double *at)
{
    Piece r[MAX_REGISTERS];
    Lanes from, to;
    memcpy(&from, at, sizeof from);
    memcpy(&to, at + 1, sizeof to);
    for (int k = 0; k < f->parameters; k++) {
        Lanes a = start[k] + from * speed[k], b = start[k] + to * speed[k];
        r[k] = widened((Piece){ lesser(a, b), greater(a, b), all(fabs(speed[k])), all(0) });
    }
    return value_of(f, r);
}

static void bounds(const Function *f, const double *start, const double *speed, const double *at, FuncPieces *out)
{
    for (int i = 0; i < FUNC_PIECES; i += WIDTH) {
        Piece v = f->n_registers <= MAX_REGISTERS ? along(f, start, speed, at + i) : unknown(-INFINITY, INFINITY);
        Lanes first = v.first * (1 + 0x1p-30), second = v.second * (1 + 0x1p-30);
        memcpy(out->first + i, &first, sizeof first);
        memcpy(out->second + i, &second, sizeof second);
    }
}

const PieceKernel ISA_NAME(piece_kernel)[1] = { { .bounds = bounds } };
