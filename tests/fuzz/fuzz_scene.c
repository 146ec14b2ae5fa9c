/* fuzz_scene.c - libFuzzer over the whole front end: any bytes as a scene, parsed and compiled. `make fuzz`.
 *
 * A scene may loop as long as it likes; a timer interrupts it after a second, as ^C would. Nothing is written outside the
 * folder the fuzzer runs in. */
#include <signal.h>
#include <stdlib.h>
#include <sys/time.h>

#include "whit.h"

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

static Whit *volatile running;

static void on_alarm(int number)
{
    (void)number;
    if (running)
        whit_interrupt(running);
}

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc, (void)argv;
    struct sigaction action = { .sa_handler = on_alarm, .sa_flags = SA_RESTART };
    sigaction(SIGVTALRM, &action, NULL);
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    static const char *const library[] = { "/usr/share/povray-3.7/include" };
    WhitOptions options = { .library_path = library, .n_library_paths = 1, .threads = 1, .memory_limit = (size_t)256 << 20,
                            .strict = n & 1 };
    Whit *w = whit_new(&options);
    if (!w)
        return 0;
    running = w;
    struct itimerval second = { .it_value = { .tv_sec = 1 } };
    setitimer(ITIMER_VIRTUAL, &second, NULL);
    whit_load_text(w, "fuzz.pov", (const char *)data, n);
    setitimer(ITIMER_VIRTUAL, &(struct itimerval){ 0 }, NULL);
    running = NULL;
    whit_free(w);
    return 0;
}
