/* test_watertight.c - rays aimed at the edges and vertices of closed convex bodies of triangles never slip through.
 *
 * Each ray runs through a ball inside the body, so it has to enter, and it enters at the edge or vertex it is aimed at.
 * WHIT_RAYS=10000000 makes it a long one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#undef fail

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/scene_text.h"

enum { MAX_VERTICES = 3000, MAX_FACES = 6000 };

typedef struct Body {
    Vec3 vertex[MAX_VERTICES];
    int face[MAX_FACES][3];
    int n_vertices, n_faces;
    double inner;                              /* radius of a ball within, about the middle */
    Vec3 middle;
} Body;

static uint64_t seed = 7;

static double uniform(double lo, double hi)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return lo + (hi - lo) * ((double)(seed >> 11) * 0x1p-53);
}

static Vec3 in_ball(double radius)
{
    Vec3 p;
    do
        p = vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    while (length2(p) > 1);
    return scaled(p, radius);
}

/* Vertices are what a mesh keeps: single precision. */
static Vec3 rounded(Vec3 v)
{
    return vec3((double)(float)v.x, (double)(float)v.y, (double)(float)v.z);
}

static int vertex_of(Body *b, Vec3 v)
{
    for (int i = 0; i < b->n_vertices; i++)
        if (length2(sub(b->vertex[i], v)) < 1e-12)
            return i;
    b->vertex[b->n_vertices] = v;
    return b->n_vertices++;
}

static void octahedron_face(Body *b, Vec3 p, Vec3 q, Vec3 r, int depth)
{
    if (depth == 0) {
        int *f = b->face[b->n_faces++];
        f[0] = vertex_of(b, p);
        f[1] = vertex_of(b, q);
        f[2] = vertex_of(b, r);
        return;
    }
    Vec3 pq = normalized(add(p, q)), qr = normalized(add(q, r)), rp = normalized(add(r, p));
    octahedron_face(b, p, pq, rp, depth - 1);
    octahedron_face(b, q, qr, pq, depth - 1);
    octahedron_face(b, r, rp, qr, depth - 1);
    octahedron_face(b, pq, qr, rp, depth - 1);
}

/* A ball of triangles, moved and resized, its vertices rounded then. */
static void make_ball(Body *b, int depth, double size, Vec3 middle)
{
    b->n_vertices = b->n_faces = 0;
    for (int i = 0; i < 8; i++)
        octahedron_face(b, vec3(i & 1 ? 1 : -1, 0, 0), vec3(0, i & 2 ? 1 : -1, 0), vec3(0, 0, i & 4 ? 1 : -1), depth);
    b->inner = 0.5 * size;
    b->middle = middle;
    for (int i = 0; i < b->n_vertices; i++)
        b->vertex[i] = rounded(add(middle, scaled(b->vertex[i], size)));
}

/* A cube of whole numbers, n squares along an edge, each two triangles: edges in line, right angles, exact zeros. */
static void make_cube(Body *b, int n)
{
    b->n_vertices = b->n_faces = 0;
    for (int axis = 0; axis < 3; axis++)
        for (int high = 0; high < 2; high++)
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++) {
                    int at[4];
                    for (int k = 0; k < 4; k++) {
                        double c[3];
                        c[axis] = high ? n : 0;
                        c[(axis + 1) % 3] = i + (k & 1);
                        c[(axis + 2) % 3] = j + (k >> 1);
                        at[k] = vertex_of(b, vec3(2 * c[0] - n, 2 * c[1] - n, 2 * c[2] - n));
                    }
                    const int two[2][3] = { { at[0], at[1], at[3] }, { at[0], at[3], at[2] } };
                    memcpy(b->face[b->n_faces], two, sizeof two);
                    b->n_faces += 2;
                }
    b->inner = n;
    b->middle = vec3(0, 0, 0);
}

static char *as_mesh2(const Body *b)
{
    char *text = malloc((size_t)(b->n_vertices + b->n_faces) * 120 + 200), *at = text;
    at += sprintf(at, "mesh2 { vertex_vectors { %d", b->n_vertices);
    for (int i = 0; i < b->n_vertices; i++)
        at += sprintf(at, ", <%.17g, %.17g, %.17g>", b->vertex[i].x, b->vertex[i].y, b->vertex[i].z);
    at += sprintf(at, " } face_indices { %d", b->n_faces);
    for (int i = 0; i < b->n_faces; i++)
        at += sprintf(at, ", <%d, %d, %d>", b->face[i][0], b->face[i][1], b->face[i][2]);
    sprintf(at, " } }");
    return text;
}

static char *as_triangles(const Body *b, const char *keyword)
{
    char *text = malloc((size_t)b->n_faces * 300 + 200), *at = text;
    at += sprintf(at, "%s {", keyword);
    for (int i = 0; i < b->n_faces; i++) {
        at += sprintf(at, " triangle {");
        for (int k = 0; k < 3; k++) {
            Vec3 v = b->vertex[b->face[i][k]];
            at += sprintf(at, " <%.17g, %.17g, %.17g>", v.x, v.y, v.z);
        }
        at += sprintf(at, " }");
    }
    sprintf(at, " }");
    return text;
}

/* On an edge or at a vertex. */
static Vec3 some_target(const Body *b)
{
    const int *f = b->face[(int)uniform(0, b->n_faces)];
    int k = (int)uniform(0, 3);
    Vec3 p = b->vertex[f[k]], q = b->vertex[f[(k + 1) % 3]];
    switch ((int)uniform(0, 4)) {
    case 0: return p;
    case 1: return lerp(p, q, 0.5);
    case 2: return lerp(p, q, floor(uniform(0, 17)) / 16);
    default: return lerp(p, q, uniform(0, 1));
    }
}

static int leaks(const Body *b, char *text, int rays)
{
    SceneText s = { 0 };
    if (!scene_text(&s, text))
        print_message("%s\n", s.messages);
    free(text);
    const World *w = &s.world;
    double unit = w->unit, size = b->inner + length(b->middle);
    int leaked = 0;
    for (int i = 0; i < rays; i++) {
        Vec3 target = some_target(b), within = add(b->middle, in_ball(0.9 * b->inner));
        double far = (i & 1) ? 0 : uniform(0.5, 5);        /* from within, or from outside */
        Vec3 o = far > 0 ? sub(target, scaled(sub(within, target), far)) : within;
        if (i & 2)
            o = rounded(o);
        Vec3 d = sub(target, o);
        if (i & 4)
            d = normalized(d);
        if ((i & 8) && far == 0)                           /* along an axis, through vertices when the body has them there */
            d = vec3(0, 0, (i & 16) ? 1 : -1);
        Ray ray = { scaled(o, unit), d, 0, INFINITY };
        Hit hit;
        bool found = world_nearest(w, &ray, 0, &hit);
        double expected = length(sub(target, o)) / length(d);
        if (!found || (!((i & 8) && far == 0) && fabs(hit.t / unit - expected) * length(d) > 1e-5 * size)) {
            if (leaked++ < 5)
                print_message("ray %d from <%.17g, %.17g, %.17g> along <%.17g, %.17g, %.17g> leaks: %g, expected %g\n", i, o.x, o.y, o.z,
                              d.x, d.y, d.z, found ? hit.t / unit : NAN, expected);
        }
    }
    scene_text_end(&s);
    return leaked;
}

static int rays_each(int share)
{
    const char *all = getenv("WHIT_RAYS");
    return (all ? atoi(all) : 200000) / share;
}

static Body body;

static void rays_at_edges_of_meshes_do_not_leak(void **state)
{
    (void)state;
    static const struct { int depth; double size; Vec3 middle; } balls[] = {
        { 0, 1, { 0, 0, 0 } }, { 2, 1, { 0, 0, 0 } }, { 4, 1, { 0.1, 0.2, 0.3 } }, { 3, 1e-3, { 5, 6, 7 } }, { 3, 1e6, { 1e5, 0, 0 } },
    };
    for (size_t i = 0; i < sizeof balls / sizeof *balls; i++) {
        make_ball(&body, balls[i].depth, balls[i].size, balls[i].middle);
        assert_int_equal(leaks(&body, as_mesh2(&body), rays_each(10)), 0);
        assert_int_equal(leaks(&body, as_triangles(&body, "mesh"), rays_each(20)), 0);
    }
}

static void rays_at_edges_of_cubes_do_not_leak(void **state)
{
    (void)state;
    for (int n = 1; n <= 9; n += 4) {
        make_cube(&body, n);
        assert_int_equal(leaks(&body, as_mesh2(&body), rays_each(10)), 0);
    }
}

static void rays_at_edges_of_single_triangles_do_not_leak(void **state)
{
    (void)state;
    make_ball(&body, 3, 1, vec3(0.3, -0.2, 0.1));
    assert_int_equal(leaks(&body, as_triangles(&body, "union"), rays_each(10)), 0);
    make_cube(&body, 4);
    assert_int_equal(leaks(&body, as_triangles(&body, "union"), rays_each(10)), 0);
}

static void points_inside_are_inside_along_edges_too(void **state)
{
    (void)state;
    make_cube(&body, 4);
    char *text = as_mesh2(&body), *end = strrchr(text, '}');
    char *solid = malloc(strlen(text) + 100);
    static const char *const vectors[] = { "<0,0,1>", "<1,1,1>", "<0,1,0.5>", "<-1,0,0>" };
    for (int k = 0; k < 4; k++) {
        sprintf(solid, "%.*s inside_vector %s }", (int)(end - text), text, vectors[k]);
        SceneText s = { 0 };
        assert_true(scene_text(&s, solid));
        /* whole numbers: the vector runs through vertices and along edges */
        for (int x = -6; x <= 6; x++)
            for (int y = -6; y <= 6; y++)
                for (int z = -6; z <= 6; z++) {
                    bool in = abs(x) < 4 && abs(y) < 4 && abs(z) < 4, on = abs(x) <= 4 && abs(y) <= 4 && abs(z) <= 4 && !in;
                    if (!on && query_inside(s.query, s.scene.object[0], vec3(x, y, z)) != in) {
                        print_message("%s: <%d,%d,%d>\n", vectors[k], x, y, z);
                        assert_true(false);
                    }
                }
        scene_text_end(&s);
    }
    free(solid);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_at_edges_of_meshes_do_not_leak),
        cmocka_unit_test(rays_at_edges_of_cubes_do_not_leak),
        cmocka_unit_test(rays_at_edges_of_single_triangles_do_not_leak),
        cmocka_unit_test(points_inside_are_inside_along_edges_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
