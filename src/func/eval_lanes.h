/* eval_lanes.h - the steps of the interpreter for WIDTH points. Private to eval_kernel.c, which includes it once for each width.
 *
 * One step for each operation: it does its plain loop over the lanes, which the compiler turns into vector code, and ends in the call
 * of the next one, a jump in fact. So each has the processor's registers to itself, and finding the next costs three instructions. */
#define NAME(name) NAME_PASTE(name, WIDTH)
#define NAME_PASTE(name, width) NAME_PASTE_AGAIN(name, width)
#define NAME_PASTE_AGAIN(name, width) name##_##width
#define ROW(reg) row_of(r, reg, WIDTH)
#define NEXT NAME(steps)[i[1].op](i + 1, r, frame)

static Step *const NAME(steps)[N_CODE_OPS];

static void NAME(run)(const Function *f, const double *const *arguments, double *out, int n)
{
    double r[f->n_registers * WIDTH] __attribute__((aligned(64)));
    for (int k = 0; k < f->parameters; k++) {
        double *row = r + k * WIDTH;
        if (n == WIDTH)
            memcpy(row, arguments[k], sizeof *row * WIDTH);
        else
            for (int l = 0; l < WIDTH; l++)    /* idle lanes repeat a point: no stray NaN or denormal */
                row[l] = arguments[k][l < n ? l : 0];
    }
    const Frame frame = { f->argument, n };
    const double *value = NAME(steps)[f->code->op](f->code, r, &frame);
    for (int l = 0; l < n; l++)
        out[l] = value[l];
}

#if WIDTH > 1
static void NAME(line)(const Function *f, const FuncLine *line, const double *t, double *out, int n)
{
    double r[f->n_registers * WIDTH] __attribute__((aligned(64))), at[WIDTH];
    for (int l = 0; l < WIDTH; l++)
        at[l] = t[l < n ? l : 0];
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < WIDTH; l++)
            r[k * WIDTH + l] = line->start[k] + at[l] * line->speed[k];
    const Frame frame = { f->argument, n };
    const double *value = NAME(steps)[f->code->op](f->code, r, &frame);
    for (int l = 0; l < n; l++)
        out[l] = value[l];
}
#endif

/* Steps that call others keep their variables apart: what a step itself has on the stack would hinder the jump. */
static __attribute__((noinline)) void NAME(noise)(const Instr *i, double *r, const Frame *frame)
{
    const double *x = ROW(i->a), *y = ROW(i->b), *z = ROW(i->c);
    double *d = ROW(i->dst);
    for (int l = 0; l < frame->n; l++)
        d[l] = noise_value(*(const int *)i->callee, &(Vec3){ x[l], y[l], z[l] });
}

static __attribute__((noinline)) void NAME(call)(const Instr *i, double *r, const Frame *frame)
{
    const double *row[CODE_MAX_ARGUMENTS];
    double value[WIDTH], *d = ROW(i->dst);
    for (int k = 0; k < i->n; k++)
        row[k] = ROW(frame->argument[i->a + k]);
    NAME(run)(i->callee, row, value, frame->n);
    memcpy(d, value, (size_t)frame->n * sizeof *d);
}

static __attribute__((noinline)) void NAME(native)(const Instr *i, double *r, const Frame *frame)
{
    double v[CODE_MAX_ARGUMENTS], *d = ROW(i->dst);
    for (int l = 0; l < frame->n; l++) {
        for (int k = 0; k < i->n; k++)
            v[k] = ROW(frame->argument[i->a + k])[l];
        d[l] = (*(FuncNative *const *)i->callee)(v);
    }
}

static __attribute__((noinline)) void NAME(host)(const Instr *i, double *r, const Frame *frame)
{
    const FuncHost *host = i->callee;
    double *d = ROW(i->dst);
    if (WIDTH > 1 && host->calls != NULL) {
        const double *row[CODE_MAX_ARGUMENTS];
        double value[WIDTH][5];
        for (int k = 0; k < i->n; k++)
            row[k] = ROW(frame->argument[i->a + k]);
        host->calls(host->data, row, value, frame->n);
        for (int l = 0; l < frame->n; l++)
            d[l] = code_part(value[l], i->c);
        return;
    }
    for (int l = 0; l < frame->n; l++) {
        double v[CODE_MAX_ARGUMENTS], out[5] = { 0 };
        if (WIDTH == 1 && i->b != 0) {         /* they stand ready */
            host->call(host->data, ROW(frame->argument[i->a]), out);
        } else {
            for (int k = 0; k < i->n; k++)
                v[k] = ROW(frame->argument[i->a + k])[l];
            host->call(host->data, v, out);
        }
        d[l] = code_part(out, i->c);
    }
}

#if WIDTH == 1
static __attribute__((noinline)) void NAME(loop)(const Instr *i, double *r, const Frame *frame)
{
    run_turns(i, frame->argument, r);
}
#else
static __attribute__((noinline)) void NAME(loop)(const Instr *i, double *r, const Frame *frame)
{
    const double *row[CODE_MAX_ARGUMENTS];
    double index[WIDTH], value[WIDTH], at[WIDTH], to[WIDTH], sum[WIDTH];
    int outer = i->n - 2, n = frame->n;        /* arguments: from, to, then the outer parameters */
    for (int k = 0; k < outer; k++)
        row[k] = ROW(frame->argument[i->a + 2 + k]);
    row[outer] = at;
    memcpy(index, ROW(frame->argument[i->a]), sizeof index);
    memcpy(to, ROW(frame->argument[i->a + 1]), sizeof to);
    for (int l = 0; l < WIDTH; l++)
        sum[l] = i->op == FUNC_SUM ? 0 : 1;
    for (double turn = 0; turn < MAX_TURNS; turn++) {
        bool any = false;
        for (int l = 0; l < n; l++)
            any = any || index[l] <= to[l];
        if (!any)
            break;
        memcpy(at, index, sizeof at);
        NAME(run)(i->callee, row, value, n);
        for (int l = 0; l < n; l++) {
            if (index[l] <= to[l])
                sum[l] = i->op == FUNC_SUM ? sum[l] + value[l] : sum[l] * value[l];
            index[l] += 1;
        }
    }
    memcpy(ROW(i->dst), sum, sizeof sum);
}
#endif

#define STEP(op) static const double *NAME(op)(const Instr *i, double *r, const Frame *frame)
#define EACH(op, needs, value)                                                                                         \
    STEP(op)                                                                                                           \
    {                                                                                                                  \
        double *d = ROW(i->dst);                                                                                       \
        const double *x = ROW(i->a);                                                                                   \
        needs                                                                                                          \
        LANE_LOOP                                                                                                      \
        for (int l = 0; l < WIDTH; l++) {                                                                              \
            double a = x[l];                                                                                           \
            d[l] = (value);                                                                                            \
        }                                                                                                              \
        return NEXT;                                                                                                   \
    }
#define OWN_EACH(op, needs, value, holds, otherwise)                                                                   \
    STEP(op)                                                                                                           \
    {                                                                                                                  \
        double *d = ROW(i->dst), own[WIDTH];                                                                           \
        const double *x = ROW(i->a);                                                                                   \
        int odd = 0;                                                                                                   \
        needs                                                                                                          \
        LANE_LOOP                                                                                                      \
        for (int l = 0; l < WIDTH; l++) {                                                                              \
            double a = x[l];                                                                                           \
            own[l] = value;                                                                                            \
            odd |= !(holds);                                                                                           \
        }                                                                                                              \
        for (int l = 0; odd && l < WIDTH; l++) {                                                                       \
            double a = x[l];                                                                                           \
            if (!(holds))                                                                                              \
                own[l] = otherwise;                                                                                    \
        }                                                                                                              \
        for (int l = 0; l < WIDTH; l++)                                                                                \
            d[l] = own[l];                                                                                             \
        return NEXT;                                                                                                   \
    }
#define OWN(op, value, holds, otherwise) OWN_EACH(op, , value, holds, otherwise)
#define OWN_BINARY(op, value, holds, otherwise)                                                                        \
    OWN_EACH(op, const double *y = ROW(i->b);, (b_of(y[l], value)), (b_of(y[l], holds)), (b_of(y[l], otherwise)))
#define UNARY(op, value) EACH(op, , value)
#define BINARY(op, value) EACH(op, const double *y = ROW(i->b);, (b_of(y[l], value)))
#define TERNARY(op, value) EACH(op, const double *y = ROW(i->b); const double *z = ROW(i->c);, (bc_of(y[l], z[l], value)))
#define WITH_K(op, value) EACH(op, const double k = i->k;, value)
#define b_of(from, value) ({ double b = from; value; })
#define bc_of(from_b, from_c, value) ({ double b = from_b, c = from_c; value; })
#include "func/operations.h"

STEP(FUNC_NUMBER)
{
    double *d = ROW(i->dst);
    const double k = i->k;
    for (int l = 0; l < WIDTH; l++)
        d[l] = k;
    return NEXT;
}

STEP(CODE_END)
{
    (void)frame;
    return ROW(i->a);
}

#define BY(op, helper)                                                                                                 \
    STEP(op)                                                                                                           \
    {                                                                                                                  \
        NAME(helper)(i, r, frame);                                                                                     \
        return NEXT;                                                                                                   \
    }
BY(FUNC_NOISE, noise)
BY(FUNC_SUM, loop)
BY(FUNC_PROD, loop)
BY(FUNC_CALL, call)
BY(FUNC_HOST, host)
BY(FUNC_NATIVE, native)

static Step *const NAME(steps)[N_CODE_OPS] = {
#define OF(op) [op] = NAME(op),
#define OWN(op, value, holds, otherwise) OF(op)
#define OWN_BINARY(op, value, holds, otherwise) OF(op)
#define UNARY(op, value) OF(op)
#define BINARY(op, value) OF(op)
#define TERNARY(op, value) OF(op)
#define WITH_K(op, value) OF(op)
#include "func/operations.h"
    OF(FUNC_NUMBER) OF(CODE_END) OF(FUNC_NOISE) OF(FUNC_SUM) OF(FUNC_PROD) OF(FUNC_CALL) OF(FUNC_HOST) OF(FUNC_NATIVE)
};

#undef NAME
#undef NAME_PASTE
#undef NAME_PASTE_AGAIN
#undef ROW
#undef NEXT
#undef STEP
#undef EACH
#undef OWN_EACH
#undef BY
#undef OF
#undef b_of
#undef bc_of
#undef WIDTH
