/* func.h - user functions as register code, evaluated over lanes of points.
 *
 * Who reads a function (sdl) builds it node by node with a FuncBuilder, bottom up; equal nodes are one, constants fold, and
 * called functions dissolve into their caller. func_finish turns the nodes into code once, and the same code serves parse-time
 * calls, isosurfaces, function patterns and parametric surfaces. Patterns, pigments, transforms and splines inside functions are
 * reached through a FuncHost, so this room knows none of them. */
#ifndef FUNC_FUNC_H
#define FUNC_FUNC_H

#include <stdint.h>

#include "base/arena.h"
#include "math/colour.h"
#include "math/vec.h"

enum { FUNC_MAX_PARAMETERS = 56, FUNC_MANY = 32 };

typedef struct Function Function;

int func_parameters(const Function *f);
int func_terms(const Function *f);             /* of its value: 1; of vector functions 2 to 5 */
double func_call(const Function *f, const double *arguments);          /* one point */
/* n points; arguments[k] is an array of n values of parameter k. Same bits as n calls. */
void func_eval(const Function *f, const double *const *arguments, double *out, uint32_t n);
/* Pigment and spline functions have vector or colour values: fills 5 numbers, returns false for scalar functions. */
bool func_call_vector(const Function *f, const double *arguments, double out[5]);
void func_eval_vector(const Function *f, const double *const *arguments, double (*out)[5], uint32_t n);        /* not of scalar ones */

/* Arithmetic and the like only, so that many lanes cost little more than one. */
bool func_is_cheap(const Function *f);

/* Points start + t speed, for functions of three parameters. */
typedef struct FuncLine { double start[3], speed[3]; } FuncLine;

/* Same bits as func_call at the points. */
double func_on_line(const Function *f, const FuncLine *line, double t);
void func_along_line(const Function *f, const FuncLine *line, const double *t, double *out, int n);        /* n <= FUNC_MANY */

/* The range of f, and how steep and how curved it is at most, on pieces of a line: piece i goes from t = at[i] to at[i + 1], derivatives
 * are by t. INFINITY: not known, or there is a kink or a jump; in both directions of the range: a value may be not a number. */
enum { FUNC_PIECES = 8 };
typedef struct FuncPieces { double lo[FUNC_PIECES], hi[FUNC_PIECES], first[FUNC_PIECES], second[FUNC_PIECES]; } FuncPieces;
void func_pieces(const Function *f, const FuncLine *line, const double at[FUNC_PIECES + 1], FuncPieces *out);

/* May func_pieces know anything of f? */
bool func_is_bounded(const Function *f);

/* Something a function asks of another room. `call` must work from any thread; it fills `terms` numbers. `calls`, which may be
 * NULL, does the same for n <= FUNC_MANY points and fills all five of each. */
typedef struct FuncHost {
    void (*call)(const void *data, const double *arguments, double *out);
    void (*calls)(const void *data, const double *const *arguments, double (*out)[5], int n);
    const void *data;
    int parameters, terms;
} FuncHost;

const Function *func_of_host(Arena *arena, const FuncHost *host);      /* copies the struct, not what `data` points to */

/* f_* number n of 01-language, section 18; NULL if there is none. noise_generator: the scene's, read when noise is asked. */
const Function *func_internal(Arena *arena, int number, const int *noise_generator);

/* The operations of functions; a tree of them is written bottom up. */
typedef enum FuncOp {
    FUNC_NUMBER, FUNC_PARAMETER,
    FUNC_NEG, FUNC_ABS, FUNC_FLOOR, FUNC_CEIL, FUNC_INT, FUNC_SQRT, FUNC_EXP, FUNC_LN, FUNC_LOG, FUNC_SIN, FUNC_COS, FUNC_TAN,
    FUNC_ASIN, FUNC_ACOS, FUNC_ATAN, FUNC_SINH, FUNC_COSH, FUNC_TANH, FUNC_ASINH, FUNC_ACOSH, FUNC_ATANH,
    FUNC_ADD, FUNC_SUB, FUNC_MUL, FUNC_DIV, FUNC_EQ, FUNC_NE, FUNC_LT, FUNC_LE, FUNC_GT, FUNC_GE, FUNC_AND, FUNC_OR, FUNC_POW,
    FUNC_MOD, FUNC_ATAN2, FUNC_MIN, FUNC_MAX,
    FUNC_IF_NEGATIVE,                          /* a < 0 ? b : c */
    FUNC_IF_ZERO,                              /* a = 0 ? b : c */
    FUNC_SUM, FUNC_PROD, FUNC_CALL, FUNC_HOST, FUNC_NATIVE, FUNC_NOISE,
    N_FUNC_OPS
} FuncOp;

/* What to take of a vector value. */
typedef enum FuncPart { FUNC_X, FUNC_Y, FUNC_Z, FUNC_T, FUNC_FIFTH, FUNC_GREY, FUNC_HF } FuncPart;

typedef struct FuncBuilder FuncBuilder;
typedef uint32_t FuncNode;

FuncBuilder *func_builder(Arena *arena, int parameters);
FuncNode func_number(FuncBuilder *b, double v);
FuncNode func_parameter(FuncBuilder *b, int i);
FuncNode func_unary(FuncBuilder *b, FuncOp op, FuncNode a);
FuncNode func_binary(FuncBuilder *b, FuncOp op, FuncNode x, FuncNode y);
FuncNode func_choice(FuncBuilder *b, FuncOp op, FuncNode a, FuncNode x, FuncNode y);     /* FUNC_IF_... */
/* `part` counts for vector functions only. */
FuncNode func_apply(FuncBuilder *b, const Function *f, const FuncNode *arguments, FuncPart part);
bool func_is_number(const FuncBuilder *b, FuncNode a, double *v);      /* is its value known already? */

/* sum and prod: the body is a function of the outer parameters and, after them, the variable of the loop. */
FuncBuilder *func_loop_body(FuncBuilder *outer);
FuncNode func_loop(FuncBuilder *outer, FuncOp op, FuncNode from, FuncNode to, const Function *body);

/* NULL if it needs more registers than there are (a thousand), or calls nest too deep (32, beyond what dissolves). */
const Function *func_finish(FuncBuilder *b, FuncNode result);

#endif
