/* test_deflate.c - streams hold what went into them, read back bit by bit after RFC 1951. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "image/deflate.h"

/* ---- the reader ---- */

typedef struct Bits { const uint8_t *bytes; size_t n, at; } Bits;      /* `at` counts bits */

static unsigned take(Bits *b, int n)
{
    unsigned v = 0;
    for (int i = 0; i < n; i++, b->at++) {
        assert_true(b->at / 8 < b->n);
        v |= (b->bytes[b->at / 8] >> b->at % 8 & 1u) << i;
    }
    return v;
}

/* One bit more until the code is that of a symbol; codes of a length follow each other (section 3.2.2). */
static int take_symbol(Bits *b, const uint8_t *length, int n)
{
    unsigned code = 0, first = 0;
    for (int bits = 1; bits <= 15; bits++) {
        code = code << 1 | take(b, 1);
        unsigned here = 0;
        for (int i = 0; i < n; i++)
            if (length[i] == bits && first + here++ == code)
                return i;
        first = (first + here) << 1;
    }
    fail_msg("no symbol has this code");
    return 0;
}

static void take_lengths(Bits *b, uint8_t *length, int n)
{
    static const int order[] = { 16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15 };
    uint8_t own[19] = { 0 };
    int n_own = 4 + (int)take(b, 4);
    for (int i = 0; i < n_own; i++)
        own[order[i]] = (uint8_t)take(b, 3);
    for (int i = 0; i < n;) {
        int symbol = take_symbol(b, own, 19);
        int times = symbol == 16 ? 3 + (int)take(b, 2) : symbol == 17 ? 3 + (int)take(b, 3) : symbol == 18 ? 11 + (int)take(b, 7) : 1;
        assert_true(i + times <= n && (symbol != 16 || i > 0));
        uint8_t value = symbol == 16 ? length[i - 1] : symbol > 16 ? 0 : (uint8_t)symbol;
        memset(length + i, value, (size_t)times);
        i += times;
    }
}

static void assert_complete(const uint8_t *length, int n)
{
    unsigned used = 0;
    for (int i = 0; i < n; i++)
        used += length[i] != 0 ? 1u << (15 - length[i]) : 0;
    assert_int_equal(used, 1 << 15);
}

/* Blocks of kind 2, all distances 1: nothing else is written. */
static size_t inflate(const uint8_t *bytes, size_t n, uint8_t *out)
{
    Bits b = { bytes, n, 0 };
    size_t n_out = 0;
    assert_int_equal((bytes[0] * 256 + bytes[1]) % 31, 0);
    assert_int_equal(take(&b, 16) & 15, 8);
    bool last;
    do {
        uint8_t length[288 + 32] = { 0 };
        last = take(&b, 1);
        assert_int_equal(take(&b, 2), 2);
        int n_symbols = 257 + (int)take(&b, 5), n_distances = 1 + (int)take(&b, 5);
        assert_int_equal(n_distances, 1);
        take_lengths(&b, length, n_symbols + n_distances);
        assert_complete(length, n_symbols);
        for (int symbol; (symbol = take_symbol(&b, length, n_symbols)) != 256;) {
            if (symbol < 256) {
                out[n_out++] = (uint8_t)symbol;
                continue;
            }
            int group = symbol - 257, more = group < 8 || group == 28 ? 0 : group / 4 - 1;
            int run = group == 28 ? 258 : group < 8 ? 3 + group : 3 + ((4 + group % 4) << more) + (int)take(&b, more);
            assert_int_equal(take_symbol(&b, length + n_symbols, n_distances), 0);
            assert_true(n_out > 0);
            memset(out + n_out, out[n_out - 1], (size_t)run);
            n_out += (size_t)run;
        }
    } while (!last);
    unsigned a = 1, c = 0, sum = 0;
    for (size_t i = 0; i < n_out; i++) {
        a = (a + out[i]) % 65521;
        c = (c + a) % 65521;
    }
    b.at = (b.at + 7) / 8 * 8;
    for (int i = 0; i < 4; i++)
        sum = sum << 8 | take(&b, 8);
    assert_int_equal(sum, c << 16 | a);
    assert_int_equal(b.at, 8 * n);
    return n_out;
}

/* ---- the tests ---- */

/* Through blocks of the size given, in memory of its own, so that the sanitizers see what is read or written beyond. */
static size_t goes_round(const uint8_t *bytes, size_t n, size_t block)
{
    Deflate d;
    size_t n_packed = 0;
    uint8_t *packed = malloc(deflate_most(n) + deflate_most(0) * (n / block + 1)), *back = malloc(n + 300);
    assert_true(deflate_start(&d, block));
    for (size_t i = 0; i < n; i += block) {
        size_t now = n - i < block ? n - i : block;
        uint8_t *part = malloc(now);
        memcpy(part, bytes + i, now);
        uint8_t *out = malloc(deflate_most(now));
        size_t made = deflate_block(&d, part, now, i + now == n, out);
        memcpy(packed + n_packed, out, made);
        n_packed += made;
        free(out);
        free(part);
    }
    deflate_free(&d);
    assert_int_equal(inflate(packed, n_packed, back), n);
    assert_memory_equal(back, bytes, n);
    free(packed);
    free(back);
    return n_packed;
}

static void streams_of_every_short_length_hold_their_bytes(void **state)
{
    (void)state;
    uint8_t bytes[40];
    for (size_t n = 1; n <= sizeof bytes; n++) {
        for (size_t i = 0; i < n; i++)
            bytes[i] = (uint8_t)(i * i);
        goes_round(bytes, n, 64);
        memset(bytes, 7, n);
        goes_round(bytes, n, 64);
        goes_round(bytes, n, 1 + n / 3);
    }
}

static void runs_of_every_length_come_back(void **state)
{
    (void)state;
    enum { LONGEST = 600 };
    static uint8_t bytes[LONGEST * (LONGEST + 1) / 2];
    size_t n = 0;
    for (int run = 1; run <= LONGEST; run++, n += (size_t)run - 1)
        memset(bytes + n, run % 251, (size_t)run);
    assert_int_equal(n, sizeof bytes);
    assert_true(goes_round(bytes, n, n) < 4500);
    goes_round(bytes, n, 1000);
}

/* Counts like Fibonacci's numbers would give codes of thirty bits. */
static void codes_stay_within_their_longest(void **state)
{
    (void)state;
    enum { KINDS = 26 };
    static uint8_t bytes[400000];
    size_t n = 0, count = 1, before = 1;
    for (int kind = 0; kind < KINDS; kind++) {
        for (size_t i = 0; i < count && n < sizeof bytes; i++)
            bytes[n++] = (uint8_t)(kind * 9);
        size_t sum = count + before;
        before = count;
        count = sum;
    }
    unsigned seed = 5;
    for (size_t i = n; i-- > 1;) {
        seed = seed * 1664525u + 1013904223u;
        size_t k = seed % (i + 1);
        uint8_t old = bytes[i];
        bytes[i] = bytes[k];
        bytes[k] = old;
    }
    size_t packed = goes_round(bytes, n, n);
    assert_true(packed < n * 4 / 10);
}

static void noise_grows_little(void **state)
{
    (void)state;
    static uint8_t bytes[100000];
    unsigned seed = 9;
    for (size_t i = 0; i < sizeof bytes; i++) {
        seed = seed * 1664525u + 1013904223u;
        bytes[i] = (uint8_t)(seed >> 24);
    }
    assert_true(goes_round(bytes, sizeof bytes, 1 << 14) < sizeof bytes * 102 / 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(streams_of_every_short_length_hold_their_bytes),
        cmocka_unit_test(runs_of_every_length_come_back),
        cmocka_unit_test(codes_stay_within_their_longest),
        cmocka_unit_test(noise_grows_little),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
