/* func.h - user functions as register code, evaluated over lanes of points.
 *
 * sdl builds a FuncExpr tree, func_compile turns it into code once, and the same code serves parse-time calls,
 * isosurfaces, function patterns and parametric surfaces. Patterns, pigments and splines inside functions are reached
 * through FuncHost entries, so this room knows none of them. */
#ifndef FUNC_FUNC_H
#define FUNC_FUNC_H

#include "base/diag.h"
#include "math/colour.h"
#include "math/vec.h"

enum { FUNC_MAX_PARAMETERS = 56 };

typedef struct Function Function;

int func_parameters(const Function *f);
int func_terms(const Function *f);             /* of its value: 1; of vector functions 2 to 5 */
double func_call(const Function *f, const double *arguments);          /* one point */
/* n points; arguments[k] is an array of n values of parameter k. Same bits as n calls. */
void func_eval(const Function *f, const double *const *arguments, double *out, uint32_t n);
/* Pigment and spline functions have vector or colour values: fills 5 numbers, returns false for scalar functions. */
bool func_call_vector(const Function *f, const double *arguments, double out[5]);

#endif
