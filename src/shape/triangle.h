/* triangle.h - a ray against triangles, so that shared edges and vertices never leak.
 *
 * The ray's largest axis becomes z and the triangle is sheared so that the ray runs along it; what remains is the
 * sign of three edge functions in the plane (after Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, JCGT 2013).
 * A vertex gets the same two numbers in every triangle it belongs to, an edge function changes its sign exactly when
 * its ends change places, and edges belong to both sides: so neighbours cannot both miss. */
#ifndef SHAPE_TRIANGLE_H
#define SHAPE_TRIANGLE_H

#include "world/ray.h"

typedef struct TriRay { Vec3 o; double sx, sy, sz; int kx, ky, kz; } TriRay;
typedef struct TriHit { double t, u, v; } TriHit;          /* u, v: weights of the second and third vertex */

static inline TriRay tri_ray(const Ray *ray)
{
    Vec3 d = ray->d;
    double ax = fabs(d.x), ay = fabs(d.y), az = fabs(d.z);
    int kz = ax > ay ? (ax > az ? 0 : 2) : ay > az ? 1 : 2;
    int kx = kz == 2 ? 0 : kz + 1, ky = kx == 2 ? 0 : kx + 1;
    double depth = vec3_at(d, kz);
    return (TriRay){ ray->o, vec3_at(d, kx) / depth, vec3_at(d, ky) / depth, 1 / depth, kx, ky, kz };
}

static inline bool tri_hit(const TriRay *r, Vec3 a, Vec3 b, Vec3 c, TriHit *out)
{
    a = sub(a, r->o);
    b = sub(b, r->o);
    c = sub(c, r->o);
    double az = vec3_at(a, r->kz), bz = vec3_at(b, r->kz), cz = vec3_at(c, r->kz);
    double ax = vec3_at(a, r->kx) - r->sx * az, ay = vec3_at(a, r->ky) - r->sy * az;
    double bx = vec3_at(b, r->kx) - r->sx * bz, by = vec3_at(b, r->ky) - r->sy * bz;
    double cx = vec3_at(c, r->kx) - r->sx * cz, cy = vec3_at(c, r->ky) - r->sy * cz;
    double u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0))
        return false;
    double det = u + v + w;
    if (det == 0)
        return false;                          /* seen edge on: its neighbours cover it */
    u /= det;
    v /= det;
    w /= det;
    *out = (TriHit){ r->sz * (u * az + v * bz + w * cz), v, w };
    return true;
}

#endif
