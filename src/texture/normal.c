/* normal.c - perturbing surface normals (07-textures, section 5).
 *
 * A normal is carried into the space of its pattern through the transforms of the chain, perturbed there, and carried back.
 * Warps and turbulence move points only. */
#include "texture/texture.h"

#include <stdlib.h>

#include "image/image.h"
#include "math/noise.h"
#include "pattern/pattern.h"
#include "scene/image_map.h"
#include "texture/carry.h"
#include "texture/map.h"
#include "texture/sample.h"

/* POV: lengths below this count as none. */
static const double TINY = 1e-10;

/* The four directions along which a pattern is differentiated: corners of a tetrahedron. */
static const Vec3 corner[4] = {
    { 0.942809041, -0.333333333, 0 }, { -0.471404521, -0.333333333, 0.816496581 },
    { -0.471404521, -0.333333333, -0.816496581 }, { 0, 1, 0 }
};

/* ---- patterns as heights ---- */

static double slope_height(const BlendMap *map, double v)
{
    MapSpot spot = map_find(map->entry, map->n, v);
    double h1 = (double)spot.to->slope.height;
    if (spot.from == NULL)
        return h1;
    double h0 = (double)spot.from->slope.height, s0 = (double)spot.from->slope.slope, s1 = (double)spot.to->slope.slope, t = spot.t;
    return t * t * t * (s0 + s1 + 2 * (h0 - h1)) - t * t * (2 * s0 + s1 + 3 * (h0 - h1)) + t * s0 + h0;
}

/* At all four corners; patterns that can answer for several points at once are asked so. */
static void heights(const Normal *normal, const Vec3 q[4], const TextureContext *at, double out[4])
{
    const Pattern *pattern = normal->pattern;
    if (pattern->ops->values != NULL)
        pattern_values(pattern, q, out, 4);
    else
        for (int i = 0; i < 4; i++)
            out[i] = pattern_value_at(pattern, q[i], at);
    if (normal->map.kind == MAP_SLOPE && normal->map.n > 0)
        for (int i = 0; i < 4; i++)
            out[i] = slope_height(&normal->map, out[i]);
}

static Vec3 by_gradient(const Normal *normal, Vec3 q, Vec3 n, const TextureContext *at)
{
    double d = (double)normal->accuracy, gain = -5 * (double)normal->amount * (0.02 / d), h[4];
    Vec3 there[4];
    for (int i = 0; i < 4; i++)
        there[i] = add(q, scaled(corner[i], d));
    heights(normal, there, at, h);
    for (int i = 0; i < 4; i++)
        n = add(n, scaled(corner[i], gain * h[i]));
    return n;
}

static Vec3 by_pattern(const Normal *normal, Vec3 q, Vec3 n, const TextureContext *at)
{
    const Pattern *pattern = normal->pattern;
    const PatternOps *ops = pattern->ops;
    if (ops == NULL)
        return n;
    if (ops->bump == NULL)
        return by_gradient(normal, q, n, at);
    PatternPoint point = { .p = q, .pattern = pattern, .context = at };
    return ops->bump(pattern->params, &point, n, (double)normal->amount);
}

/* ---- facets ---- */

/* POV: metric 1 sums the differences without their absolute values. */
static double facet_distance(Vec3 d, double metric)
{
    if (metric == 2)
        return length2(d);
    if (metric == 1)
        return d.x + d.y + d.z;
    return pow(fabs(d.x), metric) + pow(fabs(d.y), metric) + pow(fabs(d.z), metric);
}

/* The nearest of the points that lie one in each cell round u. */
static Vec3 facet_point(Vec3 u, double metric)
{
    long long x = (long long)floor(u.x - TINY), y = (long long)floor(u.y - TINY), z = (long long)floor(u.z - TINY);
    Vec3 best = u;
    double nearest = INFINITY;
    for (int a = -2; a <= 2; a++)
        for (int b = -2; b <= 2; b++)
            for (int c = -2; c <= 2; c++) {
                if ((abs(a) == 2) + (abs(b) == 2) + (abs(c) == 2) > 1)
                    continue;
                unsigned k = noise_cell(x + a, y + b, z + c);
                Vec3 q = vec3((double)(x + a) + noise_random(k), (double)(y + b) + noise_random(k + 1),
                              (double)(z + c) + noise_random(k + 2));
                double distance = facet_distance(sub(q, u), metric);
                if (distance < nearest) {
                    nearest = distance;
                    best = q;
                }
            }
    return best;
}

static Vec3 by_facets(const Normal *normal, Vec3 q, Vec3 n)
{
    n = normalized(n);
    double size = normal->facets_size, c = normal->facets_coords;
    double scale = size < 1e-6 ? 1e6 : 1 / size;
    Vec3 u = scaled(c != 0 ? q : n, scale);
    if (!(max_abs(u) < 1e15))                  /* cells are no longer told apart there */
        return n;
    Vec3 point = facet_point(u, normal->facets_metric);
    if (c == 0)
        return point;
    Vec3 d = noise_vector(&point);
    return add(n, scaled(sub(d, scaled(n, dot(d, n))), c));
}

/* ---- bump maps ---- */

static double bump_height(const Normal *normal, ImageSpot at)
{
    const ImageMap *map = normal->image;
    if (map->use_index && map->image->indexed)
        return (double)normal->amount * image_sample_index(map, at);
    Colour c = image_sample(map, at);
    return (double)normal->amount * (0.297 * (double)c.r + 0.589 * (double)c.g + 0.114 * (double)c.b);
}

static Vec3 by_bump_map(const Normal *normal, Vec3 q, Vec3 n)
{
    ImageSpot spot;
    if (!image_spot(normal->image, q, &spot))
        return n;
    /* The step is one pixel, whatever the scale of the map. */
    Vec3 p1 = vec3(0, bump_height(normal, spot), 0);
    Vec3 p2 = vec3(-1, bump_height(normal, (ImageSpot){ spot.x - 1, spot.y + 1 }), 1);
    Vec3 p3 = vec3(1, bump_height(normal, (ImageSpot){ spot.x + 1, spot.y + 1 }), 1);
    Vec3 b = normalized(cross(sub(p3, p2), sub(p1, p2)));
    Vec3 y = n, x = cross(n, vec3(0, 1, 0));
    if (length(x) < TINY) {
        x = vec3(1, 0, 0);
        y = vec3(0, fabs(n.y - 1) < TINY ? 1 : -1, 0);
    } else {
        x = normalized(x);
    }
    Vec3 z = normalized(cross(x, y));
    return sub(add(scaled(x, b.x), scaled(y, b.y)), scaled(z, b.z));
}

/* ---- maps of normals ---- */

static Vec3 perturb(const Normal *normal, const Affine *place, Vec3 p, Vec3 n, bool keep_length, const TextureContext *at);

static Vec3 by_normal_map(const Normal *normal, Vec3 q, Vec3 n, bool keep_length, const TextureContext *at)
{
    MapSpot spot = map_find(normal->map.entry, normal->map.n, pattern_value_at(normal->pattern, q, at));
    Vec3 to = perturb(spot.to->normal, NULL, q, n, keep_length, at);
    if (spot.from == NULL)
        return to;
    Vec3 from = perturb(spot.from->normal, NULL, q, n, keep_length, at);
    return add(scaled(from, 1 - spot.t), scaled(to, spot.t));
}

static Vec3 by_average(const Normal *normal, Vec3 q, Vec3 n, bool keep_length, const TextureContext *at)
{
    double total = map_total(&normal->map);
    Vec3 sum = { 0, 0, 0 };
    for (uint32_t i = 0; i < normal->map.n; i++) {
        const MapEntry *e = &normal->map.entry[i];
        sum = add(sum, scaled(perturb(e->normal, NULL, q, n, keep_length, at), (double)e->key));
    }
    return total != 0 ? scaled(sum, 1 / total) : n;
}

static Vec3 inside_chain(const Normal *normal, Vec3 q, Vec3 n, bool keep_length, const TextureContext *at)
{
    switch (normal->kind) {
    case NORMAL_AVERAGE: return by_average(normal, q, n, keep_length, at);
    case NORMAL_BUMP_MAP: return by_bump_map(normal, q, n);
    case NORMAL_FACETS: return by_facets(normal, q, n);
    default:
        if (normal->map.kind == MAP_NORMAL && normal->map.n > 0)
            return by_normal_map(normal, q, n, keep_length, at);
        return by_pattern(normal, q, n, at);
    }
}

/* p went through `place` already, n did not. */
static Vec3 perturb(const Normal *normal, const Affine *place, Vec3 p, Vec3 n, bool keep_length, const TextureContext *at)
{
    if (normal->kind == NORMAL_UV) {           /* POV: no tangent frame; the world's z axis is the uv plane's */
        const Normal *inner = normal->map.entry[0].normal;
        return normalized(perturb(inner, NULL, vec3(at->uv.u, at->uv.v, 0), n, keep_length, at));
    }
    keep_length |= normal->no_bump_scale;
    const WarpChain *chain = &normal->pattern->chain;
    n = carry_in(place, chain, n, keep_length);
    n = inside_chain(normal, pattern_point(normal->pattern, p), n, keep_length, at);
    n = carry_out(place, chain, n, keep_length);
    /* POV: maps and lists of normals give unit vectors whatever no_bump_scale says; averages do not. */
    return keep_length && normal->kind == NORMAL_PATTERN && normal->map.kind == MAP_NORMAL ? normalized(n) : n;
}

static const TextureContext nowhere = { .quality = 9 };

Vec3 normal_perturb(const Normal *normal, Vec3 p, Vec3 n, const TextureContext *at)
{
    return perturb(normal, NULL, p, n, false, at != NULL ? at : &nowhere);
}

/* ---- layers ---- */

static Vec3 frames_in(const TextureFrame *f, Vec3 n)
{
    if (f == NULL)
        return n;
    n = frames_in(f->outer, n);                /* outermost first */
    return carry_in(f->place, f->pattern != NULL ? &f->pattern->chain : NULL, n, f->no_bump_scale);
}

static Vec3 frames_out(const TextureFrame *f, Vec3 n)
{
    for (; f != NULL; f = f->outer)
        n = carry_out(f->place, f->pattern != NULL ? &f->pattern->chain : NULL, n, f->no_bump_scale);
    return n;
}

Vec3 texture_layer_bumps(const TextureLeaf *leaf, const Texture *layer, Vec3 n, TextureContext *at)
{
    bool keep_length = layer->no_bump_scale || leaf->keep_length;
    Vec3 out = perturb(layer->normal, leaf->place, leaf->p, frames_in(leaf->frame, n), keep_length, at);
    at->normal = out;                          /* POV: what slope and aoi see is not yet carried out of the frames */
    if (keep_length || layer->normal->no_bump_scale)
        out = normalized(out);
    return frames_out(leaf->frame, out);       /* POV: of another length under frames with no_bump_scale */
}
