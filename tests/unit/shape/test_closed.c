/* test_closed.c - shapes made of pieces are closed: rays enter as often as they leave, also those aimed at the joints; and what an
 * accelerator leaves out changes no bit. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#undef fail

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/scene_text.h"

enum { RAYS = 3000, MOST = 256 };

/* `joint`: a point that pieces share; rays are aimed at its circle, its line or itself. */
static const struct { const char *text; Vec3 joint; enum { AROUND_Y, ALONG_Y, ITSELF } spread; } shapes[] = {
    { "lathe { linear_spline 5 <0,-1>, <0.9,-0.4>, <0.5,0.2>, <0.7,0.6>, <0,1> }", { 0.5, 0.2, 0 }, AROUND_Y },
    { "lathe { linear_spline 5 <0.2,-1>, <0.9,-0.5>, <0.5,0.6>, <0.3,0.1>, <0.2,-1> }", { 0.5, 0.6, 0 }, AROUND_Y },
    { "lathe { cubic_spline 7 <0,-1.5>, <0,-1>, <0.9,-0.4>, <0.5,0.2>, <0.7,0.6>, <0,1>, <0,1.2> }", { 0.9, -0.4, 0 }, AROUND_Y },
    { "lathe { quadratic_spline 6 <0.3,-1.5>, <0,-1>, <0.9,-0.4>, <0.5,0.2>, <0.7,0.6>, <0,1> }", { 0.5, 0.2, 0 }, AROUND_Y },
    { "lathe { bezier_spline 8 <0,-1>, <0.8,-1>, <0.9,-0.5>, <0.7,0>, <0.7,0>, <0.5,0.5>, <0.4,1>, <0,1> }", { 0.7, 0, 0 }, AROUND_Y },
    { "sor { 6 <0.2,-1.5>, <0.5,-1>, <0.9,-0.3>, <0.4,0.4>, <0.6,1>, <0.6,1.5> }", { 0.4, 0.4, 0 }, AROUND_Y },
    { "sor { 5 <0.2,-1.5>, <0,-1>, <0.9,-0.3>, <0,1>, <0.6,1.5> }", { 0.9, -0.3, 0 }, AROUND_Y },
    { "ovus { 1, 0.6 }", { 0.6, 0.5, 0 }, AROUND_Y },
    { "prism { linear_spline -0.6, 0.7, 6 <-0.9,-0.8>, <0.8,-0.9>, <0.2,0.1>, <0.9,0.8>, <-0.7,0.7>, <-0.9,-0.8> }", { 0.2, 0, 0.1 }, ALONG_Y },
    { "prism { cubic_spline -0.5, 0.5, 7 <-0.8,0.8>, <-0.8,-0.8>, <0.8,-0.8>, <0.8,0.8>, <-0.8,0.8>, <-0.8,-0.8>, <0.8,-0.8> }",
      { 0.8, 0, 0.8 }, ALONG_Y },
    { "prism { quadratic_spline -0.3, 0.4, 6 <-1,-0.9>, <-0.9,-0.8>, <0.8,-0.7>, <0.9,0.8>, <-0.7,0.9>, <-0.9,-0.8> }", { 0.9, 0, 0.8 }, ALONG_Y },
    { "prism { conic_sweep linear_spline 0.2, 1, 4 <-0.8,-0.7>, <0.9,-0.6>, <0.1,0.9>, <-0.8,-0.7> }", { 0.05, 0.5, 0.45 }, ITSELF },
    { "sphere_sweep { linear_spline 4 <-1,0,0>, 0.3, <0,0.5,0>, 0.5, <1,0,0.2>, 0.2, <0.4,-0.8,0>, 0.3 }", { 0, 0, 0 }, ITSELF },
    { "sphere_sweep { b_spline 6 <-1.5,-0.5,0>, 0.2, <-0.9,0,0>, 0.3, <0,0.5,0>, 0.5, <0.9,0,0.2>, 0.2, <1.5,-0.5,0>, 0.2, <0,-1,0>, 0.3 }",
      { 0, 0.3, 0 }, ITSELF },
    { "sphere_sweep { cubic_spline 5 <-1.5,-0.5,0>, 0.2, <-0.9,0,0>, 0.3, <0,0.5,0>, 0.5, <0.9,0,0.2>, 0.2, <1.5,-0.5,0>, 0.2 }",
      { 0, 0, 0 }, ITSELF },
    { "blob { threshold 0.5 sphere { <-0.4,0,0>, 1, 1 } sphere { <0.5,0.1,0>, 0.9, 1 } cylinder { <0,-1,0>, <0,1,0.3>, 0.5, 0.8 } }",
      { 0, 0, 0 }, ITSELF },
    { "text { internal 1 \"8\" 0.3, 0 translate <-0.2,-0.35,-0.15> scale 2 }", { 0, 0, 0 }, ITSELF },
    { "text { internal 3 \"B\" 0.3, 0 translate <-0.2,-0.35,-0.15> scale 2 }", { 0, 0.7, 0 }, ITSELF },
};

static uint64_t seed;

static double uniform(double lo, double hi)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return lo + (hi - lo) * ((double)(seed >> 11) * 0x1p-53);
}

static Vec3 direction(void)
{
    Vec3 d;
    do
        d = vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    while (length2(d) > 1 || length2(d) < 0.01);
    return normalized(d);
}

/* Every other ray goes to a joint, every eighth along a coordinate plane. */
static Ray some_ray(size_t shape, int i, double unit)
{
    Vec3 to = vec3(uniform(-0.8, 0.8), uniform(-0.8, 0.8), uniform(-0.8, 0.8)), d = direction(), j = shapes[shape].joint;
    if (i & 1) {
        double angle = uniform(0, 2 * PI);
        to = shapes[shape].spread == AROUND_Y ? vec3(j.x * cos(angle), j.y, j.x * sin(angle))
             : shapes[shape].spread == ALONG_Y ? vec3(j.x, uniform(-0.25, 0.3), j.z)
                                               : j;
    }
    if (i % 8 == 1)
        vec3_set(&d, i / 8 % 3, 0);
    d = normalized(d);
    return (Ray){ scaled(sub(to, scaled(d, 5)), unit), d, 0, INFINITY };
}

typedef struct { int n; double t[MOST]; } Hits;

static bool collect(void *user, const Hit *hit)
{
    Hits *h = user;
    assert_true(h->n < MOST);
    h->t[h->n++] = hit->t;
    return false;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool inside_at(const SceneText *s, const Ray *ray, double t)
{
    return query_inside(s->query, s->scene.object[0], scaled(ray_at(ray, t), 1 / s->world.unit));
}

/* Hits closer than this are one place: a joint, a rim or a graze. */
static const double NEAR = 1e-6;

/* Between two places nothing changes; at a place the inside changes if and only if its hits are odd in number. Where a cap
 * meets a side both may answer. */
static int check_ray(const SceneText *s, const Ray *ray, bool capped)
{
    Hits h = { 0 };
    double unit = s->world.unit;
    world_each_hit(&s->world, ray, 0, collect, &h);
    qsort(h.t, (size_t)h.n, sizeof *h.t, ascending);
    bool in = false;
    int wrong = 0;
    for (int first = 0, last; first < h.n; first = last) {
        last = first + 1;
        while (last < h.n && h.t[last] - h.t[last - 1] < NEAR * unit)
            last++;
        double from = h.t[last - 1], to = last < h.n ? h.t[last] : from + 0.01 * unit, way = to - from;
        bool now = inside_at(s, ray, from + 0.5 * way);
        bool odd = (last - first) & 1;
        if (way < 1e-3 * unit && last < h.n) { /* too thin to ask */
            in ^= odd;
            continue;
        }
        wrong += inside_at(s, ray, from + 0.25 * way) != now || inside_at(s, ray, from + 0.75 * way) != now;
        wrong += (now != in) != odd && !(capped && last - first > 1);
        in = now;
    }
    return wrong + in;
}

static void rays_enter_as_often_as_they_leave(void **state)
{
    (void)state;
    int wrong = 0;
    for (size_t k = 0; k < sizeof shapes / sizeof *shapes; k++) {
        SceneText s = { 0 };
        assert_true(scene_text(&s, shapes[k].text));
        bool capped = strstr(shapes[k].text, "sor") || strstr(shapes[k].text, "prism") || strstr(shapes[k].text, "text");
        seed = k + 1;
        for (int i = 0; i < RAYS; i++) {
            Ray ray = some_ray(k, i, s.world.unit);
            if (check_ray(&s, &ray, capped) && wrong++ < 20)
                print_message("%.60s ray %d\n", shapes[k].text, i);
        }
        scene_text_end(&s);
    }
    assert_int_equal(wrong, 0);
}

/* ---- many parts: with a tree and without ---- */

static const char *const crowds[] = {
    ("blob { threshold 0.4 #local R = seed(1); #for (I, 1, 150) sphere { <rand(R)-0.5,rand(R)-0.5,rand(R)-0.5>*2, 0.3, 1 } #end "
        "cylinder { -x, x, 0.3, 0.7 } }"),
    "sphere_sweep { linear_spline 60 #for (I, 0, 59) , <sin(I*0.4), I*0.03-0.9, cos(I*0.4)>, 0.12+0.05*sin(I) #end }",
    "sphere_sweep { b_spline 60 #for (I, 0, 59) , <sin(I*0.4), I*0.03-0.9, cos(I*0.4)>, 0.12+0.05*sin(I) #end }",
    "prism { linear_spline -0.5, 0.5, 61 #for (I, 0, 60) , <sin(I*pi/30), cos(I*pi/30)>*(0.8+0.2*sin(I*pi/3)) #end }",
    "height_field { function 33, 29 { 0.5+0.3*sin(17*x)*cos(13*y) } translate <-0.5,-0.5,-0.5> scale 2 }",
    "text { internal 1 \"Tree, list\" 0.3, 0 translate <-1.5,-0.3,0> }",
};

static void accelerators_change_no_bit(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof crowds / sizeof *crowds; k++) {
        SceneText tree = { .accel = "bvh" }, list = { .accel = "list" };
        if (!scene_text(&tree, crowds[k]) || !scene_text(&list, crowds[k]))
            print_message("%s%s\n", tree.messages, list.messages);
        int hits = 0;
        seed = k + 1;
        for (int i = 0; i < RAYS; i++) {
            Ray ray = some_ray(0, 2 * i, tree.world.unit);
            Hit a = { 0 }, b = { 0 };
            bool hit = world_nearest(&tree.world, &ray, 0, &a), also = world_nearest(&list.world, &ray, 0, &b);
            if (hit != also || (hit && (a.t != b.t || a.part != b.part || a.u != b.u)))
                print_message("%.40s ray %d: %.17g and %.17g\n", crowds[k], i, hit ? a.t : 0, also ? b.t : 0);
            assert_true(hit == also && (!hit || (a.t == b.t && a.part == b.part && a.u == b.u)));
            hits += hit;
            if (!hit)
                continue;
            /* Where the range ends must not matter either. */
            ray.t_max = nextafter(a.t, INFINITY);
            assert_true(world_nearest(&tree.world, &ray, 0, &b) && b.t == a.t);
            ray.t_max = nextafter(a.t, 0);
            assert_false(world_nearest(&tree.world, &ray, 0, &b) && b.t <= ray.t_max && b.t == a.t);
            Surface x, y;
            ray.t_max = INFINITY;
            world_surface(&tree.world, &ray, &a, false, &x);
            world_surface(&list.world, &ray, &a, false, &y);
            assert_memory_equal(&x.normal, &y.normal, sizeof x.normal);
        }
        assert_true(hits > RAYS / 20);
        scene_text_end(&tree);
        scene_text_end(&list);
    }
}

/* Thousands of components in one place are one of their summed strength. */
static void a_crowd_in_one_place_is_one_component(void **state)
{
    (void)state;
    SceneText one = { 0 }, crowd = { 0 };
    assert_true(scene_text(&one, "blob { threshold 0.5 sphere { 0, 1, 1 } sphere { <0.9,0,0>, 0.8, 1 } }"));
    assert_true(scene_text(&crowd, "blob { threshold 0.5 #for (I, 1, 1024) sphere { 0, 1, 1/1024 } #end sphere { <0.9,0,0>, 0.8, 1 } }"));
    int hits = 0;
    seed = 5;
    for (int i = 0; i < 300; i++) {
        Ray ray = some_ray(0, 2 * i, one.world.unit);
        Vec3 o = scaled(ray.o, 1 / one.world.unit), p, n, q, m;
        bool hit = scene_text_trace(&one, o, ray.d, &p, &n);
        assert_true(scene_text_trace(&crowd, o, ray.d, &q, &m) == hit);
        hits += hit;
        if (hit)
            assert_true(length(sub(p, q)) < 1e-10 && length(sub(n, m)) < 1e-9);
    }
    assert_true(hits > 50);
    scene_text_end(&one);
    scene_text_end(&crowd);
}

/* More in one place than a ray keeps: no crash, and still a hit on most of it. */
static void too_many_components_are_survived(void **state)
{
    (void)state;
    SceneText s = { 0 };
    assert_true(scene_text(&s, "blob { threshold 0.5 #for (I, 1, 6000) sphere { <I*0.0001,0,0>, 1, 1 } #end }"));
    Vec3 p, n;
    assert_true(scene_text_trace(&s, vec3(-5, 0.1, 0.2), vec3(1, 0, 0), &p, &n));
    assert_true(vec3_finite(p) && vec3_finite(n));
    scene_text_end(&s);
}

/* ---- height fields beside all their triangles ---- */

enum { W = 12, H = 9 };

static double height_at(int i, int k)                      /* z = 0 is the function's y = 1 */
{
    double x = (double)i / (W - 1), y = 1 - (double)k / (H - 1);
    return trunc(65535 * (0.5 + 0.4 * sin(9 * x) * cos(7 * y))) / 65536;
}

static double triangle_hit(Vec3 a, Vec3 b, Vec3 c, Vec3 o, Vec3 d)
{
    Vec3 e = sub(b, a), f = sub(c, a), p = cross(d, f), t = sub(o, a), q = cross(t, e);
    double det = dot(e, p), u = dot(t, p) / det, v = dot(d, q) / det, s = dot(f, q) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && s > 0 ? s : INFINITY;
}

static void height_fields_are_their_triangles(void **state)
{
    (void)state;
    SceneText s = { 0 };
    assert_true(scene_text(&s, "height_field { function 12, 9 { 0.5+0.4*sin(9*x)*cos(7*y) } }"));
    int hits = 0;
    seed = 3;
    for (int i = 0; i < 20000; i++) {
        Vec3 to = vec3(uniform(0.05, 0.95), uniform(0.1, 0.9), uniform(0.05, 0.95)), d = direction(), o = sub(to, scaled(d, 3)), p, n;
        double best = INFINITY;
        for (int z = 0; z + 1 < H; z++)
            for (int x = 0; x + 1 < W; x++) {
                Vec3 q[4];
                for (int c = 0; c < 4; c++) {
                    int cx = x + (c & 1), cz = z + (c >> 1);
                    q[c] = vec3((double)cx / (W - 1), height_at(cx, cz), (double)cz / (H - 1));
                }
                best = fmin(best, fmin(triangle_hit(q[0], q[1], q[2], o, d), triangle_hit(q[3], q[2], q[1], o, d)));
            }
        bool hit = scene_text_trace(&s, o, d, &p, &n);
        if (hit != (best < INFINITY) || (hit && length(sub(p, add(o, scaled(d, best)))) > 1e-9))
            print_message("ray %d: %g, expected %g\n", i, hit ? length(sub(p, o)) : INFINITY, best);
        assert_true(hit == (best < INFINITY));
        assert_true(!hit || length(sub(p, add(o, scaled(d, best)))) < 1e-9);
        hits += hit;
    }
    assert_true(hits > 5000);
    scene_text_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_enter_as_often_as_they_leave),
        cmocka_unit_test(accelerators_change_no_bit),
        cmocka_unit_test(a_crowd_in_one_place_is_one_component),
        cmocka_unit_test(too_many_components_are_survived),
        cmocka_unit_test(height_fields_are_their_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
