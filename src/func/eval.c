/* eval.c - calls functions: picks the kernel of this machine and the width for the number of points. */
#include <math.h>
#include <string.h>

#include "func/code.h"
#include "math/elementary.h"

#define DECLARE(isa) extern const EvalKernel eval_kernel_##isa[1];
CPU_ISAS(DECLARE)
#define DECLARE_PIECE(isa) extern const PieceKernel piece_kernel_##isa[1];
CPU_ISAS(DECLARE_PIECE)

static const EvalKernel *const kernels[] = CPU_TABLE(eval_kernel);
static const PieceKernel *const piece_kernels[] = CPU_TABLE(piece_kernel);
static const EvalKernel *kernel;               /* written once, before main */
static const PieceKernel *piece_kernel;

__attribute__((constructor)) static void choose_kernel(void)
{
    kernel = kernels[cpu_isa()];
    piece_kernel = piece_kernels[cpu_isa()];
}

const EvalKernel *code_kernel(CpuIsa isa)
{
    return kernels[isa];
}

int func_parameters(const Function *f)
{
    return f->parameters;
}

int func_terms(const Function *f)
{
    return f->terms;
}

bool func_is_cheap(const Function *f)
{
    if (f->host != NULL)
        return false;
    for (const Instr *i = f->code; i->op != CODE_END; i++) {
        if (i->op == FUNC_HOST || i->op == FUNC_NATIVE || i->op == FUNC_NOISE)
            return false;
        if ((i->op == FUNC_SUM || i->op == FUNC_PROD || i->op == FUNC_CALL) && !func_is_cheap(i->callee))
            return false;
    }
    return true;
}

/* What asks others is unknown, unless only to choose or to limit. */
bool func_is_bounded(const Function *f)
{
    bool asks = f->host != NULL || f->n_registers > CODE_MAX_ROWS, chooses = false;
    for (const Instr *i = f->code; f->host == NULL && i->op != CODE_END; i++) {
        asks = asks || (i->op >= FUNC_SUM && i->op <= FUNC_NATIVE);
        chooses = chooses || (i->op >= FUNC_EQ && i->op <= FUNC_OR) || (i->op >= FUNC_MIN && i->op <= FUNC_IF_ZERO);
    }
    return !asks || chooses;
}

static double host_scalar(const FuncHost *host, const double *arguments)
{
    double out[5] = { 0 };
    host->call(host->data, arguments, out);
    return out[0];
}

static void host_eval(const FuncHost *host, const double *const *arguments, double (*out)[5], uint32_t n)
{
    const double *row[FUNC_MAX_PARAMETERS];
    double one[FUNC_MAX_PARAMETERS];
    for (uint32_t at = 0; host->calls != NULL && at < n; at += FUNC_MANY) {
        for (int k = 0; k < host->parameters; k++)
            row[k] = arguments[k] + at;
        host->calls(host->data, row, out + at, (int)(n - at < FUNC_MANY ? n - at : FUNC_MANY));
    }
    for (uint32_t i = 0; host->calls == NULL && i < n; i++) {
        for (int k = 0; k < host->parameters; k++)
            one[k] = arguments[k][i];
        memset(out[i], 0, sizeof out[i]);
        host->call(host->data, one, out[i]);
    }
}

void func_eval_vector(const Function *f, const double *const *arguments, double (*out)[5], uint32_t n)
{
    host_eval(f->host, arguments, out, n);
}

double func_call(const Function *f, const double *arguments)
{
    return f->host != NULL ? host_scalar(f->host, arguments) : kernel->one(f, arguments);
}

bool func_call_vector(const Function *f, const double *arguments, double out[5])
{
    if (f->terms == 1)
        return false;
    for (int i = 0; i < 5; i++)
        out[i] = 0;
    f->host->call(f->host->data, arguments, out);
    return true;
}

void func_eval(const Function *f, const double *const *arguments, double *out, uint32_t n)
{
    uint32_t lanes = (uint32_t)kernel->lanes;
    for (uint32_t at = 0; at < n; at += lanes) {
        uint32_t here = n - at < lanes ? n - at : lanes;
        const double *row[FUNC_MAX_PARAMETERS];
        for (int k = 0; k < f->parameters; k++)
            row[k] = arguments[k] + at;
        if (f->host != NULL) {
            double v[FUNC_MANY][5];
            host_eval(f->host, row, v, here);
            for (uint32_t l = 0; l < here; l++)
                out[at + l] = v[l][0];
        } else if (here == 1) {
            double one[FUNC_MAX_PARAMETERS];
            for (int k = 0; k < f->parameters; k++)
                one[k] = *row[k];
            out[at] = func_call(f, one);
        } else if (here <= 4) {
            kernel->upto_4(f, row, out + at, (int)here);
        } else if (here <= 8) {
            kernel->upto_8(f, row, out + at, (int)here);
        } else {
            kernel->upto_lanes(f, row, out + at, (int)here);
        }
    }
}

double func_on_line(const Function *f, const FuncLine *line, double t)
{
    double p[3];
    if (f->host == NULL)
        return kernel->one_on_line(f, line, t);
    for (int k = 0; k < 3; k++)
        p[k] = line->start[k] + t * line->speed[k];
    return host_scalar(f->host, p);
}

void func_along_line(const Function *f, const FuncLine *line, const double *t, double *out, int n)
{
    if (f->host == NULL && n <= kernel->lanes) {
        CodeRunLine *run = n <= 4 ? kernel->line_4 : n <= 8 ? kernel->line_8 : kernel->line_lanes;
        run(f, line, t, out, n);
        return;
    }
    double p[3][FUNC_MANY];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < n; i++)
            p[k][i] = line->start[k] + t[i] * line->speed[k];
    func_eval(f, (const double *const[]){ p[0], p[1], p[2] }, out, (uint32_t)n);
}

void func_pieces(const Function *f, const FuncLine *line, const double at[FUNC_PIECES + 1], FuncPieces *out)
{
    if (f->host != NULL || f->n_registers > CODE_MAX_ROWS) {
        for (int i = 0; i < FUNC_PIECES; i++)
            out->lo[i] = -(out->hi[i] = out->first[i] = out->second[i] = INFINITY);
    } else {
        piece_kernel->bounds(f, line, at, out);
    }
}

double code_fold(unsigned op, double a, double b, double c)
{
    const double k = b;
    switch (op) {
#define OWN(name, value, holds, otherwise) case name: return holds ? value : otherwise;
#define OWN_BINARY OWN
#define UNARY(name, value) case name: return value;
#define BINARY(name, value) case name: return value;
#define TERNARY(name, value) case name: return value;
#define WITH_K(name, value) case name: return value;
#include "func/operations.h"
    default: return NAN;
    }
}
