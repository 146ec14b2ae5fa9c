/* accel.h - the ways to find what a ray may meet; all give the same bits. */
#ifndef ACCEL_ACCEL_H
#define ACCEL_ACCEL_H

#include "world/world.h"

extern const AccelOps accel_list;              /* everything, one by one: the referee of every test */
extern const AccelOps accel_bvh;               /* a tree of boxes, eight to a node */

/* By name; NULL names the best. NULL if there is none of that name. */
const AccelOps *accel_find(const char *name);

#endif
