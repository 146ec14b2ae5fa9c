/* fractal.c - escape times in the plane: mandel, julia, magnet (06-noise-and-patterns, section 6.1). */
#include "pattern/fractal.h"

#include "base/cpu.h"
#include "pattern/map.h"
#include "sdl/parse.h"

static const MapEntry mandel_map[] = {
    MAP_RGB(0.001f, 0, 0, 0), MAP_RGB(0.001f, 0, 1, 1), MAP_RGB(0.012f, 1, 1, 0), MAP_RGB(0.015f, 1, 0, 1), MAP_RGB(0.1f, 0, 1, 1),
};

static Fractal new_fractal(FractalKind kind)
{
    return (Fractal){ .kind = kind, .exponent = 2, .exterior = 1, .exterior_factor = 1, .interior_factor = 1 };
}

static void mandel_parse(Parser *p, void *params)
{
    Fractal f = new_fractal(FRACTAL_MANDEL);
    f.iterations = parse_int(p);
    *(Fractal *)params = f;
}

static void julia_parse(Parser *p, void *params)
{
    Fractal f = new_fractal(FRACTAL_JULIA);
    f.c = parse_vec2(p);
    parse_comma(p);
    f.iterations = parse_int(p);
    *(Fractal *)params = f;
}

static void magnet_parse(Parser *p, void *params)
{
    Fractal f = new_fractal(FRACTAL_MAGNET_MANDEL);
    f.magnet = parse_int(p);
    if (f.magnet != 1 && f.magnet != 2)
        parse_fail(p, "Invalid magnet type: 1 or 2 is wanted, not %d.", f.magnet);
    if (parse_accept(p, KW_JULIA)) {
        f.kind = FRACTAL_MAGNET_JULIA;
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
        if (f->exponent < 2 || f->exponent > 33 || f->kind >= FRACTAL_MAGNET_MANDEL) {
            parse_warn(p, "Invalid fractal pattern exponent, using 2.");
            f->exponent = 2;
        }
    } else {
        return false;
    }
    return true;
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

/* In the heart and the largest disc of the Mandelbrot set, orbits run to one point or between two: is the value the same there? The
 * margin is for rounding. */
static bool is_flat(const Fractal *f, Number c)
{
    static const double margin = 1e-9;
    if (f->kind != FRACTAL_MANDEL || f->exponent != 2 || f->interior != 0)
        return false;
    double x = c.a - 0.25, y2 = c.b * c.b, q = x * x + y2;
    return q * (q + x) < 0.25 * y2 - margin || (c.a + 1) * (c.a + 1) + y2 < 0.0625 - margin;
}

static double value(const void *params, const PatternPoint *at)
{
    const Fractal *f = params;
    Number p = { at->p.x, at->p.y }, c = { f->c.u, f->c.v }, zero = { 0, 0 };
    switch (f->kind) {
    case FRACTAL_MANDEL:
        c = p;
        if (is_flat(f, c))
            return captured(f, 0, zero);
        break;
    case FRACTAL_JULIA: break;
    case FRACTAL_MAGNET_MANDEL: return f->magnet == 1 ? orbit(f, zero, p, 10000, next_magnet1, true) : orbit(f, zero, p, 10000, next_magnet2, true);
    case FRACTAL_MAGNET_JULIA: return f->magnet == 1 ? orbit(f, p, c, size2(p), next_magnet1, true) : orbit(f, p, c, size2(p), next_magnet2, true);
    }
    return f->exponent == 2 ? orbit(f, p, c, size2(p), next_square, false) : orbit(f, p, c, size2(p), next_power, false);
}

#define DECLARE(isa) FractalOrbits fractal_orbits_##isa;
CPU_ISAS(DECLARE)

static void values(const void *params, const Pattern *pattern, const Vec3 *p, double *out, int n)
{
    static FractalOrbits *const orbits[] = CPU_TABLE(fractal_orbits);
    FractalOrbits *orbits_of = orbits[cpu_isa()];
    const Fractal *f = params;
    (void)pattern;
    for (; n > 0; n -= FRACTAL_MANY, p += FRACTAL_MANY, out += FRACTAL_MANY) {
        Vec3 q[FRACTAL_MANY] = { { 0 } };
        FractalEnds end;
        uint32_t points = 0;
        for (int i = 0; i < FRACTAL_MANY && i < n; i++) {
            q[i] = p[i];
            points |= (uint32_t)!is_flat(f, (Number){ q[i].x, q[i].y }) << i;
        }
        orbits_of(f, q, points, &end);
        for (int i = 0; i < FRACTAL_MANY && i < n; i++) {
            Number z = { end.a[i], end.b[i] };
            out[i] = end.lost >> i & 1 ? escaped(f, (int)end.step[i], z) : captured(f, end.smallest2[i], z);
        }
    }
}

const PatternOps pattern_mandel = {
    .keyword = "mandel", .params_size = sizeof(Fractal), MAP_OF(mandel_map), .parse = mandel_parse, .item = item, .value = value, .values = values,
};
const PatternOps pattern_julia = {
    .keyword = "julia", .params_size = sizeof(Fractal), .parse = julia_parse, .item = item, .value = value, .values = values,
};
const PatternOps pattern_magnet = {
    .keyword = "magnet", .params_size = sizeof(Fractal), .parse = magnet_parse, .item = item, .value = value, .values = values,
};
