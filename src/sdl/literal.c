/* literal.c - see literal.h: numbers, vectors, arguments of macros, pigments and textures of one colour.
 *
 * A Lexer is changed in a copy, which is dropped when the attempt fails; the place is handed from step to step, NULL from where
 * something else stands. */
#include "sdl/literal.h"

#include <string.h>

#include "sdl/lex.h"
#include "sdl/number.h"

/* Ends an attempt: it has come to s, or failed. */
static inline bool keep(Lexer *lexer, Lexer *l, const char *s)
{
    if (s == NULL)
        return false;
    l->at = s;
    *lexer = *l;
    return true;
}

/* A number with a sign or none, and the blanks around it. */
static inline const char *number(Lexer *l, const char *s, double *out)
{
    s = lex_blank(l, s);
    bool negative = false;
    if (*s == '-') {
        negative = true;
        s++;
    }
    if (!is_digit(*s) && !(*s == '.' && is_digit(s[1])))
        return NULL;
    s = number_scan(s, l->end, out);
    if (negative)
        *out = -*out;
    return lex_blank(l, s);
}

/* n numbers with commas between them and a '>' behind the last. */
static const char *numbers(Lexer *l, const char *s, int n, double *out)
{
    for (int i = 0; i < n; i++) {
        s = number(l, s, &out[i]);
        if (s == NULL || *s != (i < n - 1 ? ',' : '>'))
            return NULL;
        s++;
    }
    return s;
}

/* Exactly this word, or exactly this mark, after blanks. */
static inline __attribute__((always_inline)) const char *word(Lexer *l, const char *s, const char *text)
{
    size_t n = strlen(text);
    s = lex_blank(l, s);
    return (size_t)(l->end - s) > n && memcmp(s, text, n) == 0 && !is_word_at(s + n) ? s + n : NULL;
}

static inline const char *mark(Lexer *l, const char *s, char c)
{
    s = lex_blank(l, s);
    return *s == c ? s + 1 : NULL;
}

static inline const char *comma(Lexer *l, const char *s)
{
    s = lex_blank(l, s);
    return *s == ',' ? lex_blank(l, s + 1) : s;
}

/* What may follow without going on with the expression. A letter may be a macro: not here. `<1,2,3> <4` compares only where a
 * full expression is asked for, and that never comes this way. */
static bool ends(const char *s)
{
    return *s == ',' || *s == '}' || *s == '<' || *s == ')';
}

bool literal_vector(Lexer *lexer, LiteralBefore before, double out[3])
{
    Lexer l = *lexer;
    const char *s = l.at;
    if (before != LITERAL_INSIDE) {
        s = before == LITERAL_COMMA ? comma(&l, s) : lex_blank(&l, s);
        if (*s++ != '<')
            return false;
    }
    s = numbers(&l, s, 3, out);
    if (s == NULL)
        return false;
    s = lex_blank(&l, s);
    if (!ends(s) && !is_digit(*s))
        return false;
    return keep(lexer, &l, s);
}

bool literal_number(Lexer *lexer, LiteralBefore before, double *out)
{
    Lexer l = *lexer;
    const char *s = number(&l, before == LITERAL_COMMA ? comma(&l, l.at) : l.at, out);
    if (s == NULL || !ends(s))
        return false;
    return keep(lexer, &l, s);
}

bool literal_numbers(Lexer *lexer, int n, double *out)
{
    Lexer l = *lexer;
    const char *s = mark(&l, l.at, '<');
    return s != NULL && keep(lexer, &l, numbers(&l, s, n, out));
}

int literal_argument(Lexer *lexer, double out[5])
{
    Lexer l = *lexer;
    const char *s = lex_blank(&l, l.at);
    int n = 0;
    if (*s != '<') {
        s = number(&l, s, &out[n++]);
    } else {
        s++;
        do
            s = number(&l, s, &out[n++]);
        while (s != NULL && n < 5 && *s == ',' && s++);
        s = s != NULL && n > 1 && *s == '>' ? lex_blank(&l, s + 1) : NULL;
    }
    if (s == NULL || (*s != ',' && *s != ')'))
        return 0;
    l.at = s + (*s == ',');
    *lexer = l;
    return n;
}

static const char *pigment(Lexer *l, const char *s, Colour *out)
{
    double v[5];
    s = mark(l, s, '{');
    if (s == NULL)
        return NULL;
    s = lex_blank(l, s);                       /* once: lines are counted */
    const char *behind = word(l, s, "color");
    if (behind != NULL)
        s = lex_blank(l, behind);
    if (s[0] != 'r' || s[1] != 'g' || s[2] != 'b')
        return NULL;
    s += 3;
    bool filter = *s == 'f';
    s += filter;
    bool transmit = *s == 't';
    s += transmit;
    if (is_word_at(s) || (s = mark(l, s, '<')) == NULL || (s = numbers(l, s, 3 + filter + transmit, v)) == NULL)
        return NULL;
    *out = (Colour){ (float)v[0], (float)v[1], (float)v[2], filter ? (float)v[3] : 0, transmit ? (float)v[3 + filter] : 0 };
    return mark(l, s, '}');
}

bool literal_pigment(Lexer *lexer, Colour *out)
{
    Lexer l = *lexer;
    const char *s = pigment(&l, l.at, out);
    return keep(lexer, &l, s);
}

static const char *texture_body(Lexer *l, const char *s, Colour *out)
{
    s = mark(l, s, '{');
    if (s == NULL || (s = word(l, s, "pigment")) == NULL || (s = pigment(l, s, out)) == NULL)
        return NULL;
    return mark(l, s, '}');
}

bool literal_texture_body(Lexer *lexer, Colour *out)
{
    Lexer l = *lexer;
    const char *s = texture_body(&l, l.at, out);
    return keep(lexer, &l, s);
}

bool literal_texture(Lexer *lexer, Colour *out)
{
    Lexer l = *lexer;
    const char *s = word(&l, l.at, "texture");
    return s != NULL && keep(lexer, &l, texture_body(&l, s, out));
}
