/* function_missing.c - weak stand-ins that refuse `function {}`; the file goes when sdl/function.c and func/ come. */
#include "func/func.h"
#include "sdl/parser.h"

#define WEAK __attribute__((weak))

WEAK int func_parameters(const Function *f) { (void)f; return 0; }
WEAK int func_terms(const Function *f) { (void)f; return 1; }
WEAK double func_call(const Function *f, const double *arguments) { (void)f, (void)arguments; return 0; }
WEAK bool func_call_vector(const Function *f, const double *arguments, double out[5]) { (void)f, (void)arguments, (void)out; return false; }
WEAK const Function *parse_function(Parser *p, const char *const *parameters, int n)
{
    (void)parameters, (void)n;
    parse_fail(p, "user functions are not modelled yet");
}
WEAK const Function *function_declaration(Parser *p) { return parse_function(p, NULL, 0); }
