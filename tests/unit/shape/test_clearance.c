/* test_clearance.c - the grid around a solid, on a ball: it never cuts anything off, and leaves little air. */
#include "shape/clearance.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

typedef struct { Vec3 centre; double radius; } Ball;

static uint32_t may_hold(const void *solid, const Vec3 centre[8], double radius)
{
    const Ball *ball = solid;
    uint32_t out = 0;
    for (int i = 0; i < 8; i++)
        out |= (uint32_t)(length(sub(centre[i], ball->centre)) <= radius + ball->radius) << i;
    return out;
}

static double coordinate(void)
{
    return rand() / (RAND_MAX + 1.0) * 2 - 1;
}

static void a_line_is_clear_from_a_few_cells_beyond_the_solid(void **state)
{
    (void)state;
    static const Ball ball = { { 0.3, -0.2, 0.1 }, 0.5 };
    Clearance *c = malloc(sizeof *c);
    clearance_build(c, may_hold, &ball, 4);
    srand(1);
    for (int i = 0; i < 20000; i++) {
        Vec3 o = vec3(coordinate(), coordinate(), coordinate()), u = normalized(vec3(coordinate(), coordinate(), coordinate()));
        double from = clearance_from(c, o, u), to = dot(sub(ball.centre, o), u);
        double miss = length(sub(add(o, scaled(u, to)), ball.centre));
        if (miss < ball.radius)
            assert_true(from >= to + sqrt(ball.radius * ball.radius - miss * miss));
        double near = ball.radius + 5 * c->cell;
        assert_true(miss > near ? from == -INFINITY : from <= to + sqrt(near * near - miss * miss));
    }
    free(c);
}

static uint32_t holds_nothing(const void *solid, const Vec3 centre[8], double radius)
{
    (void)solid, (void)centre, (void)radius;
    return 0;
}

static void around_nothing_every_line_is_clear(void **state)
{
    (void)state;
    Clearance *c = malloc(sizeof *c);
    clearance_build(c, holds_nothing, NULL, 1);
    assert_true(clearance_from(c, vec3(0, 0, 0), vec3(1, 0, 0)) == -INFINITY);
    free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_line_is_clear_from_a_few_cells_beyond_the_solid), cmocka_unit_test(around_nothing_every_line_is_clear),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
