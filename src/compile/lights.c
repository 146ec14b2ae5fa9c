/* lights.c - light sources brought to world space, and who is lit by which (08-shapes, section 10.8). */
#include "compile/context.h"

static Rgb light_colour(const LightSource *def)
{
    if (def->colour_map == NULL)
        return def->colour;
    Rgb sum = { 0 };
    for (uint32_t i = 0; i < def->colour_map->n; i++) {
        const MapEntry *e = &def->colour_map->entry[i];
        sum = rgb_add(sum, rgb_scaled(rgb_of(e->colour), e->key));
    }
    return sum;
}

void light_add(Compile *c, const Object *o, const Inherited *from, bool grouped)
{
    const LightSource *def = o->light;
    Affine in_scene = affine_then(affine_of(o->place), *from->place);
    Affine place = affine_then(in_scene, c->to_world);
    Light l = { .def = def, .location = affine_point(&place, def->location), .point_at = affine_point(&place, def->point_at),
                .axis1 = affine_vector(&place, def->axis1), .axis2 = affine_vector(&place, def->axis2),
                .colour = light_colour(def), .fade_distance = def->fade_distance * c->unit, .grouped = grouped };
    l.axis = normalized(sub(l.point_at, l.location));
    if (def->kind == LIGHT_SPOT) {
        l.radius = cos(def->radius * PI / 180);
        l.falloff = cos(def->falloff * PI / 180);
    } else {
        l.radius = def->radius * c->unit;
        l.falloff = def->falloff * c->unit;
    }
    uint32_t index = grouped ? c->group_light.n : c->global_light.n;
    if (grouped)
        array_push(c->arena, &c->group_light, l);
    else
        array_push(c->arena, &c->global_light, l);
    if (def->projected_through != NULL)
        array_push(c->arena, &c->screen, (Screen){ def->projected_through, in_scene, index, grouped });
}

/* `members` is what the group hands to its members: the lights written in its own block, and no global ones unless it and all
 * groups around it allow them. POV: groups neither inherit nor promote lights, and a light inside an inner union is global. */
void light_group(Compile *c, const Object *group, Inherited *members)
{
    members->lights_known = true;
    members->no_global_lights |= !(group->flags & OBJECT_GLOBAL_LIGHTS);
    members->first_group_light = c->group_list.n;
    for (uint32_t i = 0; i < group->n_child; i++)
        if (group->child[i]->kind == OBJECT_LIGHT) {
            array_push(c->arena, &c->group_list, c->group_light.n);
            light_add(c, group->child[i], members, true);
        }
    members->n_group_lights = c->group_list.n - members->first_group_light;
}

void lights_end(Compile *c)
{
    World *w = c->w;
    w->n_global_lights = c->global_light.n;
    w->n_lights = c->global_light.n + c->group_light.n;
    w->light = arena_array(c->arena, Light, w->n_lights);
    for (uint32_t i = 0; i < w->n_lights; i++)
        w->light[i] = i < w->n_global_lights ? c->global_light.data[i] : c->group_light.data[i - w->n_global_lights];
    w->group_light = c->group_list.data;
    w->n_group_lights = c->group_list.n;
    for (uint32_t i = 0; i < w->n_group_lights; i++)
        w->group_light[i] += w->n_global_lights;
    c->geometry_only = true;
    for (uint32_t i = 0; i < c->screen.n; i++) {
        const Screen *s = &c->screen.data[i];
        Inherited from = { .place = &s->place, .prim_flags = PRIM_HELPER };
        uint32_t item = flatten_whole(c, s->object, &from);
        if (item != NO_ITEM)
            w->light[s->light + (s->grouped ? w->n_global_lights : 0)].projected_through = item + 1;
    }
    c->geometry_only = false;
}
