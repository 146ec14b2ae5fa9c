/* light.c - what lights give to one layer of a surface (04-shading, section 5).
 *
 * A light's share is its shadowed colour times a factor of surface and directions. The factor comes first: where it is 0 no
 * shadow ray flies. */
#include "trace/path.h"

/* ---- light without shadows ---- */

static double smooth_step(double low, double high, double x)
{
    if (x < low)
        return 0;
    if (x >= high)
        return 1;
    double f = (x - low) / (high - low);
    return (3 - 2 * f) * f * f;
}

static double spot_share(const Light *light, Vec3 l)
{
    double cosine = -dot(l, light->axis);
    if (cosine <= 0)
        return 0;
    double share = light->def->tightness != 0 ? pow(cosine, light->def->tightness) : 1;
    if (light->radius > 0 && cosine < light->radius)
        share *= smooth_step(light->falloff, light->radius, cosine);
    return share;
}

static double cylinder_share(const Light *light, Vec3 p)
{
    Vec3 v = sub(p, light->location);
    double k = dot(v, light->axis);
    if (k <= 0)
        return 0;
    double beside = length(sub(v, scaled(light->axis, k)));
    if (beside >= light->falloff)
        return 0;
    double x = 1 - beside / light->falloff;
    double share = light->def->tightness != 0 ? pow(x, light->def->tightness) : 1;
    if (light->radius > 0 && beside > light->radius)
        share *= smooth_step(0, 1 - light->radius / light->falloff, x);
    return share;
}

static double light_share(const Light *light, Vec3 p, Vec3 l, double d)
{
    double share = 1;
    if (light->def->kind == LIGHT_SPOT)
        share = spot_share(light, l);
    else if (light->def->kind == LIGHT_CYLINDER)
        share = cylinder_share(light, p);
    if (share > 0 && light->def->fade_power > 0 && light->fade_distance != 0)
        share *= 2 / (1 + pow(d / fabs(light->fade_distance), light->def->fade_power));
    return share;
}

static bool is_dark(Rgb c)
{
    return rgb_max_abs(c) < (float)TINY;
}

void light_towards(const Light *light, Vec3 from, Vec3 p, Beam *out)
{
    const LightSource *def = light->def;
    Vec3 v = sub(from, p);
    if (def->kind == LIGHT_CYLINDER) {
        out->l = normalized(sub(from, light->point_at));
        out->d = dot(v, out->l);
    } else {
        out->d = length(v);
        out->l = out->d > 0 ? scaled(v, 1 / out->d) : light->axis;
    }
    if (def->parallel || def->kind == LIGHT_CYLINDER) {
        Vec3 l = def->area ? normalized(sub(from, light->point_at)) : negated(light->axis);
        out->d *= dot(l, out->l);
        out->l = l;
    }
}

bool light_beam(const Light *light, Vec3 from, Vec3 p, Rgb colour, Beam *out)
{
    light_towards(light, from, p, out);
    out->colour = rgb_scaled(colour, (float)light_share(light, p, out->l, out->d));
    return !is_dark(out->colour);
}

/* ---- the surface's answer ---- */

/* Turns white highlights into ones of the surface's colour. */
static Rgb metallic_tint(float metallic, Rgb colour, double cosine)
{
    if (metallic == 0)
        return rgb_grey(1);
    float f = (float)finish_metallic_fresnel(cosine);
    return rgb_add(rgb_grey(1), rgb_scaled(rgb_sub(colour, rgb_grey(1)), metallic * (1 - f)));
}

static double phong(const Finish *f, Vec3 d, Vec3 n, Vec3 l)
{
    double k = dot(sub(d, scaled(n, 2 * dot(d, n))), l);
    if (k <= 0 || !(f->phong_size < 60 || k > 0.0008))
        return 0;
    return (double)f->phong * pow(k, (double)f->phong_size);
}

static double specular(const Finish *f, Vec3 d, Vec3 n, Vec3 l)
{
    Vec3 half = scaled(sub(l, d), 0.5);
    double size = length(half);
    double k = size > 0 ? dot(half, n) / size : 0;
    if (k <= 0)
        return 0;
    return (double)f->specular * pow(k, f->roughness != 0 ? 1 / (double)f->roughness : 0);
}

static double diffuse_strength(const Layer *layer, bool behind)
{
    return layer->finish->has_subsurface ? 0 : (double)(behind ? layer->finish->diffuse_back : layer->finish->diffuse);
}

/* The factor on light from l; `grain` is taken off the brightness. */
static Rgb answer(const Shade *s, const Layer *layer, const Light *light, Vec3 l, bool behind, double grain)
{
    const Finish *f = layer->finish;
    double cosine = dot(layer->n, l);
    Rgb sum = rgb_grey(0);
    double k = diffuse_strength(layer, behind);
    if (k > 0) {                               /* opacity may be negative: a colour with filter + transmit above 1 */
        double intensity = f->brilliance == 1 ? fabs(cosine) : pow(fabs(cosine), (double)f->brilliance);
        sum = rgb_scaled(layer->colour, (float)(intensity * k * layer->opacity - grain));
    }
    if (!light->def->shadowless && !behind && s->path->ticket->bounces == 0 && (f->phong > 0 || f->specular > 0)) {
        double shine = (f->phong > 0 ? phong(f, s->path->d, layer->n, l) : 0) +
                       (f->specular > 0 ? specular(f, s->path->d, layer->n, l) : 0);
        if (shine > 0)
            sum = rgb_add(sum, rgb_scaled(metallic_tint(f->metallic, layer->colour, cosine), (float)shine));
    }
    return sum;
}

static Rgb iridescence(const Shade *s, const Layer *layer, Vec3 l)
{
    if (!(layer->finish->irid > 0))
        return rgb_grey(1);
    return finish_iridescence(layer->finish, s->at.point, fabs(dot(layer->n, l)), fabs(dot(layer->n, s->path->d)),
                              s->t->world->globals.irid_wavelength, &s->at);
}

/* Does the light stand behind the surface? `lit`: does it give anything there? */
static bool stands_behind(const Shade *s, const Layer *layer, Vec3 l, bool *lit)
{
    *lit = true;
    if ((s->material->flags & MATERIAL_DOUBLE_ILLUMINATE) || dot(layer->n, l) >= TINY)
        return false;
    *lit = layer->finish->diffuse_back != 0;
    return true;
}

/* ---- the loop ---- */

Rgb light_shadowed(const Spot *spot, uint32_t index, const Beam *beam)
{
    const Light *light = &spot->t->world->light[index];
    int quality = spot->t->tracing->quality;
    if (quality < 4 || (light->def->shadowless && light->projected_through == 0))
        return beam->colour;
    return light->def->area && quality >= 5 && !spot->roughly ? area_visible(spot, index, beam->colour)
                                                               : shadow_walk(spot, index, beam, beam->colour, NULL);
}

/* Shadows fall alike on all layers of a hit. */
static Rgb shadowed(Shade *s, uint32_t index, const Beam *beam)
{
    bool remembered = index < LIGHTS_REMEMBERED && !s->t->world->light[index].grouped;
    if (remembered && (s->known >> index & 1))
        return s->light[index];
    Spot spot = { s->t, s->surface->p, s->surface, s->path->in, s->path->ticket->bounces > 0 };
    Rgb c = light_shadowed(&spot, index, beam);
    if (remembered) {
        s->known |= 1u << index;
        s->light[index] = c;
    }
    return c;
}

static double grain_of(Shade *s, const Layer *layer, bool behind)
{
    if (!(layer->finish->crand > 0) || !(diffuse_strength(layer, behind) > 0))
        return 0;
    return (double)layer->finish->crand * streams_crand(&s->t->chance);
}

/* Every sample shades on its own; shadows are averaged all the same. */
static Rgb illuminate_by_area(Shade *s, const Layer *layer, const Light *light, const Beam *centre, Rgb visible)
{
    Rgb sum = rgb_grey(0);
    int n1 = light->def->size1, n2 = light->def->size2;
    Rgb share = rgb_scaled(visible, 1 / (float)(n1 * n2));
    AreaAxes axes = area_axes(light, centre->l);
    for (int v = 0; v < n2; v++)
        for (int u = 0; u < n1; u++) {
            Beam beam;
            bool lit;
            Vec3 from = add(light->location, area_sample_place(s->t, light, &axes, u, v));
            if (!light_beam(light, from, s->surface->p, share, &beam))
                continue;
            bool behind = stands_behind(s, layer, beam.l, &lit);
            if (lit)
                sum = rgb_add(sum, rgb_mul(answer(s, layer, light, beam.l, behind, grain_of(s, layer, behind)), beam.colour));
        }
    return rgb_mul(sum, iridescence(s, layer, centre->l));
}

static Rgb shade_light(Shade *s, const Layer *layer, uint32_t index)
{
    const Light *light = &s->t->world->light[index];
    Beam beam;
    bool lit_by_area = light->def->area && light->def->area_illumination && s->t->tracing->quality >= 5 &&
                       s->path->ticket->bounces == 0;
    if (!light_beam(light, light->location, s->surface->p, light->colour, &beam) && !lit_by_area)
        return rgb_grey(0);
    if (lit_by_area) {
        beam.colour = light->colour;           /* each sample fades on its own */
        Rgb visible = shadowed(s, index, &beam);
        return is_dark(visible) ? rgb_grey(0) : illuminate_by_area(s, layer, light, &beam, visible);
    }
    bool lit, behind = stands_behind(s, layer, beam.l, &lit);
    if (!lit)
        return rgb_grey(0);
    bool grainy = layer->finish->crand > 0;
    Rgb factor = rgb_grey(0);
    if (!grainy) {
        factor = answer(s, layer, light, beam.l, behind, 0);
        if (rgb_is_zero(factor))
            return factor;
    }
    Rgb colour = shadowed(s, index, &beam);
    if (is_dark(colour))
        return rgb_grey(0);
    if (grainy)
        factor = answer(s, layer, light, beam.l, behind, grain_of(s, layer, behind));
    return rgb_mul(rgb_mul(factor, iridescence(s, layer, beam.l)), colour);
}

Rgb shade_lights(Shade *s, const Layer *layer)
{
    const Finish *f = layer->finish;
    Rgb sum = rgb_grey(0);
    if (s->t->vain && s->path->ticket->bounces == 0)
        return sum;
    if (f->diffuse == 0 && f->diffuse_back == 0 && f->specular == 0 && f->phong == 0)
        return sum;
    const World *w = s->t->world;
    const Material *m = s->material;
    if (!(m->flags & MATERIAL_NO_GLOBAL_LIGHTS))
        for (uint32_t i = 0; i < w->n_global_lights; i++)
            sum = rgb_add(sum, shade_light(s, layer, i));
    for (uint32_t i = 0; i < m->n_group_lights; i++)
        sum = rgb_add(sum, shade_light(s, layer, w->group_light[m->first_group_light + i]));
    return sum;
}
