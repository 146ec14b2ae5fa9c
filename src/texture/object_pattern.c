/* object_pattern.c - object { O A, B }: the second item inside of O, the first outside.
 *
 * O is compiled alone, while the scene is parsed, into a small World that is only asked for insides. */
#include "pattern/map.h"
#include "sdl/parse.h"
#include "world/prim.h"

typedef struct Params {
    const World *world;                        /* NULL: nothing is inside */
    uint32_t item;
} Params;

/* The list of items stands inside the same braces; who reads the list closes them. */
static void parse(Parser *p, void *params)
{
    parse_open(p);
    const Object *o = parse_object(p);
    if (o == NULL)
        parse_fail(p, "the object pattern needs an object here");
    parse_comma(p);
    Params *own = params;
    own->world = parse_world_of(p, o, &own->item);
}

static double value(const void *params, const PatternPoint *at)
{
    const Params *own = params;
    return own->world != NULL && item_inside(own->world, own->item, scaled(at->p, own->world->unit));
}

static const MapEntry map[] = { MAP_RGB(0, 0, 0, 1), MAP_RGB(1, 0, 1, 0) };

const PatternOps pattern_object = {
    .keyword = "object", .params_size = sizeof(Params), .flags = PATTERN_LIST | PATTERN_NO_WAVE, .n_items = 2, .parse = parse,
    .value = value, MAP_OF(map),
};
