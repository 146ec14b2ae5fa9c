/* parser.c - the life of a parser. */
#include "sdl/parser.h"

#include <string.h>

static void temp_is_full(void *user)
{
    Parser *p = user;
    if (p->arena->out_of_memory)               /* the owner of the arena knows what to say */
        p->arena->out_of_memory(p->arena->user);
    p->arena->limit = 0;
    fail_io(p->diag, (Loc){ 0 }, "out of memory while reading the scene");
}

/* Where systems keep the fonts of POV-Ray's library, which has links to them. */
static const char FONT_FOLDER[] = "/usr/share/fonts";

/* What a scene may touch: the folder it is in, the current one, the library, and what the options add. */
static void init_access(Parser *p)
{
    const SdlOptions *o = p->options;
    file_allow_write(p->arena, &p->access, str_of("."));
    file_allow_read(p->arena, &p->access, p->scene_folder);
    for (uint32_t i = 0; i < o->n_library_paths; i++)
        file_allow_read(p->arena, &p->access, o->library_path[i]);
    file_allow_read(p->arena, &p->access, str_of(FONT_FOLDER));
    for (uint32_t i = 0; i < o->n_allow_read; i++)
        file_allow_read(p->arena, &p->access, o->allow_read[i]);
    for (uint32_t i = 0; i < o->n_allow_write; i++)
        file_allow_write(p->arena, &p->access, o->allow_write[i]);
}

Parser *parser_new(Arena *scene_arena, Diag *diag, const SdlHost *host, const SdlOptions *options, Str path, Str text)
{
    Parser *p = arena_new(scene_arena, Parser);
    p->arena = scene_arena;
    p->diag = diag;
    p->host = host;
    p->options = options;
    arena_init(&p->temp);
    p->temp.limit = scene_arena->limit;
    p->temp.out_of_memory = temp_is_full;
    p->temp.user = p;
    p->version = options->version ? options->version : 370;
    p->version_given = options->version != 0;
    p->scene_folder = file_folder(str_copy(p->arena, path));
    init_access(p);
    symbols_init(p);
    symbol_predefined(p);
    cursor_start(p, diag_source(diag, path, options->feed == NULL ? text : (Str){ 0 }), text);
    cursor_top(p)->lexer.feed = options->feed;
    return p;
}

void parser_end(Parser *p)
{
    if (p->n_conditionals)
        fail(p->diag, p->conditional[p->n_conditionals - 1].loc, "End of file reached but #end expected.");
    directive_flush_debug(p);
    if (!p->version_given)
        warn_once(p->diag, (Loc){ 0 }, "the scene has no #version: it is read as 3.7, with the gamma of 3.6");
}

void parser_free(Parser *p)
{
    for (FileHandle *h = p->handles; h; h = h->next)
        file_close(h);
    p->handles = NULL;
    diag_chain(p->diag, NULL, NULL);
    arena_free(&p->temp);
}

void **parse_kept(Parser *p, const void *key, uint32_t variant)
{
    for (uint32_t i = 0; i < p->kept.n; i++)
        if (p->kept.data[i].key == key && p->kept.data[i].variant == variant)
            return &p->kept.data[i].pointer;
    array_push(p->arena, &p->kept, (KeptPointer){ .key = key, .variant = variant });
    return &p->kept.data[p->kept.n - 1].pointer;
}
