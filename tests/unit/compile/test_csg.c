/* test_csg.c - set operations: laws of sets for points, laws of surfaces for hits, and the measured rules of 08-shapes, 10. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#undef fail                                    /* base/diag.h has a better one */

#include <stdlib.h>

#include "compile/compile.h"
#include "lib/bodies.h"
#include "world/prim.h"

typedef struct Fixture {
    Arena arena;
    Query *query;
} Fixture;

static Fixture fixture(void)
{
    Fixture f;
    arena_init(&f.arena);
    f.query = NULL;
    return f;
}

static Query *query(Fixture *f)
{
    if (f->query == NULL)
        f->query = query_new(&f->arena, NULL, NULL);
    return f->query;
}

static bool in(Fixture *f, const Object *o, Vec3 p)
{
    return query_inside(query(f), o, p);
}

static void inside_follows_the_laws_of_sets(void **state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 200; seed++) {
        Fixture f = fixture();
        Arena *a = &f.arena;
        Dice d = { seed };
        const Object *x = random_body(a, &d, 2, 1), *y = random_body(a, &d, 2, 1);
        const Object *uni = combined2(a, OBJECT_UNION, x, y), *merge = combined2(a, OBJECT_MERGE, x, y);
        const Object *both = combined2(a, OBJECT_INTERSECTION, x, y), *less = combined2(a, OBJECT_DIFFERENCE, x, y);
        const Object *not_y = inverted(a, y);
        /* inverse turns x into its complement only where no clip is involved: a clip is never inverted */
        const Object *bare = combined2(a, OBJECT_UNION, ball(a, dice_point(&d, 1), 1), block(a, vec3(-1, -1, -1), vec3(1, 1, 1)));
        const Object *de_morgan = combined2(a, OBJECT_INTERSECTION, inverted(a, bare->child[0]), inverted(a, bare->child[1]));
        for (int i = 0; i < 100; i++) {
            Vec3 p = dice_point(&d, 2);
            bool in_x = in(&f, x, p), in_y = in(&f, y, p);
            assert_int_equal(in(&f, uni, p), in_x || in_y);
            assert_int_equal(in(&f, merge, p), in_x || in_y);
            assert_int_equal(in(&f, both, p), in_x && in_y);
            assert_int_equal(in(&f, less, p), in_x && in(&f, not_y, p));
            assert_int_equal(in(&f, inverted(a, bare), p), !in(&f, bare, p));
            assert_int_equal(in(&f, de_morgan, p), !in(&f, bare, p));
        }
        arena_free(&f.arena);
    }
}

static bool collect(void *user, const Hit *hit)
{
    Hit *list = user;
    uint32_t n = list[0].prim;
    if (n < 255)
        list[++list[0].prim] = *hit;
    return false;
}

static int by_t(const void *a, const void *b)
{
    const Hit *x = a, *y = b;
    return (x->t > y->t) - (x->t < y->t);
}

/* Where all is merged or intersected, inside flips at every hit and nowhere else. */
static void inside_flips_at_every_hit_of_a_solid(void **state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 200; seed++) {
        Fixture f = fixture();
        Arena *a = &f.arena;
        Dice d = { seed };
        const Object *part[10];
        uint32_t n = seed % 3 == 0 ? 10 : 3;
        for (uint32_t i = 0; i < n; i++)
            part[i] = i % 2 ? ball(a, dice_point(&d, 1), dice_between(&d, 0.3, 1))
                            : placed(a, block(a, vec3(-0.5, -0.5, -0.5), vec3(0.5, 0.5, 0.5)),
                                     affine_then(affine_rotate(dice_point(&d, 90)), affine_translate(dice_point(&d, 1))));
        static const ObjectKind kinds[] = { OBJECT_MERGE, OBJECT_INTERSECTION, OBJECT_DIFFERENCE };
        const Object *o = combined(a, kinds[seed % 3], n, part);
        if (seed % 5 == 0)
            o = inverted(a, o);
        World *w = world_of(a, 1, &o, "bvh");
        for (int i = 0; i < 50; i++) {
            Ray ray = random_ray(&d, 1.5);
            Vec3 from = ray.o;
            ray.o = scaled(ray.o, w->unit);
            Hit hit[256];
            hit[0].prim = 0;
            world_each_hit(w, &ray, 0, collect, hit);
            uint32_t n_hits = hit[0].prim;
            qsort(hit + 1, n_hits, sizeof *hit, by_t);
            bool now = in(&f, o, from);
            double before = 0;
            for (uint32_t k = 1; k <= n_hits + 1; k++) {
                double t = k <= n_hits ? hit[k].t / w->unit : before + 10;
                assert_int_equal(in(&f, o, add(from, scaled(ray.d, (before + t) / 2))), now);
                now = !now;
                before = t;
            }
        }
        arena_free(&f.arena);
    }
}

/* The same set of visible points in another World, scaled exactly. */
static void scaling_by_powers_of_two_scales_hits_exactly(void **state)
{
    (void)state;
    static const int powers[] = { -300, -37, -1, 1, 20, 300 };
    for (uint32_t seed = 1; seed <= 40; seed++)
        for (size_t k = 0; k < sizeof powers / sizeof *powers; k++) {
            Arena a;
            arena_init(&a);
            Dice d = { seed }, e = { seed };
            double s = ldexp(1, powers[k]);
            const Object *one[5], *other[5];
            for (int i = 0; i < 5; i++) {
                one[i] = random_body(&a, &d, 2, 1);
                other[i] = placed(&a, random_body(&a, &e, 2, 1), affine_scale(vec3(s, s, s)));
            }
            World *w = world_of(&a, 5, one, "bvh"), *v = world_of(&a, 5, other, "bvh");
            assert_true(v->unit == w->unit / s);
            for (int i = 0; i < 50; i++) {
                Ray ray = random_ray(&d, 1);
                ray.o = scaled(ray.o, w->unit);
                Hit x, y;
                bool hit = world_nearest(w, &ray, 0, &x);
                assert_int_equal(hit, world_nearest(v, &ray, 0, &y));
                if (!hit)
                    continue;
                assert_true(x.t == y.t && x.prim == y.prim && x.part == y.part);
                Surface one_surface, other_surface;
                world_surface(w, &ray, &x, false, &one_surface);
                world_surface(v, &ray, &y, false, &other_surface);
                assert_memory_equal(&one_surface.p, &other_surface.p, sizeof(Vec3));
                assert_memory_equal(&one_surface.normal, &other_surface.normal, sizeof(Vec3));
                assert_memory_equal(&one_surface.geometric, &other_surface.geometric, sizeof(Vec3));
                assert_true(one_surface.error == other_surface.error);
            }
            arena_free(&a);
        }
}

static Hit nearest(const World *w, Vec3 o, Vec3 d)
{
    Ray ray = { scaled(o, w->unit), d, 0, INFINITY };
    Hit hit = { .t = -1 };
    if (!world_nearest(w, &ray, 0, &hit))
        hit.t = -1;
    hit.t /= w->unit;
    return hit;
}

static void of_equal_hits_the_first_object_and_the_last_child_win(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    const Object *box[2] = { block(&a, vec3(-1, -1, -1), vec3(1, 1, 1)), block(&a, vec3(-1, -1, -1), vec3(1, 1, 2)) };
    World *w = world_of(&a, 2, box, "bvh");
    const void *in_front = w->prim[nearest(w, vec3(0, 0, -5), vec3(0, 0, 1)).prim].data;
    assert_true(in_front != w->prim[nearest(w, vec3(0, 0, 5), vec3(0, 0, -1)).prim].data);
    assert_int_equal(nearest(w, vec3(0, 0, -5), vec3(0, 0, 1)).prim, 0);
    static const ObjectKind kinds[] = { OBJECT_UNION, OBJECT_INTERSECTION };
    for (int i = 0; i < 2; i++) {
        const Object *o = flagged(&a, combined(&a, kinds[i], 2, box), OBJECT_NO_SPLIT_UNION);
        World *v = world_of(&a, 1, &o, "bvh");
        const void *won = v->prim[nearest(v, vec3(0, 0, -5), vec3(0, 0, 1)).prim].data;
        const Bounds *data = won;
        assert_true(data->hi.z != data->hi.x); /* the second, longer one */
    }
    const Object *merge = combined(&a, OBJECT_MERGE, 2, box);
    World *m = world_of(&a, 1, &merge, "bvh");
    assert_true(nearest(m, vec3(0, 0, -5), vec3(0, 0, 1)).t > 5);      /* POV: a hole where faces coincide */
    arena_free(&a);
}

static void a_clip_cuts_hits_and_inside_but_is_never_inverted(void **state)
{
    (void)state;
    Fixture f = fixture();
    Arena *a = &f.arena;
    const Object *o = clipped_to(a, ball(a, vec3(0, 0, 0), 1), half_space(a, vec3(0, 1, 0), 0));
    World *w = world_of(a, 1, &o, "bvh");
    assert_true(fabs(nearest(w, vec3(0, 5, 0), vec3(0, -1, 0)).t - 6) < 1e-12);        /* in through the open top */
    assert_true(fabs(nearest(w, vec3(0, -5, 0), vec3(0, 1, 0)).t - 4) < 1e-12);
    const Object *inverse = inverted(a, o);
    assert_true(in(&f, o, vec3(0, -0.5, 0)) && !in(&f, o, vec3(0, 0.5, 0)));
    assert_true(in(&f, inverse, vec3(0, -2, 0)) && !in(&f, inverse, vec3(0, 2, 0)) && !in(&f, inverse, vec3(0, -0.5, 0)));
    arena_free(&f.arena);
}

static void a_small_bound_cuts_and_a_large_one_is_dropped(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    const Object *pair[2] = { ball(&a, vec3(0, 0, 0), 1), ball(&a, vec3(0, 0, 1), 1) };
    const Object *body = combined(&a, OBJECT_MERGE, 2, pair);
    const Object *cut = bounded_to(&a, body, ball(&a, vec3(0, 0, 0), 0.5)), *loose = bounded_to(&a, body, ball(&a, vec3(0, 0, 0), 9));
    World *w = world_of(&a, 1, &cut, "bvh"), *v = world_of(&a, 1, &loose, "bvh");
    assert_true(nearest(w, vec3(0, 0, -5), vec3(0, 0, 1)).t > 0 && nearest(w, vec3(0, 0.7, -5), vec3(0, 0, 1)).t < 0);
    assert_true(nearest(v, vec3(0, 0.7, -5), vec3(0, 0, 1)).t > 0);
    assert_int_equal(v->n_prims - w->n_prims, 0);
    assert_int_equal(v->n_csg + 1, w->n_csg);
    /* Alone, a shape keeps the box of its bound: a corner that the ball leaves out is still seen. */
    const Object *alone = bounded_to(&a, pair[0], ball(&a, vec3(0, 0, 0), 0.5));
    World *u = world_of(&a, 1, &alone, "bvh");
    assert_true(nearest(u, vec3(0.45, 0.45, -5), vec3(0, 0, 1)).t > 0 && nearest(u, vec3(0, 0.7, -5), vec3(0, 0, 1)).t < 0);
    arena_free(&a);
}

/* A frame and its bound turned together: the world's boxes of the two say nothing, those along the bound's axes do. */
static void a_bound_that_lies_askew_is_dropped_if_it_holds_the_body(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    const Object *frame = combined2(&a, OBJECT_DIFFERENCE, block(&a, vec3(-1, -1, -1), vec3(1, 1, 1)), block(&a, vec3(-3, -0.5, -0.5), vec3(3, 0.5, 0.5)));
    static const double size[] = { 1.1, 0.9 };
    for (int i = 0; i < 2; i++) {
        double s = size[i];
        const Object *o = placed(&a, bounded_to(&a, frame, block(&a, vec3(-s, -s, -s), vec3(s, s, s))), affine_rotate(vec3(20, 45, 10)));
        World *w = world_of(&a, 1, &o, "bvh");
        bool bounded = false;
        for (uint32_t k = 0; k < w->n_prims; k++)
            bounded |= (w->prim[k].flags & PRIM_BOUNDED) != 0;
        assert_int_equal(bounded, i == 1);
    }
    arena_free(&a);
}

static void copies_of_a_shared_shape_share_its_data(void **state)
{
    (void)state;
    enum { N = 1000 };
    Arena a;
    arena_init(&a);
    const Object *one = flagged(&a, block(&a, vec3(0, 0, 0), vec3(1, 1, 1)), OBJECT_DECLARED), *copy[N];
    for (int i = 0; i < N; i++)
        copy[i] = placed(&a, one, affine_translate(vec3(2 * i, 0, 0)));
    World *w = world_of(&a, N, copy, "bvh");
    assert_int_equal(w->n_prims, N);
    for (int i = 1; i < N; i++)
        assert_ptr_equal(w->prim[i].data, w->prim[0].data);
    for (int i = 0; i < N; i++)
        assert_int_equal(nearest(w, vec3(2 * i + 0.5, 0.5, -3), vec3(0, 0, 1)).prim, i);
    arena_free(&a);
}

static void subtrahends_and_planes_get_the_box_of_the_whole(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    const Object *part[3] = { ball(&a, vec3(0, 0, 0), 1), half_space(&a, vec3(0, 1, 0), 0), ball(&a, vec3(1, 0, 0), 5) };
    const Object *o = combined(&a, OBJECT_DIFFERENCE, 3, part);
    World *w = world_of(&a, 1, &o, "bvh");
    assert_int_equal(w->n_unbounded, 0);
    assert_int_equal(w->n_accel_prims, 3);
    for (uint32_t i = 0; i < 3; i++)
        assert_true(max_abs(w->box[i].lo) <= 1.001 * w->unit && max_abs(w->box[i].hi) <= 1.001 * w->unit);
    arena_free(&a);
}

/* Random half spaces around the origin, many of them endless together: every hit lies in the box that its plane was given. */
static void planes_together_get_a_box_that_holds_all_hits(void **state)
{
    (void)state;
    int boxed = 0;
    for (uint32_t seed = 1; seed <= 300; seed++) {
        Arena a;
        arena_init(&a);
        Dice d = { seed };
        const Object *part[9];
        uint32_t n = 3 + seed % 7;
        for (uint32_t i = 0; i < n; i++) {
            part[i] = half_space(&a, dice_direction(&d), dice(&d));
            if (i % 3 == 1)
                part[i] = inverted(&a, half_space(&a, dice_direction(&d), -dice(&d)));
            if (i % 4 == 3)
                part[i] = placed(&a, part[i], affine_then(affine_scale(vec3(1, 2, 0.5)), affine_rotate(dice_point(&d, 90))));
        }
        const Object *o = combined(&a, OBJECT_INTERSECTION, n, part);
        World *w = world_of(&a, 1, &o, "bvh"), *list = world_of(&a, 1, &o, "list");
        boxed += w->n_unbounded == 0;
        for (int i = 0; i < 100; i++) {
            Ray ray = random_ray(&d, 1);
            Hit x, y;
            bool hit = world_nearest(list, &ray, 0, &x);
            assert_int_equal(hit, world_nearest(w, &ray, 0, &y));
            assert_true(!hit || (x.t == y.t && x.prim == y.prim && bounds_contain(list->box[x.prim], ray_at(&ray, x.t))));
        }
        arena_free(&a);
    }
    assert_in_range(boxed, 50, 250);
}

static uint32_t topmost(const World *w)
{
    uint32_t k = 1;
    while (w->csg[k].parent != 0)
        k++;
    return ~k;
}

/* A random body and half spaces through its middle, which stand askew: the boxes hide no hit, and those of the planes are flat. */
static void planes_that_cut_a_body_get_the_boxes_of_their_faces(void **state)
{
    (void)state;
    int hits = 0, plane_hits = 0, flat = 0;
    for (uint32_t seed = 1; seed <= 300; seed++) {
        Arena a;
        arena_init(&a);
        Dice d = { seed };
        const Object *part[6] = { seed % 3 == 0 ? random_body(&a, &d, 2, 1) : ball(&a, dice_point(&d, 0.3), 1) };
        uint32_t n = 2 + seed % 5;
        for (uint32_t i = 1; i < n; i++)
            part[i] = half_space(&a, i % 3 == 0 ? vec3(0, 1, 0) : dice_direction(&d), dice_between(&d, -0.3, 0.5));
        if (seed % 4 == 1)
            part[0] = combined2(&a, OBJECT_UNION, ball(&a, vec3(1, 0, 0), 0.5),
                                combined2(&a, OBJECT_INTERSECTION, half_space(&a, dice_direction(&d), 0.3), block(&a, vec3(-1, -1, -1), vec3(1, 1, 1))));
        ObjectKind kind = seed % 2 ? OBJECT_DIFFERENCE : OBJECT_INTERSECTION;
        Affine place = affine_then(affine_scale(vec3(1, 2, 0.5)), affine_rotate(dice_point(&d, 90)));
        const Object *o = placed(&a, combined(&a, kind, n, part), place);
        World *w = world_of(&a, 1, &o, "bvh");
        for (uint32_t i = 0; i < w->n_prims; i++)
            flat += w->prim[i].ops == &body_half && bounds_area(w->box[i]) < 0.7 * bounds_area(w->bounds);
        for (int i = 0; i < 200; i++) {
            Ray ray = random_ray(&d, 1);
            Hit x, y;
            bool hit = item_nearest(w, topmost(w), &ray, &x);
            assert_int_equal(hit, world_nearest(w, &ray, 0, &y));
            assert_true(!hit || (x.t == y.t && x.prim == y.prim && bounds_contain(w->box[x.prim], ray_at(&ray, x.t))));
            hits += hit;
            plane_hits += hit && w->prim[x.prim].ops == &body_half;
        }
        arena_free(&a);
    }
    assert_true(hits > 8000 && plane_hits > 4000 && flat > 400);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inside_follows_the_laws_of_sets),
        cmocka_unit_test(inside_flips_at_every_hit_of_a_solid),
        cmocka_unit_test(scaling_by_powers_of_two_scales_hits_exactly),
        cmocka_unit_test(of_equal_hits_the_first_object_and_the_last_child_win),
        cmocka_unit_test(a_clip_cuts_hits_and_inside_but_is_never_inverted),
        cmocka_unit_test(a_small_bound_cuts_and_a_large_one_is_dropped),
        cmocka_unit_test(a_bound_that_lies_askew_is_dropped_if_it_holds_the_body),
        cmocka_unit_test(copies_of_a_shared_shape_share_its_data),
        cmocka_unit_test(planes_together_get_a_box_that_holds_all_hits),
        cmocka_unit_test(planes_that_cut_a_body_get_the_boxes_of_their_faces),
        cmocka_unit_test(subtrahends_and_planes_get_the_box_of_the_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
