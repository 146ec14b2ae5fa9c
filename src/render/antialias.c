/* antialias.c - see antialias.h. Three ways to fill a tile: one ray each, more where neighbours differ, or by subdividing pixels. */
#include "render/antialias.h"

#include <stdatomic.h>
#include <string.h>

#include "render/contrast.h"

typedef struct Pixel {
    Seen seen;
    bool refined;                              /* supersampled, or not to be */
} Pixel;

enum { ROW = TILE_SIZE + 1 };               /* at most SAMPLER_ROW */

/* Colours at the centres of the last row and the last column of a tile, for the tiles below and to the right. */
typedef struct Edge {
    Colour row[TILE_SIZE], column[TILE_SIZE];
    _Atomic bool known;
} Edge;

struct Antialiasing {
    const RenderOptions *options;
    const Contrast *contrast;
    Edge *edge;                                /* [tile]; NULL: each tile asks for itself */
    uint32_t across;
};

struct Antialias {
    const RenderOptions *options;
    const Contrast *contrast;
    Antialiasing *all;
    Pixel pixel[ROW * ROW];                    /* method 1: with the row above and the column to the left; 2: corners */
    Seen *fine;                                /* method 2: (side + 1)^2 places within one pixel ... */
    uint32_t *fine_stamp, stamp;               /* ... valid if stamped by it */
    int side;                                  /* 2^depth */
};

Antialiasing *antialiasing_new(Arena *arena, const World *w, const RenderOptions *options, uint32_t across, uint32_t n_tiles, bool alike)
{
    Antialiasing *all = arena_new(arena, Antialiasing);
    all->options = options;
    all->across = across;
    if (options->antialias != 0)
        all->contrast = contrast_new(arena, w, options);
    if (options->antialias == 1 && alike)
        all->edge = arena_array(arena, Edge, n_tiles);
    return all;
}

Antialias *antialias_new(Arena *arena, Antialiasing *all)
{
    Antialias *a = arena_new(arena, Antialias);
    a->all = all;
    a->options = all->options;
    a->contrast = all->contrast;
    if (a->options->antialias == 2) {
        a->side = 1 << a->options->depth;
        size_t places = (size_t)(a->side + 1) * (size_t)(a->side + 1);
        a->fine = arena_array(arena, Seen, places);
        a->fine_stamp = arena_array(arena, uint32_t, places);
    }
    return a;
}

static float *pixel_of(const Antialias *a, float *rgba, int x, int y)
{
    return &rgba[4 * ((size_t)y * (size_t)a->options->width + (size_t)x)];
}

static inline void store(float *out, Colour c)
{
    Rgb rgba = rgb_of(c);
    rgba[3] = 1 - c.t;
    memcpy(out, &rgba, sizeof rgba);
}

/* ---- method 1: neighbours ---- */

static void supersample(Antialias *a, Sampler *s, Pixel *p, int x, int y)
{
    int n = a->options->depth;
    double step = 1.0 / n, jitter = a->options->jitter / n;
    Colour sum = p->seen.colour;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            double ox = x - 0.5 + step / 2 + j * step, oy = y - 0.5 + step / 2 + i * step;
            Vec2 shift = { 0, 0 };
            if (jitter > 0)
                shift = position_jitter(&s->sampling->hash, ox, oy);
            sum = colour_add(sum, sampler_colour(s, ox + jitter * shift.u, oy + jitter * shift.v));
        }
    p->seen.colour = colour_scaled(sum, 1 / (float)(n * n + 1));
    contrast_see(a->contrast, &p->seen);
    p->refined = true;
}

static void pixel_set(const Antialias *a, Pixel *p, Colour c, bool refined)
{
    p->seen.colour = c;
    contrast_see(a->contrast, &p->seen);
    p->refined = refined;
}

/* The edge of a neighbour of the tile; NULL: there is none, or it is not known. */
static const Edge *edge_of(const Antialias *a, bool exists, uint32_t tile)
{
    const Edge *edge = a->all->edge;
    return edge != NULL && exists && atomic_load_explicit(&edge[tile].known, memory_order_acquire) ? &edge[tile] : NULL;
}

/* POV: the row above and the pixels to the left count for each tile by themselves, and are never refined. Unless there is chance
 * in them they have the colours that the neighbours found, which saves one ray in 16. */
static void by_neighbours(Antialias *a, Sampler *s, const Tile *tile, float *rgba)
{
    uint32_t across = a->all->across;
    const Edge *up = edge_of(a, tile->index >= across, tile->index - across);
    const Edge *before = edge_of(a, tile->index % across > 0, tile->index - 1);
    Edge *own = a->all->edge != NULL ? &a->all->edge[tile->index] : NULL;
    for (int x = tile->x0; x < tile->x1; x++)
        pixel_set(a, &a->pixel[x - tile->x0 + 1], up != NULL ? up->row[x - tile->x0] : sampler_colour(s, x, tile->y0 - 1), true);
    for (int y = tile->y0; y < tile->y1; y++) {
        Pixel *row = &a->pixel[(y - tile->y0 + 1) * ROW];
        pixel_set(a, &row[0], before != NULL ? before->column[y - tile->y0] : sampler_colour(s, tile->x0 - 1, y), true);
        sampler_row(s, tile->x0, y, tile->x1 - tile->x0);
        for (int x = tile->x0; x < tile->x1; x++) {
            Pixel *here = &row[x - tile->x0 + 1], *left = here - 1, *above = here - ROW;
            Colour centre = sampler_in_row(s, x - tile->x0);
            pixel_set(a, here, centre, false);
            if (own != NULL && y == tile->y1 - 1)
                own->row[x - tile->x0] = centre;
            if (own != NULL && x == tile->x1 - 1)
                own->column[y - tile->y0] = centre;
            bool from_left = contrast_differ(a->contrast, &here->seen, &left->seen);
            bool from_above = contrast_differ(a->contrast, &here->seen, &above->seen);
            if (from_left && !left->refined)
                supersample(a, s, left, x - 1, y);
            if (from_above && !above->refined)
                supersample(a, s, above, x, y - 1);
            if (from_left || from_above)
                supersample(a, s, here, x, y);
        }
    }
    if (own != NULL)
        atomic_store_explicit(&own->known, !sampler_took_chances(s), memory_order_release);
    for (int y = tile->y0; y < tile->y1; y++)
        for (int x = tile->x0; x < tile->x1; x++)
            store(pixel_of(a, rgba, x, y), a->pixel[(y - tile->y0 + 1) * ROW + x - tile->x0 + 1].seen.colour);
}

/* ---- method 2: subdividing ---- */

typedef struct Square { int x, y, size; } Square;      /* in 1/side of a pixel, from its upper left corner */

typedef struct Subdivision {
    Antialias *a;
    Sampler *s;
    double left, top;                          /* of the pixel */
} Subdivision;

static Seen *fine_pixel(const Subdivision *d, int x, int y)
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
        a->fine[i].colour = sampler_colour(d->s, px + jitter * shift.u, py + jitter * shift.v);
        contrast_see(a->contrast, &a->fine[i]);
    }
    return &a->fine[i];
}

static bool any_differ(const Antialias *a, Seen *const p[4])
{
    for (int i = 0; i < 3; i++)
        for (int j = i + 1; j < 4; j++)
            if (contrast_differ(a->contrast, p[i], p[j]))
                return true;
    return false;
}

static Colour mean_of(Colour a, Colour b, Colour c, Colour d)
{
    return colour_scaled(colour_add(colour_add(a, b), colour_add(c, d)), 0.25f);
}

/* corner: upper left, upper right, lower left, lower right. */
static Colour subdivide(const Subdivision *d, Square q, Seen *const corner[4], int level)
{
    if (level <= 0 || !any_differ(d->a, corner))
        return mean_of(corner[0]->colour, corner[1]->colour, corner[2]->colour, corner[3]->colour);
    int half = q.size / 2, x = q.x + half, y = q.y + half;
    Seen *left = fine_pixel(d, q.x, y), *top = fine_pixel(d, x, q.y), *right = fine_pixel(d, q.x + q.size, y),
         *bottom = fine_pixel(d, x, q.y + q.size), *centre = fine_pixel(d, x, y);
    Seen *const quarter[4][4] = { { corner[0], top, left, centre }, { top, corner[1], centre, right },
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
    for (int y = tile->y0; y <= tile->y1; y++) {
        sampler_row(s, tile->x0 - 0.5, y - 0.5, tile->x1 - tile->x0 + 1);
        for (int x = tile->x0; x <= tile->x1; x++)
            pixel_set(a, &a->pixel[(y - tile->y0) * ROW + x - tile->x0], sampler_in_row(s, x - tile->x0), true);
    }
    for (int y = tile->y0; y < tile->y1; y++)
        for (int x = tile->x0; x < tile->x1; x++) {
            Pixel *p = &a->pixel[(y - tile->y0) * ROW + x - tile->x0];
            Seen *const corner[4] = { &p[0].seen, &p[1].seen, &p[ROW].seen, &p[ROW + 1].seen };
            Subdivision d = { a, s, x - 0.5, y - 0.5 };
            a->stamp++;
            store(pixel_of(a, rgba, x, y), subdivide(&d, (Square){ 0, 0, a->side }, corner, a->options->depth - 1));
        }
}

static void by_centres(const Antialias *a, Sampler *s, const Tile *tile, float *rgba)
{
    for (int y = tile->y0; y < tile->y1; y++) {
        float *out = pixel_of(a, rgba, tile->x0, y);
        int n = tile->x1 - tile->x0;
        sampler_row(s, tile->x0, y, n);
        for (int i = 0; i < n; i++, out += 4)
            store(out, sampler_in_row(s, i));
    }
}

void antialias_tile(Antialias *a, Sampler *s, const Tile *tile, float *rgba)
{
    if (a->options->antialias == 1)
        by_neighbours(a, s, tile, rgba);
    else if (a->options->antialias == 2)
        by_subdividing(a, s, tile, rgba);
    else
        by_centres(a, s, tile, rgba);
}
