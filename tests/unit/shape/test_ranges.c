/* test_ranges.c - how far away, how large and how small each shape may be.
 *
 * One ray along z, off the axis, at the shape in sizes 0.001, 1 and 1000. WHIT_TABLE=1 prints the table of tests/ranges.md. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#undef fail

#include <stdio.h>
#include <stdlib.h>

#include "lib/scene_text.h"

/* far: in sizes of the shape, how far the eye may be at least, with the point hit right to a fifth of the size.
 * error: at most, in sizes, from 1e6 sizes away. small: the least size that is hit from distance 1. */
static const struct { const char *name, *text; double far, error, small; } rows[] = {
    { "sphere", "sphere { 0, 1 }", 1e12, 1e-9, 1e-150 },
    { "ellipsoid", "sphere { 0, 1 scale <1,1.5,1> }", 1e12, 1e-9, 1e-150 },
    { "box", "box { -1, 1 }", 1e12, 1e-9, 1e-150 },
    { "box, rotated", "box { -1, 1 rotate <20,30,40> }", 1e12, 1e-9, 1e-150 },
    { "plane", "plane { -z, 1 }", 1e200, 1e-9, 1e-150 },
    { "disc", "disc { -z, -z, 1 }", 1e200, 1e-9, 1e-150 },
    { "triangle", "triangle { <-2,-1,-1>, <2,-1,-1>, <0,2,-1> }", 1e200, 1e-9, 1e-150 },
    { "cylinder", "cylinder { -y, y, 1 }", 1e12, 1e-9, 1e-150 },
    { "cone", "cone { -y, 1.5, y, 0.5 }", 1e12, 1e-9, 1e-150 },
    { "torus", "torus { 0.7, 0.3 }", 1e12, 1e-9, 1e-150 },
    { "polygon", "polygon { 4, <-1,-1,-1>, <1,-1,-1>, <1,1,-1>, <-1,1,-1> }", 1e200, 1e-9, 1e-150 },
    { "mesh", "mesh { triangle { <-2,-1,-1>, <2,-1,-1>, <0,2,-1> } }", 1e200, 1e-9, 1e-150 },
    { "superellipsoid", "superellipsoid { <0.5,0.5> }", 1e12, 1e-9, 1e-150 },
    { "quadric", "quadric { <1,1,1>, <0,0,0>, <0,0,0>, -1 }", 1e12, 1e-9, 1e-150 },
    { "quartic", "quartic { <1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1,0,0,0,0,0,0,0,0,0,1,0,0,0,-1> }", 1e12, 1e-9, 1e-150 },
    { "poly, order 2", "poly { 2, <1,0,0,0,1,0,0,1,0,-1> }", 1e12, 1e-9, 1e-150 },
    { "bicubic_patch", "bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3"
      " <-1,-1,-1>,<-0.3,-1,-1>,<0.3,-1,-1>,<1,-1,-1>, <-1,-0.3,-1>,<-0.3,-0.3,-1.5>,<0.3,-0.3,-1.5>,<1,-0.3,-1>,"
      " <-1,0.3,-1>,<-0.3,0.3,-1.5>,<0.3,0.3,-1.5>,<1,0.3,-1>, <-1,1,-1>,<-0.3,1,-1>,<0.3,1,-1>,<1,1,-1> }", 1e200, 1e-9, 1e-150 },
    { "blob", "blob { threshold 0.5 sphere { 0, 1.5, 1 } }", 1e12, 1e-9, 1e-15 },
    { "lathe", "lathe { linear_spline 3, <1,-1>, <0.8,0>, <1,1> }", 1e12, 1e-9, 1e-15 },
    { "sor", "sor { 4, <1,-2>, <1,-1>, <0.8,1>, <0.8,2> }", 1e12, 1e-9, 1e-15 },
    { "prism", "prism { -1, 1, 5, <-1,-1>, <1,-1>, <1,1>, <-1,1>, <-1,-1> }", 1e12, 1e-9, 1e-150 },
    { "height_field", "height_field { function 9,9 { 0.5 } translate -0.5 rotate -90*x scale 2 }", 1e5, 1e-9, 1e-6 },
    { "sphere_sweep", "sphere_sweep { linear_spline 2, -x, 0.5, x, 0.5 }", 1e12, 1e-9, 1e-30 },
    { "text", "text { ttf \"timrom.ttf\" \"I\" 0.5, 0 translate <-0.14,-0.25,0> scale 2 }", 1e12, 1e-9, 1e-15 },
    { "ovus", "ovus { 0.8, 0.5 }", 1e12, 1e-9, 1e-15 },
    { "julia_fractal", "julia_fractal { <-0.083,0,-0.83,-0.025> quaternion sqr max_iteration 8 precision 15 }", 1e12, 1e-9, 1e-150 },
    { "isosurface", "isosurface { function { x*x+y*y+z*z-1 } contained_by { box { -1.1, 1.1 } } max_gradient 3 }", 1e12, 1e-9, 1e-3 },
};

static bool see(const char *text, double size, double distance, Vec3 *p)
{
    char scene[3000];
    snprintf(scene, sizeof scene, "object { %s scale %.17g }", text, size);
    SceneText s = { 0 };
    Vec3 n;
    bool hit = scene_text(&s, scene);
    if (!hit)
        print_message("%s\n", s.messages);
    hit = hit && scene_text_trace(&s, vec3(0.05 * size, 0.07 * size, -distance), vec3(0, 0, 1), p, &n);
    scene_text_end(&s);
    return hit;
}

static void every_shape_is_right_from_far_away_and_when_it_is_small(void **state)
{
    (void)state;
    bool table = getenv("WHIT_TABLE") != NULL;
    int bad = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (table)
            print_message("| %s ", rows[i].name);
        for (int k = 0; k < 3; k++) {
            double size = k == 0 ? 1 : k == 1 ? 0.001 : 1000, far = 0, distance = 10;
            Vec3 first, p;
            bool seen = see(rows[i].text, size, 3 * size, &first);
            for (; seen && distance < 1e300 && see(rows[i].text, size, distance * size, &p) && fabs(p.z - first.z) < 0.2 * size;
                 distance *= 10)
                far = distance;
            if (table)
                print_message("| %.0e ", far * size);
            if (far < rows[i].far) {
                bad++;
                print_message("%s of size %g is seen from %g sizes away only\n", rows[i].name, size, far);
            }
            double error = seen && see(rows[i].text, size, 1e6 * size, &p) ? fabs(p.z - first.z) / size : INFINITY;
            if (rows[i].far >= 1e6 && !(error <= rows[i].error)) {
                bad++;
                print_message("%s of size %g from 1e6 sizes away is %g sizes off\n", rows[i].name, size, error);
            }
            if (table && k == 2)
                for (double d = 1e3; d < 2e6; d *= 10)
                    print_message("| %.0e ", see(rows[i].text, 1, d, &p) && see(rows[i].text, 1, 3, &first) ? fabs(p.z - first.z) : INFINITY);
        }
        double size = 0.1, least = 1;
        Vec3 p;
        for (; size > 1e-200 && see(rows[i].text, size, 1, &p) && fabs(p.z) < 3 * size; size /= 10)
            least = size;
        if (table)
            print_message("| %.0e |\n", least);
        if (least > rows[i].small) {
            bad++;
            print_message("%s is seen down to size %g only\n", rows[i].name, least);
        }
    }
    assert_int_equal(bad, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(every_shape_is_right_from_far_away_and_when_it_is_small) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
