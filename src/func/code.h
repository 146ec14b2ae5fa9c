/* code.h - the form of compiled functions. Private to this room. */
#ifndef FUNC_CODE_H
#define FUNC_CODE_H

#include <float.h>

#include "base/array.h"
#include "base/cpu.h"
#include "func/func.h"

enum { CODE_MAX_REGISTERS = 1200, CODE_MAX_ARGUMENTS = FUNC_MAX_PARAMETERS + 8, CODE_INLINE_LIMIT = 3000,
       CODE_MAX_DEPTH = 32,                     /* of calls that are not dissolved: each takes stack for its registers */
       CODE_MAX_ROWS = 200,                     /* of functions looked at piece by piece: 256 bytes of stack each */
       CODE_ROW = sizeof(double) };             /* registers stand in code times this, their place where there is one lane */

/* Instructions: dst = op(a, b, c), where a, b, c are registers and k is a number. Those after N_FUNC_OPS exist in code only. */
enum {
    CODE_ADD_K = N_FUNC_OPS,                   /* a + k */
    CODE_RSUB_K,                               /* k - a */
    CODE_MUL_K,                                /* a * k */
    CODE_RDIV_K,                               /* k / a */
    CODE_MUL_ADD,                              /* a * b + c, rounded twice, as all three of these */
    CODE_MUL_SUB,                              /* a * b - c */
    CODE_SUB_MUL,                              /* c - a * b */
    CODE_SQUARE,                               /* a * a */
    CODE_END,                                  /* the value is in a */
    N_CODE_OPS
};

typedef struct Instr {
    uint16_t op, dst, a, b, c, n;              /* SUM ... NATIVE: n arguments, registers argument[a ...]; c: part;
                                                * b: not 0 if these follow each other.
                                                * ATAN2: n not 0 if whole turns do not matter; ABS, and MIN and MAX
                                                * with 0: if kinks at 0 do not matter */
    union { double k; const void *callee; };   /* Function, FuncHost, FuncNative; NOISE: const int, the generator */
} Instr;

typedef double FuncNative(const double *arguments);

typedef struct Node {
    uint16_t op, part, n;                      /* n: of the arguments of calls */
    uint32_t a, b, c;                          /* a: of calls, the first in Builder.argument */
    union { double k; const void *callee; };
} Node;

struct Function {
    int parameters, terms;
    const FuncHost *host;                      /* not NULL: no code, only this */
    const Instr *code;
    const uint16_t *argument;
    uint32_t n_registers;                      /* the first ones are the parameters */
    int depth;                                 /* of calls and loops within */
    const Node *node;                          /* for callers to dissolve it */
    const uint32_t *node_argument;
    uint32_t n_nodes, result;
};

typedef void CodeRun(const Function *f, const double *const *arguments, double *out, int n);
typedef void CodeRunLine(const Function *f, const FuncLine *line, const double *t, double *out, int n);

/* One build of eval_kernel.c, for as many points as the names say or fewer; lanes: many. */
typedef struct EvalKernel {
    int lanes;
    double (*one)(const Function *f, const double *arguments);
    double (*one_on_line)(const Function *f, const FuncLine *line, double t);
    CodeRun *upto_4, *upto_8, *upto_lanes;
    CodeRunLine *line_4, *line_8, *line_lanes;
} EvalKernel;

/* One build of piece_kernel.c. */
typedef struct PieceKernel {
    void (*bounds)(const Function *f, const FuncLine *line, const double *at, FuncPieces *out);
} PieceKernel;

double code_fold(unsigned op, double a, double b, double c);   /* of an operation on numbers: what the kernel would compute */
const EvalKernel *code_kernel(CpuIsa isa);

static inline double code_part(const double v[5], unsigned part)
{
    switch (part) {
    case FUNC_GREY: return 0.297 * v[0] + 0.589 * v[1] + 0.114 * v[2];
    case FUNC_HF: return (v[0] + v[1] / 255) * 0.996093;
    default: return v[part];
    }
}

#endif
