/* test_properties.c - what holds for every row of the table of shapes, whatever the reference says.
 *
 * The samples are the shapes of shapes.csv. Rays are random, seeded by the sample's number: a failure prints both ends. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#undef fail

#include <stdlib.h>
#include <string.h>

#include "lib/csv.h"
#include "lib/scene_text.h"
#include "registry.h"

enum { MAX_SAMPLES = 200, RAYS = 150 };

static struct { char *id, *text; } sample[MAX_SAMPLES];
static int n_samples;
static uint64_t seed;

static double uniform(double lo, double hi)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return lo + (hi - lo) * ((double)(seed >> 11) * 0x1p-53);
}

static Vec3 random_point(double size)
{
    return vec3(uniform(-size, size), uniform(-size, size), uniform(-size, size));
}

static int read_samples(void **state)
{
    (void)state;
    static Csv c;
    const char *only = getenv("WHIT_SHAPE");
    for (csv_open(&c, "tests/vectors/shapes.csv"); csv_next(&c);)
        if (strcmp(c.field[1], "base") == 0 && (only == NULL || strcmp(only, c.field[0]) == 0)) {
            sample[n_samples].id = strdup(c.field[0]);
            sample[n_samples++].text = strdup(c.field[2]);
        }
    return 0;
}

static bool one_of(const char *id, const char *const *list)
{
    for (; *list != NULL; list++)
        if (strncmp(id, *list, strlen(*list)) == 0)
            return true;
    return false;
}

/* A ray towards the sample from anywhere around it. */
static Ray some_ray(double unit)
{
    Vec3 o = random_point(4), to = random_point(1);
    return (Ray){ scaled(o, unit), normalized(sub(to, o)), 0, INFINITY };
}

static void every_row_has_a_sample(void **state)
{
    (void)state;
    if (getenv("WHIT_SHAPE") != NULL)
        return;
    for (const ShapeOps *const *row = registry.shape; *row != NULL; row++) {
        bool found = false;
        for (int i = 0; i < n_samples && !found; i++)
            found = strncmp(sample[i].text, (*row)->keyword, strlen((*row)->keyword)) == 0;
        if (!found)
            print_message("no sample of %s\n", (*row)->keyword);
        assert_true(found);
    }
}

typedef int Check(int i, SceneText *s);

static void for_each_sample(Check *check)
{
    int bad = 0;
    for (int i = 0; i < n_samples; i++) {
        SceneText s = { 0 };
        seed = (uint64_t)i * 1000 + 1;
        if (scene_text(&s, sample[i].text)) {
            int wrong = check(i, &s);
            if (wrong)
                print_message("%s: %d wrong\n", sample[i].id, wrong);
            bad += wrong;
        }
        scene_text_end(&s);
    }
    assert_int_equal(bad, 0);
}

/* ---- boxes ---- */

static int hit_outside_its_box(int i, SceneText *s)
{
    const World *w = &s->world;
    int wrong = 0;
    for (int k = 0; k < RAYS * 4; k++) {
        Ray ray = some_ray(w->unit);
        Hit hit;
        if (!world_nearest(w, &ray, 0, &hit))
            continue;
        Vec3 p = ray_at(&ray, hit.t);
        if (!bounds_contain(bounds_grown(w->box[hit.prim], 1e-12), p) && wrong++ < 3)
            print_message("%s ray %d: hit at <%.17g,%.17g,%.17g>\n", sample[i].id, k, p.x, p.y, p.z);
    }
    return wrong;
}

static void boxes_hold_every_hit(void **state)
{
    (void)state;
    for_each_sample(hit_outside_its_box);
}

/* ---- inside ---- */

static int does_not_flip(int i, SceneText *s)
{
    /* No inside, or half a space; open; cut by others; walls within; thin as paper; lengths of their own for accuracy. */
    static const char *const other[] = { "triangle", "smooth-triangle", "polygon", "patch", "mesh", "disc", "parametric",
                                         "cylinder-open", "cone-open", "sor-open", "prism-open", "isosurface-open",
                                         "csg-", "clipped", "bounded", "torus-spindle", "sweep", "box-flat", "julia", "text", NULL };
    if (one_of(sample[i].id, other))
        return 0;
    int wrong = 0, hits = 0;
    for (int k = 0; k < RAYS; k++) {
        Ray ray = some_ray(1);
        Vec3 p, n;
        if (!scene_text_trace(s, ray.o, ray.d, &p, &n))
            continue;
        double step = strstr(sample[i].id, "isosurface") || strstr(sample[i].id, "ellipsoid-thin") ? 2e-5 : 1e-6;
        if (strstr(sample[i].id, "isosurface"))
            step = 0.01;
        hits++;
        bool out = query_inside(s->query, s->scene.object[0], add(p, scaled(n, step)));
        bool in = query_inside(s->query, s->scene.object[0], sub(p, scaled(n, step)));
        if (out == in && wrong++ < 3)          /* normals do not always point outwards: bases of prisms, inverse quadrics */
            print_message("%s ray %d: at <%g,%g,%g> normal <%g,%g,%g> inside is %d, before it %d\n", sample[i].id, k, p.x, p.y, p.z, n.x,
                          n.y, n.z, in, out);
    }
    return wrong;
}

static void inside_flips_across_the_surface(void **state)
{
    (void)state;
    for_each_sample(does_not_flip);
}

/* ---- powers of two ---- */

static bool same_bits(Vec3 a, Vec3 b, int k)
{
    Vec3 c = vec3(ldexp(a.x, k), ldexp(a.y, k), ldexp(a.z, k));
    return c.x == b.x && c.y == b.y && c.z == b.z;
}

static int changes_with_its_unit(int i, SceneText *s)
{
    static const int powers[] = { -300, -40, 3, 300 };
    /* `accuracy` and `flatness` are lengths of the scene, and here they are not scaled along. */
    static const char *const other[] = { "isosurface", "patch", "parametric", "csg-difference-isosurface",
                                         "csg-intersection-planes",    /* endless planes alone give the World no size */
                                         NULL };
    if (one_of(sample[i].id, other))
        return 0;
    int wrong = 0;
    for (size_t n = 0; n < sizeof powers / sizeof *powers; n++) {
        int k = powers[n];
        size_t length_ = strlen(sample[i].text) + 64;
        char *text = malloc(length_);
        snprintf(text, length_, "object { %s scale pow(2,%d) }", sample[i].text, k);
        SceneText moved = { 0 };
        if (!scene_text(&moved, text)) {
            print_message("%s", moved.messages);
            wrong++;
        } else
            for (int r = 0; r < RAYS; r++) {
                Ray ray = some_ray(1);
                Vec3 p, q, a, b;
                Vec3 o = vec3(ldexp(ray.o.x, k), ldexp(ray.o.y, k), ldexp(ray.o.z, k));
                bool hit = scene_text_trace(s, ray.o, ray.d, &p, &a), same = scene_text_trace(&moved, o, ray.d, &q, &b) == hit;
                if (!(same && (!hit || (same_bits(p, q, k) && same_bits(a, b, 0)))) && wrong++ < 3)
                    print_message("%s ray %d: 2^%d changes <%.17g,%.17g,%.17g> to <%.17g,%.17g,%.17g>\n", sample[i].id, r, k, p.x, p.y,
                                  p.z, ldexp(q.x, -k), ldexp(q.y, -k), ldexp(q.z, -k));
            }
        scene_text_end(&moved);
        free(text);
    }
    return wrong;
}

static void powers_of_two_change_no_bits(void **state)
{
    (void)state;
    for_each_sample(changes_with_its_unit);
}

/* The same, for lengths that are written larger instead of being scaled. */
static void powers_of_two_as_written_change_no_bits(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "sphere { S*<0.3,0.2,0.1>, 1.1*S }", "box { S*<-1,-0.5,-0.25>, S*<1,0.5,0.3> }", "plane { <1,2,3>, 0.3*S }",
        "cylinder { S*<-0.5,-0.6,0.2>, S*<0.4,0.7,-0.3>, 0.4*S }", "cone { S*<0,-1,0.1>, 0.9*S, S*<0.2,1,0>, 0.3*S }",
        "torus { 0.9*S, 0.35*S }", "disc { S*<0,0.2,0>, <1,2,3>, S, 0.3*S }", "triangle { S*<-1,-0.5,0>, S*<1,-0.5,0.3>, S*<0,1,-0.2> }",
        "polygon { 4, S*<-1,-1,0.1>, S*<1,-1,0.1>, S*<1,1,0.1>, S*<-1,1,0.1> }",
        "mesh { triangle { S*<-1,-1,-1>, S*<1,-1,-1>, S*<0,1,0.1> } triangle { S*<1,-1,-1>, S*<0,-1,1>, S*<0,1,0.1> } }",
        "quadric { <1,0.5,0.25>, <0.1,0.2,0.3>, S*<0.3,0.2,0.1>, -0.8*S*S }",
        "bicubic_patch { type 1 flatness 0.01*S u_steps 3 v_steps 3 S*<-1,0.2,-1>,S*<-0.33,0,-1>,S*<0.33,0,-1>,S*<1,0.2,-1>,"
        " S*<-1,0,-0.3>,S*<-0.3,0.9,-0.3>,S*<0.3,0.9,-0.3>,S*<1,0,-0.3>, S*<-1,0,0.3>,S*<-0.3,0.9,0.3>,S*<0.3,0.9,0.3>,S*<1,0,0.3>,"
        " S*<-1,0.2,1>,S*<-0.33,0,1>,S*<0.33,0,1>,S*<1,0.4,1> }",
        "blob { threshold 0.5 sphere { S*<-0.4,0,0>, S, 1 } sphere { S*<0.5,0.1,0>, 0.9*S, 1 scale <1,1.2,0.8> }"
        " cylinder { S*<0,-1,0>, S*<0,1,0.3>, 0.5*S, 0.8 } }",
        "lathe { cubic_spline 5 S*<0.1,-1>, S*<0.4,-0.8>, S*<0.9,-0.1>, S*<0.5,0.6>, S*<0.3,0.9> }",
        "ovus { 0.8*S, 0.5*S }",
        "prism { quadratic_spline -0.3*S, 0.4*S, 6 S*<-1,-0.9>, S*<-0.9,-0.8>, S*<0.8,-0.7>, S*<0.9,0.8>, S*<-0.7,0.9>, S*<-0.9,-0.8> }",
        "prism { conic_sweep linear_spline 0.2*S, S, 4 <-0.8,-0.7>, <0.9,-0.6>, <0.1,0.9>, <-0.8,-0.7> }",
        "sor { 5 S*<0.3,-1.2>, S*<0.5,-0.8>, S*<0.9,-0.1>, S*<0.4,0.7>, S*<0.3,1> }",
        "sphere_sweep { linear_spline 3 S*<-0.8,0,0>, 0.3*S, S*<0,0.5,0.2>, 0.4*S, S*<0.7,0,-0.3>, 0.2*S }",
        "sphere_sweep { b_spline 5 S*<-1.5,-0.5,0>, 0.2*S, S*<-0.9,0,0>, 0.3*S, S*<0,0.5,0>, 0.5*S, S*<0.9,0,0.2>, 0.2*S,"
        " S*<1.5,-0.5,0>, 0.2*S }",
    };
    static const int powers[] = { 0, -300, -41, 2, 300 };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        Vec3 first[RAYS], first_normal[RAYS];
        bool first_hit[RAYS];
        int hits = 0;
        for (size_t n = 0; n < sizeof powers / sizeof *powers; n++) {
            int k = powers[n];
            char text[4096];
            snprintf(text, sizeof text, "#declare S = pow(2,%d); %s", k, texts[i]);
            SceneText s = { 0 };
            if (!scene_text(&s, text))
                print_message("%s", s.messages);
            assert_int_equal(s.scene.n_objects, 1);
            seed = i + 1;
            for (int r = 0; r < RAYS; r++) {
                Ray ray = some_ray(1);
                Vec3 p = { 0 }, normal = { 0 }, o = vec3(ldexp(ray.o.x, k), ldexp(ray.o.y, k), ldexp(ray.o.z, k));
                bool hit = scene_text_trace(&s, o, ray.d, &p, &normal);
                if (n == 0) {
                    first[r] = p;
                    first_normal[r] = normal;
                    first_hit[r] = hit;
                    hits += hit;
                } else if (hit != first_hit[r] || (hit && !(same_bits(first[r], p, k) && same_bits(first_normal[r], normal, 0)))) {
                    print_message("%s ray %d: 2^%d changes <%.17g,%.17g,%.17g> to <%.17g,%.17g,%.17g>\n", texts[i], r, k, first[r].x,
                                  first[r].y, first[r].z, ldexp(p.x, -k), ldexp(p.y, -k), ldexp(p.z, -k));
                    assert_true(false);
                }
            }
            scene_text_end(&s);
        }
        assert_true(hits > 5);
    }
}

/* A Lemniscate of Gerono lies between x = -1 and 1: rays that are nearly square to x, for which the equation loses its
 * leading terms, have no business elsewhere (POV-Ray draws lines across the picture). */
static void polynomials_are_not_hit_at_the_end_of_the_world(void **state)
{
    (void)state;
    SceneText s = { 0 };
    assert_true(scene_text(&s, "polynomial { 4, xyz(4,0,0): 1, xyz(2,0,0): -1, xyz(0,2,0): 1, xyz(0,0,2): 1 rotate <30,0,65> }"));
    Affine turn = affine_rotate(vec3(30, 0, 65));
    seed = 1;
    for (int i = 0; i < 20000; i++) {
        Vec3 o = vec3(uniform(-3, 3), uniform(-3, 3), uniform(-3, 3));
        Vec3 d = vec3(pow(10, uniform(-20, -1)) * (i & 1 ? 1 : -1), uniform(-1, 1), uniform(-1, 1)), p, n;
        if (!scene_text_trace(&s, affine_point(&turn, o), affine_vector(&turn, d), &p, &n))
            continue;
        if (length(p) > 1.0001)
            print_message("ray %d: hit at <%g, %g, %g>\n", i, p.x, p.y, p.z);
        assert_true(length(p) <= 1.0001);
    }
    scene_text_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_row_has_a_sample),
        cmocka_unit_test(boxes_hold_every_hit),
        cmocka_unit_test(inside_flips_across_the_surface),
        cmocka_unit_test(powers_of_two_change_no_bits),
        cmocka_unit_test(powers_of_two_as_written_change_no_bits),
        cmocka_unit_test(polynomials_are_not_hit_at_the_end_of_the_world),
    };
    return cmocka_run_group_tests(tests, read_samples, NULL);
}
