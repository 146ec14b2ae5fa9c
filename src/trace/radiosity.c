/* radiosity.c - diffuse light gathered by rays, kept, and used again near by (05-global-effects, section 1).
 *
 * What earlier passes found stands in trees of boxes, one for each number of bounces. What a tile finds itself goes to a cache
 * that can grow: a hash of cells, a grid for each power of two of a sample's reach; a sample stands in all the cells it reaches
 * into, so that a question looks at one cell of each grid. Sums are whole numbers, so that the order of samples means nothing. */
#include "trace/radiosity.h"

#include <stdlib.h>
#include <string.h>

#include "base/array.h"
#include "trace/path.h"

enum { BOUNCES_MAX = 20, GRIDS = 64, GRID_MIDDLE = 48, DIRECTIONS = 1600 };

typedef struct GatherSample {
    Vec3 p, n;                                 /* with radius all that most questions need: one cache line */
    double radius, reach;
    Vec3 nearest;                              /* direction of the nearest thing seen */
    double nearest_t;
    Rgb light;
    int bounces;
} GatherSample;

typedef struct Cell {
    int64_t x, y, z;
    int grid, bounces;
    uint32_t first, last;                      /* links, + 1 */
} Cell;

typedef struct Link { Vec3 p; double radius; uint32_t sample, next; } Link;    /* p, radius: the sample's; next: + 1 */

typedef struct Cache {
    Arena arena;
    ARRAY(GatherSample) sample;
    ARRAY(Cell) cell;
    ARRAY(Link) link;
    uint32_t *slot, n_slots;                   /* cell + 1; open addressing */
    uint64_t grids[BOUNCES_MAX];               /* bits of those in use */
} Cache;

typedef struct Found { GatherSample *sample; uint32_t n; } Found;

typedef struct Forest {                        /* samples of earlier passes */
    ARRAY(GatherSample) sample;
    const void *tree[BOUNCES_MAX];
    uint32_t *item[BOUNCES_MAX];               /* of the tree: its sample */
} Forest;

struct Radiosity {
    const World *world;
    const RadiosityDef *def;
    Vec3 eye;
    Arena arena, tree_arena;                   /* samples; trees, which are planted anew after every pass */
    Forest forest;
    Found *found;                              /* by tile, malloced */
    uint32_t n_tiles;
    Vec3 *direction;
    uint32_t n_directions;
};

struct Gather {                                /* of one tracer */
    Radiosity *radiosity;
    Cache own;
    int pass;                                  /* -1: the picture */
    uint32_t next_direction[BOUNCES_MAX];
};

/* ---- the cache ---- */

static uint32_t cell_hash(const Cell *c)
{
    uint64_t h = (uint64_t)c->x * 0x9e3779b97f4a7c15u ^ (uint64_t)c->y * 0xc2b2ae3d27d4eb4fu ^ (uint64_t)c->z * 0x165667b19e3779f9u ^
                 (uint64_t)(c->grid * 32 + c->bounces) * 0xff51afd7ed558ccdu;
    h ^= h >> 31;
    h *= 0xbf58476d1ce4e5b9u;
    return (uint32_t)(h >> 32);
}

static bool same_cell(const Cell *a, const Cell *b)
{
    return a->x == b->x && a->y == b->y && a->z == b->z && a->grid == b->grid && a->bounces == b->bounces;
}

/* The slot where the cell is, or would be. */
static uint32_t *cell_slot(const Cache *c, const Cell *cell)
{
    uint32_t at = cell_hash(cell) & (c->n_slots - 1);
    while (c->slot[at] != 0 && !same_cell(&c->cell.data[c->slot[at] - 1], cell))
        at = (at + 1) & (c->n_slots - 1);
    return &c->slot[at];
}

static void cache_make_room(Cache *c)
{
    if (c->cell.n < c->n_slots / 2)
        return;
    c->n_slots = c->n_slots == 0 ? 256 : c->n_slots * 2;
    c->slot = arena_array(&c->arena, uint32_t, c->n_slots);
    for (uint32_t i = 0; i < c->cell.n; i++)
        *cell_slot(c, &c->cell.data[i]) = i + 1;
}

static void cell_add(Cache *c, const Cell *where, uint32_t sample)
{
    cache_make_room(c);
    uint32_t *slot = cell_slot(c, where);
    if (*slot == 0) {
        array_push(&c->arena, &c->cell, *where);
        *slot = c->cell.n;
    }
    const GatherSample *s = &c->sample.data[sample];
    array_push(&c->arena, &c->link, (Link){ s->p, s->radius, sample, 0 });
    Cell *cell = &c->cell.data[*slot - 1];
    if (cell->first == 0)
        cell->first = c->link.n;
    else
        c->link.data[cell->last - 1].next = c->link.n;
    cell->last = c->link.n;
}

/* Cells of the grid are wider than the reach, at most twice, so a sample reaches into 27 of them at most. */
static int grid_of(double reach)
{
    int e;
    frexp(reach, &e);
    e += GRID_MIDDLE;
    return e < 0 ? 0 : e >= GRIDS ? GRIDS - 1 : e;
}

static double cell_size(int grid)
{
    return ldexp(1, grid - GRID_MIDDLE);
}

static void cache_add(Cache *c, const GatherSample *s)
{
    int grid = grid_of(s->reach);
    double size = cell_size(grid);
    int64_t x1 = (int64_t)floor((s->p.x - s->reach) / size), x2 = (int64_t)floor((s->p.x + s->reach) / size);
    int64_t y1 = (int64_t)floor((s->p.y - s->reach) / size), y2 = (int64_t)floor((s->p.y + s->reach) / size);
    int64_t z1 = (int64_t)floor((s->p.z - s->reach) / size), z2 = (int64_t)floor((s->p.z + s->reach) / size);
    array_push(&c->arena, &c->sample, *s);
    c->grids[s->bounces] |= UINT64_C(1) << grid;
    for (int64_t z = z1; z <= z2; z++)
        for (int64_t y = y1; y <= y2; y++)
            for (int64_t x = x1; x <= x2; x++)
                cell_add(c, &(Cell){ x, y, z, grid, s->bounces, 0, 0 }, c->sample.n - 1);
}

static void cache_clear(Cache *c)
{
    arena_free(&c->arena);
    memset(c, 0, sizeof *c);
    arena_init(&c->arena);
}

/* ---- using samples again ---- */

typedef struct Question {
    Vec3 p, n;
    double bound;                              /* error_bound, as it counts here */
    int bounces;
    bool soft;                                 /* the picture's first bounce: weights fall off smoothly */
    int64_t weight, light[3];                  /* sums; the light is weighed */
} Question;

static const double UNIT = 4294967296.0;       /* of those sums */

static double sample_weight(const Question *q, const GatherSample *s)
{
    Vec3 u = sub(q->p, s->p);
    double far2 = length2(u), most = s->radius * q->bound, turn = fabs(1 - dot(q->n, s->n));
    if (far2 >= most * most || 4 * turn >= q->bound * q->bound)
        return 0;
    double far = sqrt(far2);
    double radius = s->radius, ahead = 1;
    if (far > 0) {
        u = scaled(u, 1 / far);
        double towards = dot(s->nearest, u);
        if (towards > 0)
            radius = towards * s->nearest_t + (1 - towards) * s->radius;
        Vec3 mean = add(q->n, s->n);
        double size = length(mean);
        ahead = size > 0 ? dot(u, mean) / size : 0;
    }
    double error = far / radius + 2 * sqrt(turn);
    if (far >= radius * q->bound || error >= q->bound || ahead <= -0.05)
        return 0;
    double x = error / q->bound;
    double weight = !q->soft ? 1 - x : x < 0.5 ? 1 - 2 * x * x : 2 * (1 - x) * (1 - x);
    if (ahead <= 0)
        weight *= 1 + ahead / 0.05;
    return weight > 0.001 ? weight : 0;
}

static void ask_sample(Question *q, const GatherSample *s)
{
    double weight = sample_weight(q, s);
    if (weight == 0)
        return;
    q->weight += llrint(weight * UNIT);
    q->light[0] += llrint(weight * (double)s->light[0] * UNIT);
    q->light[1] += llrint(weight * (double)s->light[1] * UNIT);
    q->light[2] += llrint(weight * (double)s->light[2] * UNIT);
}

static void ask_cache(const Cache *c, Question *q)
{
    for (uint64_t grids = c->grids[q->bounces]; grids != 0; grids &= grids - 1) {
        int grid = __builtin_ctzll(grids);
        double size = cell_size(grid);
        Cell cell = { (int64_t)floor(q->p.x / size), (int64_t)floor(q->p.y / size), (int64_t)floor(q->p.z / size), grid, q->bounces,
                      0, 0 };
        uint32_t at = *cell_slot(c, &cell);
        if (at == 0)
            continue;
        const Link *link;
        for (uint32_t i = c->cell.data[at - 1].first; i != 0; i = link->next) {
            link = &c->link.data[i - 1];
            double far = link->radius * q->bound;
            if (length2(sub(q->p, link->p)) < far * far)
                ask_sample(q, &c->sample.data[link->sample]);
        }
    }
}

typedef struct ForestVisit { const Forest *forest; Question *question; } ForestVisit;

static bool visit_sample(void *user, uint32_t item, double *t_max)
{
    (void)t_max;
    const ForestVisit *v = user;
    Question *q = v->question;
    ask_sample(q, &v->forest->sample.data[v->forest->item[q->bounces][item]]);
    return false;
}

static void ask_forest(const World *w, const Forest *f, Question *q)
{
    ForestVisit visit = { f, q };
    if (f->tree[q->bounces] != NULL)
        w->accel_ops->around(f->tree[q->bounces], q->p, visit_sample, &visit);
}

/* How far a sample is of use, at most. */
static double reach_of(const RadiosityDef *def, const GatherSample *s, bool pretrace)
{
    double bound = (double)def->error_bound * (pretrace ? (double)def->low_error_factor : 1) + 0.25;
    return s->radius * ldexp(bound, s->bounces);
}

static void plant(Radiosity *r, bool pretrace)
{
    Forest *f = &r->forest;
    arena_free(&r->tree_arena);
    arena_init(&r->tree_arena);
    Bounds *box = arena_array(&r->tree_arena, Bounds, f->sample.n + 1);
    for (int bounces = 0; bounces < BOUNCES_MAX; bounces++) {
        uint32_t n = 0;
        f->item[bounces] = arena_array(&r->tree_arena, uint32_t, f->sample.n + 1);
        for (uint32_t i = 0; i < f->sample.n; i++) {
            const GatherSample *s = &f->sample.data[i];
            if (s->bounces != bounces)
                continue;
            box[n] = bounds_grown((Bounds){ s->p, s->p }, reach_of(r->def, s, pretrace));
            f->item[bounces][n++] = i;
        }
        f->tree[bounces] = n > 0 ? r->world->accel_ops->build(&r->tree_arena, box, n) : NULL;
        if (n == 0 && bounces > r->def->recursion_limit)
            break;
    }
}

/* ---- gathering ---- */

/* x and z across n, as POV-Ray has them. */
static Vec3 turned_to(Vec3 v, Vec3 n)
{
    if (n.y > 0.999)
        return v;
    if (n.y < -0.999)
        return negated(v);
    Vec3 x = normalized(cross(n, fabs(n.z) > 0.9 ? vec3(0, 1, 0) : vec3(0, 0, 1)));
    Vec3 z = normalized(cross(x, n));
    return add(add(scaled(x, v.x), scaled(n, v.y)), scaled(z, v.z));
}

/* The next direction around n that does not point below the true surface. */
static Vec3 next_direction(Gather *g, int bounces, Vec3 n, Vec3 raw, int *tries)
{
    const Radiosity *r = g->radiosity;
    for (;;) {
        uint32_t *next = &g->next_direction[bounces];
        Vec3 v = r->direction[*next];
        *next = (*next + 1) % r->n_directions;
        if (--*tries < 0)
            return turned_to(v, raw);
        v = turned_to(v, n);
        if (dot(v, raw) > 0)
            return v;
    }
}

static Rgb clamped(Rgb c, float most)
{
    float m = rgb_max(c);
    return most > 0 && m > most ? rgb_scaled(c, most / m) : c;
}

typedef struct Gathering {
    Vec3 light, nearest;
    double nearest_t, inverse_t;               /* sum of 1 / t */
    int n;
} Gathering;

static void gather_ray(const Shade *s, Vec3 d, const Ticket *ticket, int level, double weight, Gathering *out)
{
    static const Interiors nowhere = { .n = 0 };
    Tracer *t = s->t;
    Path path = { .ray = { surface_offset(s->surface, d), d, 0, INFINITY }, .in = &nowhere, .weight = weight,
                  .skip = PRIM_NO_RADIOSITY, .level = level, .ticket = ticket };
    Rgb c = clamped(rgb_of(trace_path(t, &path)), t->gather->radiosity->def->max_sample);
    out->light = add(out->light, vec3((double)c[0], (double)c[1], (double)c[2]));
    out->n++;
    if (t->depth >= FAR_AWAY)
        return;
    out->inverse_t += 1 / t->depth;
    if (t->depth < out->nearest_t) {
        out->nearest_t = t->depth;
        out->nearest = d;
    }
}

/* New light at this place, and a sample of it for the cache. */
static Vec3 gather(const Shade *s, Vec3 n, Vec3 raw)
{
    Tracer *t = s->t;
    Gather *g = t->gather;
    const RadiosityDef *def = g->radiosity->def;
    int bounces = s->path->ticket->bounces, rays = (int)fmax(5, floor(def->count * ldexp(1, -bounces)));
    int level = (int)(1.5 * (bounces + 1));
    Ticket ticket = { .adc_bailout = (double)def->adc_bailout, .bounces = bounces + 1, .lamps = LAMPS_GATHERED,
                      .max_level = t->tracing->max_level > level + 1 ? t->tracing->max_level : level + 1 };
    double weight = fmax(ticket.adc_bailout + TINY, pow(0.5 * (double)def->brightness, bounces + 1));
    Gathering all = { .nearest_t = FAR_AWAY, .nearest = n };
    int tries = 5 * rays;
    for (int i = 0; i < rays; i++)
        gather_ray(s, next_direction(g, bounces, n, raw, &tries), &ticket, level, weight, &all);
    Vec3 light = scaled(all.light, 1.0 / all.n);
    double far = ldexp(length(sub(g->radiosity->eye, s->surface->p)), bounces);
    double least = (double)def->minimum_reuse * far, most = (double)def->maximum_reuse * far;
    GatherSample sample = { .p = s->surface->p, .n = n, .nearest = all.nearest, .nearest_t = all.nearest_t, .bounces = bounces,
                            .light = rgb((float)light.x, (float)light.y, (float)light.z) };
    sample.radius = fmin(most, fmax(least, all.inverse_t > 0 ? all.n / all.inverse_t : INFINITY));
    sample.reach = reach_of(def, &sample, g->pass >= 0);
    if (all.nearest_t > 1e-4 * most && sample.reach > 0)
        cache_add(&g->own, &sample);
    return light;
}

/* ---- the light around a point ---- */

bool gather_here(const Shade *s)
{
    const Gather *g = s->t->gather;
    return g != NULL && s->path->ticket->bounces < g->radiosity->def->recursion_limit;
}

Rgb gathered_light(const Shade *s, Vec3 n, Vec3 raw, double weight)
{
    Gather *g = s->t->gather;
    const RadiosityDef *def = g->radiosity->def;
    int bounces = s->path->ticket->bounces;
    Vec3 around = def->normal ? n : raw;
    double bound = (double)def->error_bound * (g->pass >= 0 ? (double)def->low_error_factor : 1);
    if (weight < 0.25)
        bound += 0.25 - weight;
    Question q = { .p = s->surface->p, .n = around, .bound = ldexp(bound, bounces), .bounces = bounces,
                   .soft = g->pass < 0 && bounces == 0, };
    ask_forest(g->radiosity->world, &g->radiosity->forest, &q);
    if (g->own.n_slots > 0)
        ask_cache(&g->own, &q);
    double found = (double)q.weight / UNIT;
    Vec3 e = scaled(vec3((double)q.light[0], (double)q.light[1], (double)q.light[2]), 1 / UNIT);
    int wanted = bounces == 0 ? def->nearest_count : bounces == 1 && def->nearest_count > 2 ? 2 : bounces == 1 ? def->nearest_count : 1;
    bool enough = 4 * found >= wanted || (g->pass < 0 && !def->always_sample && found > 0);
    e = enough ? scaled(e, 1 / found) : scaled(add(e, gather(s, around, raw)), 1 / (found + 1));
    float grey = def->gray_threshold;
    Rgb light = rgb((float)e.x, (float)e.y, (float)e.z);
    light = rgb_add(rgb_scaled(light, 1 - grey), rgb_grey(grey * rgb_greyness(light)));
    return rgb_scaled(light, def->brightness);
}

/* ---- passes ---- */

Radiosity *radiosity_new(Arena *arena, const World *w, int quality, uint32_t n_tiles)
{
    const RadiosityDef *def = &w->globals.radiosity;
    if (!def->on || quality < 9)
        return NULL;
    Radiosity *r = arena_new(arena, Radiosity);
    r->world = w;
    r->def = def;
    r->eye = scaled(w->camera.location, w->unit);
    r->n_tiles = n_tiles;
    r->found = arena_array(arena, Found, n_tiles);
    arena_init(&r->arena);
    arena_init(&r->tree_arena);
    /* POV: fewer than 1600 directions come from a table of their own, which is as good as the first 1600 of these. */
    r->n_directions = def->count_bank > DIRECTIONS ? (uint32_t)def->count_bank : DIRECTIONS;
    r->direction = arena_array(arena, Vec3, r->n_directions);
    for (uint32_t i = 0; i < r->n_directions; i++) {
        double h = radical_inverse(2, i + 1), phi = 2 * PI * radical_inverse(3, i + 1);
        r->direction[i] = vec3(sqrt(h) * cos(phi), sqrt(1 - h), sqrt(h) * sin(phi));
    }
    return r;
}

void radiosity_free(Radiosity *r)
{
    if (r == NULL)
        return;
    for (uint32_t i = 0; i < r->n_tiles; i++)
        free(r->found[i].sample);
    arena_free(&r->arena);
    arena_free(&r->tree_arena);
}

int radiosity_passes(const Radiosity *r, int width, int height)
{
    double most = width > height ? width : height;
    double first = most * (double)r->def->pretrace_start, last = fmax(1, most * (double)r->def->pretrace_end);
    double passes = floor(log2(first / last) + 1 - TINY) + 1;
    return passes > 0 ? (int)passes : 0;
}

double radiosity_step(const Radiosity *r, int width, int height, int pass)
{
    double most = width > height ? width : height;
    return fmax(ldexp(most * (double)r->def->pretrace_start, -pass), fmax(1, most * (double)r->def->pretrace_end));
}

Gather *gather_new(Arena *arena, Radiosity *r)
{
    if (r == NULL)
        return NULL;
    Gather *g = arena_new(arena, Gather);
    g->radiosity = r;
    arena_init(&g->own.arena);
    return g;
}

void gather_free(Gather *g)
{
    if (g != NULL)
        arena_free(&g->own.arena);
}

/* Tiles start their directions far apart; the first tile of the first pass starts at the beginning. */
void tracer_start_gathering(Tracer *t, uint32_t tile, int pass)
{
    Gather *g = t->gather;
    g->pass = pass;
    t->vain = pass >= 0;
    cache_clear(&g->own);
    for (uint32_t i = 0; i < BOUNCES_MAX; i++)
        g->next_direction[i] = (uint32_t)((tile * UINT64_C(7919) + (uint64_t)(pass + 1) * (pass < 0 ? 0 : 104729)) % g->radiosity->n_directions);
}

void tracer_end_gathering(Tracer *t, uint32_t tile)
{
    Gather *g = t->gather;
    Found *found = &g->radiosity->found[tile];
    if (g->pass < 0 || g->own.sample.n == 0)
        return;
    found->sample = malloc(g->own.sample.n * sizeof *found->sample);
    found->n = found->sample != NULL ? g->own.sample.n : 0;    /* without memory: without these samples */
    if (found->n > 0)
        memcpy(found->sample, g->own.sample.data, found->n * sizeof *found->sample);
}

void radiosity_merge(Radiosity *r, bool last)
{
    for (uint32_t i = 0; i < r->n_tiles; i++) {
        for (uint32_t k = 0; k < r->found[i].n; k++)
            array_push(&r->arena, &r->forest.sample, r->found[i].sample[k]);
        free(r->found[i].sample);
        r->found[i] = (Found){ NULL, 0 };
    }
    plant(r, !last);
}
