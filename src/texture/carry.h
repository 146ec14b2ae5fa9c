/* carry.h - normals through the transforms of a chain, inward and back (07-textures, section 5.1). */
#ifndef TEXTURE_CARRY_H
#define TEXTURE_CARRY_H

#include "texture/texture.h"

/* POV: a unit vector before the first transform and after the last. In between only the direction counts, so once is enough, and
 * not at all for what is of unit length anyway. */
static inline Vec3 carry_unit(Vec3 n)
{
    return fabs(length2(n) - 1) < 1e-14 ? n : normalized(n);
}

/* keep_length: no_bump_scale, the normal is not made a unit vector. */
static inline Vec3 carry_in(const Affine *place, const WarpChain *chain, Vec3 n, bool keep_length)
{
    if (place != NULL)
        n = affine_normal_back(place, n);
    for (uint32_t i = 0; chain != NULL && i < chain->n; i++)
        if (chain->warp[i].kind == WARP_TRANSFORM)
            n = affine_normal_back(&chain->warp[i].transform, n);
    return keep_length ? n : carry_unit(n);
}

static inline Vec3 carry_out(const Affine *place, const WarpChain *chain, Vec3 n, bool keep_length)
{
    for (uint32_t i = chain != NULL ? chain->n : 0; i-- > 0;)
        if (chain->warp[i].kind == WARP_TRANSFORM)
            n = affine_normal(&chain->warp[i].transform, n);
    if (place != NULL)
        n = affine_normal(place, n);
    return keep_length ? n : carry_unit(n);
}

#endif
