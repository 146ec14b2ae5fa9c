/* list.c - no acceleration: every item is offered to every ray. Slow, and right by construction: the referee. */
#include "accel/accel.h"

#include <string.h>

static void *build(Arena *a, const Bounds *boxes, uint32_t n)
{
    (void)boxes;
    uint32_t *count = arena_new(a, uint32_t);
    *count = n;
    return count;
}

static bool offer_all(const void *accel, AccelVisit *visit, void *user, double *t_max)
{
    uint32_t n = *(const uint32_t *)accel;
    for (uint32_t i = 0; i < n; i++)
        if (visit(user, i, t_max))
            return true;
    return false;
}

static bool walk(const void *accel, const Ray *ray, double *t_max, AccelVisit *visit, void *user)
{
    (void)ray;
    return offer_all(accel, visit, user, t_max);
}

static bool around(const void *accel, Vec3 p, AccelVisit *visit, void *user)
{
    (void)p;
    double t_max = INFINITY;
    return offer_all(accel, visit, user, &t_max);
}

static bool between(const void *accel, Vec3 o, Bounds to, AccelVisit *visit, void *user)
{
    (void)to;
    return around(accel, o, visit, user);
}

const AccelOps accel_list = { .name = "list", .build = build, .walk = walk, .around = around, .between = between };

const AccelOps *accel_find(const char *name)
{
    static const AccelOps *const rows[] = { &accel_bvh, &accel_list };
    if (name == NULL)
        return rows[0];
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (strcmp(rows[i]->name, name) == 0)
            return rows[i];
    return NULL;
}
