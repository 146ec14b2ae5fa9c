/* test_arena.c - the bump allocator keeps its promises. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

#include "base/arena.h"
#include "base/array.h"

static void memory_is_zeroed_and_aligned(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    for (size_t n = 1; n < 100000; n = n % 128 == 0 ? n * 3 + 1 : (n * 3 / 64 + 1) * 64) {
        unsigned char *p = arena_alloc(&a, n);
        for (size_t align = 1; align <= 64; align *= 2)
            if (n % align == 0 && align != 32)
                assert_int_equal((uintptr_t)p % align, 0);
        for (size_t i = 0; i < n; i++) {
            assert_int_equal(p[i], 0);
            p[i] = 0xff;
        }
    }
    arena_free(&a);
}

static void rewinding_gives_back_what_came_after_the_mark(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    int *kept = arena_new(&a, int);
    *kept = 42;
    ArenaMark m = arena_mark(&a);
    for (int i = 0; i < 1000; i++)
        arena_alloc(&a, 1000);
    arena_rewind(&a, m);
    assert_int_equal(*kept, 42);
    assert_int_equal(a.used, m.used);
    arena_free(&a);
}

static void what_is_trimmed_away_is_handed_out_again_and_zeroed(void **state)
{
    (void)state;
    for (size_t size = 1000; size < 10000000; size *= 100) {           /* within a block, and in one of its own */
        Arena a;
        arena_init(&a);
        arena_alloc(&a, 100);
        unsigned char *p = arena_alloc(&a, size);
        for (size_t i = 0; i < size / 2; i++)
            p[i] = 0xff;
        arena_trim(&a, p, size / 2);
        assert_int_equal(a.used, 100 + size / 2);
        unsigned char *q = arena_alloc(&a, size / 4);
        assert_true(q >= p + size / 2 && q + size / 4 <= p + size);
        for (size_t i = 0; i < size / 4; i++)
            assert_int_equal(q[i], 0);
        ArenaMark m = arena_mark(&a);
        p = arena_alloc(&a, size);
        memset(p, 0xff, size);
        arena_rewind(&a, m);                   /* now there is something behind what is trimmed */
        p = arena_alloc(&a, size / 4);
        arena_trim(&a, p, 0);
        p = arena_alloc(&a, size);
        for (size_t i = 0; i < size; i++)
            assert_int_equal(p[i], 0);
        arena_free(&a);
    }
}

static void memory_is_zeroed_again_after_rewinding_in_a_large_block(void **state)
{
    (void)state;
    enum { MANY = 3 << 20 };
    Arena a;
    arena_init(&a);
    arena_alloc(&a, MANY);
    ArenaMark m = arena_mark(&a);
    for (int round = 0; round < 3; round++) {
        unsigned char *p = arena_alloc(&a, 1000);
        for (int i = 0; i < 1000; i++)
            assert_int_equal(p[i], 0);
        arena_rewind(&a, m);
        p = arena_alloc(&a, 900);
        for (int i = 0; i < 900; i++)
            p[i] = 0xff;
        arena_rewind(&a, m);
    }
    arena_free(&a);
}

static void arrays_grow_and_keep_their_items(void **state)
{
    (void)state;
    Arena a;
    arena_init(&a);
    ARRAY(int) numbers = { 0 };
    for (int i = 0; i < 10000; i++)
        array_push(&a, &numbers, i);
    assert_int_equal(numbers.n, 10000);
    for (int i = 0; i < 10000; i++)
        assert_int_equal(numbers.data[i], i);
    arena_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_is_zeroed_and_aligned),
        cmocka_unit_test(rewinding_gives_back_what_came_after_the_mark),
        cmocka_unit_test(what_is_trimmed_away_is_handed_out_again_and_zeroed),
        cmocka_unit_test(memory_is_zeroed_again_after_rewinding_in_a_large_block),
        cmocka_unit_test(arrays_grow_and_keep_their_items),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
