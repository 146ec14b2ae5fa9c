/* slice.c - the cone of a wine glass that lies on its side is cut by planes that lie as it does: in the cone's own space they stand
 * along an axis again, but for rounding.
 *
 * A plane that is tilted by rounding bounds its axis by distance + tilt * (how far the slice reaches to the sides). How far, is
 * asked of a slice thousands of times as thick: what lies outside even that is further away than the tilt can reach. */
#include "compile/slice.h"

static const double TILT = 0x1p-44, THICK = 0x1p12, LOOSE = 0x1p-20;

typedef struct Sides {
    Bounds box;
    double size;                               /* the largest distance; 0: none, or all through the origin */
} Sides;

/* The half space as the prim's own space has it, if it stands along an axis there. */
static bool is_upright(HalfSpace *h, const Affine *place, int *axis)
{
    Vec3 n = affine_normal_back(place, h->normal);
    double distance = h->distance - dot(h->normal, affine_point(place, vec3(0, 0, 0))), size = length(n);
    if (!(size > 0))
        return false;
    n = scaled(n, 1 / size);
    *h = (HalfSpace){ n, distance / size };
    for (*axis = 0; *axis < 3; ++*axis) {
        Vec3 aside = n;
        vec3_set(&aside, *axis, 0);
        if (max_abs(aside) <= TILT)
            return true;
    }
    return false;
}

static void set_side(Bounds *box, HalfSpace h, int axis, double margin)
{
    if (vec3_at(h.normal, axis) > 0)
        vec3_set(&box->hi, axis, fmin(vec3_at(box->hi, axis), h.distance + margin));
    else
        vec3_set(&box->lo, axis, fmax(vec3_at(box->lo, axis), -h.distance - margin));
}

static double size_of_sides(const Affine *place, const HalfSpace *h, uint32_t n)
{
    double size = 0;
    for (uint32_t i = 0; i < n; i++) {
        HalfSpace local = h[i];
        int axis;
        if (is_upright(&local, place, &axis))
            size = fmax(size, fabs(local.distance));
    }
    return size;
}

static Bounds within_sides(const Prim *prim, const HalfSpace *h, uint32_t n, double margin)
{
    Bounds box = bounds_everything();
    for (uint32_t i = 0; i < n; i++) {
        HalfSpace local = h[i];
        int axis;
        if (is_upright(&local, prim->place, &axis))
            set_side(&box, local, axis, margin);
    }
    return prim->ops->within(prim->data, box);
}

Bounds slice_box(const Prim *prim, const HalfSpace *h, uint32_t n)
{
    double size = size_of_sides(prim->place, h, n);
    if (!(size > 0))
        return bounds_everything();
    Bounds thick = within_sides(prim, h, n, THICK * size);
    if (bounds_is_empty(thick) || !bounds_is_finite(thick) ||
        2 * TILT * fmax(max_abs(thick.lo), max_abs(thick.hi)) > LOOSE * size)
        return bounds_everything();
    Bounds thin = within_sides(prim, h, n, LOOSE * size);
    return bounds_is_empty(thin) ? bounds_everything() : bounds_transformed(thin, prim->place);
}
