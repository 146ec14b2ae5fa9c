/* interior.c - lists of the bodies a ray is in, and what the inside of a body does to light (04-shading, sections 2, 7, 8). */
#include "trace/path.h"

bool interiors_hollow(const World *w, const Interiors *list)
{
    for (uint32_t i = 0; i < list->n; i++)
        if (!w->interior[list->at[i]].hollow)
            return false;
    return true;
}

double interior_ratio(const World *w, const Interiors *list, uint32_t interior)
{
    double ior = w->interior[interior].interior->ior;
    if (list->n == 0)
        return ior;
    double last = w->interior[list->at[list->n - 1]].interior->ior;
    if (interiors_find(list, interior) < 0)
        return ior / last;
    return list->n == 1 ? 1 / ior : last / ior;
}

static float fade(float colour, double x)
{
    return (float)(colour + (1 - (double)colour) / (1 + x));
}

static float decay(float colour, double x)
{
    return (float)exp(-(1 - (double)colour) * x);
}

/* POV: fade_power of 1000 and more means exponential decay. */
Rgb interior_fade(const Interior *i, double depth)
{
    double x = depth / i->fade_distance;
    Rgb c = i->fade_colour;
    if (i->fade_power >= 1000) {
        float r = decay(c[0], x), g = c[1] == c[0] ? r : decay(c[1], x);   /* an exponential is dear: greys need one */
        return rgb(r, g, c[2] == c[1] ? g : decay(c[2], x));
    }
    x = pow(x, (double)i->fade_power);
    return rgb(fade(c[0], x), fade(c[1], x), fade(c[2], x));
}
