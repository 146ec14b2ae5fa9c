/* eval_kernel.c - the interpreter of function code, built once per instruction set and within it for 1, 4, 8 and LANES points.
 *
 * The cost of finding out what to do is shared by all lanes. All widths and sets give the same bits: only IEEE operations and the
 * C library are used, lane by lane. */
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

typedef struct Frame {
    const uint16_t *argument;
    int n;                                     /* points */
} Frame;

/* Does instruction i and all that follow; gives the row of the value. */
typedef const double *Step(const Instr *i, double *r, const Frame *frame);

static inline double *row_of(double *r, unsigned reg, size_t width)
{
    return (double *)((char *)r + reg * width);
}

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
            rows[k][l] = *row_of(r, argument[i->a + 2 + k], 1);
        row[k] = rows[k];
    }
    row[outer] = rows[outer];
    double index = *row_of(r, argument[i->a], 1), to = *row_of(r, argument[i->a + 1], 1), acc = i->op == FUNC_SUM ? 0 : 1;
    for (double turn = 0; turn < MAX_TURNS && index <= to; turn += LANES) {
        int n = 0;
        for (; n < LANES && index <= to; n++, index += 1)
            rows[outer][n] = index;
        run_lanes(i->callee, row, value, n);
        for (int l = 0; l < n; l++)
            acc = i->op == FUNC_SUM ? acc + value[l] : acc * value[l];
    }
    *row_of(r, i->dst, 1) = acc;
}

#define WIDTH 1
#include "func/eval_lanes.h"
#define WIDTH 4
#include "func/eval_lanes.h"
#define WIDTH 8
#include "func/eval_lanes.h"
#if LANES == 16
#define WIDTH 16
#include "func/eval_lanes.h"
#define run_many run_16
#define line_many line_16
#else
#define run_many run_8
#define line_many line_8
#endif

static void run_lanes(const Function *f, const double *const *arguments, double *out, int n)
{
    run_many(f, arguments, out, n);
}

static double run_one(const Function *f, const double *arguments)
{
    double r[f->n_registers];
    for (int k = 0; k < f->parameters; k++)
        r[k] = arguments[k];
    const Frame frame = { f->argument, 1 };
    return *steps_1[f->code->op](f->code, r, &frame);
}

static double one_on_line(const Function *f, const FuncLine *line, double t)
{
    double r[f->n_registers];
    for (int k = 0; k < 3; k++)
        r[k] = line->start[k] + t * line->speed[k];
    const Frame frame = { f->argument, 1 };
    return *steps_1[f->code->op](f->code, r, &frame);
}

const EvalKernel ISA_NAME(eval_kernel)[1] = {
    { .lanes = LANES, .one = run_one, .one_on_line = one_on_line, .upto_4 = run_4, .upto_8 = run_8, .upto_lanes = run_many,
      .line_4 = line_4, .line_8 = line_8, .line_lanes = line_many },
};
