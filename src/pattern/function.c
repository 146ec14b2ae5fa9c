/* function.c - a user function of x, y, z as a pattern. */
#include "func/func.h"
#include "sdl/parse.h"

typedef struct { const Function *function; } Params;

static void parse(Parser *p, void *params)
{
    static const char *const names[] = { "x", "y", "z" };
    ((Params *)params)->function = parse_function(p, names, 3);
}

static double within_one(double v)
{
    return v > 1 ? fmod(v, 1) : v;
}

static double value(const void *params, const PatternPoint *at)
{
    const double arguments[] = { at->p.x, at->p.y, at->p.z };
    return within_one(func_call(((const Params *)params)->function, arguments));
}

static void values(const void *params, const Pattern *pattern, const Vec3 *p, double *out, int n)
{
    double x[PATTERN_MANY], y[PATTERN_MANY], z[PATTERN_MANY];
    (void)pattern;
    for (int i = 0; i < n; i++) {
        x[i] = p[i].x;
        y[i] = p[i].y;
        z[i] = p[i].z;
    }
    func_eval(((const Params *)params)->function, (const double *const[]){ x, y, z }, out, (uint32_t)n);
    for (int i = 0; i < n; i++)
        out[i] = within_one(out[i]);
}

const PatternOps pattern_function = {
    .keyword = "function", .params_size = sizeof(Params), .parse = parse, .value = value, .values = values,
};
