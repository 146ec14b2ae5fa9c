/* test_numbers.c - decimal literals become the nearest double: the fast paths against strtod, bit for bit. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sdl/run.h"

#include "sdl/number.h"

static uint64_t state_ = 88172645463325252u;

static uint64_t random64(void)                 /* xorshift64 (Marsaglia 2003) */
{
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    return state_ ^= state_ << 17;
}

static void same_as_strtod(const char *text)
{
    static char longer[6100];
    size_t n = strlen(text);
    double want = strtod(text, NULL);
    for (int behind = 0; behind < 2; behind++) {           /* at the end of a file, and with more to come */
        snprintf(longer, sizeof longer, "%s%s", text, behind ? ", 1, 2, 3, 4, 5, 6, 7" : "");
        const char *at = longer;
        double got = -1;
        at = number_scan(at, longer + strlen(longer), &got);
        assert_non_null(at);
        assert_int_equal(at - longer, n);
        if (memcmp(&got, &want, sizeof got) != 0)
            print_message("%s: %a, strtod says %a\n", text, got, want);
        assert_memory_equal(&got, &want, sizeof got);
    }
}

static void any_double_survives_being_written(void **state)
{
    (void)state;
    for (int i = 0; i < 300000; i++) {
        uint64_t bits = random64() & 0x7fffffffffffffffu;
        double v;
        memcpy(&v, &bits, sizeof v);
        if (v != v || v - v != 0)
            continue;
        char text[64];
        snprintf(text, sizeof text, "%.*g", 1 + (int)(random64() % 20), v);
        same_as_strtod(text);
    }
}

static void numbers_as_exporters_write_them(void **state)
{
    (void)state;
    for (int i = 0; i < 300000; i++) {
        double v = (double)(random64() >> 11) * 0x1p-53 * (i % 3 ? 100 : 1e-3);
        char text[64];
        snprintf(text, sizeof text, i & 1 ? "%.*f" : "%.*e", (int)(random64() % 18), v);
        same_as_strtod(text);
    }
}

static void same_as_printf(double v, int digits)
{
    char got[NUMBER_FIXED], want[400];
    size_t n = number_fixed(v, digits, got);
    if (n == 0)
        return;
    snprintf(want, sizeof want, "%.*f", digits, v);
    assert_int_equal(n, strlen(want));
    assert_memory_equal(got, want, n);
}

static void numbers_are_written_as_printf_does(void **state)
{
    (void)state;
    for (int i = 0; i < 300000; i++) {
        uint64_t r = random64();
        int digits = (int)(r % 20);
        same_as_printf(ldexp((double)(int64_t)r, -(int)(random64() % 140)), digits);
        same_as_printf((double)(int64_t)(random64() >> 50) * ((r & 64) ? -0x1p-4 : 0x1p-7), digits);  /* ties */
        same_as_printf((double)(int64_t)(random64() >> 44) / 1e5, digits);
    }
    char text[NUMBER_FIXED];
    static const double some[] = { 0, -0.0, 0.5, 1.5, 2.5, -0.5, 0.999, 9.5, 99.5, 0x1p53, 0x1p52, 9007199254740991, 1e-320, 0x1p-1022 };
    for (size_t i = 0; i < sizeof some / sizeof *some; i++)
        for (int digits = 0; digits <= 18; digits++) {
            assert_true(number_fixed(some[i], digits, text) > 0 || some[i] >= 0x1p53);
            same_as_printf(some[i], digits);
        }
    assert_int_equal(number_fixed(INFINITY, 3, text), 0);
    assert_int_equal(number_fixed(NAN, 3, text), 0);
    assert_int_equal(number_fixed(1, -1, text), 0);
    assert_int_equal(number_fixed(1, 19, text), 0);
}

static void hard_and_strange_literals(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "0", "0.0", ".5", "5.", "1e5", "1E-5", "1e+5", "00012", "0.000000000000000000000000000001", "9007199254740993",
        "9007199254740992.5", "9007199254740993.00000000000000000000000000000000001", "1.7976931348623157e308",
        "1.7976931348623158e308", "1.7976931348623159e308", "2.2250738585072014e-308", "4.9e-324", "2.4703282292062327e-324",
        "2.4703282292062328e-324", "1e400", "1e-400", "0e99999999999", "1e99999999999", "1e-99999999999", "123456789012345678901234567890",
        "0.1234567890123456789012345678901234567890", "8.5e22", "1e22", "1e23", "7.2057594037927933e16", "6929495644600919.5",
        "3.2378839133029012895883524125015321748630094231105120e-319", "100000000000000016777215", "100000000000000016777216",
        "0.3", "2.5e-1", "179769313486231580793728971405301e276",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        same_as_strtod(texts[i]);
}

static void thousands_of_digits(void **state)
{
    (void)state;
    char text[6000];
    for (int i = 0; i < 200; i++) {
        size_t n = 20 + random64() % 5000, point = random64() % n;
        for (size_t k = 0; k < n; k++)
            text[k] = k == point ? '.' : (char)('0' + random64() % 10);
        text[n] = 0;
        if (point == 0 && n < 2)
            continue;
        same_as_strtod(text);
        memset(text, '0', n / 2);              /* and zeros in front */
        same_as_strtod(text);
    }
}

static void the_exponent_may_lack_its_digits(void **state)
{
    (void)state;
    static const char *const texts[] = { "1e", "1E", "1e+", "1e-" };
    for (int i = 0; i < 4; i++) {
        const char *at = texts[i];
        double v = 0;
        at = number_scan(at, at + strlen(at), &v);
        assert_non_null(at);
        assert_true(v == 1 && *at == 0);
    }
}

/* The short way for vectors of literals takes them exactly like the grammar, or leaves them alone. */
static void vector_literals_are_taken_whole_or_not_at_all(void **state)
{
    (void)state;
    static const struct { const char *text; bool taken; } rows[] = {
        { "<1,2,3>,", true }, { "< 1 ,\n-2 , .5 > }", true }, { "<1e2,-1e-2,0>\n<4,5,6>", true }, { "<1,2,3>4", true },
        { "<1,2,3>*2", false }, { "<1,2,3>.x", false }, { "<1,2,3>/2", false }, { "<1,2,3>+x", false }, { "<1,2,3> M()", false },
        { "<1,2>,", false }, { "<1,2,3,4>,", false }, { "<1 2 3>,", false }, { "<1,2,A>,", false }, { "<1,2,3 /**/ >,", false },
        { "<1,2,--3>,", false }, { "<1,2,3+4>,", false }, { "<1,2,3.4.5>,", false }, { "<1,2,3", false }, { "<1,2,3>", false }, { "", false },
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        Lexer l;
        double v[3];
        lex_start(&l, 0, str_of(rows[i].text));
        const char *before = l.at;
        assert_int_equal(literal_vector(&l, LITERAL_NOTHING, v), rows[i].taken);
        assert_true(rows[i].taken == (l.at != before));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_double_survives_being_written),
        cmocka_unit_test(numbers_as_exporters_write_them),
        cmocka_unit_test(numbers_are_written_as_printf_does),
        cmocka_unit_test(hard_and_strange_literals),
        cmocka_unit_test(thousands_of_digits),
        cmocka_unit_test(the_exponent_may_lack_its_digits),
        cmocka_unit_test(vector_literals_are_taken_whole_or_not_at_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
