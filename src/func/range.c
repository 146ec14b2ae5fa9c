/* range.c - interval arithmetic over function code: where values lie while the parameters roam.
 *
 * Ranges are widened a little at each step, so that no rounding of a value can leave them. What is not known is everything, and
 * everything alone may be NaN. */
#include <math.h>

#include "func/native.h"

static const FuncRange EVERYTHING = { -INFINITY, INFINITY };

static inline FuncRange range_of(double lo, double hi)
{
    return lo <= hi ? (FuncRange){ lo, hi } : EVERYTHING;      /* NaN, too */
}

/* The error of the operation, and of the C library's. */
static inline FuncRange widened(double lo, double hi)
{
    return range_of(lo - fabs(lo) * 0x1p-50 - 0x1p-1000, hi + fabs(hi) * 0x1p-50 + 0x1p-1000);
}

static inline bool is_everything(FuncRange a) { return a.lo == -INFINITY && a.hi == INFINITY; }

static inline FuncRange hull(FuncRange a, FuncRange b)
{
    return (FuncRange){ fmin(a.lo, b.lo), fmax(a.hi, b.hi) };
}

static inline FuncRange sum_of(FuncRange a, FuncRange b) { return widened(a.lo + b.lo, a.hi + b.hi); }
static inline FuncRange difference_of(FuncRange a, FuncRange b) { return widened(a.lo - b.hi, a.hi - b.lo); }

static inline FuncRange product_of(FuncRange a, FuncRange b)
{
    double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
    if (isnan(p + q + r + s))
        return EVERYTHING;
    return widened(fmin(fmin(p, q), fmin(r, s)), fmax(fmax(p, q), fmax(r, s)));
}

static inline FuncRange quotient_of(FuncRange a, FuncRange b)
{
    return b.lo > 0 || b.hi < 0 ? product_of(a, widened(1 / b.hi, 1 / b.lo)) : EVERYTHING;
}

static inline FuncRange square_of(FuncRange a)
{
    double lo = a.lo > 0 ? a.lo : a.hi < 0 ? a.hi : 0, p = a.lo * a.lo, q = a.hi * a.hi;
    return widened(lo * lo, fmax(p, q));
}

static inline FuncRange magnitude_of(FuncRange a)
{
    return (FuncRange){ a.lo > 0 ? a.lo : a.hi < 0 ? -a.hi : 0, fmax(fabs(a.lo), fabs(a.hi)) };
}

/* Of a function that grows, on its domain. */
static FuncRange growing(double (*f)(double), FuncRange a, double from, double to)
{
    if (a.lo < from || a.hi > to)
        return EVERYTHING;
    return widened(f(a.lo), f(a.hi));
}

/* A sum of squares comes out a little below 0 at worst; what may really be negative gives NaN, which no range holds. */
static FuncRange root_of(FuncRange a)
{
    return a.lo < -0x1p-40 * a.hi - 0x1p-900 ? EVERYTHING : widened(a.lo > 0 ? sqrt(a.lo) : 0, sqrt(a.hi));
}

/* sin(x): -1..1 unless the range is within one monotone half wave. */
static FuncRange sine_of(FuncRange a)
{
    if (!isfinite(a.lo) || !isfinite(a.hi))
        return EVERYTHING;
    double turns = floor(a.lo / PI + 0.5);
    if (!(fabs(a.lo) < 1e6 && a.hi <= (turns + 0.5) * PI))
        return (FuncRange){ -1, 1 };
    double u = sin(a.lo), v = sin(a.hi), slack = 0x1p-48 * (1 + fabs(a.lo) + fabs(a.hi));      /* cosines come with a rounded shift */
    return range_of(fmin(u, v) - slack, fmax(u, v) + slack);
}

static FuncRange compared(bool always, bool never)
{
    return (FuncRange){ always, !never };
}

static FuncRange power_of(FuncRange a, FuncRange b)
{
    if (a.lo < 0 || b.lo != b.hi)
        return EVERYTHING;
    double u = pow(a.lo, b.lo), v = pow(a.hi, b.lo);
    return widened(fmin(u, v), fmax(u, v));
}

static FuncRange unary_of(unsigned op, FuncRange a)
{
    if (is_everything(a))
        return EVERYTHING;
    switch (op) {
    case FUNC_NEG: return (FuncRange){ -a.hi, -a.lo };
    case FUNC_ABS: return magnitude_of(a);
    case FUNC_FLOOR: return range_of(floor(a.lo), floor(a.hi));
    case FUNC_CEIL: return range_of(ceil(a.lo), ceil(a.hi));
    case FUNC_INT: return range_of(trunc(a.lo), trunc(a.hi));
    case FUNC_SQRT: return root_of(a);
    case FUNC_EXP: return growing(exp, a, -INFINITY, INFINITY);
    case FUNC_LN: return growing(log, a, 0, INFINITY);
    case FUNC_LOG: return growing(log10, a, 0, INFINITY);
    case FUNC_SIN: return sine_of(a);
    case FUNC_COS: return sine_of(widened(a.lo + PI / 2, a.hi + PI / 2));
    case FUNC_ASIN: return growing(asin, a, -1, 1);
    case FUNC_ATAN: return growing(atan, a, -INFINITY, INFINITY);
    case FUNC_SINH: return growing(sinh, a, -INFINITY, INFINITY);
    case FUNC_TANH: return growing(tanh, a, -INFINITY, INFINITY);
    case FUNC_ASINH: return growing(asinh, a, -INFINITY, INFINITY);
    case CODE_SQUARE: return square_of(a);
    default: return EVERYTHING;
    }
}

static FuncRange remainder_of(FuncRange a, FuncRange b)
{
    double n = fmax(fabs(b.lo), fabs(b.hi));
    if (!isfinite(a.lo) || !isfinite(a.hi) || (b.lo <= 0 && b.hi >= 0))
        return EVERYTHING;
    return (FuncRange){ a.lo < 0 ? -n : 0, a.hi > 0 ? n : 0 };
}

static FuncRange binary_of(unsigned op, FuncRange a, FuncRange b)
{
    bool compares = op >= FUNC_EQ && op <= FUNC_OR;
    if (!compares && (is_everything(a) || is_everything(b)))
        return EVERYTHING;
    switch (op) {
    case FUNC_ADD: return sum_of(a, b);
    case FUNC_SUB: return difference_of(a, b);
    case FUNC_MUL: return product_of(a, b);
    case FUNC_DIV: return quotient_of(a, b);
    case FUNC_LT: return compared(a.hi < b.lo, a.lo >= b.hi);
    case FUNC_LE: return compared(a.hi <= b.lo, a.lo > b.hi);
    case FUNC_GT: return compared(a.lo > b.hi, a.hi <= b.lo);
    case FUNC_GE: return compared(a.lo >= b.hi, a.hi < b.lo);
    case FUNC_EQ: case FUNC_NE: case FUNC_AND: case FUNC_OR: return (FuncRange){ 0, 1 };
    case FUNC_POW: return power_of(a, b);
    case FUNC_ATAN2: return (FuncRange){ -PI * (1 + 0x1p-50), PI * (1 + 0x1p-50) };
    case FUNC_MIN: return (FuncRange){ fmin(a.lo, b.lo), fmin(a.hi, b.hi) };
    case FUNC_MAX: return (FuncRange){ fmax(a.lo, b.lo), fmax(a.hi, b.hi) };
    case FUNC_MOD: return remainder_of(a, b);
    default: return EVERYTHING;
    }
}

static FuncRange choice_of(unsigned op, FuncRange a, FuncRange b, FuncRange c)
{
    bool always = op == FUNC_IF_NEGATIVE ? a.hi < 0 : a.lo == 0 && a.hi == 0;
    bool never = op == FUNC_IF_NEGATIVE ? a.lo >= 0 : a.lo > 0 || a.hi < 0;
    return always ? b : never ? c : hull(b, c);
}

static FuncRange call_of(const Function *f, const Instr *i, const FuncRange *r)
{
    FuncRange a[CODE_MAX_ARGUMENTS], out;
    if (i->op == FUNC_NOISE)
        return (FuncRange){ 0, 1 };
    if (i->op == FUNC_CALL) {
        for (int k = 0; k < i->n; k++)
            a[k] = r[f->argument[i->a + k]];
        return func_range(i->callee, a, &out) ? out : EVERYTHING;
    }
    if (i->op == FUNC_HOST) {
        const FuncHost *host = i->callee;
        return host->range.lo < host->range.hi && i->c <= FUNC_FIFTH ? host->range : EVERYTHING;
    }
    if (i->op == FUNC_NATIVE && i->callee == &native_noise_generator)
        return (FuncRange){ 0, 1 };
    return EVERYTHING;
}

bool func_range(const Function *f, const FuncRange *arguments, FuncRange *out)
{
    if (f->host != NULL) {
        *out = f->host->range;
        return out->lo < out->hi;
    }
    FuncRange r[f->n_registers];
    for (int k = 0; k < f->parameters; k++)
        r[k] = arguments[k];
    for (const Instr *i = f->code; ; i++) {
        FuncRange a = r[i->a < f->n_registers ? i->a : 0], k = { i->k, i->k }, v;
        switch (i->op) {
        case CODE_END: *out = a; return a.lo > -INFINITY || a.hi < INFINITY;
        case FUNC_NUMBER: v = range_of(i->k, i->k); break;
        case CODE_ADD_K: v = sum_of(a, k); break;
        case CODE_RSUB_K: v = difference_of(k, a); break;
        case CODE_MUL_K: v = product_of(a, k); break;
        case CODE_RDIV_K: v = quotient_of(k, a); break;
        case CODE_MUL_ADD: v = sum_of(product_of(a, r[i->b]), r[i->c]); break;
        case CODE_MUL_SUB: v = difference_of(product_of(a, r[i->b]), r[i->c]); break;
        case CODE_SUB_MUL: v = difference_of(r[i->c], product_of(a, r[i->b])); break;
        case FUNC_IF_NEGATIVE: case FUNC_IF_ZERO: v = choice_of(i->op, a, r[i->b], r[i->c]); break;
        case FUNC_SUM: case FUNC_PROD: case FUNC_CALL: case FUNC_HOST: case FUNC_NATIVE: case FUNC_NOISE:
            v = call_of(f, i, r);
            break;
        default: v = i->op == CODE_SQUARE || i->op < FUNC_ADD ? unary_of(i->op, a) : binary_of(i->op, a, r[i->b]); break;
        }
        r[i->dst] = v;
    }
}

/* In about the time of one addition. */
double func_cost(const Function *f)
{
    if (f->host != NULL)
        return 100;
    double cost = 10;
    for (const Instr *i = f->code; i->op != CODE_END; i++) {
        if (i->op == FUNC_HOST || i->op == FUNC_NATIVE)
            cost += 100;
        else if (i->op == FUNC_CALL || i->op == FUNC_SUM || i->op == FUNC_PROD)
            cost += func_cost(i->callee) * (i->op == FUNC_CALL ? 1 : 4);
        else
            cost += i->op == FUNC_NOISE ? 15 : i->op >= FUNC_EXP && i->op < FUNC_ADD ? 8 : 1;
    }
    return cost;
}

double func_length(const Function *f)
{
    double n = 1;
    for (const Instr *i = f->code; f->host == NULL && i->op != CODE_END; i++)
        n += i->op == FUNC_CALL ? func_length(i->callee) : 1;
    return n;
}
