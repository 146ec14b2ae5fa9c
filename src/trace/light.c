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

/* Along the straight line to a place of the light. */
static inline void aim(Beam *out, const Light *light, Vec3 v)
{
    out->d = length(v);
    out->l = out->d > 0 ? scaled(v, 1 / out->d) : light->axis;
}

bool light_is_plain(const Light *light)
{
    const LightSource *def = light->def;
    bool fades = def->fade_power > 0 && light->fade_distance != 0;
    return def->kind == LIGHT_POINT && !def->parallel && !fades && !is_dark(light->colour);
}

void light_towards(const Light *light, const Vec3 *from, const Vec3 *p, Beam *out)
{
    const LightSource *def = light->def;
    Vec3 v = sub(*from, *p);
    if (def->kind == LIGHT_CYLINDER) {
        out->l = normalized(sub(*from, light->point_at));
        out->d = dot(v, out->l);
    } else {
        aim(out, light, v);
    }
    if (def->parallel || def->kind == LIGHT_CYLINDER) {
        Vec3 l = def->area ? normalized(sub(*from, light->point_at)) : negated(light->axis);
        out->d *= dot(l, out->l);
        out->l = l;
    }
}

/* Surely, before roots and quotients: most spots shine elsewhere. */
static inline bool shines_elsewhere(const Light *light, Vec3 v)
{
    if (light->def->kind != LIGHT_SPOT || light->def->parallel || !(light->falloff > 0 && light->falloff <= light->radius))
        return false;
    double along = -dot(v, light->axis);
    return along < 0 || along * along < (1 - 0x1p-30) * light->falloff * light->falloff * length2(v);
}

/* The places are told by pointer: a copy would be loaded in pairs just after it was stored one by one, and wait. */
bool light_beam(const Light *light, const Vec3 *from, const Vec3 *p, Rgb colour, Beam *out)
{
    if (shines_elsewhere(light, sub(*from, *p)))
        return false;
    light_towards(light, from, p, out);
    out->colour = rgb_scaled(colour, (float)light_share(light, *p, out->l, out->d));
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

/* What is the same for all lights of a layer. */
typedef struct Gloss {
    bool any;
    bool alone;                                /* one highlight, of no more than a million: what fades away adds nothing */
    Vec3 mirrored;                             /* the ray; if there is phong */
    double sharpness;                          /* if there is specular */
} Gloss;

typedef struct Lit {                           /* a layer under all lights */
    Shade *s;
    const Layer *layer;
    const Vec3 *n;                             /* perturbed */
    Gloss gloss;
} Lit;

static inline void gloss_start(Gloss *g, const Shade *s, const Finish *f, const Vec3 *n)
{
    g->any = (f->traits & FINISH_GLOSSY) && (s->lamps & LAMP_SHINES);
    if (!g->any)
        return;
    g->alone = f->phong > 0 ? f->phong < 1e6f && !(f->specular > 0) : f->specular < 1e6f;
    if (f->phong > 0)
        g->mirrored = sub(s->path->ray.d, scaled(*n, 2 * dot(s->path->ray.d, *n)));
    if (f->specular > 0)
        g->sharpness = f->roughness != 0 ? 1 / (double)f->roughness : 0;
}

static const double FADED = 120;

/* Is k^power, 0 < k, sure to be less than any float but 0, even a million times? By ln k <= k - 1; spares sharp highlights, which
 * are black nearly everywhere, their power. */
static inline bool fades_away(double k, double power)
{
    return power * (1 - k) > FADED;
}

static double phong(const Finish *f, const Gloss *gloss, Vec3 l)
{
    double k = dot(gloss->mirrored, l);
    if (k <= 0 || !(f->phong_size < 60 || k > 0.0008) || (gloss->alone && fades_away(k, (double)f->phong_size)))
        return 0;
    return (double)f->phong * pow(k, (double)f->phong_size);
}

static double specular(const Finish *f, const Gloss *gloss, Vec3 d, Vec3 n, Vec3 l)
{
    Vec3 half = scaled(sub(l, d), 0.5);
    double k = dot(half, n), size2 = length2(half), dark = 1 - 1.001 * FADED * (double)f->roughness;
    if (k <= 0 || (gloss->alone && dark > 0 && dark < 1 && k * k < dark * dark * size2))
        return 0;                              /* faded away, by a wider margin: known without a root and a quotient */
    double size = sqrt(size2);
    if (!(size > 0))
        return 0;
    k /= size;
    return gloss->alone && fades_away(k, gloss->sharpness) ? 0 : (double)f->specular * pow(k, gloss->sharpness);
}

static inline double diffuse_strength(const Finish *f, bool behind)
{
    return f->has_subsurface ? 0 : (double)(behind ? f->diffuse_back : f->diffuse);
}

static Rgb highlight(const Lit *lit, const Vec3 *l, Rgb sum)
{
    const Layer *layer = lit->layer;
    const Finish *f = layer->finish;
    double shine = (f->phong > 0 ? phong(f, &lit->gloss, *l) : 0) +
                   (f->specular > 0 ? specular(f, &lit->gloss, lit->s->path->ray.d, *lit->n, *l) : 0);
    return shine > 0 ? rgb_add(sum, rgb_scaled(metallic_tint(f->metallic, layer->colour, dot(*lit->n, *l)), (float)shine)) : sum;
}

typedef struct Facing {                        /* how the surface stands to a light */
    double cosine;
    bool behind;                               /* the light is on the other side of it */
} Facing;

static inline Facing facing_of(const Lit *lit, const Vec3 *l)
{
    double cosine = dot(*lit->n, *l);
    return (Facing){ cosine, !(cosine >= TINY) && !(lit->s->material->flags & MATERIAL_DOUBLE_ILLUMINATE) };
}

static inline bool is_lit(const Lit *lit, Facing facing)
{
    return !facing.behind || lit->layer->finish->diffuse_back != 0;
}

/* The factor on light from l; `grain` is taken off the brightness. */
static inline Rgb answer(const Lit *lit, unsigned lamp, const Vec3 *l, Facing facing, double grain)
{
    const Layer *layer = lit->layer;
    const Finish *f = layer->finish;
    Rgb sum = rgb_grey(0);
    double k = diffuse_strength(f, facing.behind);
    if (k > 0 && (layer->opacity != 0 || grain != 0)) {  /* opacity may be negative: filter + transmit above 1 */
        double cosine = fabs(facing.cosine);
        double intensity = f->traits & FINISH_BRILLIANT ? pow(cosine, (double)f->brilliance) : cosine;
        sum = rgb_scaled(layer->colour, (float)(intensity * k * layer->opacity - grain));
    }
    return lit->gloss.any && (lamp & LAMP_SHINES) && !facing.behind ? highlight(lit, l, sum) : sum;
}

static Rgb film(const Lit *lit, const Vec3 *l)
{
    const Shade *s = lit->s;
    return finish_iridescence(lit->layer->finish, s->at.point, fabs(dot(*lit->n, *l)), fabs(dot(*lit->n, s->path->ray.d)),
                              s->t->world->globals.irid_wavelength, &s->at);
}

static inline Rgb iridescent(const Lit *lit, const Vec3 *l, Rgb light)
{
    return lit->layer->finish->traits & FINISH_FILM ? rgb_mul(light, film(lit, l)) : light;
}

/* ---- shadows ---- */

static inline bool after_shadows(const Spot *spot, uint32_t index, unsigned lamp, Beam *beam)
{
    if (!(lamp & LAMP_SHADED))
        return true;
    if (!(lamp & LAMP_AREA))
        return shadow_walk(spot, index, beam, NULL);
    beam->colour = area_visible(spot, index, beam->colour);
    return !is_dark(beam->colour);
}

bool light_shadowed(const Spot *spot, uint32_t index, Beam *beam)
{
    return after_shadows(spot, index, spot->t->tracing->lamp[index], beam);
}

__attribute__((noinline)) static bool shadowed_once(Shade *s, uint32_t index, unsigned lamp, Beam *beam)
{
    if (!(s->known >> index & 1)) {
        s->known |= 1u << index;
        after_shadows(&s->spot, index, lamp, beam);
        s->light[index] = beam->colour;
    }
    beam->colour = s->light[index];
    return !is_dark(beam->colour);
}

/* Shadows fall alike on all layers of a hit. */
static inline bool shadowed(Shade *s, uint32_t index, unsigned lamp, Beam *beam)
{
    return lamp & LAMP_REMEMBERED ? shadowed_once(s, index, lamp, beam) : after_shadows(&s->spot, index, lamp, beam);
}

/* ---- the loop ---- */

static double grain_of(const Lit *lit, Facing facing)
{
    const Finish *f = lit->layer->finish;
    return f->crand > 0 && diffuse_strength(f, facing.behind) > 0 ? (double)f->crand * streams_crand(&lit->s->t->chance) : 0;
}

/* Every sample shades on its own; shadows are averaged all the same. */
static Rgb illuminate_by_area(const Lit *lit, uint32_t index, unsigned lamp)
{
    Shade *s = lit->s;
    const Light *light = &s->t->world->light[index];
    Beam centre;
    light_towards(light, &light->location, &s->surface->p, &centre);
    centre.colour = light->colour;             /* each sample fades on its own */
    Rgb sum = rgb_grey(0);
    if (!shadowed(s, index, lamp, &centre))
        return sum;
    int n1 = light->def->size1, n2 = light->def->size2;
    Rgb share = rgb_scaled(centre.colour, 1 / (float)(n1 * n2));
    AreaAxes axes = area_axes(light, centre.l);
    for (int v = 0; v < n2; v++)
        for (int u = 0; u < n1; u++) {
            Beam beam;
            Vec3 from = add(light->location, area_sample_place(s->t, light, &axes, u, v));
            if (!light_beam(light, &from, &s->surface->p, share, &beam))
                continue;
            Facing facing = facing_of(lit, &beam.l);
            if (is_lit(lit, facing))
                sum = rgb_add(sum, rgb_mul(answer(lit, lamp, &beam.l, facing, grain_of(lit, facing)), beam.colour));
        }
    return iridescent(lit, &centre.l, sum);
}

/* Grain is drawn for what is lit only: after the shadow. */
static Rgb illuminate_grainy(const Lit *lit, uint32_t index, unsigned lamp, Beam *beam, Facing facing)
{
    if (!shadowed(lit->s, index, lamp, beam))
        return rgb_grey(0);
    Rgb factor = answer(lit, lamp, &beam->l, facing, grain_of(lit, facing));
    return rgb_mul(iridescent(lit, &beam->l, factor), beam->colour);
}

/* Less than this of a light can hardly be seen beside anything else. Shadows leave less than FAINT_MOST times a light (shadows_dim). */
static const float FAINT = 1e-8f, FAINT_MOST = 4;

static inline bool is_faint(Rgb c)
{
    return rgb_max(c) < FAINT && c[0] >= 0 && c[1] >= 0 && c[2] >= 0;
}

/* faint, if not NULL: what there may be on top of the result. */
__attribute__((always_inline)) static inline Rgb illuminate(const Lit *lit, uint32_t index, Rgb *faint)
{
    Shade *s = lit->s;
    const Light *light = &s->t->world->light[index];
    unsigned lamp = s->t->tracing->lamp[index] & s->lamps;
    if (lamp & LAMP_AREA_LIGHT)
        return illuminate_by_area(lit, index, lamp);
    Beam beam;
    if (lamp & LAMP_PLAIN) {
        aim(&beam, light, sub(light->location, s->surface->p));
        beam.colour = light->colour;
    } else if (!light_beam(light, &light->location, &s->surface->p, light->colour, &beam)) {
        return rgb_grey(0);
    }
    Facing facing = facing_of(lit, &beam.l);
    if (!is_lit(lit, facing))
        return rgb_grey(0);
    if (lit->layer->finish->traits & FINISH_GRAINY)
        return illuminate_grainy(lit, index, lamp, &beam, facing);
    Rgb factor = answer(lit, lamp, &beam.l, facing, 0);
    if (rgb_is_zero(factor))
        return rgb_grey(0);
    if (faint != NULL && (lamp & (LAMP_SHADED | LAMP_AREA)) == LAMP_SHADED && is_faint(rgb_mul(factor, beam.colour))) {
        *faint = rgb_scaled(rgb_mul(factor, beam.colour), FAINT_MOST);
        return rgb_grey(0);
    }
    if (!shadowed(s, index, lamp, &beam))
        return rgb_grey(0);
    return rgb_mul(iridescent(lit, &beam.l, factor), beam.colour);
}

static inline bool lit_start(Lit *lit, Shade *s, const Layer *layer, const Vec3 *n)
{
    if (!(layer->finish->traits & FINISH_LIT) || (s->t->vain && s->path->ticket->bounces == 0))
        return false;
    lit->s = s;
    lit->layer = layer;
    lit->n = n;
    gloss_start(&lit->gloss, s, layer->finish, n);
    return true;
}

Rgb shade_lights(Shade *s, const Layer *layer, const Vec3 *n)
{
    Rgb sum = rgb_grey(0);
    Lit lit;
    if (!lit_start(&lit, s, layer, n))
        return sum;
    const LightList *list = s->lit_by;
    for (uint32_t i = 0; i < list->n; i++)
        sum = rgb_add(sum, illuminate(&lit, list->light[i], NULL));
    return sum;
}

Rgb shade_lights_loosely(Shade *s, const Layer *layer, const Vec3 *n, Rgb *most)
{
    Rgb sum = rgb_grey(0);
    *most = sum;
    Lit lit;
    if (!lit_start(&lit, s, layer, n))
        return sum;
    const LightList *list = s->lit_by;
    for (uint32_t i = 0; i < list->n; i++) {
        Rgb faint = rgb_grey(0), light = illuminate(&lit, list->light[i], &faint);
        sum = rgb_add(sum, light);
        *most = rgb_add(*most, rgb_add(light, faint));
    }
    return sum;
}
