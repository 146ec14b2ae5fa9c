/* contrast.h - are two colours so far apart that the pixels between deserve more rays? (03-camera-and-sampling, section 5.2) */
#ifndef RENDER_CONTRAST_H
#define RENDER_CONTRAST_H

#include "render/render.h"

typedef struct Contrast Contrast;

/* A colour together with what it looks like to the comparison. */
typedef struct Seen {
    Colour colour;
    double light[3], sum;                      /* near the exact values (contrast.c), and their sum */
    bool exact;                                /* light needs no doubt */
} Seen;

/* Asked by one thread at a time. */
Contrast *contrast_new(Arena *arena, const World *w, const RenderOptions *options);

void contrast_see(const Contrast *c, Seen *s);         /* its colour is there already */
bool contrast_differ(const Contrast *c, Seen *a, Seen *b);

#endif
