/* brick.c - bricks in mortar, every second row shifted by half a brick. */
#include "pattern/map.h"
#include "pattern/wave.h"
#include "sdl/parse.h"

typedef struct { Vec3 size; float mortar; } Brick;

static const MapEntry map[] = { MAP_RGB(0, 0.5f, 0.5f, 0.5f), MAP_RGB(1, 0.6f, 0.15f, 0.15f) };

static float stored(double mortar)
{
    return (float)(mortar - 2 * PATTERN_TINY);
}

static void parse(Parser *p, void *params)
{
    (void)p;
    *(Brick *)params = (Brick){ .size = { 8, 3, 4.5 }, .mortar = stored(0.5) };
}

static bool item(Parser *p, void *params)
{
    Brick *b = params;
    if (parse_accept(p, KW_BRICK_SIZE))
        b->size = parse_vec3(p);
    else if (parse_accept(p, KW_MORTAR))
        b->mortar = stored(parse_float(p));
    else
        return false;
    return true;
}

static double fraction(double a)
{
    a -= trunc(a);
    return a < 0 ? a + 1 : a;
}

static double value(const void *params, const PatternPoint *at)
{
    const Brick *b = params;
    double mortar = (double)b->mortar, shift = PATTERN_TINY + mortar;
    double x = (at->p.x + shift) / b->size.x, y = (at->p.y + shift) / b->size.y, z = (at->p.z + shift) / b->size.z;
    double mortar_x = mortar / b->size.x, mortar_z = mortar / b->size.z;
    if (fraction(y) <= mortar / b->size.y)
        return 0;
    bool lower = fraction(y * 0.5) <= 0.5;
    return fraction(lower ? x : x + 0.5) > mortar_x && fraction(lower ? z + 0.5 : z) > mortar_z;
}

const PatternOps pattern_brick = {
    .keyword = "brick", .params_size = sizeof(Brick), .flags = PATTERN_LIST | PATTERN_NO_WAVE, .n_items = 2, MAP_OF(map),
    .parse = parse, .item = item, .value = value,
};
