/* test_accel.c - every accelerator and every instruction set gives the bits of the plain list. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#undef fail                                    /* base/diag.h has a better one */

#include <stdlib.h>
#include <string.h>

#include "accel/accel.h"
#include "base/cpu.h"
#include "lib/bodies.h"
#include "world/shaft.h"

enum { MAX_HITS = 4096 };

typedef struct Hits {
    uint32_t n;
    Hit hit[MAX_HITS];
} Hits;

static bool collect(void *user, const Hit *hit)
{
    Hits *h = user;
    if (h->n < MAX_HITS)
        h->hit[h->n++] = *hit;
    return false;
}

static int by_order(const void *a, const void *b)
{
    const Hit *x = a, *y = b;
    if (x->t != y->t)
        return x->t < y->t ? -1 : 1;
    if (x->prim != y->prim)
        return x->prim < y->prim ? -1 : 1;
    return x->part < y->part ? -1 : x->part > y->part;
}

static bool same_hit(const Hit *a, const Hit *b)
{
    return a->t == b->t && a->prim == b->prim && a->part == b->part;
}

static void expect_same(const World *list, const World *other, const Ray *ray, uint32_t seed, int i)
{
    static Hits a, b;
    Hit x, y;
    bool hit = world_nearest(list, ray, 0, &x);
    bool same = hit == world_nearest(other, ray, 0, &y) && (!hit || same_hit(&x, &y));
    a.n = b.n = 0;
    world_each_hit(list, ray, 0, collect, &a);
    world_each_hit(other, ray, 0, collect, &b);
    qsort(a.hit, a.n, sizeof *a.hit, by_order);
    qsort(b.hit, b.n, sizeof *b.hit, by_order);
    same &= a.n == b.n;
    for (uint32_t k = 0; same && k < a.n; k++)
        same = same_hit(&a.hit[k], &b.hit[k]);
    if (!same)
        print_error("seed %u, ray %d: hit %d prim %u t %a, not %u t %a; %u hits, not %u\n", seed, i, hit, x.prim, x.t, y.prim,
                    y.t, a.n, b.n);
    assert_true(same);
}

/* A shaft from the ray's start into a box that holds its end: what the ray meets in between lies in the shaft. */
static void expect_shaft_complete(const World *list, const World *other, const Ray *ray, uint32_t seed, int i)
{
    static Hits a, b;
    static const double half[4] = { 0, 1e-6, 0.1, 1 };
    Ray part = { ray->o, ray->d, 0, (1 + i % 5) / length(ray->d) };
    Vec3 end = ray_at(&part, part.t_max), corner = scaled(vec3(1, 0.5, 0.25), half[i % 4] + 0x1p-40 * max_abs(end));
    Shaft shaft;
    world_shaft(other, part.o, (Bounds){ sub(end, corner), add(end, corner) }, 0, &shaft);
    if (shaft.crowded)
        return;
    a.n = b.n = 0;
    world_each_hit(list, &part, 0, collect, &a);
    shaft_each_hit(other, &shaft, &part, collect, &b);
    if (a.n != b.n)
        print_error("seed %u, ray %d: %u hits, %u in the shaft of %u\n", seed, i, a.n, b.n, shaft.n);
    assert_int_equal(a.n, b.n);
}

static void expect_worlds_alike(uint32_t n, const Object *const *object, Arena *a, uint32_t seed, double size, int n_rays)
{
    static const char *const isas[] = { "base", "avx2", "avx512" };
    World *list = world_of(a, n, object, "list");
    for (size_t isa = 0; isa < sizeof isas / sizeof *isas; isa++) {
        setenv("WHIT_CPU", isas[isa], 1);
        World *bvh = world_of(a, n, object, "bvh");
        Dice d = { seed };
        for (int i = 0; i < n_rays; i++) {
            Ray ray = random_ray(&d, size);
            expect_same(list, bvh, &ray, seed, i);
            expect_shaft_complete(list, bvh, &ray, seed, i);
            Vec3 p = dice_point(&d, size);
            uint32_t in_list[8], in_bvh[8], k = world_interiors_at(list, p, in_list, 8);
            assert_int_equal(k, world_interiors_at(bvh, p, in_bvh, 8));
            assert_memory_equal(in_list, in_bvh, k * sizeof *in_list);
        }
        unsetenv("WHIT_CPU");
    }
}

static void random_scenes_are_hit_alike(void **state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 60; seed++) {
        Arena a;
        arena_init(&a);
        Dice d = { seed };
        const Object *object[40];
        uint32_t n = 1 + (uint32_t)(dice(&d) * 39);
        for (uint32_t i = 0; i < n; i++)
            object[i] = placed(&a, random_body(&a, &d, (int)(dice(&d) * 4), 0.5), affine_translate(dice_point(&d, 1.5)));
        expect_worlds_alike(n, object, &a, seed, 2, 150);
        arena_free(&a);
    }
}

static void thousands_of_balls_are_hit_alike(void **state)
{
    (void)state;
    enum { N = 5000 };
    Arena a;
    arena_init(&a);
    Dice d = { 7 };
    const Object **object = arena_array(&a, const Object *, N);
    for (uint32_t i = 0; i < N; i++)           /* sizes over many orders of magnitude */
        object[i] = ball(&a, dice_point(&d, 1), 0.2 * pow(10, -8 * dice(&d)));
    expect_worlds_alike(N, object, &a, 7, 1, 300);
    arena_free(&a);
}

/* Whole-number boxes, and rays along their faces, edges and through their corners. */
static void rays_along_a_lattice_are_hit_alike(void **state)
{
    (void)state;
    enum { N = 8 };
    Arena a;
    arena_init(&a);
    const Object *object[N * N * N];
    uint32_t n = 0;
    for (int x = 0; x < N; x++)
        for (int y = 0; y < N; y++)
            for (int z = 0; z < N; z++)
                object[n++] = block(&a, vec3(x, y, z), vec3(x + 1, y + 1, z + 1));
    World *list = world_of(&a, n, object, "list"), *bvh = world_of(&a, n, object, "bvh");
    double unit = list->unit;
    Dice d = { 3 };
    for (int i = 0; i < 3000; i++) {
        Vec3 from = vec3(floor(dice_between(&d, -2, N + 3)), floor(dice_between(&d, -2, N + 3)), floor(dice_between(&d, -2, N + 3)));
        Vec3 to = vec3(floor(dice_between(&d, -2, N + 3)), floor(dice_between(&d, -2, N + 3)), floor(dice_between(&d, -2, N + 3)));
        Vec3 step = sub(to, from);
        if (length2(step) == 0)
            continue;
        Ray ray = { scaled(from, unit), i % 2 ? normalized(step) : scaled(step, unit), 0, INFINITY };
        expect_same(list, bvh, &ray, 3, i);
        expect_shaft_complete(list, bvh, &ray, 3, i);
    }
    arena_free(&a);
}

/* The tree takes what shapes that do not know better hand to it. */
static bool count_item(void *user, uint32_t item, double *t_max)
{
    (void)t_max;
    ((uint32_t *)user)[item]++;
    return false;
}

static void odd_boxes_are_offered_whenever_a_ray_may_meet_them(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    Bounds box[40];
    for (uint32_t i = 0; i < 40; i++)
        box[i] = (Bounds){ { i, 0, 0 }, { i + 0.5, 0, 0 } };   /* lines */
    box[5] = bounds_everything();
    box[6] = (Bounds){ { NAN, 0, 0 }, { 1, 1, 1 } };
    box[7] = (Bounds){ { -1e200, 0, 0 }, { 1e200, 1, 1 } };
    box[8] = (Bounds){ { 0, 0, 0 }, { 0, 0, 0 } };
    void *tree = accel_bvh.build(&a, box, 40);
    for (int axis = 0; axis < 3; axis++) {
        uint32_t seen[40] = { 0 };
        Ray ray = { { 0, 0, 0 }, { axis == 0, axis == 1, axis == 2 }, 0, INFINITY };
        double t_max = INFINITY;
        accel_bvh.walk(tree, &ray, &t_max, count_item, seen);
        for (uint32_t i = 0; i < 40; i++)
            if (axis == 0 || (i >= 5 && i <= 8) || i == 0)
                assert_true(seen[i] >= 1);
    }
    uint32_t seen[40] = { 0 };
    accel_bvh.around(tree, vec3(3.25, 0, 0), count_item, seen);
    assert_true(seen[3] && seen[5] && seen[7] && !seen[20]);
    arena_free(&a);
}

/* Crowds within crowds, some in one place, and a few far away: grids in cells of grids. */
static void each_of_many_boxes_stands_in_the_tree_once(void **state)
{
    (void)state;
    enum { N = 20000 };
    Arena a;
    arena_init(&a);
    Dice d = { 11 };
    Bounds *box = arena_array(&a, Bounds, N);
    for (uint32_t i = 0; i < N; i++) {
        static const double spread[4] = { 1e6, 1, 1e-4, 0 };
        Vec3 p = dice_point(&d, spread[i % 97 == 0 ? 0 : 1 + i % 3]);
        box[i] = (Bounds){ p, add(p, vec3(1e-3 * dice(&d), i % 5 == 0 ? 0 : 1e-5, 1e-4)) };
    }
    void *tree = accel_bvh.build(&a, box, N);
    uint32_t *seen = arena_array(&a, uint32_t, N);
    for (uint32_t i = 0; i < N; i += 7) {
        memset(seen, 0, N * sizeof *seen);
        accel_bvh.around(tree, box[i].lo, count_item, seen);
        for (uint32_t k = 0; k < N; k++)
            assert_true(seen[k] <= 1 && (seen[k] == 1 || !bounds_contain(box[k], box[i].lo)));
    }
    arena_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_scenes_are_hit_alike),
        cmocka_unit_test(thousands_of_balls_are_hit_alike),
        cmocka_unit_test(rays_along_a_lattice_are_hit_alike),
        cmocka_unit_test(odd_boxes_are_offered_whenever_a_ray_may_meet_them),
        cmocka_unit_test(each_of_many_boxes_stands_in_the_tree_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
