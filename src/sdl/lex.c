/* lex.c - from bytes to tokens, straight from the text of a file (01-language, section 1). */
#include <string.h>

#include "sdl/parser.h"

enum { C_ILLEGAL, C_BLANK, C_LINE, C_LETTER, C_DIGIT, C_QUOTE, C_SLASH, C_HASH, C_DOT, C_LESS, C_MARK };

#define L C_LETTER
#define D C_DIGIT
#define B C_BLANK
#define M C_MARK

static const unsigned char class_of[256] = {
    B, 0, 0, 0, 0, 0, 0, 0, 0, B, C_LINE, B, B, C_LINE, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, B, 0, 0, 0, 0, 0,
    B, M, C_QUOTE, C_HASH, M, M, M, M, M, M, M, M, M, M, C_DOT, C_SLASH, D, D, D, D, D, D, D, D, D, D, M, M, C_LESS, M, M, M,
    M, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, M, M, M, M, L,
    M, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, M, M, M, M, 0,
};

#undef L
#undef D
#undef B
#undef M

static const uint16_t mark_of[128] = {
    ['{'] = TOK_OPEN, ['}'] = TOK_CLOSE, ['('] = TOK_LPAREN, [')'] = TOK_RPAREN, ['['] = TOK_LBRACKET, [']'] = TOK_RBRACKET,
    ['='] = TOK_EQUAL, ['!'] = TOK_NOT, ['&'] = TOK_AND, ['|'] = TOK_OR, ['+'] = TOK_PLUS, ['-'] = TOK_MINUS,
    ['*'] = TOK_STAR, [','] = TOK_COMMA, [';'] = TOK_SEMICOLON, [':'] = TOK_COLON, ['?'] = TOK_QUESTION,
    ['>'] = TOK_GREATER, ['@'] = TOK_OTHER, ['\\'] = TOK_OTHER, ['`'] = TOK_OTHER, ['$'] = TOK_OTHER, ['%'] = TOK_OTHER,
    ['^'] = TOK_OTHER, ['~'] = TOK_OTHER, ['\''] = TOK_OTHER,
};

static inline unsigned char class_at(const char *s)
{
    return class_of[(unsigned char)*s];
}

void lex_start(Lexer *l, uint16_t source, Str text)
{
    if (!text.n)
        text = str_of("");                     /* no arithmetic on NULL */
    *l = (Lexer){ .at = text.data, .end = text.data + text.n, .line_start = text.data, .line = 1, .source = source };
    while (l->at < l->end && (*l->at & 0x80))  /* POV: not only the three bytes of the mark */
        l->at++;
}

Loc lex_loc(const Lexer *l)
{
    ptrdiff_t column = l->at - l->line_start + 1;
    return (Loc){ l->line, l->source, (uint16_t)(column > UINT16_MAX ? UINT16_MAX : column) };
}

/* The end of a file is told as the end of its last line with something on it: there is something to point at. */
static Loc end_loc(Parser *p, const Lexer *l)
{
    const char *start = diag_source_text(p->diag, l->source).data, *s = l->end;
    uint32_t line = l->line;
    while (s > start && (unsigned char)s[-1] <= ' ') {
        s--;
        line -= *s == '\n' && line > 1;
    }
    const char *from = s;
    while (from > start && from[-1] != '\n' && from[-1] != '\r')
        from--;
    ptrdiff_t column = s - from + 1;
    return (Loc){ line, l->source, (uint16_t)(column > UINT16_MAX ? UINT16_MAX : column) };
}

/* At CR or LF; CR LF and LF CR are one line end. */
static inline const char *line_end(Lexer *l, const char *s)
{
    char other = *s == '\n' ? '\r' : '\n';
    s++;
    if (s < l->end && *s == other)
        s++;
    l->line++;
    l->line_start = s;
    return s;
}

/* Comments nest. */
static void block_comment(Parser *p, Lexer *l)
{
    Loc start = lex_loc(l);
    const char *s = l->at + 2;
    unsigned open = 1;
    while (open) {
        if (l->end - s < 2)
            fail(p->diag, start, "No */ closing comment found.");
        if (s[0] == '*' && s[1] == '/') {
            s += 2;
            open--;
        } else if (s[0] == '/' && s[1] == '*') {
            s += 2;
            open++;
        } else if (*s == '\n' || *s == '\r') {
            s = line_end(l, s);
        } else {
            s++;
        }
    }
    l->at = s;
}

static void skip_blank(Parser *p, Lexer *l)
{
    const char *s = l->at, *end = l->end;
    while (s < end) {
        unsigned char c = class_at(s);
        if (c == C_BLANK) {
            s++;
        } else if (c == C_LINE) {
            s = line_end(l, s);
        } else if (c == C_SLASH && end - s > 1 && s[1] == '/') {
            const char *lf = memchr(s, '\n', (size_t)(end - s));
            const char *stop = lf ? lf : end;
            const char *cr = memchr(s, '\r', (size_t)(stop - s));
            s = cr ? cr : stop;
        } else if (c == C_SLASH && end - s > 1 && s[1] == '*') {
            l->at = s;
            block_comment(p, l);
            s = l->at;
        } else {
            break;
        }
    }
    l->at = s;
}

static void word(Parser *p, Lexer *l, Token *out)
{
    const char *s = l->at, *end = l->end;
    while (s < end && (class_at(s) == C_LETTER || class_at(s) == C_DIGIT))
        s++;
    size_t n = (size_t)(s - l->at);
    if (n > MAX_LITERAL)
        fail(p->diag, out->loc, "String too long.");
    out->sym = symbol_intern(p, l->at, n);
    out->kind = out->sym->keyword ? out->sym->keyword : TOK_NAME;
    l->at = s;
}

/* Between the quotes as written: escapes are decoded where the string is used, as file names have none. */
static void string(Parser *p, Lexer *l, Token *out)
{
    const char *s = l->at + 1, *start = s;
    for (;; s++) {
        if (s >= l->end)
            fail(p->diag, out->loc, "No end quote for string.");
        if (*s == '"')
            break;
        if (*s == '\\' && s + 1 < l->end) {
            s++;
            if (*s == '\n' || *s == '\r')
                fail(p->diag, out->loc, "Unterminated string literal.");
        } else if (*s == '\n' || *s == '\r') {
            s = line_end(l, s) - 1;
        }
        if (s - start > MAX_LITERAL)
            break;
    }
    if (s - start > MAX_LITERAL)
        fail(p->diag, out->loc, "String too long.");
    out->kind = TOK_STRING;
    out->text = start;
    out->n = (uint32_t)(s - start);
    l->at = s + 1;
}

static void number(Parser *p, Lexer *l, Token *out)
{
    out->kind = TOK_NUMBER;
    const char *start = l->at;
    number_scan(&l->at, l->end, &out->number);
    if (l->at < l->end && *l->at == '.' && memchr(start, '.', (size_t)(l->at - start)))
        fail(p->diag, lex_loc(l), "Unexpected additional '.' in floating-point number");
}

/* '#' and a directive word are one token; '#' before anything else counts for nothing. */
static bool hash(Parser *p, Lexer *l, Token *out)
{
    l->at++;
    skip_blank(p, l);
    if (l->at >= l->end || class_at(l->at) != C_LETTER)
        return false;
    Token name = { .loc = lex_loc(l) };
    word(p, l, &name);
    if (name.sym->is_directive) {
        out->kind = TOK_HASH;
        out->directive = name.sym->keyword;
        out->n = 0;
        out->sym = name.sym;
    } else {
        *out = name;
    }
    return true;
}

void lex_next(Parser *p, Lexer *l, Token *out)
{
    for (;;) {
        unsigned char class = l->at < l->end ? class_at(l->at) : C_BLANK;
        if (class == C_BLANK || class == C_LINE || class == C_SLASH) {
            skip_blank(p, l);
            class = l->at < l->end ? class_at(l->at) : C_BLANK;
        }
        out->loc = lex_loc(l);
        if (l->at >= l->end) {
            out->loc = end_loc(p, l);
            out->kind = TOK_END;
            out->sym = NULL;
            return;
        }
        switch (class) {
        case C_LETTER: word(p, l, out); return;
        case C_DIGIT: number(p, l, out); return;
        case C_QUOTE: string(p, l, out); return;
        case C_HASH:
            if (hash(p, l, out))
                return;
            continue;
        case C_DOT:
            if (l->at + 1 < l->end && class_at(l->at + 1) == C_DIGIT) {
                number(p, l, out);
                return;
            }
            out->kind = TOK_DOT;
            l->at++;
            return;
        case C_SLASH:
            out->kind = TOK_SLASH;
            l->at++;
            return;
        case C_LESS:
        case C_MARK: {
            char c = *l->at++;
            bool equal = l->at < l->end && *l->at == '=';
            out->kind = c == '<' ? TOK_LESS : mark_of[(unsigned char)c];
            out->text = l->at - 1;
            if (equal && (c == '<' || c == '>' || c == '!')) {
                out->kind = c == '<' ? TOK_LESS_EQUAL : c == '>' ? TOK_GREATER_EQUAL : TOK_NOT_EQUAL;
                l->at++;
            }
            return;
        }
        default:
            fail(p->diag, out->loc, "Illegal character in input file, value is %02x.", (unsigned)(unsigned char)*l->at);
        }
    }
}

bool lex_accept(Parser *p, Lexer *l, char c)
{
    skip_blank(p, l);
    if (l->at >= l->end || *l->at != c)
        return false;
    l->at++;
    return true;
}

int lex_peek_char(Parser *p, Lexer *l)
{
    skip_blank(p, l);
    return l->at < l->end ? (unsigned char)*l->at : -1;
}

/* Blanks and line ends; a comment simply ends the fast path. */
static inline const char *fast_blank(Lexer *l, const char *s)
{
    while (s < l->end) {
        unsigned char c = class_at(s);
        if (c == C_BLANK)
            s++;
        else if (c == C_LINE)
            s = line_end(l, s);
        else
            break;
    }
    return s;
}

/* A literal with a sign or none, and the blanks behind it; NULL if there is none. */
static const char *fast_number(Lexer *l, const char *s, double *out)
{
    s = fast_blank(l, s);
    bool negative = s < l->end && *s == '-';
    s += negative;
    if (s >= l->end || !(class_at(s) == C_DIGIT || (*s == '.' && s + 1 < l->end && class_at(s + 1) == C_DIGIT)))
        return NULL;
    double v = 0;
    if (!number_scan(&s, l->end, &v))
        return NULL;
    *out = negative ? -v : v;
    return fast_blank(l, s);
}

/* n literals with commas between them and a '>' behind the last. */
static bool fast_numbers(Lexer *l, const char **at, int n, double *out)
{
    const char *s = *at;
    for (int i = 0; i < n; i++) {
        s = fast_number(l, s, &out[i]);
        if (s == NULL)
            return false;
        if (s >= l->end || *s != (i < n - 1 ? ',' : '>'))
            return false;
        s++;
    }
    *at = s;
    return true;
}

/* Exactly this word, or exactly this mark, after blanks; NULL if something else comes. */
static const char *fast_word(Lexer *l, const char *s, const char *word, size_t n)
{
    s = fast_blank(l, s);
    if ((size_t)(l->end - s) <= n || memcmp(s, word, n) != 0 || class_at(s + n) == C_LETTER || class_at(s + n) == C_DIGIT)
        return NULL;
    return s + n;
}

static const char *fast_mark(Lexer *l, const char *s, char mark)
{
    s = fast_blank(l, s);
    return s < l->end && *s == mark ? s + 1 : NULL;
}

/* Behind `rgb`, `rgbf`, `rgbt` or `rgbft`, with a `color` before it or not. */
static const char *fast_rgb(Lexer *l, const char *s, bool *filter, bool *transmit)
{
    s = fast_blank(l, s);                      /* once: lines are counted */
    const char *color = fast_word(l, s, "color", 5);
    s = color ? fast_blank(l, color) : s;
    if (l->end - s < 6 || memcmp(s, "rgb", 3) != 0)
        return NULL;
    s += 3;
    *filter = *s == 'f';
    s += *filter;
    *transmit = *s == 't';
    s += *transmit;
    return class_at(s) == C_LETTER || class_at(s) == C_DIGIT ? NULL : s;
}

static const char *fast_comma(Lexer *l, const char *s)
{
    s = fast_blank(l, s);
    return s < l->end && *s == ',' ? fast_blank(l, s + 1) : s;
}

/* What may follow without going on with the expression. A letter may be a macro: not here. `<1,2,3> <4` compares only where a
 * full expression is asked for, and that never comes this way. */
static bool fast_end(Lexer *l, const char *s)
{
    return s < l->end && (*s == ',' || *s == '}' || *s == '<' || *s == ')');
}

bool lex_vector_literal(Lexer *lexer, LexBefore before, double out[3])
{
    Lexer l = *lexer;                          /* given up without a trace when anything is unusual */
    const char *s = l.at;
    if (before != LEX_INSIDE) {
        s = before == LEX_COMMA ? fast_comma(&l, s) : fast_blank(&l, s);
        if (s >= l.end || *s != '<')
            return false;
        s++;
    }
    if (!fast_numbers(&l, &s, 3, out))
        return false;
    s = fast_blank(&l, s);
    if (!fast_end(&l, s) && !(s < l.end && class_at(s) == C_DIGIT))
        return false;
    l.at = s;
    *lexer = l;
    return true;
}

bool lex_number_literal(Lexer *lexer, LexBefore before, double *out)
{
    Lexer l = *lexer;
    const char *s = before == LEX_COMMA ? fast_comma(&l, l.at) : l.at;
    s = fast_number(&l, s, out);
    if (s == NULL || !fast_end(&l, s))
        return false;
    l.at = s;
    *lexer = l;
    return true;
}

bool lex_numbers_literal(Lexer *lexer, int n, double *out)
{
    Lexer l = *lexer;
    const char *s = fast_mark(&l, l.at, '<');
    if (!s || !fast_numbers(&l, &s, n, out))
        return false;
    l.at = s;
    *lexer = l;
    return true;
}

bool lex_texture_literal(Lexer *lexer, Colour *out)
{
    Lexer l = *lexer;
    const char *s = fast_word(&l, l.at, "texture", 7);
    if (!s)
        return false;
    l.at = s;
    if (!lex_pigment_literal(&l, true, out))
        return false;
    *lexer = l;
    return true;
}

int lex_argument_literal(Lexer *lexer, double out[5])
{
    Lexer l = *lexer;
    const char *s = fast_blank(&l, l.at);
    int n = 0;
    if (s >= l.end)
        return 0;
    if (*s != '<') {
        s = fast_number(&l, s, &out[n++]);
    } else {
        s++;
        do
            s = fast_number(&l, s, &out[n++]);
        while (s != NULL && n < 5 && s < l.end && *s == ',' && s++);
        s = s != NULL && n > 1 ? fast_mark(&l, s, '>') : NULL;
    }
    s = s != NULL ? fast_blank(&l, s) : NULL;
    if (s == NULL || s >= l.end || (*s != ',' && *s != ')'))
        return 0;
    l.at = s + (*s == ',');
    *lexer = l;
    return n;
}

bool lex_pigment_literal(Lexer *lexer, bool texture, Colour *out)
{
    Lexer l = *lexer;
    const char *s = fast_mark(&l, l.at, '{');
    bool filter, transmit;
    double v[5];
    if (s && texture && (s = fast_word(&l, s, "pigment", 7)))
        s = fast_mark(&l, s, '{');
    if (!s || !(s = fast_rgb(&l, s, &filter, &transmit)) || !(s = fast_mark(&l, s, '<'))
        || !fast_numbers(&l, &s, 3 + filter + transmit, v) || !(s = fast_mark(&l, s, '}')))
        return false;
    if (texture && !(s = fast_mark(&l, s, '}')))
        return false;
    *out = (Colour){ (float)v[0], (float)v[1], (float)v[2], filter ? (float)v[3] : 0, transmit ? (float)v[3 + filter] : 0 };
    l.at = s;
    *lexer = l;
    return true;
}
