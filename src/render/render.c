/* render.c - the region cut into tiles, which the threads take one after the other.
 *
 * What a tile looks like depends on nothing but the World and its own place. */
#include "render/render.h"

#include <pthread.h>

#include "base/thread.h"
#include "render/antialias.h"

typedef struct Render {
    const World *world;
    const RenderOptions *options;
    Arena *arena;                              /* guarded by lock */
    const Sampling *sampling;
    Radiosity *radiosity;                      /* NULL: none */
    int pass;                                  /* of radiosity; -1: the picture */
    double *wobble;                            /* of the places that passes look at */
    float *rgba;
    WorkCounter tiles;
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
    mersenne_seed(&m, 5489);
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
    Antialias *antialias = r->pass < 0 ? antialias_new(r->arena, r->world, r->options) : NULL;
    sampler_init(&sampler, r->arena, r->sampling, r->radiosity);
    pthread_mutex_unlock(&r->lock);
    uint32_t index;
    while (!r->cancelled && work_take(&r->tiles, &index)) {
        do_tile(r, antialias, &sampler, index);
        tell(r);
    }
    sampler_free(&sampler);
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
    int down = (options->last_row - options->first_row) / TILE_SIZE + 1;
    int tiles = r.across * down, threads = least(options->threads < 1 ? 1 : options->threads, tiles);
    r.radiosity = radiosity_new(&arena, w, options->quality, (uint32_t)tiles);
    int passes = r.radiosity != NULL ? radiosity_passes(r.radiosity, options->width, options->height) : 0;
    r.wobble = passes > 0 ? wobble_new(&arena) : NULL;
    r.all = (passes + 1) * tiles;
    pthread_mutex_init(&r.lock, NULL);
    for (int i = 0; i <= passes && !r.cancelled; i++) {
        r.pass = i < passes ? i : -1;
        work_start(&r.tiles, (uint32_t)tiles);
        thread_run(threads, work, &r);
        if (i < passes)
            radiosity_merge(r.radiosity, i + 1 == passes);
    }
    pthread_mutex_destroy(&r.lock);
    radiosity_free(r.radiosity);
    arena_free(&arena);
    return !r.cancelled;
}
