/* fan.h - four rays from one point, asked at once: the way to four samples of a light, to the corners of a window. */
#ifndef WORLD_FAN_H
#define WORLD_FAN_H

#include "base/simd.h"
#include "world/world.h"

enum { FAN_RAYS = 4, FAN_ALL = 15 };

struct Vec3s { d4 x, y, z; };

/* Each ray as in Ray. Rays without length count for nothing: their d may be NaN. */
struct Fan {
    Vec3 o;
    double t_min;
    Vec3s d;
    d4 t_max;
};

/* Up to two roots of each. Bit i: that of ray i exists and is in its range. unsaid: of these rays nothing is known. */
struct FanHits {
    d4 t[2];
    uint32_t in_range[2], unsaid;
};

/* Vectors four times, each operation as vec.h has it. */
static inline Vec3s vec3s_set(Vec3 a) { return (Vec3s){ d4_set(a.x), d4_set(a.y), d4_set(a.z) }; }
static inline Vec3s vec3s_add(Vec3s a, Vec3s b) { return (Vec3s){ d4_add(a.x, b.x), d4_add(a.y, b.y), d4_add(a.z, b.z) }; }
static inline Vec3s vec3s_sub(Vec3s a, Vec3s b) { return (Vec3s){ d4_sub(a.x, b.x), d4_sub(a.y, b.y), d4_sub(a.z, b.z) }; }
static inline Vec3s vec3s_scaled(Vec3s a, d4 s) { return (Vec3s){ d4_mul(a.x, s), d4_mul(a.y, s), d4_mul(a.z, s) }; }

static inline d4 vec3s_dot(Vec3s a, Vec3s b)
{
    return d4_add(d4_add(d4_mul(a.x, b.x), d4_mul(a.y, b.y)), d4_mul(a.z, b.z));
}

static inline d4 vec3s_max_abs(Vec3s a)
{
    return d4_max(d4_max(d4_abs(a.x), d4_abs(a.y)), d4_abs(a.z));
}

/* What shapes report: root k of the rays that have one. */
static inline void fan_hit(const Fan *fan, FanHits *hits, int k, d4 t, uint32_t rays)
{
    hits->t[k] = t;
    hits->in_range[k] = rays & d4_lt(d4_set(fan->t_min), t) & d4_le(t, fan->t_max);
}

/* Is every node above a prim one whose children can all be asked four points at a time? */
bool fan_climbs(const World *w, const Prim *prim);

/* Bit i of the result: ray i, one of `rays`, meets the prim, counted with its CSG: as prim_meets for each. */
uint32_t fan_meets(const World *w, uint32_t prim, const Fan *fan, uint32_t rays);

#endif
