/* penumbra.c - an area light behind opaque things: each of its samples is lit or dark.
 *
 * So a sample is one bit, and the mean of four a matter of how many are lit. Up to four samples are asked at once, at a glance; those
 * that it leaves open are looked at closely, by the arithmetic of single rays. */
#include "trace/area.h"
#include "world/glance.h"

enum { ASKED_MAX = 5 };

typedef struct Penumbra {
    const Area *a;
    Tracer *t;
    int columns;
    Ray ray;                                   /* starts as those to the samples do */
    uint32_t stamp;                            /* of samples that are known, and 1 if they are lit */
    bool round;                                /* the grid is a disc */
    bool deep;                                 /* lit and dark ones differ */
    bool veiled;                               /* a sample is neither: all is in vain */
    int n;                                     /* samples to be asked, in the order in which they draw chance */
    uint32_t *sample[ASKED_MAX];
    double u[ASKED_MAX + FAN_RAYS], v[ASKED_MAX + FAN_RAYS];   /* area_cell of each; the rest is room */
    f4 to_s, to_r, middle;                     /* cells are numbers of a Sight times this, off by the middle */
    Rgb share[5];                              /* the mean of four, by the number of lit ones */
    Glance glance;
} Penumbra;

/* ---- four samples at a time ---- */

/* As area_sample_place, for a grid of more than one row and column. */
static Vec3s places_of(const Area *a, const double *u, const double *v)
{
    const LightSource *def = a->light->def;
    d4 middle = d4_set(area_middle(def)), zero = d4_set(0);
    d4 s = d4_sub(d4_div(d4_load(u), d4_set(def->size1 - 1)), middle);
    d4 r = d4_sub(d4_div(d4_load(v), d4_set(def->size2 - 1)), middle);
    if (def->circular || def->orient) {
        d4 distance = d4_sqrt(d4_add(d4_mul(s, s), d4_mul(r, r)));
        d4 g = d4_max(d4_div(d4_max(d4_abs(s), d4_abs(r)), distance), zero);   /* 0 / 0 gives 0 */
        s = d4_mul(s, g);
        r = d4_mul(r, g);
    }
    Vec3s on1 = vec3s_scaled(vec3s_set(a->axes.axis1), s), on2 = vec3s_scaled(vec3s_set(a->axes.axis2), r);
    return vec3s_add(vec3s_set(a->light->location), vec3s_add(on1, on2));
}

/* Rays as light_towards and shadow_walk make them where they have no choice. */
static Fan fan_to(const Penumbra *p, Vec3s from)
{
    Vec3s v = vec3s_sub(from, vec3s_set(p->a->spot->p));
    d4 d = d4_sqrt(vec3s_dot(v, v));
    return (Fan){ p->ray.o, p->ray.t_min, vec3s_scaled(v, d4_div(d4_set(1), d)), d4_mul(d, d4_set(LIGHT_END)) };
}

__attribute__((noinline)) static uint32_t look_closely(Penumbra *p, int first, uint32_t rays)
{
    const Area *a = p->a;
    Fan fan = fan_to(p, places_of(a, &p->u[first], &p->v[first]));
    uint32_t veiled, hidden = shaft_hides(p->t->world, a->among, &fan, rays, &veiled);
    p->veiled |= (veiled & ~hidden) != 0;
    return hidden;
}

static inline f4 singles(const double *x)      /* stored one by one: not to be read at once */
{
    return f4_of((float)x[0], (float)x[1], (float)x[2], (float)x[3]);
}

static uint32_t look_at_four(Penumbra *p, int first, uint32_t rays)
{
    f4 s = f4_sub(f4_mul(singles(&p->u[first]), p->to_s), p->middle), r = f4_sub(f4_mul(singles(&p->v[first]), p->to_r), p->middle);
    if (p->round) {
        f4 distance = f4_sqrt(f4_add(f4_mul(s, s), f4_mul(r, r))), g = f4_div(f4_max(f4_abs(s), f4_abs(r)), distance);
        s = f4_mul(s, g);
        r = f4_mul(r, g);
    }
    uint32_t clear, hidden = glance_hides(&p->glance, s, r, rays, &clear), open = rays & ~(hidden | clear);
    return open != 0 ? hidden | look_closely(p, first, open) : hidden;
}

static inline void ask(Penumbra *p, uint32_t *sample, int u, int v)
{
    if ((*sample ^ p->stamp) <= 1)
        return;
    Vec2 cell = area_cell(p->t, p->a->light->def, u, v);
    *sample = p->stamp;
    p->u[p->n] = cell.u;
    p->v[p->n] = cell.v;
    p->sample[p->n++] = sample;
}

static void see(Penumbra *p)
{
    for (int first = 0; first < p->n; first += FAN_RAYS) {
        int n = p->n - first < FAN_RAYS ? p->n - first : FAN_RAYS;
        uint32_t hidden = look_at_four(p, first, (1u << n) - 1);
        for (int i = 0; i < n; i++)
            *p->sample[first + i] |= ~hidden >> i & 1;
    }
    p->n = 0;
}

/* ---- their mean ---- */

static inline Rgb mean(const Penumbra *p, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    return p->share[(a & 1) + (b & 1) + (c & 1) + (d & 1)];
}

/* Three by three samples, the corners known: the quarters ask for the middle and the middles of the sides, in this order, and have
 * nothing left to divide. */
static Rgb mean_of_nine(Penumbra *p, int u, int v)
{
    uint32_t *low = p->t->lit + u * p->columns + v, *middle = low + p->columns, *high = middle + p->columns;
    ask(p, &middle[0], u + 1, v);
    ask(p, &low[1], u, v + 1);
    ask(p, &middle[1], u + 1, v + 1);
    ask(p, &high[1], u + 2, v + 1);
    ask(p, &middle[2], u + 1, v + 2);
    see(p);
    return area_mean_of(mean(p, low[0], middle[0], low[1], middle[1]), mean(p, middle[0], high[0], middle[1], high[1]),
                        mean(p, low[1], middle[1], low[2], middle[2]), mean(p, middle[1], high[1], middle[2], high[2]));
}

/* As area.c has it for samples of any colour. */
static Rgb mean_within(Penumbra *p, int u1, int v1, int u2, int v2, int level)
{
    uint32_t *low = p->t->lit + u1 * p->columns, *high = p->t->lit + u2 * p->columns;
    ask(p, &low[v1], u1, v1);
    ask(p, &high[v1], u2, v1);
    ask(p, &low[v2], u1, v2);
    ask(p, &high[v2], u2, v2);
    see(p);
    unsigned n = (low[v1] & 1) + (high[v1] & 1) + (low[v2] & 1) + (high[v2] & 1);
    bool divide = (u2 - u1 > 1 || v2 - v1 > 1) && (level < p->a->light->def->adaptive || (p->deep && n % 4 != 0));
    if (!divide || p->veiled)
        return p->share[n];
    if (u2 - u1 == 2 && v2 - v1 == 2)
        return mean_of_nine(p, u1, v1);
    int ul = (u1 + u2) / 2, uh = (u1 + u2 + 1) / 2, vl = (v1 + v2) / 2, vh = (v1 + v2 + 1) / 2;
    Rgb a = mean_within(p, u1, v1, ul, vl, level + 1), b = mean_within(p, uh, v1, u2, vl, level + 1);
    Rgb c = mean_within(p, u1, vh, ul, v2, level + 1), d = mean_within(p, uh, vh, u2, v2, level + 1);
    return area_mean_of(a, b, c, d);
}

static uint32_t next_stamp(Tracer *t)
{
    t->lit_stamp += 2;
    if (t->lit_stamp == 0) {
        memset(t->lit, 0, t->tracing->n_area_samples * sizeof t->lit[0]);
        t->lit_stamp = 2;
    }
    return t->lit_stamp;
}

bool penumbra_mean(const Area *a, Rgb *out)
{
    const Spot *spot = a->spot;
    const LightSource *def = a->light->def;
    Tracer *t = spot->t;
    if (def->size1 < 2 || def->size2 < 2 || shadow_dims(t, a->light))
        return false;
    Penumbra p;                                /* not cleared: room for many bodies */
    Rgb dark = rgb_grey(0);
    p.a = a;
    p.t = t;
    p.columns = def->size2;
    p.ray = shadow_ray(spot, a->l, 0);
    p.stamp = next_stamp(t);
    p.deep = area_differ(a->colour, dark);
    p.veiled = false;
    p.n = 0;
    p.round = def->circular || def->orient;
    p.to_s = f4_set(1 / (float)(def->size1 - 1));
    p.to_r = f4_set(1 / (float)(def->size2 - 1));
    p.middle = f4_set((float)area_middle(def));
    memset(p.u, 0, sizeof p.u);
    memset(p.v, 0, sizeof p.v);
    for (int i = 0; i <= 4; i++)
        p.share[i] = area_mean_of(i > 0 ? a->colour : dark, i > 1 ? a->colour : dark, i > 2 ? a->colour : dark, i > 3 ? a->colour : dark);
    Sight sight = { p.ray.o, sub(a->light->location, spot->p), a->axes.axis1, a->axes.axis2 };
    glance_start(&p.glance, t->world, a->among, &sight);
    Streams before = t->chance;
    *out = mean_within(&p, 0, 0, def->size1 - 1, def->size2 - 1, 0);
    if (p.veiled)
        t->chance = before;
    return !p.veiled;
}
