/* build.h - what a shape may call while it is compiled. Implemented by compile. */
#ifndef WORLD_BUILD_H
#define WORLD_BUILD_H

#include "scene/ops.h"
#include "world/world.h"

struct ShapeBuild {
    Arena *arena;                              /* the world's */
    const Object *object;                      /* flags: OBJECT_OPEN, OBJECT_STURM... */
    const AccelOps *accel;                     /* for a shape that keeps its own hierarchy (mesh, blob) */
    Affine place;                              /* the shape's own space to the world: object, parents, unit scale */
    double unit;                               /* World.unit, already in place; 1 for SHAPE_SHARED */
    Diag *diag;
    bool no_inside;                            /* set by a shape that turns out to be a patch: mesh without inside_vector */
    struct Compile *compile;                   /* private */
};

/* Zeroed memory in the world arena. */
void *build_data(ShapeBuild *b, size_t bytes);

/* One prim with these constants. `local` bounds it in the space that `place` takes to the world.
 * Shapes normalise their numbers by a power of two (build_unit) so that squares and products neither overflow nor
 * vanish: data in units of s, place = scale(s) then b->place. Exact, so pictures do not change under powers of two. */
void build_prim(ShapeBuild *b, const void *data, const Affine *place, Bounds local);

/* The power of two s with size / s in [1, 2); 1 for 0, infinities and NaN. */
double build_unit(double size);

/* b->place preceded by a scale of s. */
Affine build_place(const ShapeBuild *b, double s);

/* For a SHAPE_SHARED shape whose data turn out to depend on where it stands: the place of this copy, unit included. The data
 * are then this copy's alone. */
Affine build_own_place(ShapeBuild *b);

/* An index for Surface.texture: this texture, moved by `place` since it was attached, then by the object. */
uint32_t build_texture(ShapeBuild *b, const Texture *texture, const Affine *place);

#endif
