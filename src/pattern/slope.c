/* slope.c - what depends on the surface: slope and aoi. Both are 0 where there is no surface. */
#include "pattern/context.h"
#include "pattern/wave.h"
#include "sdl/parse.h"

typedef struct {
    Vec3 direction;                            /* unit; or the point that is looked at */
    bool point_at;
    double low, range;                         /* range 0: none */
    Vec3 altitude;                             /* unit; weight 0: none */
    double altitude_low, altitude_range;
    double weight;                             /* of the slope beside the altitude; 1 without altitude */
} Slope;

static void parse_range(Parser *p, double *low, double *range)
{
    *low = parse_optional_float(p, 0);
    double high = parse_optional_float(p, 0);
    *range = high - *low;
    if (*range == 0 && (high != 0 || *low != 0)) {
        parse_warn(p, "Zero slope range; ignoring it.");
        *low = 0;
    }
}

static void parse(Parser *p, void *params)
{
    Slope s = { .weight = 1 };
    bool block = parse_accept(p, TOK_OPEN);
    s.point_at = block && parse_accept(p, KW_POINT_AT);
    Vec3 direction = parse_vec3(p);
    double strength = length(direction);
    s.direction = s.point_at ? direction : normalized(direction);
    if (block) {
        parse_range(p, &s.low, &s.range);
        if (parse_accept(p, KW_ALTITUDE)) {
            Vec3 altitude = parse_vec3(p);
            double n = length(altitude);
            if (n > 0) {
                s.altitude = normalized(altitude);
                s.weight = strength / (strength + n);
            }
            parse_range(p, &s.altitude_low, &s.altitude_range);
        }
        parse_close(p);
    }
    *(Slope *)params = s;
}

static double clipped(double v)
{
    return v < -1 ? -1 : v > 1 ? 1 : v;
}

static double wrapped(double v)
{
    return v < 0 ? 1 + fmod(v, 1) : fmod(v, 1);
}

static double slope(const void *params, const PatternPoint *at)
{
    const Slope *s = params;
    const TextureContext *hit = at->context;
    if (hit == NULL || !hit->hit)
        return 0;
    Vec3 direction = s->point_at ? normalized(sub(s->direction, hit->point)) : s->direction;
    double v = (2 * asin(clipped(dot(hit->normal, direction))) / PI + 1) / 2;
    if (s->range != 0)
        v = (v - s->low) / s->range;
    if (s->altitude.x == 0 && s->altitude.y == 0 && s->altitude.z == 0)
        return wrapped(v == 1 ? 1 - PATTERN_TINY : v);
    double high = dot(at->p, s->altitude);
    if (s->altitude_range != 0)
        high = (high - s->altitude_low) / s->altitude_range;
    v = s->weight * v + (1 - s->weight) * high;
    return wrapped(v >= 1 && v < 1 + PATTERN_TINY ? v - PATTERN_TINY : v);
}

static double aoi(const void *params, const PatternPoint *at)
{
    (void)params;
    const TextureContext *hit = at->context;
    return hit == NULL || !hit->hit ? 0 : acos(clipped(dot(normalized(hit->normal), hit->ray))) / PI;
}

const PatternOps pattern_slope = { .keyword = "slope", .params_size = sizeof(Slope), .parse = parse, .value = slope };
const PatternOps pattern_aoi = { .keyword = "aoi", .value = aoi };
