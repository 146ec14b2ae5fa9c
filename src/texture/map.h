/* map.h - finding a value in a map of keys (07-textures, section 2). */
#ifndef TEXTURE_MAP_H
#define TEXTURE_MAP_H

#include "scene/texture.h"

/* One entry alone (`from` is NULL), or a blend: from + t (to - from). */
typedef struct MapSpot {
    const MapEntry *from, *to;
    double t;
} MapSpot;

/* Keys are in written order, perhaps not rising: the first one not below v counts. n > 0. */
static inline MapSpot map_find(const MapEntry *entry, uint32_t n, double v)
{
    if (v >= (double)entry[n - 1].key)
        return (MapSpot){ NULL, &entry[n - 1], 1 };
    uint32_t i = 0;
    while (i < n - 1 && !(v <= (double)entry[i].key))
        i++;
    if (i == 0 || v == (double)entry[i].key)
        return (MapSpot){ NULL, &entry[i], 1 };
    double low = (double)entry[i - 1].key, width = (double)entry[i].key - low;
    return (MapSpot){ &entry[i - 1], &entry[i], width == 1 ? v - low : (v - low) / width };    /* colours wait for a division */
}

/* A value of a list pattern is the number of its item. */
static inline double map_total(const BlendMap *map)
{
    double total = 0;
    for (uint32_t i = 0; i < map->n; i++)
        total += (double)map->entry[i].key;
    return total;
}

#endif
