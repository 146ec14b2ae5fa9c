/* trace.c - one ray: what it hits, or the sky, then the air between (04-shading, section 1). */
#include "trace/path.h"

static const Colour BLACK = { 0, 0, 0, 0, 0 };         /* opaque */

/* Fog and rainbows lie in front of whatever was found, unless the ray is inside something solid. */
static Colour through_air(Tracer *t, const Path *path, double depth, Colour c)
{
    const Tracing *tracing = t->tracing;
    uint32_t n_media = t->world->scene->n_media;
    if (path->ticket->bounces > 0 && !t->world->globals.radiosity.media)
        return c;
    if (!interiors_hollow(t->world, path->in))
        return c;
    if (tracing->n_bows > 0)
        c = rainbow_apply(t, path->ray.d, depth, c);
    if (n_media > 0)
        c = media_air(t, path, depth, c);
    if (tracing->n_fog > 0)
        c = fog_apply(tracing, path->ray.o, path->ray.d, depth, c);
    return c;
}

static bool worth_following(const Tracer *t, const Path *path)
{
    return path->level < path->ticket->max_level && !(path->weight < path->ticket->adc_bailout) && t->nesting < NESTING_MAX;
}

/* What the path meets, the air before it left aside. */
static inline Colour meet(Tracer *t, const Path *path)
{
    const Tracing *tracing = t->tracing;
    Hit hit;
    if (world_nearest(t->world, &path->ray, path->skip, &hit))
        return shade_hit(t, path, &hit);
    t->depth = FAR_AWAY;
    return tracing->plain_sky ? tracing->sky[path->alpha] : sky_colour(tracing, path->ray.d, path->alpha);
}

static __attribute__((noinline)) Colour meet_in_air(Tracer *t, const Path *path)
{
    Colour c = meet(t, path);
    return through_air(t, path, t->depth, c);
}

Colour trace_path(Tracer *t, const Path *path)
{
    if (worth_following(t, path))
        return t->tracing->has_air ? meet_in_air(t, path) : meet(t, path);
    t->depth = FAR_AWAY;
    return BLACK;
}

void tracer_interiors(const Tracer *t, Vec3 p, Interiors *out)
{
    out->n = world_interiors_at(t->world, p, out->at, INTERIORS_MAX);
}

Ray *tracer_eye(Tracer *t)
{
    return &t->eye.ray;
}

Colour tracer_look(Tracer *t, const Interiors *around)
{
    t->eye.in = around;
    return trace_path(t, &t->eye);
}
