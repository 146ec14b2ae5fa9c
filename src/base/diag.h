/* diag.h - where things stand in the sources, and what is said about them.
 *
 * An author's mistake ends in fail(): it records "chair.pov:12:7: error: ...", the source line, a caret and the chain
 * of includes and macro calls, then jumps to the landing set by diag_catch. Warnings are recorded and go on. Nothing
 * prints here: the command line shows the messages, by the sink it installs. */
#ifndef BASE_DIAG_H
#define BASE_DIAG_H

#include <setjmp.h>

#include "base/str.h"

typedef struct Loc {
    uint32_t line;                             /* from 1; 0 = no place */
    uint16_t source, column;                   /* source: index by diag_source; column from 1, in bytes, capped at 65535 */
} Loc;

typedef enum DiagKind { DIAG_ERROR, DIAG_WARNING, DIAG_DEBUG, DIAG_RENDER, DIAG_STATISTICS } DiagKind;

typedef struct DiagMessage {
    DiagKind kind;
    Loc loc;
    Str text;                                  /* whole: place, message, source line, caret, call chain */
} DiagMessage;

typedef struct Diag Diag;

Diag *diag_new(Arena *arena);
void diag_sink(Diag *d, void (*show)(void *user, const DiagMessage *m), void *user);   /* told at once; may be NULL */
/* Registers a source file; its text must outlive d. Without text it is the file of that name, and is read when it is needed. */
uint16_t diag_source(Diag *d, Str name, Str text);
Str diag_source_name(const Diag *d, uint16_t source);
Str diag_source_text(Diag *d, uint16_t source);

/* Called by diag when a message is built, to append lines like "  in macro Tree called at chair.pov:40:3". */
void diag_chain(Diag *d, Str (*chain)(void *user, Arena *a), void *user);

_Noreturn void fail(Diag *d, Loc loc, const char *format, ...) __attribute__((format(printf, 3, 4)));
_Noreturn void fail_io(Diag *d, Loc loc, const char *format, ...) __attribute__((format(printf, 3, 4)));  /* exit code 3 */
void warn(Diag *d, Loc loc, const char *format, ...) __attribute__((format(printf, 3, 4)));
void warn_once(Diag *d, Loc loc, const char *format, ...) __attribute__((format(printf, 3, 4)));  /* by its text, placeless */
void say(Diag *d, DiagKind kind, Str text);                /* streams of #debug, #render, #statistics: text as it is */

/* The landing: if (setjmp(*diag_landing(d)) == 0) { ... may fail ... } else { failed }. */
jmp_buf *diag_landing(Diag *d);
int diag_exit_code(const Diag *d);                         /* 0, 1 after fail, 3 after fail_io */
uint32_t diag_count(const Diag *d);
const DiagMessage *diag_message(const Diag *d, uint32_t i);

#endif
