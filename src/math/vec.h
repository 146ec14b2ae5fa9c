/* vec.h - vectors of doubles; vector arithmetic has bare names, so that formulas look like formulas. */
#ifndef MATH_VEC_H
#define MATH_VEC_H

#include <math.h>
#include <stdbool.h>

#define PI 3.14159265358979323846

typedef struct Vec2 { double u, v; } Vec2;
typedef struct Vec3 { double x, y, z; } Vec3;
typedef struct Vec4 { double x, y, z, t; } Vec4;

static inline Vec3 vec3(double x, double y, double z) { return (Vec3){ x, y, z }; }
static inline Vec3 add(Vec3 a, Vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline Vec3 sub(Vec3 a, Vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline Vec3 mul(Vec3 a, Vec3 b) { return vec3(a.x * b.x, a.y * b.y, a.z * b.z); }
static inline Vec3 scaled(Vec3 a, double s) { return vec3(a.x * s, a.y * s, a.z * s); }
static inline Vec3 negated(Vec3 a) { return vec3(-a.x, -a.y, -a.z); }
static inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline double length2(Vec3 a) { return dot(a, a); }
static inline double length(Vec3 a) { return sqrt(dot(a, a)); }
static inline Vec3 lerp(Vec3 a, Vec3 b, double t) { return add(a, scaled(sub(b, a), t)); }

static inline Vec3 cross(Vec3 a, Vec3 b)
{
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* The zero vector stays zero. Exactly scale-free: normalized(2^k a) has the bits of normalized(a). */
static inline Vec3 normalized(Vec3 a)
{
    double n = length(a);
    return n > 0 ? scaled(a, 1 / n) : a;
}

/* fmin and fmax without their care for NaN, which costs a call. */
static inline double lesser(double a, double b) { return a < b ? a : b; }
static inline double greater(double a, double b) { return a > b ? a : b; }

static inline double max_abs(Vec3 a)
{
    double x = fabs(a.x), y = fabs(a.y), z = fabs(a.z), most = x > y ? x : y;  /* fmax would be a call */
    return most > z ? most : z;
}

static inline double vec3_at(Vec3 a, int axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }

static inline void vec3_set(Vec3 *a, int axis, double value)
{
    *(axis == 0 ? &a->x : axis == 1 ? &a->y : &a->z) = value;
}

static inline bool vec3_finite(Vec3 a) { return isfinite(a.x) && isfinite(a.y) && isfinite(a.z); }

#endif
