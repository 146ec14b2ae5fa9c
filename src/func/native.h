/* native.h - built-in functions with loops, in C. Private to this room. */
#ifndef FUNC_NATIVE_H
#define FUNC_NATIVE_H

#include "func/code.h"

extern FuncNative *const native_hetero_mf, *const native_ridge, *const native_ridged_mf, *const native_polytubes,
    *const native_noise_generator;

FuncNode build_call(FuncBuilder *b, FuncOp op, const void *callee, const FuncNode *arguments, int n);      /* build.c */

#endif
