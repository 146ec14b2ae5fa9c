/* pattern.h - chains of warps, and the value of a pattern at a point. */
#ifndef PATTERN_PATTERN_H
#define PATTERN_PATTERN_H

#include "pattern/context.h"
#include "scene/ops.h"

/* The whole chain, turbulence record included (07, section 3). */
Vec3 chain_apply(const WarpChain *chain, Vec3 p);
Vec3 chain_apply_warps(const WarpChain *chain, Vec3 p);                /* without that record */

/* Where the pattern, its map entries and its list items see p: the chain, without the turbulence record for patterns that use it in
 * their own formula alone (marble, wood). */
Vec3 pattern_point(const Pattern *pattern, Vec3 p);

/* At a point that went through pattern_point; after frequency, phase and wave. */
double pattern_value(const Pattern *pattern, Vec3 at, const TextureContext *context);

/* Both for n <= PATTERN_MANY points without a context, as functions ask them: what there is to find out about the pattern is found out
 * once. Same bits. */
void pattern_points(const Pattern *pattern, Vec3 *p, int n);
void pattern_values(const Pattern *pattern, const Vec3 *at, double *out, int n);

void chain_apply_many(const WarpChain *chain, Vec3 *p, int n, bool turbulence);        /* false: without that record */

/* Scalar turbulence U(p) of 06, section 4. */
double pattern_turbulence(const Turbulence *t, int noise_generator, Vec3 p);

#endif
