/* bodies.h - Worlds for tests without a parser: three simple shapes, set operations, random scenes. */
#ifndef LIB_BODIES_H
#define LIB_BODIES_H

#include "scene/ops.h"
#include "world/world.h"

extern const ShapeOps body_ball, body_block, body_half;        /* ball is compiled per copy, block is SHAPE_SHARED */

/* Numbers that depend on the seed alone. */
typedef struct Dice { uint64_t state; } Dice;
double dice(Dice *d);                          /* [0, 1) */
double dice_between(Dice *d, double lo, double hi);
Vec3 dice_point(Dice *d, double size);         /* in the cube of half edge `size` */
Vec3 dice_direction(Dice *d);

const Object *ball(Arena *a, Vec3 centre, double radius);
const Object *block(Arena *a, Vec3 lo, Vec3 hi);
const Object *half_space(Arena *a, Vec3 normal, double distance);
const Object *combined(Arena *a, ObjectKind kind, uint32_t n, const Object *const *child);
const Object *combined2(Arena *a, ObjectKind kind, const Object *one, const Object *two);
const Object *inverted(Arena *a, const Object *o);
const Object *placed(Arena *a, const Object *o, Affine place);         /* with its clips */
const Object *clipped_to(Arena *a, const Object *o, const Object *clip);
const Object *bounded_to(Arena *a, const Object *o, const Object *bound);
const Object *flagged(Arena *a, const Object *o, uint32_t flags);
/* A random tree of set operations about as large as `size`. */
const Object *random_body(Arena *a, Dice *d, int depth, double size);

/* The World of these statements; its arena is a. */
World *world_of(Arena *a, uint32_t n, const Object *const *object, const char *accel);

Ray random_ray(Dice *d, double size);          /* from somewhere in twice the cube, unit length */

#endif
