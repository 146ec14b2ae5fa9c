/* ray.h - rays, hits, and the surface at a hit. */
#ifndef WORLD_RAY_H
#define WORLD_RAY_H

#include <stdint.h>

#include "math/vec.h"

typedef struct World World;

/* Points o + t d with t_min < t <= t_max. d keeps its length through transforms, so t is the same in every space. */
struct Ray {
    Vec3 o, d;
    double t_min, t_max;
};
typedef struct Ray Ray;

struct Hit {
    double t;
    double u, v;                               /* the shape's own, e.g. barycentric */
    uint32_t prim, part;                       /* part: the shape's own, e.g. a triangle or a face */
};
typedef struct Hit Hit;

static inline Vec3 ray_at(const Ray *r, double t)
{
    return add(r->o, scaled(r->d, t));
}

/* The open part of a search: which roots still matter. */
struct HitSink {
    double t_min, limit;                       /* hits in (t_min, limit] count; limit -INFINITY: nothing more is wanted */
};
typedef struct HitSink HitSink;

/* A root in range: decided by the total order (smaller t, then smaller prim, then smaller part) and the CSG tests. */
void hit_offer(HitSink *sink, double t, uint32_t part, double u, double v);

/* The one way a shape reports a root. Any order, any number of times. */
static inline void hit_add_uv(HitSink *sink, double t, uint32_t part, double u, double v)
{
    if (t > sink->t_min && t <= sink->limit)
        hit_offer(sink, t, part, u, v);
}

static inline void hit_add(HitSink *sink, double t, uint32_t part)
{
    hit_add_uv(sink, t, part, 0, 0);
}

/* What lies beyond this t cannot win any more; a hint for skipping work. -INFINITY: nothing more is wanted. */
static inline double hit_limit(const HitSink *sink)
{
    return sink->limit;
}

enum { SURFACE_MAX_TEXTURES = 16 };

/* Filled by ShapeOps.surface in the prim's local space, then carried to world space by world_surface. */
struct Surface {
    Vec3 p;                                    /* in: o + t d; the shape may move it onto the true surface */
    Vec3 normal;                               /* out: outward, any length, zero: towards the ray; smooth shapes: the shading normal */
    Vec3 geometric;                            /* SHAPE_SMOOTH alone: out if it differs from normal; in: zero */
    Vec2 uv;                                   /* out, if want_uv and SHAPE_HAS_UV; for the rest scene coordinates x, y are taken */
    bool want_uv;                              /* in */
    double error;                              /* in: rounding bound on |p - surface|, local; a shape may raise it */
    /* out: weighted textures of this point (blob components, mesh vertices), by build_texture's index; 0 = the prim's own */
    uint32_t n_textures;
    struct { uint32_t texture; float weight; } texture[SURFACE_MAX_TEXTURES];
    bool back;                                 /* set by world_surface: the ray meets the inner side */
};
typedef struct Surface Surface;

#endif
