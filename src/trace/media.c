/* media.c - light on its way through dust, smoke and glow (05-global-effects, section 2).
 *
 * A stretch of a ray is cut where lights begin and end to reach it, the pieces into intervals, and each interval is sampled: how
 * much light is lost there, and how much comes in. Lengths are world units; the numbers of media count per scene unit. */
#include "math/chi_square.h"
#include "trace/path.h"

enum { CLOUDS_MAX = 32,                        /* media at one place; more are not seen */
       DENSITIES_MAX = 8 };                    /* of a medium, with which one does not go on when the product is known to be 0 */

typedef struct Cloud {
    const Media *media;
    const Affine *place;                       /* NULL: identity */
    Rgb lost;                                  /* of light, at a density of 1 */
} Cloud;

typedef struct Matter { Rgb extinction, emission, scattering; } Matter;        /* of media at one place */

typedef struct Stretch {
    Tracer *t;
    Vec3 o, d;
    double length;
    const Interiors *in;                       /* NULL: only extinction is wanted */
    const Material *lit_for;
    Cloud cloud[CLOUDS_MAX];
    uint32_t n;
    const Media *ruling;                       /* whose numbers of samples count */
    const double *threshold;                   /* of its adaptive sampling, by count */
    float aa_threshold;
    bool scatters;
    bool even;                                 /* no densities: the same matter everywhere */
    Matter matter;                             /* at a density of 1 */
    uint32_t n_light_spans;
} Stretch;

typedef struct Part {                          /* an interval */
    double from, length;
    bool lit;
} Part;

typedef struct Sample { Rgb light, depth; } Sample;

/* ---- what is there ---- */

static const Matter NOTHING = { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 } };

static inline void matter_add(Matter *to, const Media *m, Rgb lost, Rgb density)
{
    to->extinction = rgb_add(to->extinction, rgb_mul(density, lost));
    to->emission = rgb_add(to->emission, rgb_mul(density, m->emission));
    to->scattering = rgb_add(to->scattering, rgb_mul(density, m->scattering.colour));
}

static void add_cloud(Stretch *s, const Media *media, const Affine *place)
{
    if (s->n == CLOUDS_MAX)
        return;
    Rgb lost = rgb_add(media->absorption, rgb_scaled(media->scattering.colour, media->scattering.extinction));
    s->cloud[s->n++] = (Cloud){ media, place, lost };
    matter_add(&s->matter, media, lost, rgb_grey(1));
    if (s->ruling == NULL || media->intervals > s->ruling->intervals)
        s->ruling = media;
    s->aa_threshold = s->n == 1 ? media->aa_threshold : fminf(s->aa_threshold, media->aa_threshold);
    s->even = s->even && media->n_density == 0;
    s->scatters = s->scatters || (media->scattering.type != 0 && !rgb_is_zero(media->scattering.colour));
}

static void add_bodies(Stretch *s, const Interiors *in)
{
    const World *w = s->t->world;
    for (uint32_t i = 0; i < in->n; i++) {
        const PlacedInterior *body = &w->interior[in->at[i]];
        for (uint32_t k = 0; k < body->interior->n_media; k++)
            add_cloud(s, &body->interior->media[k], body->place);
    }
}

/* The last one is asked first, which often is the shape that the others fill: where it is 0, they are not asked. */
static __attribute__((noinline)) Rgb density_product(const Media *m, const Vec3 *p)
{
    uint32_t n = m->n_density, i = n;
    Rgb factor[DENSITIES_MAX], density = rgb_grey(1);
    while (i > 0 && n <= DENSITIES_MAX) {
        i--;
        factor[i] = rgb_of(pigment_colour_at(m->density[i], p, NULL, NULL));
        if (rgb_is_zero(factor[i]))
            return rgb_grey(0);
    }
    for (i = 0; i < n; i++)
        density = rgb_mul(density, n <= DENSITIES_MAX ? factor[i] : rgb_of(pigment_colour_at(m->density[i], p, NULL, NULL)));
    return density;
}

static inline Rgb density_at(const Media *m, const Vec3 *p)
{
    if (m->n_density == 1)
        return rgb_of(pigment_colour_at(m->density[0], p, NULL, NULL));
    return m->n_density == 0 ? rgb_grey(1) : density_product(m, p);
}

static Matter matter_at(const Stretch *s, Vec3 p)
{
    Matter all = NOTHING;
    Vec3 local = p;
    const Affine *place = NULL;
    for (uint32_t i = 0; i < s->n; i++) {
        const Cloud *c = &s->cloud[i];
        if (c->place != place) {
            place = c->place;
            local = place != NULL ? affine_point_back(place, p) : p;
        }
        matter_add(&all, c->media, c->lost, density_at(c->media, &local));
    }
    return all;
}

/* How much of light from `l` goes on along the ray; alpha is 1 when one looks into the light. */
static double phase(const Scattering *s, double alpha)
{
    double e = (double)s->eccentricity;
    switch (s->type) {
    case 2: return 0.576655375 * (1 + 9 * pow((1 + alpha) / 2, 8));
    case 3: return 0.495714547 * (1 + 50 * pow((1 + alpha) / 2, 32));
    case 4: return 0.799372013 * (1 + alpha * alpha);
    case 5: return (1 - e * e) / pow(1 + e * e - 2 * e * alpha, 1.5);
    default: return 1;
    }
}

/* POV: the mean over all media, those that do not scatter included. */
static double mean_phase(const Stretch *s, Vec3 l)
{
    double sum = 0;
    for (uint32_t i = 0; i < s->n; i++)
        sum += phase(&s->cloud[i].media->scattering, dot(l, s->d));
    return sum / s->n;
}

static Rgb light_at(const Stretch *s, Vec3 p, double at)
{
    const World *w = s->t->world;
    Rgb sum = rgb_grey(0);
    Spot spot = { .t = s->t, .p = p, .in = s->in };
    for (uint32_t i = 0; i < s->n_light_spans; i++) {
        const LightSpan *span = &s->t->light_span[i];
        const Light *light = &w->light[span->light];
        Beam beam;
        if (at < span->from || at > span->to || !light_beam(light, &light->location, &spot.p, light->colour, &beam))
            continue;
        light_shadowed(&spot, span->light, &beam);
        if (!rgb_is_zero(beam.colour))
            sum = rgb_add(sum, rgb_scaled(beam.colour, (float)mean_phase(s, beam.l)));
    }
    return sum;
}

static Rgb dimmed(Rgb depth)
{
    if (depth[0] == depth[1] && depth[1] == depth[2])      /* often grey, and clear to begin with */
        return rgb_grey(expf(-depth[0]));
    return rgb(expf(-depth[0]), expf(-depth[1]), expf(-depth[2]));
}

/* At a fraction of the part. `faded`: the light is dimmed by what lies before it in the part. */
static Sample sample(const Stretch *s, const Part *part, double fraction, bool faded)
{
    double at = part->from + fraction * part->length, to_scene = s->t->tracing->to_scene;
    Vec3 p = add(s->o, scaled(s->d, at));
    Matter m = s->even ? s->matter : matter_at(s, scaled(p, to_scene));
    float length = (float)(part->length * to_scene);
    Sample out = { rgb_grey(0), rgb_scaled(m.extinction, length) };
    if (s->in == NULL)
        return out;
    Rgb light = m.emission;
    if (s->scatters && part->lit)
        light = rgb_add(light, rgb_mul(m.scattering, light_at(s, p, at)));
    out.light = rgb_scaled(light, length);
    if (faded)
        out.light = rgb_mul(out.light, dimmed(rgb_scaled(out.depth, (float)fraction)));
    return out;
}

/* ---- sampling one interval ---- */

typedef struct Sums { Rgb light, light2, depth; float n; } Sums;

static void sums_add(Sums *sums, Sample x)
{
    sums->light = rgb_add(sums->light, x.light);
    sums->light2 = rgb_add(sums->light2, rgb_mul(x.light, x.light));
    sums->depth = rgb_add(sums->depth, x.depth);
    sums->n++;
}

static double chance(const Stretch *s)
{
    return streams_media(&s->t->chance);
}

static bool unsettled(const Stretch *s, const Sums *sums)
{
    Rgb mean = rgb_scaled(sums->light, 1 / sums->n);
    Rgb variance = rgb_scaled(rgb_sub(rgb_scaled(sums->light2, 1 / sums->n), rgb_mul(mean, mean)), 1 / sums->n);
    return (double)rgb_max(variance) >= s->threshold[(int)sums->n];
}

/* Methods 1 and 2: at random, or evenly with jitter; then more at random until it is sure enough. */
static Sums sample_scattered(const Stretch *s, const Part *part, int samples)
{
    const Media *m = s->ruling;
    Sums sums = { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 }, 0 };
    for (int j = 0; j < samples; j++) {
        double at;
        if (m->method == 2)
            at = (j + 0.5) / samples + (m->jitter != 0 ? (double)m->jitter * chance(s) / samples : 0);
        else
            at = chance(s);
        sums_add(&sums, sample(s, part, at, true));
    }
    if (s->in != NULL && s->threshold != NULL)
        while ((int)sums.n <= m->samples_max && unsettled(s, &sums))
            sums_add(&sums, sample(s, part, chance(s), true));
    return sums;
}

static Sample thirds(Sample near, Sample middle)
{
    return (Sample){ rgb_add(rgb_scaled(near.light, 1.0f / 3), rgb_scaled(middle.light, 1.0f / 6)),
                     rgb_add(rgb_scaled(near.depth, 1.0f / 3), rgb_scaled(middle.depth, 1.0f / 6)) };
}

static Sample sample_sum(Sample a, Sample b)
{
    return (Sample){ rgb_add(a.light, b.light), rgb_add(a.depth, b.depth) };
}

static Sample sample_scaled(Sample a, float by)
{
    return (Sample){ rgb_scaled(a.light, by), rgb_scaled(a.depth, by) };
}

static bool apart(const Stretch *s, Sample a, Sample b)
{
    Rgb d = rgb_sub(a.light, b.light);
    return fabsf(d[0]) + fabsf(d[1]) + fabsf(d[2]) > s->aa_threshold;
}

static Sample refine(const Stretch *s, const Part *part, double from, Sample first, double to, Sample last, int depth)
{
    double middle = (from + to) / 2;
    if (s->ruling->jitter != 0)
        middle += (double)s->ruling->jitter * (to - from) * (chance(s) - 0.5);
    Sample mid = sample(s, part, middle, false);
    if (depth <= 0)
        return sample_scaled(sample_sum(sample_sum(first, mid), last), 1.0f / 3);
    Sample left = apart(s, first, mid) ? sample_scaled(refine(s, part, from, first, middle, mid, depth - 1), 0.5f)
                                       : thirds(first, mid);
    Sample right = apart(s, mid, last) ? sample_scaled(refine(s, part, middle, mid, to, last, depth - 1), 0.5f)
                                       : thirds(last, mid);
    return sample_sum(left, right);
}

/* Method 3. POV: the last step of each interval is never walked. */
static Sums sample_adaptively(const Stretch *s, const Part *part)
{
    const Media *m = s->ruling;
    int steps = m->samples_min / 2 + 1 > 2 ? m->samples_min / 2 + 1 : 2;
    double step = 1.0 / (steps + 1);
    Sums sums = { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 }, (float)steps };
    double from = m->jitter != 0 ? step * (double)m->jitter * (chance(s) - 0.5) : 0;
    Sample first = sample(s, part, from, false);
    for (int j = 1; j <= steps; j++) {
        double to = j * step + (m->jitter != 0 ? step * (double)m->jitter * (chance(s) - 0.5) : 0);
        Sample last = sample(s, part, to, false);
        Sample x = refine(s, part, from, first, to, last, m->aa_level - 1);
        Rgb before = dimmed(rgb_scaled(sums.depth, 1 / (float)steps));
        sums.light = rgb_add(sums.light, rgb_mul(x.light, before));
        sums.depth = rgb_add(sums.depth, x.depth);
        from = to;
        first = last;
    }
    return sums;
}

/* POV: taken for the same everywhere if the density written last is, whatever stands before it. */
static bool constant(const Media *m)
{
    return m->n_density == 0 || m->density[m->n_density - 1]->kind == PIGMENT_PLAIN;
}

static bool all_constant(const Stretch *s)
{
    for (uint32_t i = 0; i < s->n; i++)
        if (!constant(s->cloud[i].media))
            return false;
    return true;
}

static Sums sample_part(const Stretch *s, const Part *part)
{
    if (s->in == NULL && all_constant(s)) {    /* one place tells all */
        Sums sums = { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 }, 0 };
        sums_add(&sums, sample(s, part, chance(s), true));
        return sums;
    }
    if (s->ruling->method == 3)
        return sample_adaptively(s, part);
    return sample_scattered(s, part, s->ruling->samples_min);
}

/* ---- where lights reach ---- */

static const double FAR_OFF = 0x1p-30;         /* relative to what was added up */

static bool in_reach(const Light *light, Vec3 v)
{
    double k = dot(v, light->axis);
    if (light->def->kind == LIGHT_SPOT)
        return k > 0 && k >= light->falloff * length(v);
    return k > 0 && length(sub(v, scaled(light->axis, k))) <= light->falloff;
}

static void add_root(double t, double length, double *root, int *n)
{
    if (t > 0 && t < length)
        root[(*n)++] = t;
}

/* a t^2 + 2 b t + c: above 0 where v + t d is nearer to the axis than the falloff says; for spots, also behind them. */
typedef struct Within { double a, b, c, disc, v2; } Within;

static Within within_falloff(const Light *light, Vec3 v, Vec3 d, double vk, double dk)
{
    Within w = { .v2 = dot(v, v) };
    double f2 = light->falloff * light->falloff;
    if (light->def->kind == LIGHT_SPOT) {
        w.a = dk * dk - f2 * dot(d, d);
        w.b = dk * vk - f2 * dot(v, d);
        w.c = vk * vk - f2 * w.v2;
    } else {
        w.a = dk * dk - dot(d, d);
        w.b = vk * dk - dot(v, d);
        w.c = f2 - (w.v2 - vk * vk);
    }
    w.disc = w.b * w.b - w.a * w.c;
    return w;
}

/* Surely, whatever is rounded: most rays pass most spots far off. */
static bool never_within(const Within *w)
{
    return w->disc < -FAR_OFF * (w->b * w->b + fabs(w->a * w->c)) && w->c < -FAR_OFF * w->v2 && w->a < -FAR_OFF;
}

/* Where the ray crosses the falloff or passes the light. */
static int reach_ends(const Within *w, double vk, double dk, double length, double *root)
{
    int n = 0;
    if (dk != 0)
        add_root(-vk / dk, length, root, &n);
    if (w->disc > 0) {
        double q = w->b > 0 ? -w->b - sqrt(w->disc) : -w->b + sqrt(w->disc);
        if (w->a != 0)
            add_root(q / w->a, length, root, &n);
        if (q != 0)
            add_root(w->c / q, length, root, &n);
    }
    return n;
}

static void sort(double *x, int n)
{
    for (int i = 1; i < n; i++)
        for (int j = i; j > 0 && x[j] < x[j - 1]; j--) {
            double t = x[j];
            x[j] = x[j - 1];
            x[j - 1] = t;
        }
}

/* The reach of a light is convex: one span at most. */
static bool light_span(const Stretch *s, const Light *light, double *from, double *to)
{
    *from = 0;
    *to = s->length;
    if (light->def->kind == LIGHT_POINT || (light->def->kind == LIGHT_SPOT && light->falloff <= 0))
        return true;
    Vec3 v = sub(s->o, light->location);
    double vk = dot(v, light->axis), dk = dot(s->d, light->axis), end[5] = { 0 };
    Within within = within_falloff(light, v, s->d, vk, dk);
    if (never_within(&within))
        return false;
    int n = 1 + reach_ends(&within, vk, dk, s->length, end + 1);
    end[n++] = s->length;
    sort(end, n);
    bool found = false;
    for (int i = 0; i + 1 < n; i++)
        if (in_reach(light, add(v, scaled(s->d, (end[i] + end[i + 1]) / 2)))) {
            if (!found)
                *from = end[i];
            *to = end[i + 1];
            found = true;
        }
    return found;
}

static void add_light(Stretch *s, uint32_t index)
{
    const Light *light = &s->t->world->light[index];
    LightSpan span = { .light = index };
    if (!light->def->shadowless && light->def->media_interaction && light_span(s, light, &span.from, &span.to))
        s->t->light_span[s->n_light_spans++] = span;
}

static void add_lights(Stretch *s)
{
    const World *w = s->t->world;
    if (s->lit_for == NULL || !(s->lit_for->flags & MATERIAL_NO_GLOBAL_LIGHTS))
        for (uint32_t i = 0; i < w->n_global_lights; i++)
            add_light(s, i);
    if (s->lit_for != NULL)
        for (uint32_t i = 0; i < s->lit_for->n_group_lights; i++)
            add_light(s, w->group_light[s->lit_for->first_group_light + i]);
}

/* Lit and dark spans by turns, from the union of what the lights reach. */
static uint32_t cut(const Stretch *s)
{
    MediaSpan *span = s->t->media_span;
    uint32_t n = 0;
    double at = 0;
    while (at < s->length) {
        double begin = s->length, end = at;
        for (uint32_t i = 0; i < s->n_light_spans; i++) {      /* the first to begin, ... */
            const LightSpan *l = &s->t->light_span[i];
            if (l->to > at && l->from < begin)
                begin = fmax(l->from, at);
        }
        end = begin;
        for (uint32_t i = 0; i < s->n_light_spans; i++)        /* ... as far as others carry on */
            for (uint32_t k = 0; k < s->n_light_spans; k++)
                if (s->t->light_span[k].from <= end && s->t->light_span[k].to > end)
                    end = s->t->light_span[k].to;
        if (begin > at)
            span[n++] = (MediaSpan){ at, begin, false };
        if (end > begin)
            span[n++] = (MediaSpan){ begin, end, true };
        at = end > at ? end : s->length;
    }
    return n;
}

/* ---- a whole stretch ---- */

typedef struct Haze { Rgb light, depth; } Haze;

static void through_span(const Stretch *s, const MediaSpan *span, int parts, Haze *haze)
{
    for (int i = 0; i < parts; i++) {
        double length = (span->to - span->from) / parts;
        Part part = { span->from + i * length, length, span->lit };
        Sums sums = sample_part(s, &part);
        haze->light = rgb_add(haze->light, rgb_mul(rgb_scaled(sums.light, 1 / sums.n), dimmed(haze->depth)));
        haze->depth = rgb_add(haze->depth, rgb_scaled(sums.depth, 1 / sums.n));
    }
}

static Haze through(Stretch *s)
{
    Haze haze = { { 0, 0, 0 }, { 0, 0, 0 } };
    int intervals = s->ruling->intervals;
    s->threshold = tracing_media_threshold(s->t->tracing, s->ruling);
    if (s->in != NULL)
        add_lights(s);
    uint32_t n = s->n_light_spans > 0 ? cut(s) : 0;
    if (n <= 1) {
        MediaSpan whole = { 0, s->length, n == 1 && s->t->media_span[0].lit };
        through_span(s, &whole, !whole.lit && constant(s->ruling) ? 1 : intervals, &haze);
        return haze;
    }
    int all = intervals > (int)n ? intervals : (int)n, left = all;
    double ratio = (double)s->ruling->ratio, sum = 0;
    for (uint32_t i = 0; i < n; i++)
        sum += s->t->media_span[i].lit ? ratio : 1 - ratio;
    for (uint32_t i = 0; i < n; i++) {
        MediaSpan span = s->t->media_span[i];
        int parts = (int)((span.lit ? ratio : 1 - ratio) / sum * all) + 1;
        int most = left - (int)(n - i - 1);
        if (parts > most)
            parts = most;
        left -= parts;
        through_span(s, &span, parts, &haze);
    }
    return haze;
}

static Colour seen_through(Haze haze, Colour c)
{
    Rgb pass = dimmed(haze.depth);
    Rgb seen = rgb_add(rgb_mul(rgb_of(c), pass), haze.light);
    return colour_of(seen, c.f, c.t * rgb_greyness(pass));
}

static void stretch_start(Stretch *s, Tracer *t, Vec3 o, Vec3 d, double depth, const Interiors *in)
{
    s->t = t;
    s->o = o;
    s->d = d;
    s->length = depth;
    s->in = in;
    s->lit_for = NULL;
    s->n = 0;
    s->ruling = NULL;
    s->scatters = false;
    s->even = true;
    s->matter = NOTHING;
    s->n_light_spans = 0;
}

static void add_air(Stretch *s)
{
    const Scene *scene = s->t->world->scene;
    for (uint32_t i = 0; i < scene->n_media; i++)
        add_cloud(s, scene->media[i], NULL);
}

Colour media_air(Tracer *t, const Path *path, double depth, Colour c)
{
    Stretch s;
    stretch_start(&s, t, path->ray.o, path->ray.d, depth, path->in);
    add_air(&s);
    return s.n > 0 ? seen_through(through(&s), c) : c;
}

Colour media_bodies(Tracer *t, const Path *path, const Material *lit_for, double depth, Colour c)
{
    if (path->ticket->bounces > 0 && !t->world->globals.radiosity.media)
        return c;
    if (path->in->n == 0 || !interiors_hollow(t->world, path->in))
        return c;
    Stretch s;
    stretch_start(&s, t, path->ray.o, path->ray.d, depth, path->in);
    s.lit_for = lit_for;
    add_bodies(&s, path->in);
    return s.n > 0 ? seen_through(through(&s), c) : c;
}

/* What extinction leaves of light. Where all is even, one number of the stream is drawn all the same. */
static Rgb left_by(Stretch *s)
{
    if (s->n == 0)
        return rgb_grey(1);
    if (!s->even)
        return dimmed(through(s).depth);
    (void)chance(s);
    return dimmed(rgb_scaled(s->matter.extinction, (float)(s->length * s->t->tracing->to_scene)));
}

Rgb media_dims_air(Tracer *t, Vec3 o, Vec3 d, double depth)
{
    Stretch s;
    stretch_start(&s, t, o, d, depth, NULL);
    add_air(&s);
    return left_by(&s);
}

Rgb media_dims_bodies(Tracer *t, const Interiors *in, Vec3 o, Vec3 d, double depth)
{
    if (in->n == 0 || !interiors_hollow(t->world, in))
        return rgb_grey(1);
    Stretch s;
    stretch_start(&s, t, o, d, depth, NULL);
    add_bodies(&s, in);
    return left_by(&s);
}
