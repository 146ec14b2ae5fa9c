/* literal.c - see literal.h: numbers, vectors, arguments of macros, pigments and textures of one colour.
 *
 * The place is handed from step to step, NULL from where something else stands; then the lines that were counted on the way are not
 * counted. */
#include "sdl/literal.h"

#include <string.h>

#include "sdl/lex.h"
#include "sdl/number.h"

typedef struct Line { const char *start; uint32_t number; } Line;

static inline Line line_of(const Lexer *l)
{
    return (Line){ l->line_start, l->line };
}

/* Ends an attempt that began in that line: it has come to s, or failed. */
static inline bool keep(Lexer *l, Line line, const char *s)
{
    if (s == NULL) {
        l->line_start = line.start;
        l->line = line.number;
        return false;
    }
    l->at = s;
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

static const char *vector(Lexer *l, LiteralBefore before, double out[3])
{
    const char *s = l->at;
    if (before != LITERAL_INSIDE) {
        s = before == LITERAL_COMMA ? comma(l, s) : lex_blank(l, s);
        if (*s++ != '<')
            return NULL;
    }
    s = numbers(l, s, 3, out);
    if (s == NULL)
        return NULL;
    s = lex_blank(l, s);
    return ends(s) || is_digit(*s) ? s : NULL;
}

bool literal_vector(Lexer *l, LiteralBefore before, double out[3])
{
    Line line = line_of(l);
    return keep(l, line, vector(l, before, out));
}

bool literal_number(Lexer *l, LiteralBefore before, double *out)
{
    Line line = line_of(l);
    const char *s = number(l, before == LITERAL_COMMA ? comma(l, l->at) : l->at, out);
    return keep(l, line, s != NULL && ends(s) ? s : NULL);
}

bool literal_numbers(Lexer *l, int n, double *out)
{
    Line line = line_of(l);
    const char *s = mark(l, l->at, '<');
    return keep(l, line, s != NULL ? numbers(l, s, n, out) : NULL);
}

int literal_argument(Lexer *l, double out[5])
{
    Line line = line_of(l);
    const char *s = lex_blank(l, l->at);
    int n = 0;
    if (*s != '<') {
        s = number(l, s, &out[n++]);
    } else {
        s++;
        do
            s = number(l, s, &out[n++]);
        while (s != NULL && n < 5 && *s == ',' && s++);
        s = s != NULL && n > 1 && *s == '>' ? lex_blank(l, s + 1) : NULL;
    }
    if (s != NULL && *s == ',')
        s++;
    else if (s != NULL && *s != ')')
        s = NULL;
    return keep(l, line, s) ? n : 0;
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

bool literal_pigment(Lexer *l, Colour *out)
{
    Line line = line_of(l);
    return keep(l, line, pigment(l, l->at, out));
}

static const char *texture_body(Lexer *l, const char *s, Colour *out)
{
    s = mark(l, s, '{');
    if (s == NULL || (s = word(l, s, "pigment")) == NULL || (s = pigment(l, s, out)) == NULL)
        return NULL;
    return mark(l, s, '}');
}

bool literal_texture_body(Lexer *l, Colour *out)
{
    Line line = line_of(l);
    return keep(l, line, texture_body(l, l->at, out));
}

bool literal_texture(Lexer *l, Colour *out)
{
    Line line = line_of(l);
    const char *s = word(l, l->at, "texture");
    return keep(l, line, s != NULL ? texture_body(l, s, out) : NULL);
}
