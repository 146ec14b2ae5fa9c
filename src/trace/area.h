/* area.h - one area light as a spot sees it: what area.c and penumbra.c share. */
#ifndef TRACE_AREA_H
#define TRACE_AREA_H

#include "trace/path.h"

typedef struct Area {
    const Spot *spot;
    const Light *light;
    uint32_t index;                            /* of the light */
    Vec3 l;
    AreaAxes axes;
    Rgb colour;
    Shaft *among;                              /* what may hide samples; NULL: not known */
} Area;

/* POV: off by a little, so that it is never 0. */
static inline double area_middle(const LightSource *def)
{
    return def->circular || def->orient ? 0.499 : 0.5;
}

/* Which place of the grid a sample takes. */
static inline Vec2 area_cell(Tracer *t, const LightSource *def, int u, int v)
{
    Vec2 cell = { u, v };
    if (def->jitter) {
        cell.u += streams_uniform(&t->chance) - 0.5;
        cell.v += streams_uniform(&t->chance) - 0.5;
    }
    return cell;
}

static inline Rgb area_mean_of(Rgb a, Rgb b, Rgb c, Rgb d)
{
    return rgb_scaled(rgb_add(rgb_add(a, b), rgb_add(c, d)), 0.25f);
}

/* So much that places between them are asked? */
static inline bool area_differ(Rgb a, Rgb b)
{
    Rgb d = rgb_sub(a, b);
    return fabsf(d[0]) + fabsf(d[1]) + fabsf(d[2]) > 0.1f;
}

/* penumbra.c. The rays to all samples start on the same side of the surface; no red of a->colour is negative. False, and nothing has
 * happened, if not all samples are lit or dark. */
bool penumbra_mean(const Area *a, Rgb *out);

#endif
