/* interior.c - lists of the bodies a ray is in, and what the inside of a body does to light (04-shading, sections 2, 7, 8). */
#include <string.h>

#include "trace/path.h"

void interiors_add(Interiors *list, uint32_t interior)
{
    if (list->n < INTERIORS_MAX)
        list->at[list->n++] = interior;
}

void interiors_remove(Interiors *list, uint32_t place)
{
    list->n--;
    if (place < list->n)                       /* mostly it is the last */
        memmove(&list->at[place], &list->at[place + 1], (list->n - place) * sizeof list->at[0]);
}

int interiors_find(const Interiors *list, uint32_t interior)
{
    for (uint32_t i = 0; i < list->n; i++)
        if (list->at[i] == interior)
            return (int)i;
    return -1;
}

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
