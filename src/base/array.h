/* array.h - growable arrays on an arena.
 *
 *     ARRAY(Vec3) points = {0};
 *     array_push(arena, &points, p);          points.data[i], points.n
 *
 * Growth doubles and leaves the old copy to the arena: at most the final size is wasted. */
#ifndef BASE_ARRAY_H
#define BASE_ARRAY_H

#include "base/arena.h"

#define ARRAY(T) struct { T *data; uint32_t n, capacity; }

#define array_push(arena, array, ...) \
    ((array)->n == (array)->capacity \
         ? (void)((array)->data = array_grow((arena), (array)->data, (array)->n, &(array)->capacity, sizeof *(array)->data)) \
         : (void)0, \
     (array)->data[(array)->n++] = (__VA_ARGS__))

/* Room for at least one more than n items; n items are copied. */
void *array_grow(Arena *a, const void *data, uint32_t n, uint32_t *capacity, size_t size);

#endif
