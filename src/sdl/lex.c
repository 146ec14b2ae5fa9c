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

static const char others[] = "@\\`$%^~'";

void lex_start(Lexer *l, uint16_t source, Str text)
{
    if (!text.n)
        text = str_of("");                     /* no arithmetic on NULL */
    *l = (Lexer){ .at = text.data, .end = text.data + text.n, .line_start = text.data, .line = 1, .source = source };
    while (l->at < l->end && (*l->at & 0x80))  /* POV: not only the three bytes of the mark */
        l->at++;
}

/* ---- long files ---- */

/* A token that begins has this much text before it, or all there is: none is longer, but for numbers without end. */
enum { TOKEN_ROOM = 1 << 13 };

/* Moves the window, if there is more to come. The line goes along from its beginning, or as far as columns count. */
static bool more(Lexer *l)
{
    FileFeed *f = l->feed;
    if (f == NULL)
        return false;
    size_t at = (size_t)(l->at - f->data), line = (size_t)(l->line_start - f->data);
    if (at - line > UINT16_MAX)
        line = at - UINT16_MAX;
    if (!file_feed_more(f, line))
        return false;
    l->at = f->data + (at - line);
    l->line_start = f->data;
    l->end = f->data + f->n;
    return true;
}

uint64_t lex_base(const Lexer *l)
{
    return l->feed != NULL ? l->feed->offset : 0;
}

void lex_resume(Lexer *l, uint64_t base)
{
    FileFeed *f = l->feed;
    if (f == NULL)
        return;
    uint64_t at = base + (uint64_t)(l->at - f->data), line = base + (uint64_t)(l->line_start - f->data);
    if (line < f->offset)
        file_feed_seek(f, line);
    l->at = f->data + (at - f->offset);
    l->line_start = f->data + (line - f->offset);
    l->end = f->data + f->n;
}

/* ---- places ---- */

Loc lex_loc(const Lexer *l)
{
    ptrdiff_t column = l->at - l->line_start + 1;
    return (Loc){ l->line, l->source, (uint16_t)(column > UINT16_MAX ? UINT16_MAX : column) };
}

static const char *back_over_blanks(const char *start, const char *s, uint32_t *line)
{
    while (s > start && (unsigned char)s[-1] <= ' ') {
        s--;
        *line -= *s == '\n' && *line > 1;
    }
    return s;
}

/* The end of a file is told as the end of its last line with something on it: there is something to point at. */
static Loc end_loc(Parser *p, const Lexer *l)
{
    uint32_t line = l->line;
    const char *start = l->feed != NULL ? l->feed->data : diag_source_text(p->diag, l->source).data;
    const char *s = back_over_blanks(start, l->end, &line);
    if (s == start && lex_base(l) > 0) {       /* a whole window of blank lines */
        Str whole = diag_source_text(p->diag, l->source);
        start = whole.data;
        s = back_over_blanks(start, start + (lex_base(l) < whole.n ? lex_base(l) : whole.n), &line);
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
        if (l->end - s < 2) {
            l->at = s;
            if (!more(l))
                fail(p->diag, start, "No */ closing comment found.");
            s = l->at;
        } else if (s[0] == '*' && s[1] == '/') {
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
        bool cut = class == C_LINE && s + 1 == l->end && l->feed != NULL && !file_feed_is_whole(l->feed);      /* CR | LF */
        if (class == C_LINE && !cut)
            s = line_end(l, s);
        else if (class == C_BLANK && s < l->end)
            s++;
        else
            return s;
    }
}

/* At `//`. */
static void line_comment(Lexer *l)
{
    do {
        const char *lf = memchr(l->at, '\n', (size_t)(l->end - l->at));
        const char *stop = lf ? lf : l->end;
        const char *cr = memchr(l->at, '\r', (size_t)(stop - l->at));
        l->at = cr ? cr : stop;
    } while (l->at == l->end && more(l));
}

static bool comment(Parser *p, Lexer *l)
{
    if (l->at[1] == '/')
        line_comment(l);
    else if (l->at[1] == '*')
        block_comment(p, l);
    else
        return false;
    return true;
}

/* Behind it there is room for a token. */
static inline void skip_blank(Parser *p, Lexer *l)
{
    do {
        l->at = lex_blank(l, l->at);
        while (*l->at == '/' && comment(p, l))
            l->at = lex_blank(l, l->at);
    } while (l->feed != NULL && l->end - l->at < TOKEN_ROOM && more(l));
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
    out->n = (uint32_t)(s - start);
    out->text = l->feed == NULL ? start : arena_copy(p->arena, start, out->n);
    l->at = s + 1;
}

static void number(Parser *p, Lexer *l, Token *out)
{
    out->kind = TOK_NUMBER;
    const char *start = l->at;
    l->at = number_scan(start, l->end, &out->number);
    if (l->at == l->end && l->feed != NULL && !file_feed_is_whole(l->feed))
        fail(p->diag, out->loc, "a number of more than %d characters in a long file", TOKEN_ROOM);
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
            out->text = out->kind == TOK_OTHER ? strchr(others, c) : NULL;
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
