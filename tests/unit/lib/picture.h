/* picture.h - small pictures from scene texts, and their pixels. */
#ifndef LIB_PICTURE_H
#define LIB_PICTURE_H

#include "whit.h"

typedef struct Picture {
    Whit *whit;
    WhitImage image;
} Picture;

/* Renders; prints what is said about a scene that has mistakes and fails the test. The pieces are put together, up to a NULL. */
Picture picture_of(const WhitOptions *options, const char *const *pieces);
void picture_free(Picture *p);

static inline const float *picture_pixel(const Picture *p, int x, int y)
{
    return &p->image.rgba[4 * (y * p->image.width + x)];
}

/* Red, green, blue of a pixel within the tolerance; says what is there if not. */
bool picture_has(const Picture *p, int x, int y, const double rgb[3], double tolerance);

#endif
