/* token.h - what the lexer makes of the text: 24 bytes a token.
 *
 * Big files are lexed as they are parsed and leave no tokens behind. Only the bodies of loops and macros are kept, as
 * arrays of tokens that are replayed by index; there each directive knows where its next branch begins. */
#ifndef SDL_TOKEN_H
#define SDL_TOKEN_H

#include "base/diag.h"
#include "sdl/parse.h"

typedef struct Binding Binding;

/* A word of the text, once per parser. The binding is the innermost one visible now, so a look-up is one load. */
typedef struct Sym {
    Str text;
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
    uint32_t line;
    uint16_t source;
} Lexer;

void lex_start(Lexer *l, uint16_t source, Str text);       /* skips a UTF-8 mark; then `at` is behind the start */
void lex_next(Parser *p, Lexer *l, Token *out);
/* `<a, b, c>` of plain literals, or one, with nothing behind it that could go on with the expression: takes it, or takes
 * nothing. */
typedef enum LexBefore { LEX_NOTHING, LEX_COMMA, LEX_INSIDE } LexBefore;       /* a comma may come first; `<` has been taken already */
bool lex_vector_literal(Lexer *l, LexBefore before, double out[3]);
bool lex_number_literal(Lexer *l, LexBefore before, double *out);
bool lex_numbers_literal(Lexer *l, int n, double *out);     /* n of them, behind a '<' that is still to come: of matrix */
/* A macro's argument that is a literal float or vector, and the ',' behind it, or before a ')': its terms; 0, nothing taken: another. */
int lex_argument_literal(Lexer *l, double out[5]);
/* `{ rgb <a,b,c> }` behind `pigment`, or `{ pigment { rgb <a,b,c> } }` behind `texture`; rgbf, rgbt, rgbft and a `color` before
 * them too. Takes it whole or takes nothing. */
bool lex_pigment_literal(Lexer *l, bool texture, Colour *out);
bool lex_texture_literal(Lexer *l, Colour *out);           /* the latter with `texture` itself still to come */
/* Skips blanks and comments; true if the character after them is `c`, which is taken. */
bool lex_accept(Parser *p, Lexer *l, char c);
int lex_peek_char(Parser *p, Lexer *l);        /* the next character that counts, not taken; -1 at the end */
Loc lex_loc(const Lexer *l);                   /* of `at` */

/* A decimal literal at `*at`, moved behind it; false if there is none. Correctly rounded. */
bool number_scan(const char **at, const char *end, double *out);

/* What printf makes of "%.*f"; the number of characters, or 0 for what only printf can do: large numbers and many digits. */
enum { NUMBER_FIXED = 48 };
size_t number_fixed(double v, int digits, char out[NUMBER_FIXED]);

#endif
