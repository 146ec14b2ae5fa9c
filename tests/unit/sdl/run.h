/* run.h - runs a text through the core of the language: directives and expressions, no objects. */
#ifndef TEST_SDL_RUN_H
#define TEST_SDL_RUN_H

#include <stdio.h>
#include <string.h>

#undef fail                                    /* cmocka's; ours is a function */

#include "sdl/parser.h"

typedef struct Run {
    Arena arena;
    Diag *diag;
    Parser *parser;
    bool failed;
    char debug[16384];                         /* what #debug said */
    char messages[65536];                      /* warnings, the error; one after the other, each ended by a line end */
} Run;

static inline void run_show(void *user, const DiagMessage *m)
{
    Run *r = user;
    char *to = m->kind == DIAG_DEBUG ? r->debug : r->messages;
    size_t size = m->kind == DIAG_DEBUG ? sizeof r->debug : sizeof r->messages, n = strlen(to);
    snprintf(to + n, size - n, "%.*s%s", STR_ARGS(m->text), m->kind == DIAG_DEBUG ? "" : "\n");
}

static inline void run_statements(Parser *p)
{
    while (parse_peek(p) != TOK_END)
        if (!parse_bare_directive(p))
            parse_expected(p, "object or directive");
    parser_end(p);
}

/* What is still to be asked of r->parser may be asked until run_end. */
static inline bool run_options(Run *r, const char *text, SdlOptions *options)
{
    static const SdlHost host = { 0 };
    memset(r, 0, sizeof *r);
    arena_init(&r->arena);
    r->diag = diag_new(&r->arena);
    diag_sink(r->diag, run_show, r);
    if (!options->version)
        options->version = 370;
    if (setjmp(*diag_landing(r->diag)) != 0) {
        r->failed = true;
        return false;
    }
    r->parser = parser_new(&r->arena, r->diag, &host, options, str_of("scene.pov"), str_of(text));
    run_statements(r->parser);
    return true;
}

static inline bool run(Run *r, const char *text)
{
    SdlOptions options = { .width = 320, .height = 240, .strict = true, .input_name = str_of("folder/scene.pov") };
    return run_options(r, text, &options);
}

static inline void run_end(Run *r)
{
    if (r->parser)
        parser_free(r->parser);
    arena_free(&r->arena);
}

#endif
