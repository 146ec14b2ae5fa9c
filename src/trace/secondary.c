/* secondary.c - the rays that leave a surface: mirrored and passed on (04-shading, section 8). */
#include "trace/path.h"

static const Colour BLACK = { 0, 0, 0, 0, 0 };         /* opaque: of rays not worth following */

static inline Vec3 mirrored(Vec3 d, Vec3 n)
{
    return sub(d, scaled(n, 2 * dot(d, n)));
}

/* Never below the surface that `raw` stands on. */
static inline Vec3 reflected(Vec3 d, Vec3 n, Vec3 raw)
{
    Vec3 r = mirrored(d, n);
    if (dot(r, raw) < 0)
        r = dot(r, n) < 0 ? mirrored(d, raw) : mirrored(r, raw);
    return normalized(r);
}

static Colour iridescent(const Shade *s, const Polish *polish, Vec3 d, Colour c)
{
    Rgb film = finish_iridescence(polish->finish, s->at.point, fabs(dot(polish->n, d)), fabs(dot(polish->n, s->path->ray.d)),
                                  s->t->world->globals.irid_wavelength, &s->at);
    return colour_of(rgb_mul(rgb_of(c), film), c.f, c.t);
}

Colour shade_reflect(const Shade *s, const Polish *polish, double weight)
{
    if (shade_gives_up(s, weight))
        return BLACK;
    Vec3 d = reflected(s->path->ray.d, polish->n, s->surface->normal);
    Path path = {
        .ray = { surface_offset(s->surface, d), d, 0, INFINITY }, .in = s->path->in, .weight = weight,
        .wavelength = s->path->wavelength, .ticket = s->path->ticket, .level = s->level,
        .skip = PRIM_NO_REFLECTION | (s->path->skip & PRIM_NO_RADIOSITY)   /* and no alpha: mirrors see the background opaque */
    };
    Colour c = trace_path(s->t, &path);
    return polish->finish->irid > 0 ? iridescent(s, polish, d, c) : c;
}

typedef struct Crossing {                      /* from one body into another */
    double ratio, dispersion;                  /* index of refraction from / to */
    int bands;
    int place;                                 /* of the body among those the ray is in; -1: it is entered */
} Crossing;

static Crossing crossing_of(const Shade *s)
{
    const World *w = s->t->world;
    const Interiors *list = s->path->in;
    const Interior *here = w->interior[s->interior].interior;
    Crossing c = { .bands = here->dispersion_samples > 1 ? here->dispersion_samples : 1, .place = interiors_find(list, s->interior) };
    if (c.place < 0) {
        const Interior *last = list->n > 0 ? w->interior[list->at[list->n - 1]].interior : NULL;
        c.ratio = (last != NULL ? (double)last->ior : 1) / (double)here->ior;
        c.dispersion = (last != NULL ? (double)last->dispersion : 1) / (double)here->dispersion;
    } else if ((uint32_t)c.place + 1 < list->n) {      /* not the innermost: nothing changes for the ray */
        c.ratio = c.dispersion = 1;
    } else {
        c.ratio = (double)here->ior;
        c.dispersion = (double)here->dispersion;
        if (c.place > 0) {
            const Interior *outer = w->interior[list->at[c.place - 1]].interior;
            c.ratio /= (double)outer->ior;
            c.dispersion /= (double)outer->dispersion;
            if (outer->dispersion_samples > c.bands)
                c.bands = outer->dispersion_samples;
        }
    }
    return c;
}

/* A ray that goes on behind the surface. */
static Colour pass_on(const Shade *s, const Crossing *c, const Vec3 *d, double wavelength, bool straight, double weight)
{
    const Path *from = s->path;
    if (shade_gives_up(s, weight))
        return BLACK;
    Interiors beyond;
    interiors_copy(&beyond, from->in);
    if (c->place < 0)
        interiors_add(&beyond, s->interior);
    else
        interiors_remove(&beyond, (uint32_t)c->place);
    uint32_t skip = from->skip & PRIM_NO_IMAGE ? PRIM_NO_IMAGE | PRIM_NO_IMAGE_LATER : from->skip;
    Path path = { .ray = { surface_offset(s->surface, *d), *d, 0, INFINITY }, .in = &beyond, .weight = weight, .wavelength = wavelength,
                  .ticket = from->ticket, .skip = skip, .level = s->level, .straight = straight, .alpha = from->alpha };
    return trace_path(s->t, &path);
}

/* One bent ray; `total`: it could not leave, and was mirrored. */
static Colour bent(const Shade *s, const Crossing *c, const Polish *top, double ratio, double wavelength, double weight, bool *total)
{
    Vec3 d = s->path->ray.d, n = top->n;
    double cosine = dot(n, d), k = fabs(cosine);
    double rest = 1 + ratio * ratio * (k * k - 1);
    *total = rest < 0;
    if (rest < 0)
        return shade_reflect(s, top, weight);
    if (cosine > 0)                            /* POV: not before: what is mirrored knows a normal that points away */
        n = negated(n);
    Vec3 on = add(scaled(d, ratio), scaled(n, ratio * k - sqrt(rest)));
    return pass_on(s, c, &on, wavelength, false, weight);
}

/* POV: 555 nm has the index of refraction itself; dispersion is the quotient at the ends of the spectrum. */
static double ratio_at(const Crossing *c, double wavelength)
{
    return c->ratio * pow(c->dispersion, -(wavelength - 555) / 350);
}

static Colour spectrum(const Shade *s, const Crossing *c, const Polish *top, double weight)
{
    Rgb sum = rgb_grey(0);
    double width = 350.0 / c->bands;
    for (int i = 0; i < c->bands; i++) {
        double wavelength = 380 + width * (i + 0.5);
        bool total;
        Colour band = bent(s, c, top, ratio_at(c, wavelength), wavelength, weight, &total);
        sum = rgb_add(sum, rgb_mul(rgb_of(band), hue_of_band(s->t->tracing, wavelength, width)));
    }
    sum = rgb_scaled(sum, 1 / (float)c->bands);
    return colour_of(sum, 0, 0);
}

static Rgb dimming(const Shade *s, bool leaves)
{
    const Interior *here = s->t->world->interior[s->interior].interior;
    Rgb dim = rgb_grey(here->old_refraction);
    /* POV: what is seen fades with fade_distance alone, shadows only with fade_power too. */
    if (here->fade_distance != 0 && leaves)
        dim = rgb_mul(dim, interior_fade(here, s->depth * s->t->tracing->to_scene));
    return dim;
}

bool shade_transmit(const Shade *s, const Polish *top, Rgb filter, bool filtered, double through, Passed *passed)
{
    Crossing c = crossing_of(s);
    double weight = s->path->weight * (double)rgb_max_abs(filter), wavelength = s->path->wavelength;
    Colour seen;
    bool total = false;
    if (fabs(c.ratio - 1) < TINY && fabs(c.dispersion - 1) < TINY)
        seen = pass_on(s, &c, &s->path->ray.d, wavelength, true, weight);
    else if (fabs(c.dispersion - 1) >= TINY && wavelength == 0)
        seen = spectrum(s, &c, top, weight);
    else
        seen = bent(s, &c, top, c.dispersion != 1 && wavelength != 0 ? ratio_at(&c, wavelength) : c.ratio, wavelength, weight, &total);
    Rgb dim = dimming(s, c.place >= 0);
    passed->light = rgb_mul(rgb_of(seen), dim);
    if (total)
        return true;
    if (filtered)
        passed->light = rgb_mul(passed->light, filter);
    passed->t = rgb_greyness(dim) * seen.t * (filtered ? (float)through : 1);
    return false;
}
