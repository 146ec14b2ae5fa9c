/* area.c - area lights: which samples are asked, and how they are weighed (04-shading, section 6.6).
 *
 * The rays to the samples of a light run side by side: what may stand in their way is looked up once, and mostly it is
 * little or nothing. */
#include "trace/path.h"

/* Axes of an oriented light: it always faces the point it lights. */
static void orient(Vec3 l, double size, Vec3 *axis1, Vec3 *axis2)
{
    Vec3 e = fabs(fabs(l.z) - 1) < 0.01 ? vec3(0, 1, 0) : vec3(0, 0, 1);
    *axis1 = scaled(normalized(cross(l, e)), size);
    *axis2 = scaled(normalized(cross(l, *axis1)), size);
}

/* Displacement from the light's place. l: from the surface to the light's centre. */
Vec3 area_sample_place(Tracer *t, const Light *light, Vec3 l, int u, int v)
{
    const LightSource *def = light->def;
    Vec3 axis1 = light->axis1, axis2 = light->axis2;
    double x = u, y = v;
    if (def->jitter) {
        x += streams_uniform(&t->chance) - 0.5;
        y += streams_uniform(&t->chance) - 0.5;
    }
    if (def->orient)
        orient(l, length(light->axis1), &axis1, &axis2);
    double middle = def->circular || def->orient ? 0.499 : 0.5;    /* POV: off by a little, so that it is never 0 */
    double s = def->size1 > 1 ? x / (def->size1 - 1) - middle : 0;
    double r = def->size2 > 1 ? y / (def->size2 - 1) - middle : 0;
    if (def->circular || def->orient) {
        double distance = sqrt(s * s + r * r);
        double g = distance > 0 ? fmax(fabs(s), fabs(r)) / distance : 0;
        s *= g;
        r *= g;
    }
    return add(scaled(axis1, s), scaled(axis2, r));
}

typedef struct Area {
    const Spot *spot;
    uint32_t light;
    Vec3 l;
    Rgb colour;
    const Shaft *among;                        /* what may hide samples; NULL: not known */
    bool clear;                                /* all samples reach the surface as they are */
} Area;

/* ---- what lies between ---- */

/* How far samples lie along an axis of the light, in its lengths. */
static double reach_of(const LightSource *def, int size)
{
    double reach = size > 1 ? 0.501 : 0;
    return size > 1 && def->jitter ? reach + 0.5 / (size - 1) : reach;
}

static Bounds bounds_of_samples(const Light *light, double margin)
{
    double r1 = reach_of(light->def, light->def->size1), r2 = reach_of(light->def, light->def->size2);
    Vec3 a = scaled(light->axis1, r1), b = scaled(light->axis2, r2);
    Vec3 half = vec3(fabs(a.x) + fabs(b.x), fabs(a.y) + fabs(b.y), fabs(a.z) + fabs(b.z));
    if (light->def->orient) {                  /* it turns, with the length of its first axis for both */
        double most = length(light->axis1) * (r1 + r2);
        half = vec3(most, most, most);
    }
    half = add(half, vec3(margin, margin, margin));
    return (Bounds){ sub(light->location, half), add(light->location, half) };
}

/* Fails if the rays to the samples do not all start on the same side of the surface, or do not lead to them. */
static bool look_between(const Area *a, Shaft *out)
{
    const Spot *spot = a->spot;
    const Light *light = &spot->t->world->light[a->light];
    if (light->def->parallel || light->def->kind == LIGHT_CYLINDER || light->projected_through != 0)
        return false;
    const Surface *surface = spot->surface;
    Bounds to = bounds_of_samples(light, 8 * (surface != NULL ? surface->error : 0));
    if (surface != NULL) {
        Vec3 g = surface->geometric, half = sub(to.hi, light->location);
        double across = dot(g, sub(light->location, spot->p));
        if (fabs(across) <= fabs(g.x) * half.x + fabs(g.y) * half.y + fabs(g.z) * half.z)
            return false;
    }
    world_shaft(spot->t->world, surface != NULL ? surface_offset(surface, a->l) : spot->p, to, PRIM_NO_SHADOW, out);
    return !out->crowded;
}

/* ---- samples ---- */

/* POV: a sample counts as known by its red not being negative. */
static Rgb area_sample(const Area *a, int u, int v)
{
    Tracer *t = a->spot->t;
    const Light *light = &t->world->light[a->light];
    AreaSample *known = &t->area[u * light->def->size2 + v];
    if (known->stamp == t->area_stamp && known->colour.r >= 0)
        return known->colour;
    Vec3 from = add(light->location, area_sample_place(t, light, a->l, u, v));
    known->colour = a->colour;
    if (!a->clear) {
        Beam beam;
        light_beam(light, from, a->spot->p, a->colour, &beam);
        known->colour = shadow_walk(a->spot, a->light, &beam, a->colour, a->among);
    }
    known->stamp = t->area_stamp;
    return known->colour;
}

static float apart(Rgb a, Rgb b)
{
    return fabsf(a.r - b.r) + fabsf(a.g - b.g) + fabsf(a.b - b.b);
}

static bool corners_differ(const Rgb c[4])
{
    return apart(c[0], c[1]) > 0.1f || apart(c[1], c[3]) > 0.1f || apart(c[3], c[2]) > 0.1f || apart(c[2], c[0]) > 0.1f;
}

static Rgb area_mean(const Area *a, int u1, int v1, int u2, int v2, int level)
{
    Rgb c[4] = { area_sample(a, u1, v1) };
    c[1] = area_sample(a, u2, v1);
    c[2] = area_sample(a, u1, v2);
    c[3] = area_sample(a, u2, v2);
    if ((u2 - u1 > 1 || v2 - v1 > 1) &&
        (level < a->spot->t->world->light[a->light].def->adaptive || corners_differ(c))) {
        int ul = (u1 + u2) / 2, uh = (u1 + u2 + 1) / 2, vl = (v1 + v2) / 2, vh = (v1 + v2 + 1) / 2;
        c[0] = area_mean(a, u1, v1, ul, vl, level + 1);
        c[1] = area_mean(a, uh, v1, u2, vl, level + 1);
        c[2] = area_mean(a, u1, vh, ul, v2, level + 1);
        c[3] = area_mean(a, uh, vh, u2, v2, level + 1);
    }
    return rgb_scaled(rgb_add(rgb_add(c[0], c[1]), rgb_add(c[2], c[3])), 0.25f);
}

Rgb area_visible(const Spot *spot, uint32_t light, Rgb colour)
{
    const Light *source = &spot->t->world->light[light];
    spot->t->area_stamp++;
    Area a = { .spot = spot, .light = light, .l = normalized(sub(source->location, spot->p)), .colour = colour };
    Shaft among;
    if (look_between(&a, &among)) {
        a.among = &among;
        a.clear = among.n == 0 && !shadow_dims(spot->t);
        if (a.clear && !source->def->jitter)
            return colour;                     /* the mean of equals, exactly */
    }
    return area_mean(&a, 0, 0, source->def->size1 - 1, source->def->size2 - 1, 0);
}
