/* lex.c - from bytes to tokens, straight from the text of a file (01-language, section 1). */
#include "sdl/lex.h"

#include <string.h>

#include "sdl/number.h"
#include "sdl/parser.h"

#define L C_LETTER
#define D C_DIGIT
#define B C_BLANK
#define M C_MARK

const unsigned char lex_class[256] = {
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
    if (*s == other)
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

const char *lex_blanks(Lexer *l, const char *s)
{
    for (;;) {
        unsigned char class = class_at(s);
        if (class == C_LINE)
            s = line_end(l, s);
        else if (class == C_BLANK && s < l->end)
            s++;
        else
            return s;
    }
}

/* Behind `//`. */
static const char *line_comment(const Lexer *l, const char *s)
{
    const char *lf = memchr(s, '\n', (size_t)(l->end - s));
    const char *stop = lf ? lf : l->end;
    const char *cr = memchr(s, '\r', (size_t)(stop - s));
    return cr ? cr : stop;
}

static inline void skip_blank(Parser *p, Lexer *l)
{
    l->at = lex_blank(l, l->at);
    while (*l->at == '/') {
        if (l->at[1] == '/')
            l->at = line_comment(l, l->at);
        else if (l->at[1] == '*')
            block_comment(p, l);
        else
            return;
        l->at = lex_blank(l, l->at);
    }
}

static void word(Parser *p, Lexer *l, Token *out)
{
    const char *s = l->at;
    while (is_word_at(s))
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
    l->at = number_scan(start, l->end, &out->number);
    if (*l->at == '.' && memchr(start, '.', (size_t)(l->at - start)))
        fail(p->diag, lex_loc(l), "Unexpected additional '.' in floating-point number");
}

/* '#' and a directive word are one token; '#' before anything else counts for nothing. */
static bool hash(Parser *p, Lexer *l, Token *out)
{
    l->at++;
    skip_blank(p, l);
    if (class_at(l->at) != C_LETTER)
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
        skip_blank(p, l);
        out->loc = lex_loc(l);
        switch (class_at(l->at)) {
        case C_BLANK:
            out->loc = end_loc(p, l);
            out->kind = TOK_END;
            out->sym = NULL;
            return;
        case C_LETTER: word(p, l, out); return;
        case C_DIGIT: number(p, l, out); return;
        case C_QUOTE: string(p, l, out); return;
        case C_HASH:
            if (hash(p, l, out))
                return;
            continue;
        case C_DOT:
            if (is_digit(l->at[1])) {
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
            bool equal = *l->at == '=';
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
    if (*l->at != c)
        return false;
    l->at++;
    return true;
}

int lex_peek_char(Parser *p, Lexer *l)
{
    skip_blank(p, l);
    return l->at < l->end ? (unsigned char)*l->at : -1;
}
