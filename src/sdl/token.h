/* token.h - what the lexer makes of the text: 24 bytes a token.
 *
 * Big files are lexed as they are parsed and leave no tokens behind. Only the bodies of loops and macros are kept, as
 * arrays of tokens that are replayed by index; there each directive knows where its next branch begins. Behind the last one that a
 * reader may take stands a TOK_HASH (a macro's #end) or TOK_END. */
#ifndef SDL_TOKEN_H
#define SDL_TOKEN_H

#include "base/diag.h"
#include "base/file.h"
#include "sdl/parse.h"

typedef struct Binding Binding;

/* A word of the text, once per parser. The binding is the innermost one visible now, so a look-up is one load. */
typedef struct Sym {
    Str text;
    uint64_t head;                             /* its first 8 bytes: all of most words */
    uint32_t hash;
    uint16_t keyword;                          /* 0: an identifier */
    bool is_directive;                         /* may follow '#' */
    Binding *binding;
} Sym;

typedef struct Token {
    uint16_t kind;                             /* a KW_ or TOK_ constant */
    uint16_t directive;                        /* TOK_HASH: its KW_ constant */
    uint32_t n;                                /* TOK_STRING: bytes; TOK_HASH in an array: index of its next branch or #end */
    Loc loc;
    union {
        double number;
        Sym *sym;                              /* keywords, names and directives */
        const char *text;                      /* TOK_STRING: as written between the quotes; TOK_OTHER: the character */
    };
} Token;

typedef struct Lexer {
    const char *at, *end, *line_start;
    FileFeed *feed;                            /* NULL, or: the text is its window */
    uint32_t line;
    uint16_t source;
} Lexer;

void lex_start(Lexer *l, uint16_t source, Str text);       /* skips a UTF-8 mark; then `at` is behind the start */
/* A copy of a lexer goes on where it was, though the window may have moved: `base` is lex_base() of when it was made. */
uint64_t lex_base(const Lexer *l);
void lex_resume(Lexer *l, uint64_t base);
void lex_next(Parser *p, Lexer *l, Token *out);
/* Skips blanks and comments; true if the character after them is `c`, which is taken. */
bool lex_accept(Parser *p, Lexer *l, char c);
int lex_peek_char(Parser *p, Lexer *l);        /* the next character that counts, not taken; -1 at the end */
Loc lex_loc(const Lexer *l);                   /* of `at` */

#endif
