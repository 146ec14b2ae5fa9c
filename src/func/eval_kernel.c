/* eval_kernel.c - the interpreter of function code, built once per instruction set and within it for 1, 4, 8 and LANES points.
 *
 * Every instruction is a plain loop over the lanes that the compiler turns into vector code; the cost of finding out what to do is
 * shared by all lanes. All widths and sets give the same bits: only IEEE operations and the C library are used, lane by lane. */
#include <math.h>
#include <string.h>

#include "func/code.h"
#include "math/elementary.h"
#include "math/noise.h"

#ifndef LANES
#define LANES 8
#endif

/* d may be one of the operands, but never overlaps one by part of a row. Unrolling before vectorising would spoil it. */
#ifdef __clang__
#define LANE_LOOP _Pragma("clang loop unroll(disable)")
#else
#define LANE_LOOP _Pragma("GCC ivdep") _Pragma("GCC unroll 1")
#endif

#define INLINE static inline __attribute__((always_inline))

typedef void Run(const Function *f, const double *const *arguments, double *out, int n);

/* The longest sum anybody waits for. */
static const double MAX_TURNS = 1e9;

static void run_lanes(const Function *f, const double *const *arguments, double *out, int n);

/* One point: the lanes take turns of the loop instead, and are added in order. */
static void run_turns(const Instr *i, const uint16_t *argument, double *r)
{
    double rows[CODE_MAX_ARGUMENTS][LANES], value[LANES];
    const double *row[CODE_MAX_ARGUMENTS];
    int outer = i->n - 2;
    for (int k = 0; k < outer; k++) {
        for (int l = 0; l < LANES; l++)
            rows[k][l] = r[argument[i->a + 2 + k]];
        row[k] = rows[k];
    }
    row[outer] = rows[outer];
    double index = r[argument[i->a]], to = r[argument[i->a + 1]], acc = i->op == FUNC_SUM ? 0 : 1;
    for (double turn = 0; turn < MAX_TURNS && index <= to; turn += LANES) {
        int n = 0;
        for (; n < LANES && index <= to; n++, index += 1)
            rows[outer][n] = index;
        run_lanes(i->callee, row, value, n);
        for (int l = 0; l < n; l++)
            acc = i->op == FUNC_SUM ? acc + value[l] : acc * value[l];
    }
    r[i->dst] = acc;
}

INLINE void run_loop(const Instr *i, const uint16_t *argument, double *r, const int width, int n, Run *run)
{
    if (width == 1) {
        run_turns(i, argument, r);
        return;
    }
    const double *row[CODE_MAX_ARGUMENTS];
    double *acc = r + i->dst * width, index[width], value[width], at[width], to[width];
    int outer = i->n - 2;                      /* arguments: from, to, then the outer parameters */
    for (int k = 0; k < outer; k++)
        row[k] = r + argument[i->a + 2 + k] * width;
    row[outer] = at;
    memcpy(index, r + argument[i->a] * width, sizeof index);
    memcpy(to, r + argument[i->a + 1] * width, sizeof to);
    double sum[width];
    for (int l = 0; l < width; l++)
        sum[l] = i->op == FUNC_SUM ? 0 : 1;
    for (double turn = 0; turn < MAX_TURNS; turn++) {
        bool any = false;
        for (int l = 0; l < n; l++)
            any = any || index[l] <= to[l];
        if (!any)
            break;
        memcpy(at, index, sizeof at);
        run(i->callee, row, value, n);
        for (int l = 0; l < n; l++) {
            if (index[l] <= to[l])
                sum[l] = i->op == FUNC_SUM ? sum[l] + value[l] : sum[l] * value[l];
            index[l] += 1;
        }
    }
    memcpy(acc, sum, sizeof sum);
}

INLINE void run_call(const Instr *i, const uint16_t *argument, double *r, const int width, int n, Run *run)
{
    double *d = r + i->dst * width;
    if (i->op == FUNC_CALL) {
        const double *row[CODE_MAX_ARGUMENTS];
        double value[width];
        for (int k = 0; k < i->n; k++)
            row[k] = r + argument[i->a + k] * width;
        run(i->callee, row, value, n);
        memcpy(d, value, (size_t)n * sizeof *d);
        return;
    }
    const FuncHost *host = i->op == FUNC_HOST ? i->callee : NULL;
    if (width > 1 && host != NULL && host->calls != NULL) {
        const double *row[CODE_MAX_ARGUMENTS];
        double value[width][5];
        for (int k = 0; k < i->n; k++)
            row[k] = r + argument[i->a + k] * width;
        host->calls(host->data, row, value, n);
        for (int l = 0; l < n; l++)
            d[l] = code_part(value[l], i->c);
        return;
    }
    for (int l = 0; l < n; l++) {
        double v[CODE_MAX_ARGUMENTS], out[5] = { 0 };
        for (int k = 0; k < i->n; k++)
            v[k] = r[argument[i->a + k] * width + l];
        if (host == NULL) {
            d[l] = (*(FuncNative *const *)i->callee)(v);
        } else {
            host->call(host->data, v, out);
            d[l] = code_part(out, i->c);
        }
    }
}

INLINE void run_noise(const Instr *i, const uint16_t *argument, double *r, const int width, int n)
{
    const double *x = r + argument[i->a] * width, *y = r + argument[i->a + 1] * width, *z = r + argument[i->a + 2] * width;
    double *d = r + i->dst * width;
    for (int l = 0; l < n; l++)
        d[l] = noise_value(*(const int *)i->callee, &(Vec3){ x[l], y[l], z[l] });
}

/* n <= width points; r has their parameters in the first registers. Returns the register row of the value. */
INLINE const double *run_code(const Function *f, double *r, const int width, int n, Run *run)
{
    for (const Instr *i = f->code; ; i++) {
        double *d = r + i->dst * width;
        const double *x = r + i->a * width;
        switch (i->op) {
#define EACH(op, needs, value)                                                                                         \
    case op: {                                                                                                         \
        needs                                                                                                          \
        LANE_LOOP                                                                                                      \
        for (int l = 0; l < width; l++) {                                                                              \
            double a = x[l];                                                                                           \
            d[l] = (value);                                                                                            \
        }                                                                                                              \
        break;                                                                                                         \
    }
#define OWN_EACH(op, needs, value, holds, otherwise)                                                                   \
    case op: {                                                                                                         \
        needs                                                                                                          \
        double own[width];                                                                                             \
        int odd = 0;                                                                                                   \
        LANE_LOOP                                                                                                      \
        for (int l = 0; l < width; l++) {                                                                              \
            double a = x[l];                                                                                           \
            own[l] = value;                                                                                            \
            odd |= !(holds);                                                                                           \
        }                                                                                                              \
        for (int l = 0; odd && l < width; l++) {                                                                       \
            double a = x[l];                                                                                           \
            if (!(holds))                                                                                              \
                own[l] = otherwise;                                                                                    \
        }                                                                                                              \
        for (int l = 0; l < width; l++)                                                                                \
            d[l] = own[l];                                                                                             \
        break;                                                                                                         \
    }
#define OWN(op, value, holds, otherwise) OWN_EACH(op, , value, holds, otherwise)
#define OWN_BINARY(op, value, holds, otherwise)                                                                        \
    OWN_EACH(op, const double *y = r + i->b * width;, (b_of(y[l], value)), (b_of(y[l], holds)), (b_of(y[l], otherwise)))
#define UNARY(op, value) EACH(op, , value)
#define BINARY(op, value) EACH(op, const double *y = r + i->b * width;, (b_of(y[l], value)))
#define TERNARY(op, value)                                                                                             \
    EACH(op, const double *y = r + i->b * width; const double *z = r + i->c * width;, (bc_of(y[l], z[l], value)))
#define WITH_K(op, value) EACH(op, const double k = i->k;, value)
#define b_of(from, value) ({ double b = from; value; })
#define bc_of(from_b, from_c, value) ({ double b = from_b, c = from_c; value; })
#include "func/operations.h"
        case FUNC_NUMBER: {
            const double k = i->k;
            for (int l = 0; l < width; l++)
                d[l] = k;
            break;
        }
        case FUNC_NOISE: run_noise(i, f->argument, r, width, n); break;
        case FUNC_SUM: case FUNC_PROD: run_loop(i, f->argument, r, width, n, run); break;
        case FUNC_CALL: case FUNC_HOST: case FUNC_NATIVE: run_call(i, f->argument, r, width, n, run); break;
        default: return x;                     /* CODE_END */
        }
    }
}

INLINE void run_rows(const Function *f, const double *const *arguments, double *out, const int width, int n, Run *run)
{
    double r[f->n_registers * (unsigned)width] __attribute__((aligned(64)));
    for (int k = 0; k < f->parameters; k++) {
        double *row = r + k * width;
        if (n == width)
            memcpy(row, arguments[k], sizeof *row * (size_t)width);
        else
            for (int l = 0; l < width; l++)    /* idle lanes repeat a point: no stray NaN or denormal */
                row[l] = arguments[k][l < n ? l : 0];
    }
    const double *value = run_code(f, r, width, n, run);
    for (int l = 0; l < n; l++)
        out[l] = value[l];
}

static void run_1(const Function *f, const double *const *arguments, double *out, int n)
{
    run_rows(f, arguments, out, 1, n, run_1);
}

static void run_4(const Function *f, const double *const *arguments, double *out, int n)
{
    run_rows(f, arguments, out, 4, n, run_4);
}

static void run_8(const Function *f, const double *const *arguments, double *out, int n)
{
    run_rows(f, arguments, out, 8, n, run_8);
}

static void run_lanes(const Function *f, const double *const *arguments, double *out, int n)
{
    run_rows(f, arguments, out, LANES, n, run_lanes);
}

static double run_one(const Function *f, const double *arguments)
{
    double r[f->n_registers];
    for (int k = 0; k < f->parameters; k++)
        r[k] = arguments[k];
    return *run_code(f, r, 1, 1, run_1);
}

const EvalKernel ISA_NAME(eval_kernel)[1] = { { .lanes = LANES, .one = run_one, .few = run_4, .some = run_8, .many = run_lanes } };
