/* test_thread.c - work shared among threads is done once, whoever does it; and the environment chooses the instruction set. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "base/cpu.h"
#include "base/thread.h"

enum { ITEMS = 10000 };

typedef struct Job {
    WorkCounter counter;
    _Atomic uint32_t done[ITEMS];
    _Atomic uint32_t workers;
} Job;

static void take_all(void *user, int worker)
{
    Job *job = user;
    uint32_t i;
    atomic_fetch_or(&job->workers, 1u << worker);
    while (work_take(&job->counter, &i))
        atomic_fetch_add(&job->done[i], 1);
}

static void every_item_is_taken_exactly_once(void **state)
{
    (void)state;
    for (int threads = 1; threads <= 16; threads *= 2) {
        Job *job = calloc(1, sizeof *job);
        work_start(&job->counter, ITEMS);
        thread_run(threads, take_all, job);
        for (int i = 0; i < ITEMS; i++)
            assert_int_equal(job->done[i], 1);
        assert_int_equal(job->workers, (1u << threads) - 1);
        free(job);
    }
}

static void there_is_a_processor(void **state)
{
    (void)state;
    assert_true(thread_processors() >= 1);
}

static void the_environment_may_ask_for_less_than_the_machine_has(void **state)
{
    (void)state;
    CpuIsa best = cpu_isa();
    for (int i = 0; i < N_CPU_ISAS; i++) {
        setenv("WHIT_CPU", cpu_isa_name((CpuIsa)i), 1);
        assert_int_equal(cpu_isa(), i <= (int)best ? i : (int)best);
    }
    setenv("WHIT_CPU", "no such thing", 1);
    assert_int_equal(cpu_isa(), best);
    unsetenv("WHIT_CPU");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_item_is_taken_exactly_once),
        cmocka_unit_test(there_is_a_processor),
        cmocka_unit_test(the_environment_may_ask_for_less_than_the_machine_has),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
