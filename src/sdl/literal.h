/* literal.h - what stands in big files a million times over, straight from its characters.
 *
 * Each takes all of what it is for, or takes nothing when anything about it is unusual: then the tokens take over. */
#ifndef SDL_LITERAL_H
#define SDL_LITERAL_H

#include "sdl/token.h"

typedef enum LiteralBefore {                   /* a comma may come first; `<` has been taken already */
    LITERAL_NOTHING, LITERAL_COMMA, LITERAL_INSIDE
} LiteralBefore;

/* `<a, b, c>`, or one number, with nothing behind it that could go on with the expression. */
bool literal_vector(Lexer *l, LiteralBefore before, double out[3]);
bool literal_number(Lexer *l, LiteralBefore before, double *out);
bool literal_numbers(Lexer *l, int n, double *out);        /* n of them, behind a '<' that is still to come: of matrix */

/* A macro's argument, float or vector, and the ',' behind it, or before a ')': its terms; 0, nothing taken: another. */
int literal_argument(Lexer *l, double out[5]);

/* `{ rgb <a,b,c> }` behind `pigment`, `{ pigment { rgb <a,b,c> } }` behind `texture`, and the latter with `texture` still to come; rgbf,
 * rgbt, rgbft and a `color` before them too. */
bool literal_pigment(Lexer *l, Colour *out);
bool literal_texture_body(Lexer *l, Colour *out);
bool literal_texture(Lexer *l, Colour *out);

#endif
