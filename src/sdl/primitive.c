/* primitive.c - the small things of parse.h that every grammar is made of. */
#include <stdio.h>
#include <string.h>

#include "sdl/parser.h"

Arena *parse_arena(Parser *p) { return p->arena; }
Diag *parse_diag(Parser *p) { return p->diag; }
int parse_version(const Parser *p) { return p->version; }

const struct World *parse_world_of(Parser *p, const Object *o, uint32_t *item)
{
    return p->host->world != NULL ? p->host->world(p->host->user, o, item) : NULL;
}

Loc parse_loc(Parser *p)
{
    cursor_look(p);
    return p->token.loc;
}

int parse_peek(Parser *p)
{
    cursor_look(p);
    return p->token.kind;
}

/* Nothing is taken: a macro that stands next must not run before what is being read is declared. */
int parse_peek_raw(Parser *p)
{
    Token t = p->token;
    if (p->have)
        return t.kind;
    Reader *r = cursor_top(p);
    if (!r->is_file)
        return r->at < r->n ? r->tokens[r->at].kind : TOK_END;
    Lexer ahead = r->lexer;
    uint64_t base = lex_base(&ahead);
    lex_next(p, &ahead, &t);
    lex_resume(&r->lexer, base);
    return t.kind;
}

void parse_skip(Parser *p)
{
    cursor_look(p);
    p->have = p->token.kind == TOK_END;        /* the end is never behind us */
}

bool parse_accept(Parser *p, int kind)
{
    static const char mark[TOK_OTHER + 1] = {
        [TOK_OPEN] = '{', [TOK_CLOSE] = '}', [TOK_LPAREN] = '(', [TOK_RPAREN] = ')', [TOK_LBRACKET] = '[', [TOK_RBRACKET] = ']',
        [TOK_COMMA] = ',', [TOK_SEMICOLON] = ';',
    };
    if (mark[kind] && cursor_take_mark(p, kind, mark[kind]))
        return true;
    cursor_look(p);
    if (p->token.kind != kind)
        return false;
    p->have = kind == TOK_END;
    return true;
}

const char *token_keyword_text(int kind)
{
    static const char *const mark[] = {
        [TOK_END - N_KEYWORDS] = "End of File", [TOK_NUMBER - N_KEYWORDS] = "numeric expression",
        [TOK_STRING - N_KEYWORDS] = "string literal", [TOK_NAME - N_KEYWORDS] = "identifier",
        [TOK_OPEN - N_KEYWORDS] = "{", [TOK_CLOSE - N_KEYWORDS] = "}", [TOK_LPAREN - N_KEYWORDS] = "(",
        [TOK_RPAREN - N_KEYWORDS] = ")", [TOK_LBRACKET - N_KEYWORDS] = "[", [TOK_RBRACKET - N_KEYWORDS] = "]",
        [TOK_LESS - N_KEYWORDS] = "<", [TOK_GREATER - N_KEYWORDS] = ">", [TOK_LESS_EQUAL - N_KEYWORDS] = "<=",
        [TOK_GREATER_EQUAL - N_KEYWORDS] = ">=", [TOK_NOT_EQUAL - N_KEYWORDS] = "!=", [TOK_EQUAL - N_KEYWORDS] = "=",
        [TOK_NOT - N_KEYWORDS] = "!", [TOK_AND - N_KEYWORDS] = "&", [TOK_OR - N_KEYWORDS] = "|",
        [TOK_PLUS - N_KEYWORDS] = "+", [TOK_MINUS - N_KEYWORDS] = "-", [TOK_STAR - N_KEYWORDS] = "*",
        [TOK_SLASH - N_KEYWORDS] = "/", [TOK_COMMA - N_KEYWORDS] = ", ", [TOK_SEMICOLON - N_KEYWORDS] = ";",
        [TOK_COLON - N_KEYWORDS] = ":", [TOK_QUESTION - N_KEYWORDS] = "?", [TOK_DOT - N_KEYWORDS] = ". (period)",
        [TOK_HASH - N_KEYWORDS] = "#",
    };
    static const struct { const char *text; int keyword; } word[] = {
#define KEYWORD(text, kw) { #text, kw },
#include "sdl/keyword.def"
#undef KEYWORD
    };
    for (size_t i = 0; kind < N_KEYWORDS && i < sizeof word / sizeof *word; i++)
        if (word[i].keyword == kind)
            return word[i].text;
    size_t i = (size_t)(kind - N_KEYWORDS);
    return i < sizeof mark / sizeof *mark && mark[i] ? mark[i] : "character";
}

/* 01-language, section 2: the only words that can start a numeric expression. */
const char *keyword_group(int keyword)
{
    switch (keyword) {
    case KW_ABS: case KW_ACOS: case KW_ACOSH: case KW_ASC: case KW_ASIN: case KW_ASINH: case KW_ATAN: case KW_ATAN2:
    case KW_ATANH: case KW_BITWISE_AND: case KW_BITWISE_OR: case KW_BITWISE_XOR: case KW_CEIL: case KW_COS: case KW_COSH:
    case KW_DEFINED: case KW_DEGREES: case KW_DIMENSION_SIZE: case KW_DIMENSIONS: case KW_DIV: case KW_EXP:
    case KW_FILE_EXISTS: case KW_FLOOR: case KW_INSIDE: case KW_INT: case KW_LN: case KW_LOG: case KW_MAX: case KW_MIN:
    case KW_MOD: case KW_POW: case KW_RADIANS: case KW_RAND: case KW_SEED: case KW_SELECT: case KW_SIN: case KW_SINH:
    case KW_SQRT: case KW_STRCMP: case KW_STRLEN: case KW_TAN: case KW_TANH: case KW_VAL: case KW_VDOT: case KW_VLENGTH:
    case KW_PI: case KW_TRUE: case KW_YES: case KW_ON: case KW_FALSE: case KW_NO: case KW_OFF: case KW_VERSION:
    case KW_CLOCK: case KW_CLOCK_ON: case KW_NOW:
        return "float function";
    case KW_X: case KW_Y: case KW_Z: case KW_T: case KW_U: case KW_V: case KW_VAXIS_ROTATE: case KW_VCROSS:
    case KW_VNORMALIZE: case KW_VROTATE: case KW_VTURBULENCE: case KW_TRACE: case KW_MIN_EXTENT: case KW_MAX_EXTENT:
        return "vector function";
    case KW_RGB: case KW_RGBF: case KW_RGBT: case KW_RGBFT: case KW_SRGB: case KW_SRGBF: case KW_SRGBT: case KW_SRGBFT:
    case KW_COLOR: case KW_RED: case KW_GREEN: case KW_BLUE: case KW_FILTER: case KW_TRANSMIT: case KW_GRAY: case KW_ALPHA:
        return "color keyword";
    default:
        return NULL;
    }
}

/* 01-language, section 33. */
const char *token_description(Parser *p)
{
    const Token *t = &p->token;
    const char *group = NULL;
    switch (t->kind) {
    case TOK_NUMBER: return "float function 'float constant'";
    case TOK_OTHER: return str_c(p->arena, (Str){ t->text, 1 });
    case TOK_NAME: break;
    case TOK_HASH: return "#";
    default:
        if (t->kind >= N_KEYWORDS)
            return token_keyword_text(t->kind);
        group = keyword_group(t->kind);
        return str_format(p->arena, group ? "%s '%.*s'" : "%s%.*s", group ? group : "", STR_ARGS(t->sym->text)).data;
    }
    Value *v = p->value;
    if (v && v->kind == VALUE_NUMBER)
        return str_format(p->arena, "%s '%s'", v->terms == 1 ? "float function" : v->terms == 5 ? "color keyword"
                          : "vector function", value_type_name(v)).data;
    if (v && v->kind != VALUE_NONE)
        return value_type_name(v);
    Str near = symbol_nearest(p, t->sym);
    Str text = str_format(p->arena, "undeclared identifier '%.*s'", STR_ARGS(t->sym->text));
    return near.n ? str_format(p->arena, "%s (did you mean '%.*s'?)", text.data, STR_ARGS(near)).data : text.data;
}

_Noreturn void parse_expected(Parser *p, const char *what)
{
    cursor_look(p);
    fail(p->diag, p->token.loc, "Expected '%s', %s found instead", what, token_description(p));
}

void parse_expect(Parser *p, int kind)
{
    if (!parse_accept(p, kind))
        parse_expected(p, token_keyword_text(kind));
}

static void brace_opened(Parser *p)
{
    if (++p->braces > MAX_BRACES)
        fail(p->diag, cursor_loc(p), "more than %d braces are open", MAX_BRACES);
}

void parse_open(Parser *p)
{
    parse_expect(p, TOK_OPEN);
    brace_opened(p);
}

void block_open(Parser *p, const char *word)
{
    if (!parse_accept(p, TOK_OPEN))
        parse_fail(p, "Missing { after '%s', %s found instead", word, token_description(p));
    brace_opened(p);
}

void parse_close(Parser *p)
{
    parse_expect(p, TOK_CLOSE);
    p->braces--;
}

void block_close(Parser *p, const char *word)
{
    if (!parse_accept(p, TOK_CLOSE))
        parse_fail(p, "No matching } in '%s', %s found instead", word, token_description(p));
    p->braces--;
}

void parse_comma(Parser *p)
{
    if (!cursor_take_mark(p, TOK_COMMA, ',') && !cursor_sees_no_word(p))
        parse_accept(p, TOK_COMMA);
}

bool parse_at_close(Parser *p)
{
    if (cursor_sees_no_word(p))
        return *cursor_top(p)->lexer.at == '}';
    return cursor_look(p) == TOK_CLOSE;
}

bool parse_at_number(Parser *p)
{
    cursor_look(p);
    return kind_starts_number(p);
}

/* The reader, if what comes next can be read straight from the characters of a file. */
static Reader *plain_text(Parser *p)
{
    Reader *r = cursor_top(p);
    return r->is_file && !p->have ? r : NULL;
}

double parse_float(Parser *p)
{
    Reader *r = plain_text(p);
    double v;
    return r != NULL && literal_number(&r->lexer, LITERAL_NOTHING, &v) ? v : expr_float(p);
}

double parse_next_float(Parser *p)
{
    Reader *r = plain_text(p);
    double v;
    if (r != NULL && literal_number(&r->lexer, LITERAL_COMMA, &v))
        return v;
    parse_comma(p);
    return expr_float(p);
}

double parse_optional_float(Parser *p, double otherwise)
{
    parse_comma(p);
    return parse_at_number(p) ? expr_float(p) : otherwise;
}

int parse_int(Parser *p)
{
    double v = parse_float(p);
    if (v != v)
        fail(p->diag, cursor_loc(p), "expected a whole number, found one that is not a number");
    return v >= 2147483647.0 ? 2147483647 : v <= -2147483648.0 ? -2147483647 - 1 : (int)v;
}

bool parse_bool(Parser *p)
{
    return fabs(expr_float(p)) > EPSILON;
}

bool parse_optional_bool(Parser *p, bool otherwise)
{
    return parse_at_number(p) ? parse_bool(p) : otherwise;
}

static Num vector(Parser *p, int terms, const char *name)
{
    Num n;
    expr_sum(p, &n);
    if (n.terms > terms)
        fail(p->diag, cursor_loc(p), "%s expected but %s expression found.", name,
             terms == 3 ? "color" : "vector or color");
    num_promote(&n, terms);
    return n;
}

Vec2 parse_vec2(Parser *p)
{
    Num n = vector(p, 2, "UV_Vector");
    return (Vec2){ n.v[0], n.v[1] };
}

Vec3 parse_vec3(Parser *p)
{
    Reader *r = cursor_top(p);
    double v[3];
    bool inside = p->have && p->token.kind == TOK_LESS;
    if (r->is_file && (inside || !p->have) && literal_vector(&r->lexer, inside ? LITERAL_INSIDE : LITERAL_NOTHING, v)) {
        p->have = false;
        return vec3(v[0], v[1], v[2]);
    }
    Num n = vector(p, 3, "Vector");
    return vec3(n.v[0], n.v[1], n.v[2]);
}

Vec3 parse_next_vec3(Parser *p)
{
    Reader *r = plain_text(p);
    double v[3];
    if (r != NULL && literal_vector(&r->lexer, LITERAL_COMMA, v))
        return vec3(v[0], v[1], v[2]);
    parse_comma(p);
    return parse_vec3(p);
}

Vec4 parse_vec4(Parser *p)
{
    Num n = vector(p, 4, "4d vector");
    return (Vec4){ n.v[0], n.v[1], n.v[2], n.v[3] };
}

int parse_terms(Parser *p, double out[5])
{
    Num n;
    expr_sum(p, &n);
    for (int i = 0; i < 5; i++)
        out[i] = i < n.terms ? n.v[i] : 0;
    return n.terms;
}

static Str string(Parser *p, bool file_name)
{
    ArenaMark mark = arena_mark(&p->temp);
    Str s = str_copy(p->arena, string_expression(p, file_name));
    arena_rewind(&p->temp, mark);
    return s;
}

Str parse_string(Parser *p)
{
    return string(p, false);
}

Str parse_file_name(Parser *p)
{
    return string(p, true);
}

BlockKind parse_peek_block(Parser *p)
{
    if (cursor_sees_no_word(p))
        return BLOCK_NONE;
    cursor_look(p);
    return p->token.kind == TOK_NAME && p->value && p->value->kind == VALUE_BLOCK ? (BlockKind)p->value->block : BLOCK_NONE;
}

const void *parse_take_block(Parser *p, BlockKind kind)
{
    if (parse_peek_block(p) != kind || kind == BLOCK_NONE)
        return NULL;
    p->have = false;
    return p->value->pointer;
}

bool parse_at_colour(Parser *p)
{
    cursor_look(p);
    return kind_starts_colour(p);
}

Str parse_read_file(Parser *p, Str name, Loc where)
{
    static const char *const none[] = { NULL };
    uint16_t source = 0;
    return file_find(p, name, none, where, true, &source, true);
}

bool parse_find_file(Parser *p, Str name, const char *const *extensions, Loc where, Str *out)
{
    *out = file_find(p, name, extensions, where, false, NULL, true);
    return out->data != NULL;
}

bool parse_is_strict(const Parser *p)
{
    return p->options->strict;
}

void parse_mend(Parser *p, const char *what)
{
    if (p->options->strict)
        parse_fail(p, "%s", what);
    warn_once(p->diag, parse_loc(p), "%s: read all the same.", what);
}

void parse_stray_comma(Parser *p)
{
    if (parse_accept(p, TOK_COMMA))
        parse_mend(p, "A comma that separates nothing");
}

void parse_due_comma(Parser *p)
{
    if (!parse_accept(p, TOK_COMMA))
        parse_mend(p, "A comma is missing");
}

bool parse_charset_is_ascii(const Parser *p)
{
    return p->charset == CHARSET_ASCII;
}

/* Where the last token read begins, like the reference: a mistake in a block's last argument is told at its brace. */
static Loc fail_loc(Parser *p)
{
    return cursor_loc(p);
}

void parse_fail(Parser *p, const char *format, ...)
{
    char text[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    fail(p->diag, fail_loc(p), "%s", text);
}

void parse_warn(Parser *p, const char *format, ...)
{
    char text[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    warn(p->diag, fail_loc(p), "%s", text);
}
