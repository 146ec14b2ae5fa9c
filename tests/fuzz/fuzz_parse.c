/* fuzz_parse.c - libFuzzer feeds scenes to the front end: lexer, directives, grammars of all blocks. Nothing is rendered.
 *
 * `make fuzz FUZZ_TIME=60`. A finding is a file crash-*, timeout-* or oom-* in build/fuzz/found/; give it to build/fuzz/fuzz_parse
 * to see it again. */
#include <signal.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>

#include "registry.h"
#include "sdl/host.h"

enum { MEMORY = 256 << 20, MILLISECONDS = 500 };

static volatile int stop;

static void on_time(int signal)
{
    (void)signal;
    stop = 1;
}

/* Endless loops are legal: they are told to stop, as the program's own time limit would. */
static void start_clock(void)
{
    struct itimerval t = { .it_value = { 0, MILLISECONDS * 1000 } };
    stop = 0;
    setitimer(ITIMER_VIRTUAL, &t, NULL);
}

static void memory_ran_out(void *user)
{
    Diag *d = ((void **)user)[0];
    Arena *a = ((void **)user)[1];
    a->limit = 0;
    fail_io(d, (Loc){ 0 }, "out of memory");
}

static bool no_trace(void *user, const Object *o, Vec3 from, Vec3 direction, Vec3 *point, Vec3 *normal)
{
    (void)user, (void)o, (void)from, (void)direction, (void)point, (void)normal;
    return false;
}

static bool no_inside(void *user, const Object *o, Vec3 p)
{
    (void)user, (void)o, (void)p;
    return false;
}

static Bounds no_extent(void *user, const Object *o)
{
    (void)user, (void)o;
    return bounds_everything();
}

static Colour no_pigment(void *user, const Pigment *pigment, Vec3 p)
{
    (void)user, (void)pigment, (void)p;
    return (Colour){ 0 };
}

static double no_pattern(void *user, const Pattern *pattern, Vec3 p)
{
    (void)user, (void)pattern, (void)p;
    return 0;
}

static const struct World *no_world(void *user, const Object *o, uint32_t *context)
{
    (void)user, (void)o, (void)context;
    return NULL;
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
    static const SdlHost host = { .registry = &registry, .trace = no_trace, .inside = no_inside, .extent = no_extent,
                                  .pigment = no_pigment, .pattern = no_pattern, .world = no_world };
    char *text = malloc(size ? size : 1);      /* a block of its own: reading past the end is seen */
    Arena arena;
    arena_init(&arena);
    Diag *d = diag_new(&arena);
    void *both[2] = { d, &arena };
    arena.limit = MEMORY;
    arena.out_of_memory = memory_ran_out;
    arena.user = both;
    if (size)
        memcpy(text, data, size);
    /* The first byte chooses between strict and forgiving. */
    SdlOptions options = { .width = 64, .height = 48, .stop = &stop, .strict = size && (data[0] & 1) };
    Scene scene = { 0 };
    if (setjmp(*diag_landing(d)) == 0) {
        start_clock();
        sdl_parse(&arena, d, &host, &options, str_of("fuzz.pov"), (Str){ text, (uint32_t)size }, &scene);
    }
    arena_free(&arena);
    free(text);
    return 0;
}
