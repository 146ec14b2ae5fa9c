/* diag.c - messages with their place; see diag.h. */
#include "base/diag.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/array.h"
#include "base/file.h"

/* A scene that warns in every turn of a loop must not fill the memory, nor drown the one warning that matters. */
enum { MAX_KEPT = 1000, MAX_SOURCE_LINE = 160, MAX_SOURCES = UINT16_MAX };

typedef struct Source {
    Str name, text;
    bool unread;
    uint32_t last_line;                        /* where the last look-up ended: messages come in order */
    size_t last_at;
} Source;

struct Diag {
    Arena *arena;
    ARRAY(Source) source;
    ARRAY(DiagMessage) message;
    ARRAY(Str) said_once;
    void (*show)(void *user, const DiagMessage *m);
    void *show_user;
    Str (*chain)(void *user, Arena *a);
    void *chain_user;
    jmp_buf landing;
    int exit_code;
    uint32_t n_warnings;
    bool failing;
};

Diag *diag_new(Arena *arena)
{
    Diag *d = arena_new(arena, Diag);
    d->arena = arena;
    return d;
}

void diag_sink(Diag *d, void (*show)(void *user, const DiagMessage *m), void *user)
{
    d->show = show;
    d->show_user = user;
}

uint16_t diag_source(Diag *d, Str name, Str text)
{
    if (d->source.n >= MAX_SOURCES)
        return 0;                              /* the 65536th file is reported under the first one's name */
    array_push(d->arena, &d->source, (Source){ .name = str_copy(d->arena, name), .text = text, .unread = text.data == NULL,
                                               .last_line = 1 });
    return (uint16_t)(d->source.n - 1);
}

Str diag_source_name(const Diag *d, uint16_t source)
{
    return source < d->source.n ? d->source.data[source].name : str_of("");
}

Str diag_source_text(Diag *d, uint16_t source)
{
    if (source >= d->source.n)
        return str_of("");
    Source *s = &d->source.data[source];
    if (s->unread && file_read(d->arena, NULL, s->name, &s->text) != FILE_OK)
        s->text = str_of("");
    s->unread = false;
    return s->text;
}

void diag_chain(Diag *d, Str (*chain)(void *user, Arena *a), void *user)
{
    d->chain = chain;
    d->chain_user = user;
}

/* LF, CR, CR LF and LF CR each end a line. Returns the index behind the line end at i. */
static size_t skip_line_end(Str text, size_t i)
{
    char other = text.data[i] == '\n' ? '\r' : '\n';
    return i + 1 + (i + 1 < text.n && text.data[i + 1] == other);
}

static Str source_line(Source *s, uint32_t line)
{
    if (line < s->last_line) {
        s->last_line = 1;
        s->last_at = 0;
    }
    size_t i = s->last_at;
    uint32_t at = s->last_line;
    while (at < line && i < s->text.n) {
        while (i < s->text.n && s->text.data[i] != '\n' && s->text.data[i] != '\r')
            i++;
        if (i < s->text.n)
            i = skip_line_end(s->text, i);
        at++;
    }
    s->last_line = at;
    s->last_at = i;
    size_t end = i;
    while (end < s->text.n && s->text.data[end] != '\n' && s->text.data[end] != '\r')
        end++;
    return (Str){ s->text.data + i, (uint32_t)(end - i) };
}

/* "\n  text of the line\n      ^". Bytes that a terminal might obey become spaces; long lines show the part around the
 * column. */
static Str caret(Diag *d, Loc loc)
{
    if (!loc.line || !loc.column || loc.source >= d->source.n)
        return str_of("");
    diag_source_text(d, loc.source);
    Str line = source_line(&d->source.data[loc.source], loc.line);
    uint32_t column = loc.column - 1u;
    if (column > line.n || line.n == 0)
        return str_of("");
    uint32_t from = column > MAX_SOURCE_LINE / 2 && line.n > MAX_SOURCE_LINE ? column - MAX_SOURCE_LINE / 2 : 0;
    uint32_t n = line.n - from < MAX_SOURCE_LINE ? line.n - from : MAX_SOURCE_LINE;
    char shown[MAX_SOURCE_LINE], blank[MAX_SOURCE_LINE];
    for (uint32_t i = 0; i < n; i++) {
        char c = line.data[from + i];
        shown[i] = (unsigned char)c < ' ' || c == 127 ? ' ' : c;
        if (c & 0x80)                          /* the log is ASCII for those who decode it so */
            shown[i] = '?';
    }
    uint32_t n_blank = column - from;
    memset(blank, ' ', sizeof blank);
    return str_format(d->arena, "\n  %.*s\n  %.*s^", (int)n, shown, (int)(n_blank < sizeof blank ? n_blank : sizeof blank),
                      blank);
}

static void record(Diag *d, DiagKind kind, Loc loc, Str text)
{
    DiagMessage m = { kind, loc, text };
    if (kind == DIAG_WARNING && ++d->n_warnings > MAX_KEPT) {
        if (d->n_warnings > MAX_KEPT + 1)
            return;
        m.text = str_of("warning: further warnings are not shown");
    }
    if (d->message.n < MAX_KEPT || kind == DIAG_ERROR)
        array_push(d->arena, &d->message, m);
    if (d->show)
        d->show(d->show_user, &m);
}

static void report(Diag *d, DiagKind kind, Loc loc, const char *format, va_list args)
{
    const char *word = kind == DIAG_ERROR ? "error" : "warning";
    Str text = str_vformat(d->arena, format, args);
    Str chain = d->chain && loc.line ? d->chain(d->chain_user, d->arena) : str_of("");
    Str whole;
    if (loc.line && loc.column)
        whole = str_format(d->arena, "%.*s:%u:%u: %s: %.*s", STR_ARGS(diag_source_name(d, loc.source)), loc.line,
                           loc.column, word, STR_ARGS(text));
    else if (loc.line)
        whole = str_format(d->arena, "%.*s:%u: %s: %.*s", STR_ARGS(diag_source_name(d, loc.source)), loc.line, word,
                           STR_ARGS(text));
    else
        whole = str_format(d->arena, "%s: %.*s", word, STR_ARGS(text));
    whole = str_concat(d->arena, whole, caret(d, loc));
    record(d, kind, loc, str_concat(d->arena, whole, chain));
}

_Noreturn static void land(Diag *d, int exit_code)
{
    d->exit_code = exit_code;
    longjmp(d->landing, 1);
}

/* A failure while reporting a failure: only the first is told. */
static void report_failure(Diag *d, Loc loc, const char *format, va_list args)
{
    if (d->failing)
        return;
    d->failing = true;
    report(d, DIAG_ERROR, loc, format, args);
    d->failing = false;
}

void fail(Diag *d, Loc loc, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    report_failure(d, loc, format, args);
    va_end(args);
    land(d, 1);
}

void fail_io(Diag *d, Loc loc, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    report_failure(d, loc, format, args);
    va_end(args);
    land(d, 3);
}

void warn(Diag *d, Loc loc, const char *format, ...)
{
    if (d->n_warnings > MAX_KEPT)
        return;
    va_list args;
    va_start(args, format);
    report(d, DIAG_WARNING, loc, format, args);
    va_end(args);
}

void warn_once(Diag *d, Loc loc, const char *format, ...)
{
    if (d->n_warnings > MAX_KEPT || d->said_once.n >= MAX_KEPT)
        return;
    va_list args;
    va_start(args, format);
    ArenaMark mark = arena_mark(d->arena);
    Str text = str_vformat(d->arena, format, args);
    va_end(args);
    for (uint32_t i = 0; i < d->said_once.n; i++)
        if (str_equal(d->said_once.data[i], text)) {
            arena_rewind(d->arena, mark);
            return;
        }
    array_push(d->arena, &d->said_once, text);
    va_start(args, format);
    report(d, DIAG_WARNING, loc, format, args);
    va_end(args);
}

void say(Diag *d, DiagKind kind, Str text)
{
    bool kept = d->message.n < MAX_KEPT;
    record(d, kind, (Loc){ 0 }, kept ? str_copy(d->arena, text) : text);
}

jmp_buf *diag_landing(Diag *d)
{
    return &d->landing;
}

int diag_exit_code(const Diag *d)
{
    return d->exit_code;
}

uint32_t diag_count(const Diag *d)
{
    return d->message.n;
}

const DiagMessage *diag_message(const Diag *d, uint32_t i)
{
    return &d->message.data[i];
}
