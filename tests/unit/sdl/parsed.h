/* parsed.h - for tests: a scene from a text, or the message of its first mistake. */
#ifndef TESTS_SDL_PARSED_H
#define TESTS_SDL_PARSED_H

#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include "registry.h"
#include "sdl/host.h"

typedef struct Parsed {
    Arena arena;
    Diag *diag;
    Scene scene;
    bool failed;
} Parsed;

static bool no_inside(void *user, const Object *o, Vec3 p)
{
    (void)user, (void)o, (void)p;
    return false;
}

static Colour no_colour(void *user, const Pigment *pigment, Vec3 p)
{
    (void)user, (void)pigment, (void)p;
    return (Colour){ 0 };
}

static double no_value(void *user, const Pattern *pattern, Vec3 p)
{
    (void)user, (void)pattern, (void)p;
    return 0;
}

/* feed: NULL, or the text is its window. */
static Parsed *parsed_from(const char *path, const char *text, FileFeed *feed, bool strict)
{
    Parsed *volatile s = calloc(1, sizeof *s);
    SdlHost host = { .registry = &registry, .inside = no_inside, .pigment = no_colour, .pattern = no_value };
    SdlOptions options = { .width = 320, .height = 240, .strict = strict, .input_name = str_of(path), .feed = feed };
    arena_init(&s->arena);
    s->diag = diag_new(&s->arena);
    if (setjmp(*diag_landing(s->diag)) == 0)
        sdl_parse(&s->arena, s->diag, &host, &options, str_of(path), str_of(text), &s->scene);
    else
        s->failed = true;
    return s;
}

static inline Parsed *parsed(const char *text)
{
    return parsed_from("test.pov", text, NULL, false);
}

static inline Parsed *parsed_strictly(const char *text)
{
    return parsed_from("test.pov", text, NULL, true);
}

static void parsed_free(Parsed *s)
{
    arena_free(&s->arena);
    free(s);
}

/* Is this among the texts of the messages? Messages fold lines; so must `text`, that is: keep it short. */
static inline bool said(const Parsed *s, DiagKind kind, const char *text)
{
    for (uint32_t i = 0; i < diag_count(s->diag); i++) {
        const DiagMessage *m = diag_message(s->diag, i);
        char copy[4096];
        snprintf(copy, sizeof copy, "%.*s", STR_ARGS(m->text));
        if (m->kind == kind && strstr(copy, text) != NULL)
            return true;
    }
    return false;
}

#endif
