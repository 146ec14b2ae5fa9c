/* antialias.c - see antialias.h. Three ways to fill a tile: one ray each, more where neighbours differ, or by subdividing pixels. */
#include "render/antialias.h"

#include "image/gamma.h"

/* A colour together with what it looks like to the comparison. */
typedef struct Pixel {
    Colour colour;
    double seen[3];
    bool refined;                              /* supersampled, or not to be */
} Pixel;

enum { ROW = TILE_SIZE + 1 };

struct Antialias {
    const RenderOptions *options;
    Transfer working;                          /* of the colours that are compared */
    double exponent;                           /* then this power */
    Pixel pixel[ROW * ROW];                    /* method 1: with the row above and the column to the left; 2: corners */
    Pixel *fine;                               /* method 2: (side + 1)^2 places within one pixel ... */
    uint32_t *fine_stamp, stamp;               /* ... valid if stamped by it */
    int side;                                  /* 2^depth */
};

Antialias *antialias_new(Arena *arena, const World *w, const RenderOptions *options)
{
    Antialias *a = arena_new(arena, Antialias);
    a->options = options;
    double gamma = options->antialias_gamma;
    a->exponent = gamma <= 0 || fabs(gamma - 1) <= 0.01 ? 1 : 1 / gamma;
    a->working = (Transfer){ TRANSFER_NONE, 1 };
    if (w->globals.assumed_gamma == GAMMA_SRGB)
        a->working = (Transfer){ TRANSFER_SRGB, 1 };
    else if (w->globals.assumed_gamma == GAMMA_POWER && fabs(w->globals.assumed_gamma_value - 1) > 0.01)
        a->exponent *= w->globals.assumed_gamma_value;         /* two powers are one */
    if (options->antialias == 2) {
        a->side = 1 << options->depth;
        size_t places = (size_t)(a->side + 1) * (size_t)(a->side + 1);
        a->fine = arena_array(arena, Pixel, places);
        a->fine_stamp = arena_array(arena, uint32_t, places);
    }
    return a;
}

static double seen(const Antialias *a, float value)
{
    if (value <= 0)
        return 0;
    double v = (double)value;
    if (a->working.kind == TRANSFER_SRGB)
        v = transfer_decode(a->working, v);
    return a->exponent == 1 ? v : pow(v, a->exponent);
}

static void pixel_set(const Antialias *a, Pixel *p, Colour c)
{
    p->colour = c;
    p->seen[0] = seen(a, c.r);                 /* a power each: greys need one */
    p->seen[1] = c.g == c.r ? p->seen[0] : seen(a, c.g);
    p->seen[2] = c.b == c.g ? p->seen[1] : seen(a, c.b);
}

static bool differ(const Antialias *a, const Pixel *p, const Pixel *q)
{
    double distance = fabs(p->seen[0] - q->seen[0]) + fabs(p->seen[1] - q->seen[1]) + fabs(p->seen[2] - q->seen[2]) +
                      fabs((double)p->colour.t - (double)q->colour.t);
    return distance >= a->options->threshold;
}

static void store(const Antialias *a, float *rgba, int x, int y, Colour c)
{
    float *out = &rgba[4 * ((size_t)y * (size_t)a->options->width + (size_t)x)];
    out[0] = c.r;
    out[1] = c.g;
    out[2] = c.b;
    out[3] = 1 - c.t;
}

/* ---- method 1: neighbours ---- */

static void supersample(Antialias *a, Sampler *s, Pixel *p, int x, int y)
{
    int n = a->options->depth;
    double step = 1.0 / n, jitter = a->options->jitter / n;
    Colour sum = p->colour;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            double ox = x - 0.5 + step / 2 + j * step, oy = y - 0.5 + step / 2 + i * step;
            Vec2 shift = { 0, 0 };
            if (jitter > 0)
                shift = position_jitter(&s->sampling->hash, ox, oy);
            sum = colour_add(sum, sampler_colour(s, ox + jitter * shift.u, oy + jitter * shift.v));
        }
    pixel_set(a, p, colour_scaled(sum, 1 / (float)(n * n + 1)));
    p->refined = true;
}

/* POV: the row above and the pixels to the left are asked again by each tile for itself, and never refined. */
static void by_neighbours(Antialias *a, Sampler *s, const Tile *tile, float *rgba)
{
    for (int x = tile->x0; x < tile->x1; x++) {
        Pixel *p = &a->pixel[x - tile->x0 + 1];
        pixel_set(a, p, sampler_colour(s, x, tile->y0 - 1));
        p->refined = true;
    }
    for (int y = tile->y0; y < tile->y1; y++) {
        Pixel *row = &a->pixel[(y - tile->y0 + 1) * ROW];
        pixel_set(a, &row[0], sampler_colour(s, tile->x0 - 1, y));
        row[0].refined = true;
        for (int x = tile->x0; x < tile->x1; x++) {
            Pixel *here = &row[x - tile->x0 + 1], *left = here - 1, *above = here - ROW;
            pixel_set(a, here, sampler_colour(s, x, y));
            here->refined = false;
            bool from_left = differ(a, here, left), from_above = differ(a, here, above);
            if (from_left && !left->refined)
                supersample(a, s, left, x - 1, y);
            if (from_above && !above->refined)
                supersample(a, s, above, x, y - 1);
            if (from_left || from_above)
                supersample(a, s, here, x, y);
        }
    }
    for (int y = tile->y0; y < tile->y1; y++)
        for (int x = tile->x0; x < tile->x1; x++)
            store(a, rgba, x, y, a->pixel[(y - tile->y0 + 1) * ROW + x - tile->x0 + 1].colour);
}

/* ---- method 2: subdividing ---- */

typedef struct Square { int x, y, size; } Square;      /* in 1/side of a pixel, from its upper left corner */

typedef struct Subdivision {
    Antialias *a;
    Sampler *s;
    double left, top;                          /* of the pixel */
} Subdivision;

static const Pixel *fine_pixel(const Subdivision *d, int x, int y)
{
    Antialias *a = d->a;
    size_t i = (size_t)y * (size_t)(a->side + 1) + (size_t)x;
    if (a->fine_stamp[i] != a->stamp) {
        a->fine_stamp[i] = a->stamp;
        double px = d->left + (double)x / a->side, py = d->top + (double)y / a->side;
        Vec2 shift = { 0, 0 };
        double jitter = a->options->jitter / (a->side + 1);
        if (jitter > 0)
            shift = position_jitter(&d->s->sampling->hash, px, py);
        pixel_set(a, &a->fine[i], sampler_colour(d->s, px + jitter * shift.u, py + jitter * shift.v));
    }
    return &a->fine[i];
}

static bool any_differ(const Antialias *a, const Pixel *const p[4])
{
    for (int i = 0; i < 3; i++)
        for (int j = i + 1; j < 4; j++)
            if (differ(a, p[i], p[j]))
                return true;
    return false;
}

static Colour mean_of(Colour a, Colour b, Colour c, Colour d)
{
    return colour_scaled(colour_add(colour_add(a, b), colour_add(c, d)), 0.25f);
}

/* corner: upper left, upper right, lower left, lower right. */
static Colour subdivide(const Subdivision *d, Square q, const Pixel *const corner[4], int level)
{
    if (level <= 0 || !any_differ(d->a, corner))
        return mean_of(corner[0]->colour, corner[1]->colour, corner[2]->colour, corner[3]->colour);
    int half = q.size / 2, x = q.x + half, y = q.y + half;
    const Pixel *left = fine_pixel(d, q.x, y), *top = fine_pixel(d, x, q.y), *right = fine_pixel(d, q.x + q.size, y),
                *bottom = fine_pixel(d, x, q.y + q.size), *centre = fine_pixel(d, x, y);
    const Pixel *const quarter[4][4] = { { corner[0], top, left, centre }, { top, corner[1], centre, right },
                                         { left, centre, corner[2], bottom }, { centre, right, bottom, corner[3] } };
    Colour c[4];
    for (int i = 0; i < 4; i++) {
        Square part = { i & 1 ? x : q.x, i & 2 ? y : q.y, half };
        c[i] = subdivide(d, part, quarter[i], level - 1);
    }
    return mean_of(c[0], c[1], c[2], c[3]);
}

static void by_subdividing(Antialias *a, Sampler *s, const Tile *tile, float *rgba)
{
    for (int y = tile->y0; y <= tile->y1; y++)
        for (int x = tile->x0; x <= tile->x1; x++)
            pixel_set(a, &a->pixel[(y - tile->y0) * ROW + x - tile->x0], sampler_colour(s, x - 0.5, y - 0.5));
    for (int y = tile->y0; y < tile->y1; y++)
        for (int x = tile->x0; x < tile->x1; x++) {
            const Pixel *p = &a->pixel[(y - tile->y0) * ROW + x - tile->x0];
            const Pixel *const corner[4] = { p, p + 1, p + ROW, p + ROW + 1 };
            Subdivision d = { a, s, x - 0.5, y - 0.5 };
            a->stamp++;
            store(a, rgba, x, y, subdivide(&d, (Square){ 0, 0, a->side }, corner, a->options->depth - 1));
        }
}

void antialias_tile(Antialias *a, Sampler *s, const Tile *tile, float *rgba)
{
    if (a->options->antialias == 1)
        by_neighbours(a, s, tile, rgba);
    else if (a->options->antialias == 2)
        by_subdividing(a, s, tile, rgba);
    else
        for (int y = tile->y0; y < tile->y1; y++)
            for (int x = tile->x0; x < tile->x1; x++)
                store(a, rgba, x, y, sampler_colour(s, x, y));
}
