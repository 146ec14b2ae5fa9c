/* render.c - the region cut into tiles, which the threads take one after the other.
 *
 * What a tile looks like depends on nothing but the World and its own place. */
#include "render/render.h"

#include <pthread.h>

#include "base/thread.h"
#include "math/mersenne.h"
#include "render/antialias.h"

typedef struct Render {
    const World *world;
    const RenderOptions *options;
    Arena *arena;                              /* guarded by lock */
    const Sampling *sampling;
    Antialiasing *antialiasing;
    Radiosity *radiosity;                      /* NULL: none */
    int pass;                                  /* of radiosity; -1: the picture */
    double *wobble;                            /* of the places that passes look at */
    float *rgba;
    WorkCounter work;                          /* hands out tile[first], tile[first + 1], ... */
    uint32_t *tile, first;
    int across;                                /* tiles in a row */
    pthread_mutex_t lock;
    RenderProgress *progress;
    void *user;
    int done, all;                             /* tiles, those of passes too */
    _Atomic bool cancelled;
} Render;

static int least(int a, int b)
{
    return a < b ? a : b;
}

static Tile tile_of(const Render *r, uint32_t index)
{
    const RenderOptions *o = r->options;
    int x = o->first_column + (int)index % r->across * TILE_SIZE, y = o->first_row + (int)index / r->across * TILE_SIZE;
    return (Tile){ x, y, least(x + TILE_SIZE, o->last_column + 1), least(y + TILE_SIZE, o->last_row + 1), index };
}

static void tell(Render *r)
{
    pthread_mutex_lock(&r->lock);
    r->done++;
    if (r->progress != NULL && !r->cancelled && !r->progress(r->user, r->done, r->all))
        r->cancelled = true;
    pthread_mutex_unlock(&r->lock);
}

/* ---- passes of radiosity: a wide grid of places, which grows finer ---- */

enum { WOBBLES = 2047 };

static double *wobble_new(Arena *arena)
{
    double *table = arena_array(arena, double, WOBBLES);
    Mersenne m;
    mersenne_seed(&m, MERSENNE_SEED);
    for (int i = 0; i < WOBBLES; i++)
        table[i] = mersenne_next(&m) / 2147483648.0 - 1;
    return table;
}

/* Only what this adds to the cache of radiosity counts. */
static void look_over_tile(const Render *r, Sampler *s, const Tile *tile)
{
    double step = radiosity_step(r->radiosity, r->options->width, r->options->height, r->pass);
    double wide = fmin(1, step / 2), middle = (step - 1) / 2;
    uint32_t at = (17 * (uint32_t)r->pass + 13 * tile->index) % WOBBLES;
    for (double y = ceil((tile->y0 - 0.5) / step) * step; y < tile->y1 - 0.5; y += step)
        for (double x = ceil((tile->x0 - 0.5) / step) * step; x < tile->x1 - 0.5; x += step) {
            double wx = r->wobble[at = (at + 1) % WOBBLES], wy = r->wobble[at = (at + 1) % WOBBLES];
            sampler_colour(s, x + middle + wide * wx, y + middle + wide * wy);
        }
}

static void do_tile(const Render *r, Antialias *antialias, Sampler *sampler, uint32_t index)
{
    Tile tile = tile_of(r, index);
    tracer_start_tile(sampler->tracer, index);
    if (r->radiosity != NULL)
        tracer_start_gathering(sampler->tracer, index, r->pass);
    if (r->pass >= 0)
        look_over_tile(r, sampler, &tile);
    else
        antialias_tile(antialias, sampler, &tile, r->rgba);
    if (r->radiosity != NULL)
        tracer_end_gathering(sampler->tracer, index);
}

static void work(void *user, int worker)
{
    (void)worker;
    Render *r = user;
    Sampler sampler;
    pthread_mutex_lock(&r->lock);
    Antialias *antialias = r->pass < 0 ? antialias_new(r->arena, r->antialiasing) : NULL;
    sampler_init(&sampler, r->arena, r->sampling, r->radiosity);
    pthread_mutex_unlock(&r->lock);
    uint32_t index;
    while (!r->cancelled && work_take(&r->work, &index)) {
        do_tile(r, antialias, &sampler, r->tile[r->first + index]);
        tell(r);
    }
    sampler_free(&sampler);
}

static void do_tiles(Render *r, int pass, uint32_t first, uint32_t n)
{
    r->pass = pass;
    r->first = first;
    work_start(&r->work, n);
    int threads = r->options->threads < 1 ? 1 : r->options->threads;
    thread_run(least(threads, (int)n), work, r);
}

/* The first pass of radiosity begins with one tile, so that the others need not find again what it has found; then two, four,
 * and so on, strewn over the picture. */
static void do_passes(Render *r, uint32_t n)
{
    int passes = radiosity_passes(r->radiosity, r->options->width, r->options->height);
    uint32_t stride = n * 5 / 8 | 1;
    uint8_t *taken = arena_array(r->arena, uint8_t, n);
    for (uint32_t i = 0, at = 0; i < n; i++, at = (at + stride) % n) {
        while (taken[at])
            at = (at + 1) % n;
        taken[at] = 1;
        r->tile[i] = at;
    }
    r->wobble = wobble_new(r->arena);
    r->all = (passes + 1) * (int)n;
    for (int pass = 0; pass < passes && !r->cancelled; pass++)
        for (uint32_t first = 0, size = pass == 0 ? 1 : n; first < n && !r->cancelled; first += size, size *= 2) {
            if (size > n - first)
                size = n - first;
            do_tiles(r, pass, first, size);
            radiosity_merge(r->radiosity, pass + 1 == passes && first + size == n);
        }
}

bool render(const World *w, const RenderOptions *options, float *rgba, RenderProgress *progress, void *user)
{
    if (options->last_column < options->first_column || options->last_row < options->first_row)
        return true;
    Arena arena;
    arena_init(&arena);
    Render r = { .world = w, .options = options, .arena = &arena, .rgba = rgba, .progress = progress, .user = user };
    r.sampling = sampling_new(&arena, w, options);
    r.across = (options->last_column - options->first_column) / TILE_SIZE + 1;
    uint32_t n = (uint32_t)r.across * (uint32_t)((options->last_row - options->first_row) / TILE_SIZE + 1);
    r.tile = arena_array(&arena, uint32_t, n);
    r.all = (int)n;
    r.radiosity = radiosity_new(&arena, w, options->quality, n);
    r.antialiasing = antialiasing_new(&arena, w, options, (uint32_t)r.across, n, r.radiosity == NULL);
    pthread_mutex_init(&r.lock, NULL);
    if (r.radiosity != NULL)
        do_passes(&r, n);
    for (uint32_t i = 0; i < n; i++)
        r.tile[i] = i;
    if (!r.cancelled)
        do_tiles(&r, -1, 0, n);
    pthread_mutex_destroy(&r.lock);
    radiosity_free(r.radiosity);
    arena_free(&arena);
    return !r.cancelled;
}
