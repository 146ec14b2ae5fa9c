/* fractal_kernel.c - the orbits of four points of a fractal pattern side by side, built once per instruction set with the same bits.
 *
 * One orbit is a chain of dependent operations: three more cost next to nothing. For normals, which ask four points, and functions. */
#include <string.h>

#include "base/cpu.h"

#define WIDTH_MOST 4
#include "base/wide.h"

#define REAL Lanes
#include "pattern/fractal.h"

INLINE bool any(Mask m) { return bits(m) != 0; }

/* As `orbit` in fractal.c has it for one; whole turns are left out when all that are not lost have come back at once. */
INLINE void orbits(const Fractal *f, Number z, Number c, Lanes smallest2, Mask alive, Next *next, bool magnet, FractalEnds *out, int at)
{
    double limit = magnet ? 10000 : 4;
    Number mark = { all(NAN), all(NAN) };
    Lanes last = all(-1);
    Mask lost = alive & 0;
    for (int step = 0, marked = 0; step < f->iterations && any(alive); step++) {
        Number to = next(f, z, c);
        z = (Number){ chosen(alive, to.a, z.a), chosen(alive, to.b, z.b) };
        Lanes n = size2(z);
        smallest2 = chosen(n < smallest2, n, smallest2);
        last = chosen(alive, all(step), last);
        Mask out_now = n > limit;
        if (magnet)
            out_now |= (z.a - 1) * (z.a - 1) + z.b * z.b < 0.0001;
        lost |= alive & out_now;
        alive &= ~out_now;
        if (step > marked && !any(alive & ~((z.a == mark.a) & (z.b == mark.b))))
            step += (f->iterations - 1 - step) / (step - marked) * (step - marked);
        if ((step & (step - 1)) == 0) {
            mark = z;
            marked = step;
        }
    }
    memcpy(out->a + at, &z.a, sizeof z.a);
    memcpy(out->b + at, &z.b, sizeof z.b);
    memcpy(out->smallest2 + at, &smallest2, sizeof smallest2);
    memcpy(out->step + at, &last, sizeof last);
    for (int i = 0; i < WIDTH; i++)
        out->lost |= (uint32_t)(lost[i] & 1) << (at + i);
}

void ISA_NAME(fractal_orbits)(const Fractal *f, const Vec3 p[FRACTAL_MANY], uint32_t points, FractalEnds *out)
{
    out->lost = 0;
    for (int at = 0; at < FRACTAL_MANY; at += WIDTH) {
        Number q = { all(0), all(0) }, zero = q, c = { all(f->c.u), all(f->c.v) };
        Mask alive = { 0 };
        for (int i = 0; i < WIDTH; i++) {
            q.a[i] = p[at + i].x;
            q.b[i] = p[at + i].y;
            alive[i] = -(int64_t)(points >> (at + i) & 1);
        }
        switch (f->kind) {
        case FRACTAL_MANDEL:
        case FRACTAL_JULIA:
            if (f->kind == FRACTAL_MANDEL)
                c = q;
            if (f->exponent == 2)
                orbits(f, q, c, size2(q), alive, next_square, false, out, at);
            else
                orbits(f, q, c, size2(q), alive, next_power, false, out, at);
            break;
        case FRACTAL_MAGNET_MANDEL:
            if (f->magnet == 1)
                orbits(f, zero, q, all(10000), alive, next_magnet1, true, out, at);
            else
                orbits(f, zero, q, all(10000), alive, next_magnet2, true, out, at);
            break;
        case FRACTAL_MAGNET_JULIA:
            if (f->magnet == 1)
                orbits(f, q, c, size2(q), alive, next_magnet1, true, out, at);
            else
                orbits(f, q, c, size2(q), alive, next_magnet2, true, out, at);
            break;
        }
    }
}
