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

/* Mostly there is none or one. By branches, which can be foreseen as files are regular: a place that is computed from what
 * stands there makes every character wait for the one before. */
static inline const char *lex_blank(Lexer *l, const char *s)
{
    if ((unsigned char)*s > ' ')
        return s;
    return *s == ' ' && (unsigned char)s[1] > ' ' ? s + 1 : lex_blanks(l, s);
}

/* This mark; blanks before it go in any case. */
static inline bool lex_mark(Lexer *l, char c)
{
    l->at = lex_blank(l, l->at);
    if (*l->at != c)
        return false;
    l->at++;
    return true;
}

#endif
