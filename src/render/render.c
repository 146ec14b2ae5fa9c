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
    float *rgba;
    WorkCounter tiles;
    int across;                                /* tiles in a row */
    pthread_mutex_t lock;
    RenderProgress *progress;
    void *user;
    int done;
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
    if (r->progress != NULL && !r->cancelled && !r->progress(r->user, r->done, (int)r->tiles.n))
        r->cancelled = true;
    pthread_mutex_unlock(&r->lock);
}

static void work(void *user, int worker)
{
    (void)worker;
    Render *r = user;
    Sampler sampler;
    pthread_mutex_lock(&r->lock);
    Antialias *antialias = antialias_new(r->arena, r->world, r->options);
    sampler_init(&sampler, r->arena, r->sampling);
    pthread_mutex_unlock(&r->lock);
    uint32_t index;
    while (!r->cancelled && work_take(&r->tiles, &index)) {
        Tile tile = tile_of(r, index);
        tracer_start_tile(sampler.tracer, index);
        antialias_tile(antialias, &sampler, &tile, r->rgba);
        tell(r);
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
    int down = (options->last_row - options->first_row) / TILE_SIZE + 1;
    pthread_mutex_init(&r.lock, NULL);
    work_start(&r.tiles, (uint32_t)r.across * (uint32_t)down);
    thread_run(least(options->threads < 1 ? 1 : options->threads, r.across * down), work, &r);
    pthread_mutex_destroy(&r.lock);
    arena_free(&arena);
    return !r.cancelled;
}
