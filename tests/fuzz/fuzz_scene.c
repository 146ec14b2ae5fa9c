/* fuzz_scene.c - libFuzzer feeds scenes to everything before the first ray: lexer, directives, grammars of all blocks, what a scene
 * asks while it is read (trace(), inside(), pigments), the making of the World, and its plan. Nothing is rendered.
 *
 * `make fuzz FUZZ_TIME=60`. A finding is a file crash-*, timeout-* or oom-* in build/fuzz/found/; give it to build/fuzz/fuzz_scene
 * to see it again. */
#include <signal.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>

#include "whit.h"

enum { MEMORY = 256 << 20, MILLISECONDS = 500 };

static Whit *volatile running;

static void on_time(int signal)
{
    (void)signal;
    if (running != NULL)
        whit_interrupt(running);
}

/* Endless loops are legal: they are told to stop, as ^C would. */
static void set_clock(int milliseconds)
{
    struct itimerval t = { .it_value = { 0, milliseconds * 1000 } };
    setitimer(ITIMER_VIRTUAL, &t, NULL);
}

static void hear(void *user, const WhitMessage *message)
{
    *(size_t *)user += strlen(message->text);  /* reads each to its end */
}

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc, (void)argv;
    signal(SIGVTALRM, on_time);
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    /* The first byte chooses between strict and forgiving. */
    WhitOptions options = { .width = 8, .height = 6, .threads = 1, .memory_limit = MEMORY, .strict = size && (data[0] & 1) };
    Whit *w = whit_new(&options);
    if (w == NULL)
        abort();
    size_t heard = 0;
    whit_show(w, hear, &heard);
    running = w;
    set_clock(MILLISECONDS);
    if (whit_load_text(w, "fuzz.pov", (const char *)data, size))
        heard += strlen(whit_explain(w));
    set_clock(0);
    running = NULL;
    heard += strlen(whit_summary(w));
    whit_free(w);
    return heard == SIZE_MAX;
}
