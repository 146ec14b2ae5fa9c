/* pattern.h - chains of warps, and the value of a pattern at a point. */
#ifndef PATTERN_PATTERN_H
#define PATTERN_PATTERN_H

#include "pattern/context.h"
#include "scene/ops.h"
#include "scene/texture.h"

static const double PATTERN_FAR = 1e17;        /* points beyond are moved here, axis by axis */

static inline bool pattern_reaches(Vec3 p) { return fabs(p.x) <= PATTERN_FAR && fabs(p.y) <= PATTERN_FAR && fabs(p.z) <= PATTERN_FAR; }

/* The whole chain (07, section 3), with or without its turbulence record; for one point or for many. */
void chain_apply(const WarpChain *chain, bool turbulence, const Vec3 *from, Vec3 *to);
void chain_apply_many(const WarpChain *chain, bool turbulence, Vec3 *p, int n);

static inline bool pattern_has_own_turbulence(const Pattern *pattern)
{
    return pattern->ops != NULL && (pattern->ops->flags & PATTERN_OWN_TURBULENCE);
}

/* Where the pattern, its map entries and its list items see p: the chain, without the turbulence record for patterns that use it in
 * their own formula alone (marble, wood). */
static inline void pattern_place(const Pattern *pattern, const Vec3 *p, Vec3 *out)
{
    const WarpChain *chain = &pattern->chain;
    if (chain->n == 0 && !chain->has_turbulence && pattern_reaches(*p))
        *out = *p;
    else
        chain_apply(chain, !pattern_has_own_turbulence(pattern), p, out);
}

static inline Vec3 pattern_point(const Pattern *pattern, Vec3 p)
{
    Vec3 out;
    pattern_place(pattern, &p, &out);
    return out;
}

/* At a point that went through pattern_point; after frequency, phase and wave. */
double pattern_value(const PatternPoint *at);
static inline double pattern_value_at(const Pattern *pattern, Vec3 p, const TextureContext *context)
{
    return pattern_value(&(PatternPoint){ p, pattern, context });
}

/* Both for n <= PATTERN_MANY points without a context, as functions ask them: what there is to find out about the pattern is found out
 * once. Same bits. */
void pattern_points(const Pattern *pattern, Vec3 *p, int n);
void pattern_values(const Pattern *pattern, const Vec3 *at, double *out, int n);

/* Scalar turbulence U(p) of 06, section 4. */
double pattern_turbulence(const Turbulence *t, int noise_generator, Vec3 p);

#endif
