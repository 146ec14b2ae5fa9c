/* lex.h - classes of characters and the blanks between tokens, for those who look at them.
 *
 * Behind every text stands a zero (host.h), so that a character may be looked at without asking whether there is one. */
#ifndef SDL_LEX_H
#define SDL_LEX_H

#include "sdl/token.h"

typedef enum CharClass {                       /* LETTER and DIGIT last: what words are made of */
    C_ILLEGAL, C_BLANK, C_LINE, C_QUOTE, C_SLASH, C_HASH, C_DOT, C_LESS, C_MARK, C_LETTER, C_DIGIT
} CharClass;

extern const unsigned char lex_class[256];

static inline unsigned char class_at(const char *s)
{
    return lex_class[(unsigned char)*s];
}

static inline bool is_word_at(const char *s)
{
    return class_at(s) >= C_LETTER;
}

/* Behind blanks and line ends, which are counted; a comment stops it. */
const char *lex_blanks(Lexer *l, const char *s);

static inline const char *lex_blank(Lexer *l, const char *s)
{
    s += *s == ' ';                            /* mostly there is none or one */
    return (unsigned char)*s > ' ' ? s : lex_blanks(l, s);
}

/* This mark; blanks before it go in any case. */
static inline bool lex_mark(Lexer *l, char c)
{
    const char *s = lex_blank(l, l->at);
    bool taken = *s == c;
    l->at = s + taken;
    return taken;
}

#endif
