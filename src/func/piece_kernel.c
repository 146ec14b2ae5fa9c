/* piece_kernel.c - the range of a function, and how steep and how curved it can be, on pieces of a line, all pieces at once.
 *
 * Every register holds, per piece, the range of its values and bounds of its first and second derivative by the parameter of the
 * line; each instruction has its rule from calculus, for one piece, and a loop over the pieces that the compiler turns into vector
 * code. INFINITY is what is not known, or a kink or a jump. Sums, products and roots are rounded up and down alike wherever they are
 * computed, so ranges hold for computed values as they stand, and only those of library functions are widened. Bounds are sums and
 * products of positive numbers, so their rounding is covered once, at the end. */
#include <math.h>
#include <string.h>

#include "func/code.h"

#ifdef __clang__
#define PIECE_LOOP _Pragma("clang loop unroll(disable)") for (int l = 0; l < FUNC_PIECES; l++)
#else
#define PIECE_LOOP _Pragma("GCC ivdep") _Pragma("GCC unroll 1") for (int l = 0; l < FUNC_PIECES; l++)
#endif
#define INLINE static inline __attribute__((always_inline))

typedef struct Piece {
    double lo, hi;                             /* of the value; -INFINITY to INFINITY: it may be not a number at all */
    double first, second;                      /* |derivative| is not more */
} Piece;                                       /* never NaN */

typedef FuncPieces Row;

static const double UNIT = 1 + 0x1p-50;        /* sines are not above */

/* Does instruction i and all that follow; gives the row of the value. */
typedef const Row *Step(const Instr *i, Row *r);
static Step *const steps[N_CODE_OPS];

INLINE Row *row_of(Row *r, unsigned reg) { return (Row *)((char *)r + reg * (sizeof(Row) / CODE_ROW)); }
INLINE Piece at(const Row *r, int l) { return (Piece){ r->lo[l], r->hi[l], r->first[l], r->second[l] }; }

INLINE void put(Row *r, int l, Piece v)
{
    r->lo[l] = v.lo;
    r->hi[l] = v.hi;
    r->first[l] = v.first;
    r->second[l] = v.second;
}

INLINE double largest(Piece a) { return greater(fabs(a.lo), fabs(a.hi)); }

/* NaN is as good as nothing. */
INLINE double known(double bound) { return lesser(bound, INFINITY); }
INLINE double low(double v) { return greater(v, -INFINITY); }
INLINE double high(double v) { return lesser(v, INFINITY); }

/* Wide enough for the rounding of a library function or two. */
INLINE double below(double v) { return v - fabs(v) * 0x1p-50; }
INLINE double above(double v) { return v + fabs(v) * 0x1p-50; }

INLINE Piece number(double v) { return (Piece){ v, v, 0, 0 }; }
INLINE Piece unknown(double lo, double hi) { return (Piece){ lo, hi, INFINITY, INFINITY }; }
INLINE Piece constant(double k) { return isfinite(k) ? number(k) : unknown(-INFINITY, INFINITY); }

INLINE Piece picked(bool m, Piece a, Piece b)
{
    return (Piece){ m ? a.lo : b.lo, m ? a.hi : b.hi, m ? a.first : b.first, m ? a.second : b.second };
}

/* v from a, but where a may be not a number. */
INLINE Piece unless_lost(Piece a, Piece v)
{
    bool lost = (a.lo == -INFINITY) & (a.hi == INFINITY);
    return (Piece){ lost ? -INFINITY : v.lo, lost ? INFINITY : v.hi, v.first, v.second };
}

INLINE Piece negative(Piece a)
{
    return (Piece){ -a.hi, -a.lo, a.first, a.second };
}

INLINE Piece sum(Piece a, Piece b)
{
    return (Piece){ low(a.lo + b.lo), high(a.hi + b.hi), a.first + b.first, a.second + b.second };
}

INLINE Piece difference(Piece a, Piece b)
{
    return sum(a, negative(b));
}

INLINE Piece multiple(Piece a, double k)
{
    double p = a.lo * k, q = a.hi * k, size = fabs(k);
    return (Piece){ low(k < 0 ? q : p), high(k < 0 ? p : q), known(a.first * size), known(a.second * size) };
}

INLINE Piece product(Piece a, Piece b)
{
    double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi, u = largest(a), v = largest(b), any = p + q + r + s;
    Piece out = { lesser(lesser(p, q), lesser(r, s)), greater(greater(p, q), greater(r, s)), known(u * b.first + a.first * v),
                  known(u * b.second + 2 * a.first * b.first + a.second * v) };
    return picked(any == any, out, unknown(-INFINITY, INFINITY));
}

INLINE Piece square(Piece a)
{
    double least = a.lo > 0 ? a.lo : a.hi < 0 ? a.hi : 0, most = largest(a);
    Piece out = { least * least, most * most, known(2 * most * a.first), known(2 * (a.first * a.first + most * a.second)) };
    return unless_lost(a, out);
}

/* g(a) where g' and g'' stay within first and second. */
INLINE Piece through(Piece a, double lo, double hi, double first, double second)
{
    return (Piece){ lo, hi, known(first * a.first), known(first * a.second + second * a.first * a.first) };
}

/* Quotients come out as products with it, so its range is widened. */
INLINE Piece reciprocal(Piece a)
{
    double q = a.lo > 0 ? 1 / a.lo : -1 / a.hi;                /* the largest magnitude */
    Piece out = through(a, below(1 / a.hi), above(1 / a.lo), q * q, 2 * q * q * q);
    return picked((a.lo > 0) | (a.hi < 0), out, unknown(-INFINITY, INFINITY));
}

/* A sum of squares comes out a little below 0 at worst; what may really be negative gives NaN. */
INLINE Piece square_root(Piece a)
{
    double from = greater(a.lo, 0), lo = sqrt(from), hi = sqrt(greater(a.hi, 0)), m = 0.5 / lo;
    Piece out = through(a, lo, hi, m, m * 0.5 / from);
    return picked((a.lo < -0x1p-40 * a.hi - 0x1p-900) | (a.lo == -INFINITY), unknown(-INFINITY, INFINITY), out);
}

/* A kink at 0 is smooth again if only the square is taken. */
INLINE Piece absolute(Piece a, bool squared)
{
    Piece kinked = { 0, largest(a), a.first, squared ? a.second : INFINITY };
    return unless_lost(a, picked(a.lo >= 0, a, picked(a.hi <= 0, negative(a), kinked)));
}

/* The greater of two, which may cross: b if a is not a number. b is 0 if `squared`. */
INLINE Piece greater_of(Piece a, Piece b, bool squared)
{
    Piece either = { greater(a.lo, b.lo), greater(a.hi, b.hi), greater(a.first, b.first), squared ? a.second : INFINITY };
    return unless_lost(b, picked(a.lo > b.hi, a, picked(b.lo > a.hi, b, either)));
}

INLINE Piece lesser_of(Piece a, Piece b, bool squared)
{
    return negative(greater_of(negative(a), negative(b), squared));
}

/* atan2(a, b); `turns`: of its value only sines and cosines of whole multiples are taken, so that the jump by a turn is none. */
INLINE Piece angle(Piece a, Piece b, bool turns)
{
    Piece u = square(a), v = square(b);
    double r2 = u.lo + v.lo, p = largest(a), q = largest(b), across = p * b.first + q * a.first;
    Piece out = { -3.2, 3.2, known(across / r2),
                  known((q * a.second + p * b.second) / r2 + 2 * across * (p * a.first + q * b.first) / (r2 * r2)) };
    bool jumps = !turns & (b.lo < 0) & (a.lo <= 0) & (a.hi >= 0);
    return unless_lost(a, unless_lost(b, picked(jumps, unknown(-3.2, 3.2), out)));
}

/* By the C library; g grows and is defined from `from` on. */
INLINE void ends(double (*g)(double), Piece a, double from, double *lo, double *hi)
{
    bool inside = a.lo > from;
    *lo = low(inside ? below(g(a.lo)) : -INFINITY);
    *hi = high(inside ? above(g(a.hi)) : INFINITY);
}

INLINE Piece exponential(Piece a)
{
    double lo, hi;
    ends(exp, a, -INFINITY, &lo, &hi);
    return through(a, lo, hi, hi, hi);
}

INLINE Piece logarithm(Piece a)
{
    double lo, hi, m = 1 / greater(a.lo, 0);
    ends(log, a, 0, &lo, &hi);
    return through(a, lo, hi, m, m * m);
}

/* For positive a and a number b. */
INLINE Piece power(Piece a, Piece b)
{
    double k = b.lo, u = pow(a.lo, k), v = pow(a.hi, k);
    if (!(k == b.hi && a.lo > 0 && a.hi < INFINITY))
        return unknown(-INFINITY, INFINITY);
    double first = fabs(k) * greater(u / a.lo, v / a.hi), second = fabs(k * (k - 1)) * greater(u / (a.lo * a.lo), v / (a.hi * a.hi));
    return through(a, below(lesser(u, v)), above(greater(u, v)), first, second);
}

/* floor and its kin, at the ends: no slope while the whole number is one. */
INLINE Piece stepped(double lo, double hi)
{
    double slope = lo == hi ? 0 : INFINITY;
    return (Piece){ low(lo), high(hi), slope, slope };
}

INLINE Piece remainder_of(Piece a, Piece b)
{
    double n = b.lo;
    if (!(n == b.hi && n > 0))
        return unknown(-INFINITY, INFINITY);
    Piece whole = multiple(a, 1 / n), turns = stepped(trunc(below(whole.lo)), trunc(above(whole.hi)));
    Piece moved = sum(a, multiple(turns, -n));
    double most = largest(a), margin = most * 0x1p-50;
    bool sure = (turns.lo == turns.hi) & (most < 1e9);
    moved.lo -= margin;
    moved.hi += margin;
    return unless_lost(a, picked(sure, moved, unknown(-n, n)));
}

/* `holds` and `fails` say what is sure. */
INLINE Piece compared(bool holds, bool fails)
{
    double sure = (holds | fails) ? 0 : INFINITY;
    return (Piece){ holds ? 1 : 0, fails ? 0 : 1, sure, sure };
}

INLINE Piece chosen(bool always, bool never, Piece b, Piece c)
{
    Piece either = { lesser(b.lo, c.lo), greater(b.hi, c.hi), INFINITY, INFINITY };
    return picked(always, b, picked(never, c, either));
}

/* Slope and curvature of noise: the greatest that any numbers of its table could give at the corners of a cell. Generators 1
 * and 3 are cut off at 0 and 1, where they have kinks; generator 2 hardly ever. Far out the lattice repeats with a jump. */
INLINE Piece noise(Piece a, Piece b, Piece c, int generator)
{
    const double slope = generator == 2 ? 2.02 : generator == 3 ? 1.76 : 4.12, bend = generator == 2 ? 10.1 : INFINITY;
    double speed = a.first * a.first + b.first * b.first + c.first * c.first;
    double turn = a.second + b.second + c.second;              /* not less than its length, and mostly 0 */
    double far = greater(largest(a), greater(largest(b), largest(c)));
    Piece out = { 0, 1, slope * sqrt(speed), known(bend * speed + slope * turn) };
    return picked(far < 1800, out, unknown(0, 1));
}

/* ---- one step for each operation, which ends in the call of the next one ---- */

#define STEP(name, operands, value)                                                                                    \
    static const Row *name##_step(const Instr *i, Row *r)                                                              \
    {                                                                                                                  \
        Row *d = row_of(r, i->dst);                                                                                    \
        const Row *x = row_of(r, i->a);                                                                                \
        operands                                                                                                       \
        PIECE_LOOP                                                                                                     \
        {                                                                                                              \
            Piece a = at(x, l);                                                                                        \
            put(d, l, value);                                                                                          \
        }                                                                                                              \
        return steps[i[1].op](i + 1, r);                                                                               \
    }
#define ONE(name, value) STEP(name, , value)
#define TWO(name, value) STEP(name, const Row *y = row_of(r, i->b);, ({ Piece b = at(y, l); value; }))
#define THREE(name, value)                                                                                             \
    STEP(name, const Row *y = row_of(r, i->b); const Row *z = row_of(r, i->c);, ({ Piece b = at(y, l), c = at(z, l); value; }))
#define STEPS                                                                                                          \
    ONE(FUNC_NEG, negative(a))                                                                                         \
    ONE(FUNC_FLOOR, stepped(floor(a.lo), floor(a.hi)))                                                                 \
    ONE(FUNC_CEIL, stepped(ceil(a.lo), ceil(a.hi)))                                                                    \
    ONE(FUNC_INT, stepped(trunc(a.lo), trunc(a.hi)))                                                                   \
    ONE(FUNC_SQRT, square_root(a))                                                                                     \
    ONE(FUNC_EXP, exponential(a))                                                                                      \
    ONE(FUNC_LN, logarithm(a))                                                                                         \
    ONE(FUNC_LOG, multiple(logarithm(a), 0.43429448190325182765))                                                      \
    ONE(FUNC_SIN, unless_lost(a, through(a, -UNIT, UNIT, 1, 1)))                                                       \
    ONE(FUNC_COS, unless_lost(a, through(a, -UNIT, UNIT, 1, 1)))                                                       \
    ONE(FUNC_ATAN, unless_lost(a, through(a, -1.6, 1.6, 1, 1)))                                                        \
    ONE(FUNC_TANH, unless_lost(a, through(a, -1, 1, 1, 1)))                                                            \
    ONE(CODE_SQUARE, square(a))                                                                                        \
    STEP(CODE_ADD_K, const Piece k = constant(i->k);, sum(a, k))                                                       \
    STEP(CODE_RSUB_K, const Piece k = constant(i->k);, difference(k, a))                                               \
    STEP(CODE_MUL_K, const double k = i->k;, multiple(a, k))                                                           \
    STEP(CODE_RDIV_K, const double k = i->k;, multiple(reciprocal(a), k))                                              \
    TWO(FUNC_ADD, sum(a, b))                                                                                           \
    TWO(FUNC_SUB, difference(a, b))                                                                                    \
    TWO(FUNC_MUL, product(a, b))                                                                                       \
    TWO(FUNC_DIV, product(a, reciprocal(b)))                                                                           \
    TWO(FUNC_LT, compared(a.hi < b.lo, a.lo >= b.hi))                                                                  \
    TWO(FUNC_LE, compared(a.hi <= b.lo, a.lo > b.hi))                                                                  \
    TWO(FUNC_GT, compared(a.lo > b.hi, a.hi <= b.lo))                                                                  \
    TWO(FUNC_GE, compared(a.lo >= b.hi, a.hi < b.lo))                                                                  \
    TWO(FUNC_POW, power(a, b))                                                                                         \
    TWO(FUNC_MOD, remainder_of(a, b))                                                                                  \
    THREE(CODE_MUL_ADD, sum(product(a, b), c))                                                                         \
    THREE(CODE_MUL_SUB, difference(product(a, b), c))                                                                  \
    THREE(CODE_SUB_MUL, difference(c, product(a, b)))                                                                  \
    THREE(FUNC_IF_NEGATIVE, chosen(a.hi < 0, a.lo >= 0, b, c))                                                         \
    THREE(FUNC_IF_ZERO, chosen((a.lo == 0) & (a.hi == 0), (a.lo > 0) | (a.hi < 0), b, c))                              \
    STEP(FUNC_ABS, const bool flag = i->n != 0;, absolute(a, flag))                                                    \
    STEP(FUNC_MIN, const Row *y = row_of(r, i->b); const bool flag = i->n != 0;, lesser_of(a, at(y, l), flag))         \
    STEP(FUNC_MAX, const Row *y = row_of(r, i->b); const bool flag = i->n != 0;, greater_of(a, at(y, l), flag))        \
    STEP(FUNC_ATAN2, const Row *y = row_of(r, i->b); const bool flag = i->n != 0;, angle(a, at(y, l), flag))           \
    STEP(FUNC_NOISE, const Row *y = row_of(r, i->b); const Row *z = row_of(r, i->c); const int which = *(const int *)i->callee;, \
         noise(a, at(y, l), at(z, l), which))
STEPS

static const Row *number_step(const Instr *i, Row *r)
{
    Row *d = row_of(r, i->dst);
    const Piece v = constant(i->k);
    PIECE_LOOP
        put(d, l, v);
    return steps[i[1].op](i + 1, r);
}

static const Row *unknown_step(const Instr *i, Row *r)
{
    Row *d = row_of(r, i->dst);
    PIECE_LOOP
        put(d, l, unknown(-INFINITY, INFINITY));
    return steps[i[1].op](i + 1, r);
}

static const Row *end_step(const Instr *i, Row *r)
{
    return row_of(r, i->a);
}

#define UNKNOWN(name) [name] = unknown_step,
#undef STEP
#define STEP(name, operands, value) [name] = name##_step,
static Step *const steps[N_CODE_OPS] = {
    [FUNC_NUMBER] = number_step, [CODE_END] = end_step, STEPS
    UNKNOWN(FUNC_TAN) UNKNOWN(FUNC_ASIN) UNKNOWN(FUNC_ACOS) UNKNOWN(FUNC_SINH) UNKNOWN(FUNC_COSH) UNKNOWN(FUNC_ASINH)
    UNKNOWN(FUNC_ACOSH) UNKNOWN(FUNC_ATANH) UNKNOWN(FUNC_EQ) UNKNOWN(FUNC_NE) UNKNOWN(FUNC_AND) UNKNOWN(FUNC_OR)
    UNKNOWN(FUNC_SUM) UNKNOWN(FUNC_PROD) UNKNOWN(FUNC_CALL) UNKNOWN(FUNC_HOST) UNKNOWN(FUNC_NATIVE)
};

static void bounds(const Function *f, const FuncLine *line, const double *at, FuncPieces *out)
{
    Row r[f->n_registers] __attribute__((aligned(64)));
    for (int k = 0; k < 3; k++) {
        const double start = line->start[k], speed = line->speed[k];
        PIECE_LOOP {
            double a = start + at[l] * speed, b = start + at[l + 1] * speed;
            put(&r[k], l, (Piece){ lesser(a, b), greater(a, b), fabs(speed), 0 });
        }
    }
    *out = *steps[f->code->op](f->code, r);
    PIECE_LOOP {
        out->first[l] *= 1 + 0x1p-30;
        out->second[l] *= 1 + 0x1p-30;
    }
}

const PieceKernel ISA_NAME(piece_kernel)[1] = { { .bounds = bounds } };
