/* object_pattern.c - object { O A, B }: the second item inside of O, the first outside.
 *
 * O is compiled alone, while the scene is parsed, into a small World that is only asked for insides. */
#include "sdl/parse.h"
#include "world/prim.h"

typedef struct Params {
    const World *world;
} Params;

/* The list of items stands inside the same braces; who reads the list closes them. */
static void parse(Parser *p, void *params)
{
    parse_open(p);
    const Object *o = parse_object(p);
    if (o == NULL)
        parse_fail(p, "the object pattern needs an object here");
    parse_comma(p);
    ((Params *)params)->world = parse_world_of(p, o);
}

static double value(const void *params, const PatternPoint *at)
{
    const World *w = ((const Params *)params)->world;
    Vec3 p = scaled(at->p, w->unit);
    for (uint32_t i = 0; i < w->n_bodies; i++)
        if (item_inside(w, w->body[i], p))
            return 1;
    return 0;
}

const PatternOps pattern_object = {
    .keyword = "object", .params_size = sizeof(Params), .flags = PATTERN_LIST | PATTERN_NO_WAVE, .n_items = 2, .parse = parse,
    .value = value,
};
