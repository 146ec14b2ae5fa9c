/* fractal.c - escape times in the plane: mandel, julia, magnet (06-noise-and-patterns, section 6.1). */
#include "pattern/map.h"
#include "sdl/parse.h"

typedef enum Kind { MANDEL, JULIA, MAGNET_MANDEL, MAGNET_JULIA } Kind;

typedef struct {
    Kind kind;
    int magnet;                                /* 1 or 2 */
    Vec2 c;                                    /* of the julia kinds */
    int iterations, exponent;
    int exterior, interior;
    double exterior_factor, interior_factor;
} Fractal;

static const MapEntry mandel_map[] = {
    MAP_RGB(0.001f, 0, 0, 0), MAP_RGB(0.001f, 0, 1, 1), MAP_RGB(0.012f, 1, 1, 0), MAP_RGB(0.015f, 1, 0, 1), MAP_RGB(0.1f, 0, 1, 1),
};

static Fractal new_fractal(Kind kind)
{
    return (Fractal){ .kind = kind, .exponent = 2, .exterior = 1, .exterior_factor = 1, .interior_factor = 1 };
}

static void mandel_parse(Parser *p, void *params)
{
    Fractal f = new_fractal(MANDEL);
    f.iterations = parse_int(p);
    *(Fractal *)params = f;
}

static void julia_parse(Parser *p, void *params)
{
    Fractal f = new_fractal(JULIA);
    f.c = parse_vec2(p);
    parse_comma(p);
    f.iterations = parse_int(p);
    *(Fractal *)params = f;
}

static void magnet_parse(Parser *p, void *params)
{
    Fractal f = new_fractal(MAGNET_MANDEL);
    f.magnet = parse_int(p);
    if (f.magnet != 1 && f.magnet != 2)
        parse_fail(p, "Invalid magnet type: 1 or 2 is wanted, not %d.", f.magnet);
    if (parse_accept(p, KW_JULIA)) {
        f.kind = MAGNET_JULIA;
        f.c = parse_vec2(p);
        parse_comma(p);
    } else {
        parse_expect(p, KW_MANDEL);
    }
    f.iterations = parse_int(p);
    *(Fractal *)params = f;
}

static void coloring(Parser *p, int last, int *type, double *factor)
{
    *type = parse_int(p);
    *factor = parse_next_float(p);
    if (*type < 0 || *type > last)
        parse_fail(p, "Invalid fractal pattern coloring type %d: 0 to %d are known.", *type, last);
}

static bool item(Parser *p, void *params)
{
    Fractal *f = params;
    if (parse_accept(p, KW_EXTERIOR)) {
        coloring(p, 8, &f->exterior, &f->exterior_factor);
    } else if (parse_accept(p, KW_INTERIOR)) {
        coloring(p, 6, &f->interior, &f->interior_factor);
    } else if (parse_accept(p, KW_EXPONENT)) {
        f->exponent = parse_int(p);
        if (f->exponent < 2 || f->exponent > 33 || f->kind >= MAGNET_MANDEL) {
            parse_warn(p, "Invalid fractal pattern exponent, using 2.");
            f->exponent = 2;
        }
    } else {
        return false;
    }
    return true;
}

typedef struct Number { double a, b; } Number;                 /* a + i b */

static inline Number plus(Number x, Number y) { return (Number){ x.a + y.a, x.b + y.b }; }
static inline Number times(Number x, Number y) { return (Number){ x.a * y.a - x.b * y.b, x.a * y.b + x.b * y.a }; }
static inline double size2(Number x) { return x.a * x.a + x.b * x.b; }

static inline Number over(Number x, Number y)
{
    double n = size2(y);
    return (Number){ (x.a * y.a + x.b * y.b) / n, (x.b * y.a - x.a * y.b) / n };
}

static inline Number power(Number x, int n)
{
    Number result = x;
    for (int bit = 1 << (30 - __builtin_clz((unsigned)n)); bit != 0; bit >>= 1) {
        result = times(result, result);
        if (n & bit)
            result = times(result, x);
    }
    return result;
}

typedef Number Next(const Fractal *f, Number z, Number c);

static inline Number next_square(const Fractal *f, Number z, Number c)
{
    (void)f;
    return plus(times(z, z), c);
}

static inline Number next_power(const Fractal *f, Number z, Number c)
{
    return plus(power(z, f->exponent), c);
}

static inline Number next_magnet1(const Fractal *f, Number z, Number c)
{
    (void)f;
    Number top = plus(times(z, z), (Number){ c.a - 1, c.b });
    Number bottom = { 2 * z.a + c.a - 2, 2 * z.b + c.b };
    Number q = over(top, bottom);
    return times(q, q);
}

static inline Number next_magnet2(const Fractal *f, Number z, Number c)
{
    (void)f;
    Number c1 = { c.a - 1, c.b }, c2 = { c.a - 2, c.b }, c12 = times(c1, c2), z2 = times(z, z);
    Number top = plus(times(z2, z), plus(times((Number){ 3 * c1.a, 3 * c1.b }, z), c12));
    Number bottom = plus((Number){ 3 * z2.a, 3 * z2.b }, plus(times((Number){ 3 * c2.a, 3 * c2.b }, z), c12));
    bottom.a += 1;
    Number q = over(top, bottom);
    return times(q, q);
}

static double escaped(const Fractal *f, int steps, Number z)
{
    double k = f->exterior_factor;
    int whole = k > -1e9 && k < 1e9 ? (int)(f->exterior == 8 ? k + 1 : k) : 0;
    switch (f->exterior) {
    case 1: return (double)steps / f->iterations;
    case 2: return z.a * k;
    case 3: return z.b * k;
    case 4: return z.a * z.a * k;
    case 5: return z.b * z.b * k;
    case 6: return sqrt(size2(z)) * k;
    case 7: case 8: return whole != 0 ? steps % whole / k : 0;
    default: return k;
    }
}

static double captured(const Fractal *f, double smallest2, Number z)
{
    double k = f->interior_factor;
    switch (f->interior) {
    case 1: return sqrt(smallest2) * k;
    case 2: return z.a * k;
    case 3: return z.b * k;
    case 4: return z.a * z.a * k;
    case 5: return z.b * z.b * k;
    case 6: return z.a * z.a + z.b * z.b * k;  /* POV: the factor reaches the second square only */
    default: return k;
    }
}

/* An orbit that comes back to a point where it was goes round for ever: whole turns are left out. The point to come back to is taken
 * anew whenever the steps have doubled (after Brent). The test hides behind the latency of the step. */
static inline __attribute__((always_inline)) double orbit(const Fractal *f, Number z, Number c, double smallest2, Next *next, bool magnet)
{
    double limit = magnet ? 10000 : 4;
    Number mark = { NAN, NAN };
    for (int step = 0, marked = 0; step < f->iterations; step++) {
        z = next(f, z, c);
        double n = size2(z);
        if (n < smallest2)
            smallest2 = n;
        if (n > limit || (magnet && (z.a - 1) * (z.a - 1) + z.b * z.b < 0.0001))
            return escaped(f, step, z);
        if (z.a == mark.a && z.b == mark.b)
            step += (f->iterations - 1 - step) / (step - marked) * (step - marked);
        if ((step & (step - 1)) == 0) {
            mark = z;
            marked = step;
        }
    }
    return captured(f, smallest2, z);
}

/* In the heart and the largest disc of the Mandelbrot set, orbits run to one point or between two. The margin is for rounding. */
static bool is_deep(Number c)
{
    static const double margin = 1e-9;
    double x = c.a - 0.25, y2 = c.b * c.b, q = x * x + y2;
    return q * (q + x) < 0.25 * y2 - margin || (c.a + 1) * (c.a + 1) + y2 < 0.0625 - margin;
}

static double value(const void *params, const PatternPoint *at)
{
    const Fractal *f = params;
    Number p = { at->p.x, at->p.y }, c = { f->c.u, f->c.v }, zero = { 0, 0 };
    switch (f->kind) {
    case MANDEL:
        c = p;
        if (f->exponent == 2 && f->interior == 0 && is_deep(c))
            return captured(f, 0, zero);
        break;
    case JULIA: break;
    case MAGNET_MANDEL: return f->magnet == 1 ? orbit(f, zero, p, 10000, next_magnet1, true) : orbit(f, zero, p, 10000, next_magnet2, true);
    case MAGNET_JULIA: return f->magnet == 1 ? orbit(f, p, c, size2(p), next_magnet1, true) : orbit(f, p, c, size2(p), next_magnet2, true);
    }
    return f->exponent == 2 ? orbit(f, p, c, size2(p), next_square, false) : orbit(f, p, c, size2(p), next_power, false);
}

const PatternOps pattern_mandel = {
    .keyword = "mandel", .params_size = sizeof(Fractal), MAP_OF(mandel_map), .parse = mandel_parse, .item = item, .value = value,
};
const PatternOps pattern_julia = {
    .keyword = "julia", .params_size = sizeof(Fractal), .parse = julia_parse, .item = item, .value = value,
};
const PatternOps pattern_magnet = {
    .keyword = "magnet", .params_size = sizeof(Fractal), .parse = magnet_parse, .item = item, .value = value,
};
