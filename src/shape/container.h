/* container.h - contained_by { box or sphere }: where isosurfaces and parametric surfaces are looked for. */
#ifndef SHAPE_CONTAINER_H
#define SHAPE_CONTAINER_H

#include "math/bounds.h"
#include "sdl/parse.h"
#include "world/ray.h"

typedef struct Container {
    bool sphere;
    Vec3 centre;
    double radius;
    Bounds box;                                /* of the sphere, too */
} Container;

/* A part of the container's skin: 1 to 6 for the sides of the box (axis, then low or high), 7 for the sphere. */
enum { CONTAINER_SIDES = 1, CONTAINER_SPHERE = 7 };

Container container_default(void);             /* the box from -1 to 1 */
Container container_parse(Parser *p);          /* after contained_by */
bool container_span(const Container *c, const Ray *ray, double *enter, double *leave, uint32_t *enter_side, uint32_t *leave_side);
bool container_holds(const Container *c, Vec3 p);
Vec3 container_normal(const Container *c, uint32_t side, Vec3 p);

#endif
