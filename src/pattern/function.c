/* function.c - a user function of x, y, z as a pattern. */
#include "func/func.h"
#include "sdl/parse.h"

typedef struct { const Function *function; } Params;

static void parse(Parser *p, void *params)
{
    static const char *const names[] = { "x", "y", "z" };
    ((Params *)params)->function = parse_function(p, names, 3);
}

static double value(const void *params, const PatternPoint *at)
{
    const double arguments[] = { at->p.x, at->p.y, at->p.z };
    double v = func_call(((const Params *)params)->function, arguments);
    return v > 1 ? fmod(v, 1) : v;
}

const PatternOps pattern_function = { .keyword = "function", .params_size = sizeof(Params), .parse = parse, .value = value };
