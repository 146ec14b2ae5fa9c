/* slice.h - the box of an endless shape between planes that need not stand along the axes of the world. */
#ifndef COMPILE_SLICE_H
#define COMPILE_SLICE_H

#include "compile/polytope.h"
#include "world/world.h"

/* Around what lies in the prim's solid and in all n half spaces; everything if that is endless, or not easily said. */
Bounds slice_box(const Prim *prim, const HalfSpace *h, uint32_t n);

#endif
