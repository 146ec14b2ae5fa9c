/* Shared libraries at run time: found by name or told to be missing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>

#include "base/library.h"

#define FUNCTIONS(each) each(cos) each(sqrt)

typedef struct Functions { FUNCTIONS(LIBRARY_FIELD) } Functions;

static const char *const names[] = { FUNCTIONS(LIBRARY_NAME) };

static void functions_of_the_program_itself_are_found(void **state)
{
    (void)state;
    Functions f;
    volatile double four = 4;                  /* the program is linked with both */
    assert_true(library_load(NULL, names, 2, &f));
    assert_true(f.sqrt(four) == 2 && f.sqrt(four) == sqrt(four));
    assert_true(f.cos(four) == cos(four));
}

static void a_library_or_a_function_that_is_missing_is_told(void **state)
{
    (void)state;
    Functions f;
    const char *const missing[] = { "cos", "no_such_function_anywhere" };
    assert_false(library_load("libno_such_library.so.1", names, 2, &f));
    assert_false(library_load(NULL, missing, 2, &f));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(functions_of_the_program_itself_are_found),
        cmocka_unit_test(a_library_or_a_function_that_is_missing_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
