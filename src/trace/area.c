/* area.c - area lights: which samples are asked, and how they are weighed (04-shading, section 6.6).
 *
 * The rays to the samples of a light run side by side: what may stand in their way is looked up once, and mostly it is
 * little or nothing. Where it is something opaque, samples are lit or dark (penumbra.c). */
#include "trace/area.h"

/* ---- where samples are ---- */

static AreaAxes oriented(Vec3 l, double size)
{
    Vec3 e = fabs(fabs(l.z) - 1) < 0.01 ? vec3(0, 1, 0) : vec3(0, 0, 1);
    Vec3 axis1 = scaled(normalized(cross(l, e)), size);
    return (AreaAxes){ axis1, scaled(normalized(cross(l, axis1)), size) };
}

AreaAxes area_axes(const Light *light, Vec3 l)
{
    return light->def->orient ? oriented(l, length(light->axis1)) : (AreaAxes){ light->axis1, light->axis2 };
}

Vec3 area_sample_place(Tracer *t, const Light *light, const AreaAxes *axes, int u, int v)
{
    const LightSource *def = light->def;
    Vec2 cell = area_cell(t, def, u, v);
    double s = def->size1 > 1 ? cell.u / (def->size1 - 1) - area_middle(def) : 0;
    double r = def->size2 > 1 ? cell.v / (def->size2 - 1) - area_middle(def) : 0;
    if (def->circular || def->orient) {
        double distance = sqrt(s * s + r * r), a = fabs(s), b = fabs(r);
        double g = distance > 0 ? (a > b ? a : b) / distance : 0;
        s *= g;
        r *= g;
    }
    return add(scaled(axes->axis1, s), scaled(axes->axis2, r));
}

/* How many of the places first ... last along one axis are asked when all samples are the same: ends and middles down to
 * `levels` halvings. */
static uint32_t least_along(int first, int last, int levels)
{
    if (levels <= 0 || last - first <= 1)
        return last > first ? 2 : 1;
    int low = (first + last) / 2, high = (first + last + 1) / 2;
    return least_along(first, low, levels - 1) + least_along(high, last, levels - 1) - (low == high);
}

uint32_t area_least_samples(const LightSource *def)
{
    return least_along(0, def->size1 - 1, def->adaptive) * least_along(0, def->size2 - 1, def->adaptive);
}

/* ---- what lies between ---- */

/* How far samples lie along an axis of the light, in its lengths. */
static double reach_of(const LightSource *def, int size)
{
    double reach = size > 1 ? 0.501 : 0;
    return size > 1 && def->jitter ? reach + 0.5 / (size - 1) : reach;
}

static Window window_of_samples(const Area *a)
{
    const LightSource *def = a->light->def;
    return (Window){ a->light->location, scaled(a->axes.axis1, reach_of(def, def->size1)),
                     scaled(a->axes.axis2, reach_of(def, def->size2)) };
}

static Bounds bounds_of_window(const Window *window, double margin)
{
    Vec3 u = window->half1, v = window->half2;
    Vec3 half = vec3(fabs(u.x) + fabs(v.x) + margin, fabs(u.y) + fabs(v.y) + margin, fabs(u.z) + fabs(v.z) + margin);
    return (Bounds){ sub(window->middle, half), add(window->middle, half) };
}

/* The least slope of the rays to the samples over the surface for their start not to be in doubt. */
static const double CLEARLY_ABOVE = 0x1p-20;

typedef enum Between { BETWEEN_UNKNOWN, BETWEEN_SOME, BETWEEN_CLEAR, BETWEEN_DARK } Between;

/* Unknown if the rays to the samples do not all start on the same side of the surface, or do not lead to them. */
static Between look_between(const Area *a, Shaft *shaft)
{
    const Spot *spot = a->spot;
    const Light *light = a->light;
    const World *w = spot->t->world;
    if (light->def->parallel || light->def->kind == LIGHT_CYLINDER || light->projected_through != 0)
        return BETWEEN_UNKNOWN;
    const Surface *surface = spot->surface;
    Window window = window_of_samples(a);
    Bounds to = bounds_of_window(&window, 8 * (surface != NULL ? surface->error : 0));
    Vec3 o = spot->p, up = vec3(0, 0, 0);
    if (surface != NULL) {
        Vec3 g = surface->geometric, half = sub(to.hi, light->location), v = sub(light->location, spot->p);
        double slope = dot(g, v), doubt = fabs(g.x) * half.x + fabs(g.y) * half.y + fabs(g.z) * half.z;
        if (fabs(slope) <= doubt + CLEARLY_ABOVE * max_abs(v))
            return BETWEEN_UNKNOWN;
        o = surface_offset(surface, a->l);
        up = slope > 0 ? g : negated(g);
    }
    uint32_t *last = &spot->t->last_blocker[a->index], closer = *last - 1;
    if (*last != 0 && window_closed_by(w, o, &window, &closer, 1) != 0)
        return BETWEEN_DARK;
    world_shaft(w, o, to, PRIM_NO_SHADOW, shaft);
    if (shaft->crowded)
        return BETWEEN_UNKNOWN;
    shaft_narrow(w, o, &window, up, shaft);
    *last = 0;
    if (shaft->n == 0 && !shadow_dims(spot->t, light))
        return BETWEEN_CLEAR;
    *last = window_closed_by(w, o, &window, shaft->prim, shaft->n_opaque);
    return *last != 0 ? BETWEEN_DARK : BETWEEN_SOME;
}

/* ---- samples ---- */

static Rgb seen_from(const Area *a, Vec3 from)
{
    Beam beam;
    light_towards(a->light, &from, &a->spot->p, &beam);
    beam.colour = a->colour;
    shadow_walk(a->spot, a->index, &beam, a->among);
    return beam.colour;
}

static AreaSample *sample_at(const Area *a, int u, int v)
{
    return &a->spot->t->area[u * a->light->def->size2 + v];
}

static Vec3 place_of(const Area *a, int u, int v)
{
    return add(a->light->location, area_sample_place(a->spot->t, a->light, &a->axes, u, v));
}

static Rgb ask(const Area *a, AreaSample *sample, int u, int v)
{
    sample->colour = seen_from(a, place_of(a, u, v));
    sample->stamp = a->spot->t->area_stamp;
    return sample->colour;
}

/* POV: a sample counts as known by its red not being negative. Most are known: corners are shared. */
static inline bool is_known(const Area *a, const AreaSample *sample)
{
    return sample->stamp == a->spot->t->area_stamp && sample->colour[0] >= 0;
}

static inline Rgb area_sample(const Area *a, int u, int v)
{
    AreaSample *sample = sample_at(a, u, v);
    return is_known(a, sample) ? sample->colour : ask(a, sample, u, v);
}

/* ---- their mean ---- */

/* Surely: the fourth numbers have no meaning, but count. */
static inline bool are_same(Rgb a, Rgb b)
{
    typedef int64_t Halves __attribute__((vector_size(16)));
    Halves equal = (Halves)(a == b);
    return (equal[0] & equal[1]) == -1;
}

static bool corners_differ(const Rgb c[4])
{
    if (are_same(c[0], c[1]) && are_same(c[1], c[2]) && are_same(c[2], c[3]))
        return false;
    return area_differ(c[0], c[1]) || area_differ(c[1], c[3]) || area_differ(c[3], c[2]) || area_differ(c[2], c[0]);
}

static Rgb area_mean(const Area *a, int u1, int v1, int u2, int v2, int level)
{
    Rgb c[4];
    c[0] = area_sample(a, u1, v1);
    c[1] = area_sample(a, u2, v1);
    c[2] = area_sample(a, u1, v2);
    c[3] = area_sample(a, u2, v2);
    if ((u2 - u1 > 1 || v2 - v1 > 1) && (level < a->light->def->adaptive || corners_differ(c))) {
        int ul = (u1 + u2) / 2, uh = (u1 + u2 + 1) / 2, vl = (v1 + v2) / 2, vh = (v1 + v2 + 1) / 2;
        c[0] = area_mean(a, u1, v1, ul, vl, level + 1);
        c[1] = area_mean(a, uh, v1, u2, vl, level + 1);
        c[2] = area_mean(a, u1, vh, ul, v2, level + 1);
        c[3] = area_mean(a, uh, vh, u2, v2, level + 1);
    }
    return area_mean_of(c[0], c[1], c[2], c[3]);
}

static Rgb mean_of_all(const Area *a)
{
    const LightSource *def = a->light->def;
    a->spot->t->area_stamp++;
    return area_mean(a, 0, 0, def->size1 - 1, def->size2 - 1, 0);
}

/* All samples are the same, and so is their mean, exactly. They would have drawn from the stream, though. */
static Rgb mean_of_equals(const Area *a, Rgb colour)
{
    Tracer *t = a->spot->t;
    if (a->light->def->jitter)
        streams_skip(&t->chance, 2 * t->tracing->area_least[a->index]);
    return colour;
}

Rgb area_visible(const Spot *spot, uint32_t light, Rgb colour)
{
    const Light *source = &spot->t->world->light[light];
    Area a = { .spot = spot, .light = source, .index = light, .colour = colour };
    a.l = normalized(sub(source->location, spot->p));
    a.axes = area_axes(source, a.l);
    Shaft among;
    Between between = look_between(&a, &among);
    if (colour[0] >= 0 && between == BETWEEN_CLEAR)
        return mean_of_equals(&a, colour);
    if (between == BETWEEN_DARK)
        return mean_of_equals(&a, rgb_grey(0));
    if (between == BETWEEN_SOME) {
        a.among = &among;
        Rgb mean;
        if (colour[0] >= 0 && penumbra_mean(&a, &mean))
            return mean;
    }
    return mean_of_all(&a);
}
