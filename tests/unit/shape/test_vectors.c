/* test_vectors.c - hits, normals, insides, extents and uv of every shape beside values measured on the reference.
 *
 * Each shape is also moved: scaled, turned, taken far away. The answers must then be the first ones, moved along. Where the
 * reference itself changed its mind under the move, its own answer passes too. What differs on purpose stands in
 * shape-differences.tsv with the reason: id, variant, ray (or * for all of them). */
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

enum { MAX_SHAPES = 1000, MAX_ROWS = 8000, MAX_DIFFERENCES = 600 };

typedef struct { char *id, *variant, *text; } ShapeText;
typedef struct { char *id, *variant; int ray; Vec3 o, d; bool hit; Vec3 p, n; } TraceRow;
typedef struct { char *id, *variant; Vec3 p; bool inside; } InsideRow;
typedef struct { char id[64], variant[16], ray[16]; int used; } Difference;

static ShapeText shapes[MAX_SHAPES];
static TraceRow traces[MAX_ROWS];
static InsideRow insides[MAX_ROWS];
static Difference differences[MAX_DIFFERENCES];
static int n_shapes, n_traces, n_insides, n_differences;
static const char *only;                       /* WHIT_SHAPE: just this one */

static Vec3 vec_at(const Csv *c, int i)
{
    return vec3(csv_number(c, i), csv_number(c, i + 1), csv_number(c, i + 2));
}

static void read_differences(void)
{
    FILE *f = fopen("tests/vectors/shape-differences.tsv", "r");
    char line[1000];
    assert_non_null(f);
    while (fgets(line, sizeof line, f) != NULL)
        if (line[0] != '#' && line[0] != '\n') {
            Difference *d = &differences[n_differences++];
            assert_true(n_differences < MAX_DIFFERENCES);
            assert_int_equal(sscanf(line, "%63s %15s %15s", d->id, d->variant, d->ray), 3);
        }
    fclose(f);
}

static int read_all(void **state)
{
    (void)state;
    static Csv c;
    only = getenv("WHIT_SHAPE");
    for (csv_open(&c, "tests/vectors/shapes.csv"); csv_next(&c);)
        shapes[n_shapes++] = (ShapeText){ strdup(c.field[0]), strdup(c.field[1]), strdup(c.field[2]) };
    for (csv_open(&c, "tests/vectors/shape-trace.csv"); csv_next(&c);) {
        bool hit = strcmp(c.field[9], "hit") == 0;
        Vec3 none = { 0, 0, 0 };
        traces[n_traces++] = (TraceRow){ strdup(c.field[0]), strdup(c.field[1]), atoi(c.field[2]), vec_at(&c, 3), vec_at(&c, 6),
                                         hit, hit ? vec_at(&c, 10) : none, hit ? vec_at(&c, 13) : none };
    }
    for (csv_open(&c, "tests/vectors/shape-inside.csv"); csv_next(&c);)
        insides[n_insides++] = (InsideRow){ strdup(c.field[0]), strdup(c.field[1]), vec_at(&c, 2), atoi(c.field[5]) != 0 };
    read_differences();
    return 0;
}

/* ---- moves ---- */

static Affine move_of(const char *variant)
{
    if (strcmp(variant, "s1e-4") == 0)
        return affine_scale(vec3(1e-4, 1e-4, 1e-4));
    if (strcmp(variant, "s1e-2") == 0)
        return affine_scale(vec3(1e-2, 1e-2, 1e-2));
    if (strcmp(variant, "s1e4") == 0)
        return affine_scale(vec3(1e4, 1e4, 1e4));
    if (strcmp(variant, "rot") == 0)
        return affine_rotate(vec3(30, 40, 50));
    if (strcmp(variant, "far") == 0)
        return affine_translate(vec3(1e5, -1e5, 1e5));
    if (strcmp(variant, "mix") == 0)
        return affine_then(affine_then(affine_scale(vec3(1, 2, 0.5)), affine_rotate(vec3(10, 20, 30))),
                           affine_translate(vec3(3, -2, 1)));
    return affine_identity();
}

/* `accuracy` and `flatness` are lengths of the scene: such shapes are other shapes when they are scaled. */
static bool changes_with_scale(const ShapeText *s)
{
    bool has = strstr(s->text, "isosurface") || strstr(s->text, "bicubic_patch") || strstr(s->text, "parametric") ||
               strstr(s->text, "smooth_triangle{<");
    return has && strcmp(s->variant, "base") != 0 && strcmp(s->variant, "rot") != 0 && strcmp(s->variant, "far") != 0;
}

static double tolerance_of(const ShapeText *s)
{
    static const char *const rough[] = { "superellipsoid", "isosurface", "julia", "bicubic_patch" };
    static const char *const middling[] = { "quartic", "lathe", "sphere_sweep", "cubic", "poly", "sor", "ovus", "prism", "mesh", "height" };
    if (strstr(s->text, "parametric"))
        return 3e-3;                           /* its accuracy is 0.001: the reference reports cells, whit the surface in them */
    for (size_t i = 0; i < sizeof rough / sizeof *rough; i++)
        if (strstr(s->text, rough[i]))
            return 1e-4;
    for (size_t i = 0; i < sizeof middling / sizeof *middling; i++)
        if (strstr(s->text, middling[i]))
            return 1e-5;
    return 1e-6;
}

static bool is_listed(const char *id, const char *variant, int ray)
{
    char number[16];
    snprintf(number, sizeof number, "%d", ray);
    for (int i = 0; i < n_differences; i++) {
        Difference *d = &differences[i];
        if (strcmp(d->id, id) == 0 && (strcmp(d->variant, "*") == 0 || strcmp(d->variant, variant) == 0) &&
            (strcmp(d->ray, "*") == 0 || strcmp(d->ray, number) == 0)) {
            d->used++;
            return true;
        }
    }
    return false;
}

/* ---- trace ---- */

typedef struct { bool hit; Vec3 p, n; } Answer;

static bool agrees(Answer got, Answer want, double size, double tolerance, double normal_tolerance)
{
    if (got.hit != want.hit)
        return false;
    if (!want.hit)
        return true;
    return length(sub(got.p, want.p)) <= tolerance * size &&
           (isnan(want.n.x) || length(sub(got.n, want.n)) <= normal_tolerance);
}

static const TraceRow *own_row(const char *id, const char *variant, int ray)
{
    for (int i = 0; i < n_traces; i++)
        if (traces[i].ray == ray && strcmp(traces[i].variant, variant) == 0 && strcmp(traces[i].id, id) == 0)
            return &traces[i];
    return NULL;
}

static double size_under(const Affine *a)
{
    double most = 0;
    for (int i = 0; i < 3; i++)
        most = fmax(most, length(affine_vector(a, vec3(i == 0, i == 1, i == 2))));
    return most;
}

/* Rays of one shape in one variant; returns how many are wrong. */
static int check_rays(const ShapeText *shape, const SceneText *scene)
{
    Affine move = move_of(shape->variant);
    double size = size_under(&move), tolerance = tolerance_of(shape);
    bool far = strcmp(shape->variant, "far") == 0;
    int wrong = 0;
    for (int i = 0; i < n_traces; i++) {
        const TraceRow *row = &traces[i];
        if (strcmp(row->id, shape->id) != 0 || strcmp(row->variant, "base") != 0)
            continue;
        Vec3 o = affine_point(&move, row->o), d = normalized(affine_vector(&move, row->d));
        Answer want = { row->hit, affine_point(&move, row->p), normalized(affine_normal(&move, row->n)) }, got = { 0 };
        got.hit = scene_text_trace(scene, o, d, &got.p, &got.n);
        double off = far ? fmax(tolerance, 1e-9 * 1e5 / size) : tolerance;
        if (agrees(got, want, size, off, fmax(1e-5, 10 * off)))
            continue;
        const TraceRow *own = own_row(shape->id, shape->variant, row->ray);
        if (own != NULL && own != row && agrees(got, (Answer){ own->hit, own->p, own->n }, size, off, fmax(1e-5, 10 * off)))
            continue;
        if (is_listed(shape->id, shape->variant, row->ray))
            continue;
        if (wrong++ < 100)
            print_message("%s %s ray %d: <%g,%g,%g> along <%g,%g,%g>\n"
                          "  want %s <%.9g,%.9g,%.9g> normal <%.6g,%.6g,%.6g>\n"
                          "  got  %s <%.9g,%.9g,%.9g> normal <%.6g,%.6g,%.6g>\n",
                          shape->id, shape->variant, row->ray, o.x, o.y, o.z, d.x, d.y, d.z, want.hit ? "hit" : "miss", want.p.x,
                          want.p.y, want.p.z, want.n.x, want.n.y, want.n.z, got.hit ? "hit" : "miss", got.p.x, got.p.y, got.p.z,
                          got.n.x, got.n.y, got.n.z);
    }
    return wrong;
}

static int check_insides(const ShapeText *shape, const SceneText *scene)
{
    Affine move = move_of(shape->variant);
    int wrong = 0, number = 0;
    for (int i = 0; i < n_insides; i++) {
        const InsideRow *row = &insides[i];
        if (strcmp(row->id, shape->id) != 0 || strcmp(row->variant, "base") != 0)
            continue;
        number++;
        Vec3 p = affine_point(&move, row->p);
        if (query_inside(scene->query, scene->scene.object[0], p) == row->inside || is_listed(shape->id, shape->variant, -number))
            continue;
        if (wrong++ < 5)
            print_message("%s %s point -%d <%.9g,%.9g,%.9g> should be %s\n", shape->id, shape->variant, number, p.x, p.y, p.z,
                          row->inside ? "inside" : "outside");
    }
    return wrong;
}

/* Shapes come one by one: rows that need one that is not in the registry wait for it. */
static bool waits(const char *text)
{
    static const char *const words[] = { "blob", "height_field", "julia_fractal", "sphere_sweep", "text", "isosurface", "parametric" };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        bool known = false;
        for (const ShapeOps *const *row = registry.shape; *row != NULL; row++)
            known |= strcmp((*row)->keyword, words[i]) == 0;
        if (!known && strstr(text, words[i]) != NULL)
            return true;
    }
    return false;
}

typedef int Check(const ShapeText *shape, const SceneText *scene);

static void for_each_shape(Check *check)
{
    int bad = 0, tried = 0;
    for (int i = 0; i < n_shapes; i++) {
        if ((only != NULL && strcmp(only, shapes[i].id) != 0) || changes_with_scale(&shapes[i]) || waits(shapes[i].text) ||
            is_listed(shapes[i].id, shapes[i].variant, 9999))
            continue;
        SceneText scene = { 0 };
        int wrong = 1;
        if (scene_text(&scene, shapes[i].text))
            wrong = check(&shapes[i], &scene);
        else
            print_message("%s %s: %s\n", shapes[i].id, shapes[i].variant, scene.messages);
        if (wrong)
            print_message("%s %s: %d wrong\n", shapes[i].id, shapes[i].variant, wrong);
        bad += wrong;
        tried++;
        scene_text_end(&scene);
    }
    assert_true(tried > 0);
    assert_int_equal(bad, 0);
}

static void rays_hit_what_they_hit_in_the_reference(void **state)
{
    (void)state;
    for_each_shape(check_rays);
}

static void points_are_inside_as_in_the_reference(void **state)
{
    (void)state;
    for_each_shape(check_insides);
}

/* ---- extents ---- */

static double limited(double x)
{
    return fmax(-1e10, fmin(1e10, x));
}

static void extents_are_those_of_the_reference(void **state)
{
    (void)state;
    static Csv c;
    int bad = 0;
    for (csv_open(&c, "tests/vectors/shape-extents.csv"); csv_next(&c);) {
        const ShapeText *shape = NULL;
        for (int i = 0; i < n_shapes && shape == NULL; i++)
            if (strcmp(shapes[i].id, c.field[0]) == 0 && strcmp(shapes[i].variant, c.field[1]) == 0)
                shape = &shapes[i];
        if (shape == NULL || waits(shape->text) || (only != NULL && strcmp(only, shape->id) != 0) || is_listed(shape->id, shape->variant, 9999))
            continue;
        SceneText scene = { 0 };
        if (scene_text(&scene, shape->text)) {
            Bounds b = query_extent(scene.query, scene.scene.object[0]);
            double got[6] = { b.lo.x, b.lo.y, b.lo.z, b.hi.x, b.hi.y, b.hi.z };
            double size = 1e-6;
            for (int i = 0; i < 6; i++)
                if (fabs(csv_number(&c, 2 + i)) < 1e9)
                    size = fmax(size, fabs(csv_number(&c, 2 + i)));
            for (int i = 0; i < 6; i++)
                if (!(fabs(limited(got[i]) - csv_number(&c, 2 + i)) <= 2e-6 * size)) {
                    if (!is_listed(shape->id, shape->variant, 8888)) {
                        bad++;
                        print_message("%s %s: extent %d is %.9g, measured %s\n", shape->id, shape->variant, i, got[i], c.field[2 + i]);
                    }
                    break;
                }
        }
        scene_text_end(&scene);
    }
    assert_int_equal(bad, 0);
}

/* ---- uv ---- */

static void uv_is_that_of_the_reference(void **state)
{
    (void)state;
    static Csv c;
    int bad = 0;
    char last[1000] = "";
    SceneText scene = { 0 };
    bool ready = false;
    for (csv_open(&c, "tests/vectors/uv.csv"); csv_next(&c);) {
        if (strcmp(last, c.field[0]) != 0) {
            if (*last)
                scene_text_end(&scene);
            snprintf(last, sizeof last, "%s", c.field[0]);
            char text[2000], *uv = strstr(c.field[0], " UV");
            assert_non_null(uv);
            snprintf(text, sizeof text, "%.*s uv_mapping pigment { rgb 1 } %s", (int)(uv - c.field[0]), c.field[0], uv + 3);
            ready = scene_text(&scene, text);
            if (!ready && !waits(text)) {
                print_message("%s\n%s", text, scene.messages);
                bad++;
            }
        }
        if (!ready)
            continue;
        double k = scene.world.unit;
        Ray ray = { scaled(vec3(csv_number(&c, 1), csv_number(&c, 2), -10), k), vec3(0, 0, 1), 0, INFINITY };
        Hit hit;
        if (!world_nearest(&scene.world, &ray, 0, &hit)) {
            bad++;
            print_message("%s: no hit at %s %s\n", last, c.field[1], c.field[2]);
            continue;
        }
        Surface s;
        world_surface(&scene.world, &ray, &hit, true, &s);
        double du = s.uv.u - csv_number(&c, 3), dv = s.uv.v - csv_number(&c, 4);
        du -= floor(du + 0.5);                 /* a pigment repeats */
        dv -= floor(dv + 0.5);
        double tolerance = strstr(last, "parametric") ? 0.02 : 4e-4;
        if (!(fabs(du) < tolerance && fabs(dv) < tolerance)) {
            bad++;
            print_message("%.60s at %s %s: uv %.5f %.5f, measured %s %s\n", last, c.field[1], c.field[2], s.uv.u, s.uv.v, c.field[3],
                          c.field[4]);
        }
    }
    if (*last)
        scene_text_end(&scene);
    assert_int_equal(bad, 0);
}

static void every_listed_difference_is_one(void **state)
{
    (void)state;
    int idle = 0;
    for (int i = 0; i < n_differences && only == NULL; i++)
        if (differences[i].used == 0) {
            idle++;
            print_message("shape-differences.tsv: %s %s %s is not needed\n", differences[i].id, differences[i].variant,
                          differences[i].ray);
        }
    assert_int_equal(idle, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_hit_what_they_hit_in_the_reference),
        cmocka_unit_test(points_are_inside_as_in_the_reference),
        cmocka_unit_test(extents_are_those_of_the_reference),
        cmocka_unit_test(uv_is_that_of_the_reference),
        cmocka_unit_test(every_listed_difference_is_one),
    };
    return cmocka_run_group_tests(tests, read_all, NULL);
}
