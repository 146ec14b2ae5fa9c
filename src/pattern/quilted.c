/* quilted.c - pillows over the unit cubes; two controls shape their profile. */
#include "pattern/wave.h"
#include "sdl/parse.h"

typedef struct { float control0, control1; } Quilted;

static void parse(Parser *p, void *params)
{
    (void)p;
    *(Quilted *)params = (Quilted){ 1, 1 };
}

static bool item(Parser *p, void *params)
{
    Quilted *q = params;
    if (parse_accept(p, KW_CONTROL0))
        q->control0 = (float)parse_float(p);
    else if (parse_accept(p, KW_CONTROL1))
        q->control1 = (float)parse_float(p);
    else
        return false;
    return true;
}

/* The place in the cube about its middle, and the strength there. */
static Vec3 pillow(const Quilted *q, Vec3 p, double *strength)
{
    Vec3 c = vec3(p.x - wave_floor(p.x) - 0.5, p.y - wave_floor(p.y) - 0.5, p.z - wave_floor(p.z) - 0.5);
    double t = length(c), i = 1 - t;
    *strength = 1.154700538 * (t * t * t + 3 * t * i * i * (double)q->control0 + 3 * t * t * i * (double)q->control1);
    return c;
}

static double value(const void *params, const PatternPoint *at)
{
    double strength;
    Vec3 c = pillow(params, at->p, &strength);
    return strength * (fabs(c.x) + fabs(c.y) + fabs(c.z)) / 3;
}

static Vec3 bump(const void *params, const PatternPoint *at, Vec3 normal, double amount)
{
    double strength;
    Vec3 c = pillow(params, at->p, &strength);
    return add(normal, scaled(c, amount * strength));
}

const PatternOps pattern_quilted = {
    .keyword = "quilted", .params_size = sizeof(Quilted), .flags = PATTERN_OWN_NORMAL | PATTERN_NO_WAVE, .parse = parse,
    .item = item, .value = value, .bump = bump,
};
