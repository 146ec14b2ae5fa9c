/* blur.c - see blur.h. A few hexagonal grids, filled up by points of a sub-random sequence that keep apart. */
#include "render/blur.h"

#include "math/chi_square.h"
#include "math/mersenne.h"
#include "texture/texture.h"
#include "trace/random.h"

/* ---- when to stop ---- */

static const double *thresholds(Arena *arena, uint32_t n, double confidence, double variance)
{
    double *threshold = arena_array(arena, double, n + 1);
    if (n < 2)
        return threshold;
    double first = variance / chi_square_quantile_pov(n - 1, confidence);
    for (uint32_t m = 1; m <= n; m++)
        threshold[m] = first * chi_square_quantile_pov(m, confidence);
    return threshold;
}

/* ---- where ---- */

#define A 0.28867513459481287                  /* 1 / (2 sqrt 3), 1 / (3 sqrt 3), 1 / (8 sqrt 3) */
#define B 0.19245008972987526
#define C(n) (0.07216878364870323 * (n))
#define Q(n) (0.125 * (n))

static const Vec2 SQUARE[4] = { { -0.25, 0.25 }, { 0.25, 0.25 }, { -0.25, -0.25 }, { 0.25, -0.25 } };

static const Vec2 HEX_7[7] = { { -A, 0 }, { 0, 0 }, { A, 0 }, { -A / 2, 0.25 }, { -A / 2, -0.25 }, { A / 2, 0.25 },
                               { A / 2, -0.25 } };

static const Vec2 HEX_19[19] = {
    { -B, 1 / 3.0 }, { -B, -1 / 3.0 }, { B, 1 / 3.0 }, { B, -1 / 3.0 }, { 2 * B, 0 }, { -2 * B, 0 }, { 0, 0 },
    { 0, 1 / 3.0 }, { 0, -1 / 3.0 }, { -1.5 * B, 1 / 6.0 }, { -1.5 * B, -1 / 6.0 }, { 1.5 * B, 1 / 6.0 },
    { 1.5 * B, -1 / 6.0 }, { -B / 2, 1 / 6.0 }, { -B / 2, -1 / 6.0 }, { B / 2, 1 / 6.0 }, { B / 2, -1 / 6.0 }, { -B, 0 },
    { B, 0 }
};

static const Vec2 HEX_37[37] = {
    { 0, 0 }, { C(-3), Q(3) }, { C(3), Q(-3) }, { C(-3), Q(-3) }, { C(3), Q(3) }, { C(-6), 0 }, { C(6), 0 },
    { C(-2), Q(2) }, { C(2), Q(-2) }, { C(-2), Q(-2) }, { C(2), Q(2) }, { C(-4), 0 }, { C(4), 0 },
    { C(-1), Q(1) }, { C(1), Q(-1) }, { C(-1), Q(-1) }, { C(1), Q(1) }, { C(-2), 0 }, { C(2), 0 },
    { C(-5), Q(1) }, { C(-5), Q(-1) }, { C(5), Q(1) }, { C(5), Q(-1) },
    { C(-4), Q(2) }, { C(-4), Q(-2) }, { C(4), Q(2) }, { C(4), Q(-2) },
    { C(-1), Q(3) }, { C(-1), Q(-3) }, { C(1), Q(3) }, { C(1), Q(-3) },
    { C(-3), Q(1) }, { C(-3), Q(-1) }, { C(3), Q(1) }, { C(3), Q(-1) }, { 0, Q(2) }, { 0, Q(-2) }
};

static const uint8_t CHUNKS_37[] = { 7, 6, 6, 4, 4, 4, 4, 2, 0 }, CHUNKS_19[] = { 7, 6, 6, 0 }, CHUNKS_7[] = { 7, 0 },
                     CHUNKS_4[] = { 0 };

static const struct Grid { uint32_t n; const Vec2 *place; double jitter; const uint8_t *chunk; } GRID[] = {
    { 37, HEX_37, 0.0721688, CHUNKS_37 }, { 19, HEX_19, 0.096225, CHUNKS_19 }, { 7, HEX_7, 0.144338, CHUNKS_7 },
    { 0, SQUARE, 0, CHUNKS_4 }                 /* the square gives as many as are wanted, up to 4 */
};

typedef struct Cells { uint8_t *taken; uint32_t side; } Cells;

static uint8_t *cell_of(const Cells *cells, Vec2 p)
{
    double last = cells->side - 1;
    uint32_t x = (uint32_t)fmax(0, fmin(last, (p.u + 0.5) * cells->side));
    uint32_t y = (uint32_t)fmax(0, fmin(last, (p.v + 0.5) * cells->side));
    return &cells->taken[x * cells->side + y];
}

static Vec2 disc_point(uint32_t k)
{
    double r = sqrt(radical_inverse(2, k + 1) / 4), angle = 2 * PI * radical_inverse(3, k + 1);
    return (Vec2){ r * cos(angle), r * sin(angle) };
}

static void fill_up(Arena *arena, Vec2 *place, uint32_t have, uint32_t n)
{
    uint32_t side = 2 * (uint32_t)ceil(sqrt(n / PI)) + 1;
    Cells cells = { arena_array(arena, uint8_t, (size_t)side * side), side };
    for (uint32_t i = 0; i < have; i++)
        *cell_of(&cells, place[i]) = 1;
    uint32_t remain = 10 * n, k = 0;
    for (uint32_t i = have; i < n; i++) {
        Vec2 p = disc_point(k++);
        remain--;
        while ((*cell_of(&cells, p) || p.u * p.u + p.v * p.v > 0.25) && remain > n - i) {
            p = disc_point(k++);
            remain--;
        }
        place[i] = p;
        *cell_of(&cells, p) = 1;
    }
}

/* By rejection: the brighter the pigment, the more rays. */
static void fill_bokeh(const Pigment *bokeh, Vec2 *place, uint32_t n)
{
    Mersenne chance;
    mersenne_seed(&chance, MERSENNE_SEED);
    mersenne_next(&chance);
    uint32_t k = 0;
    for (uint32_t i = 0; i < n; i++) {
        double weight;
        do {
            place[i] = (Vec2){ radical_inverse(2, k + 1) - 0.5, radical_inverse(3, k + 1) - 0.5 };
            k++;
            Colour c = pigment_colour(bokeh, vec3(place[i].u + 0.5, place[i].v + 0.5, 0), NULL, NULL);
            weight = (double)rgb_greyness(rgb_of(c)) + k / ((double)n * n);
        } while (mersenne_next(&chance) / 4294967296.0 > weight);
    }
}

const Blur *blur_new(Arena *arena, const CameraDef *def)
{
    if (def->aperture == 0 || def->blur_samples <= 0)
        return NULL;
    Blur *blur = arena_new(arena, Blur);
    blur->n = (uint32_t)def->blur_samples;
    blur->n_min = def->blur_samples_min > 0 ? (uint32_t)def->blur_samples_min : 0;
    blur->threshold = thresholds(arena, blur->n, def->confidence, def->variance);
    Vec2 *place = arena_array(arena, Vec2, blur->n);
    blur->place = place;
    if (def->bokeh != NULL) {
        blur->jitter = 0.5 / sqrt(blur->n);
        blur->chunk = CHUNKS_4;
        fill_bokeh(def->bokeh, place, blur->n);
        return blur;
    }
    const struct Grid *grid = GRID;
    while (grid->n > blur->n)
        grid++;
    uint32_t have = grid->n > 0 ? grid->n : blur->n < 4 ? blur->n : 4;
    for (uint32_t i = 0; i < have; i++)        /* POV: written down with six decimals */
        place[i] = (Vec2){ round(grid->place[i].u * 1e6) / 1e6, round(grid->place[i].v * 1e6) / 1e6 };
    if (have < blur->n)
        fill_up(arena, place, have, blur->n);
    /* POV: the jitter of a grid that was filled up is that of its new number of points. */
    blur->jitter = grid->n == blur->n ? grid->jitter : 0.5 / sqrt(blur->n);
    blur->chunk = grid->chunk;
    return blur;
}
