/* directive.c - #declare and the other directives that are not flow of control (01-language, sections 12 to 16). */
#include <math.h>
#include <string.h>

#include "sdl/parser.h"

/* -- Values -- */

static void take_number(Parser *p, Value *out, const Num *n, bool was)
{
    value_set_number(p, out, n);
    p->suspended = was;
}

/* At a declared name. */
static bool name_value(Parser *p, Value *out, bool suspended)
{
    Value *v = p->value;
    if (v->kind == VALUE_FUNCTION || v->kind == VALUE_SPLINE) {
        Token name = p->token;
        p->have = false;
        bool called = cursor_raw_at(p, TOK_LPAREN, '(');
        if (!called) {
            value_copy(p, out, v);
            return false;
        }
        p->token = name;
        p->have = true;
    } else if (v->kind != VALUE_NUMBER) {
        p->have = false;
        value_copy(p, out, v);
        return false;
    }
    Num n;
    bool was = p->suspended;
    p->suspended = suspended;
    if (p->version < 350 && v->kind == VALUE_NUMBER && v->terms == 5)
        colour_parse(p, &n, false);
    else
        expr_sum(p, &n);
    take_number(p, out, &n, was);
    return true;
}

bool value_parse(Parser *p, Value *out, bool suspended)
{
    int kind = parse_peek(p);
    Num n;
    switch (kind) {
    case KW_ARRAY: array_parse(p, out); return false;
    case KW_SPLINE: spline_parse(p, out); return false;
    case KW_FUNCTION:
        *out = (Value){ .kind = VALUE_FUNCTION, .function = function_declaration(p) };
        return false;
    case TOK_NAME:
        if (!p->value || p->value->kind == VALUE_NONE) {
            Str near = symbol_nearest(p, p->token.sym);
            fail(p->diag, p->token.loc, "Cannot assign uninitialized identifier.%s%.*s%s", near.n ? " (did you mean '" : "",
                 STR_ARGS(near), near.n ? "'?)" : "");
        }
        if (p->value->kind != VALUE_STRING)
            return name_value(p, out, suspended);
        break;
    default:
        break;
    }
    if (kind_starts_string(p)) {
        value_set_string(p, out, string_expression(p, false));
        return false;
    }
    if (kind_starts_number(p)) {
        bool was = p->suspended;
        p->suspended = suspended;
        if (kind_starts_colour(p))
            colour_parse(p, &n, false);
        else
            expr_sum(p, &n);
        take_number(p, out, &n, was);
        return true;
    }
    BlockKind block = BLOCK_NONE;
    const void *pointer = block_parse(p, &block);
    if (block == BLOCK_NONE)
        parse_expected(p, "RValue to declare");
    *out = (Value){ .kind = VALUE_BLOCK, .block = (uint8_t)block, .pointer = pointer };
    return false;
}

/* -- #declare and #local -- */

/* [deprecated [once] ["message"]]: the name that follows is read into t. */
static bool deprecation(Parser *p, Token *t, bool *once, Str *message)
{
    if (t->kind != KW_DEPRECATED)
        return false;
    cursor_raw(p, t);
    *once = t->kind == KW_ONCE;
    if (*once)
        cursor_raw(p, t);
    if (t->kind == TOK_STRING) {
        *message = str_copy(p->arena, string_decode(p, (Str){ t->text, t->n }, t->loc, false));
        cursor_raw(p, t);
    }
    return true;
}

static _Noreturn void not_a_new_name(Parser *p, const Token *t, Value *v)
{
    p->token = *t;
    p->value = v;
    p->have = true;
    p->suspended = true;                       /* '#' is told, not obeyed */
    parse_expected(p, "undeclared identifier");
}

/* A value of numbers ends with a semicolon; others may. */
static void end_of_value(Parser *p, bool number, uint32_t n_readers)
{
    if (!number) {
        /* The value was the last of a macro whose branches are still open: they end before a semicolon can come. */
        if (p->n_readers > n_readers)
            parse_accept(p, TOK_SEMICOLON);
        else
            cursor_raw_accept(p, TOK_SEMICOLON, ';');
        return;
    }
    p->suspended = true;
    if (parse_accept(p, TOK_SEMICOLON)) {
        cursor_raw_accept(p, TOK_SEMICOLON, ';');
    } else if (p->version >= 350) {
        static const char text[] = "All #declares of float, vector, and color require semi-colon ';' at end";
        if (p->options->strict)
            fail(p->diag, p->token.loc, "%s: %s found instead", text, token_description(p));
        warn_once(p->diag, p->token.loc, "%s: supplied.", text);
    }
    p->suspended = false;
}

static void declare(Parser *p, bool local)
{
    uint32_t table = p->n_tables - 1, n_readers = p->n_readers;
    Token name;
    bool once = false, deprecated;
    Str message = { 0 };
    cursor_raw(p, &name);
    deprecated = deprecation(p, &name, &once, &message);
    Value *old = name.kind == TOK_NAME ? symbol_value(name.sym) : NULL;
    if (name.kind != TOK_NAME || (old && old->kind == VALUE_MACRO))
        not_a_new_name(p, &name, old);
    Value *item = NULL;
    ValueArray *array = NULL;
    if (old && old->kind == VALUE_ARRAY && cursor_raw_at(p, TOK_LBRACKET, '['))
        item = array_target(p, old, &array);
    parse_expect(p, TOK_EQUAL);
    Value value = { 0 };
    bool number = value_parse(p, &value, true);
    if (item) {
        array_check_type(p, array, &value, name.loc);
        value_move(p, item, &value);
    } else {
        if (old && old->kind == VALUE_FUNCTION && (!local || name.sym->binding->table == table))
            fail(p->diag, name.loc, "Redeclaring functions is not allowed - #undef the function first!");
        if (table >= p->n_tables)              /* the value came from behind the macro that began the statement */
            table = p->n_tables - 1;
        Binding *b = symbol_declare(p, name.sym, local, table);
        Value *target = b->value;
        if (target->kind == VALUE_NUMBER && value.kind == VALUE_NUMBER)
            *target = value;
        else
            value_move(p, target, &value);
        if (deprecated) {
            b->deprecated = true;
            b->deprecated_once = once;
            b->message = message.n ? message : str_format(p->arena, "Identifier '%.*s' was declared deprecated.",
                                                          STR_ARGS(name.sym->text));
        }
    }
    end_of_value(p, number, n_readers);
}

static void undef(Parser *p)
{
    Token name;
    cursor_raw(p, &name);
    Value *v = name.kind == TOK_NAME ? symbol_value(name.sym) : NULL;
    if (name.kind != TOK_NAME)
        not_a_new_name(p, &name, NULL);
    if (!v || v->kind == VALUE_NONE)
        warn(p->diag, name.loc, "Attempt to undef unknown identifier");
    else if (v->kind == VALUE_ARRAY && cursor_raw_at(p, TOK_LBRACKET, '['))
        value_clear(p, array_subscript(p, v));
    else
        symbol_undef(p, name.sym);
    cursor_raw_accept(p, TOK_SEMICOLON, ';');
}

/* -- Messages -- */

/* Cut as the reference cuts: the first `kept` bytes and three dots. */
static Str shortened(Parser *p, Str s, uint32_t longest, uint32_t kept)
{
    return s.n > longest ? str_format(&p->temp, "%.*s...", (int)kept, s.data) : s;
}

/* The console shows ASCII. */
static Str console_text(Parser *p, Str s)
{
    char *data = arena_alloc(&p->temp, s.n + 1u);
    uint32_t n = 0;
    for (uint32_t i = 0; i < s.n; i++)
        if (!(s.data[i] & 0x80) || ((unsigned char)s.data[i] & 0xc0) == 0xc0)
            data[n++] = s.data[i] & 0x80 ? ' ' : s.data[i];
    return (Str){ data, n };
}

/* Text of #debug is shown line by line; what has no end yet waits. */
static void debug_text(Parser *p, Str s)
{
    s = shortened(p, console_text(p, s), 200, 156);
    for (uint32_t i = 0; i < s.n; i++) {
        p->debug_text[p->debug_n++] = s.data[i];
        if (s.data[i] == '\n' || p->debug_n == sizeof p->debug_text) {
            say(p->diag, DIAG_DEBUG, (Str){ p->debug_text, p->debug_n });
            p->debug_n = 0;
        }
    }
}

void directive_flush_debug(Parser *p)
{
    if (p->debug_n)
        debug_text(p, str_of("\n"));
}

/* Line ends inside a message become blanks, as each message is one line. */
static Str one_line(Parser *p, Str s)
{
    char *data = arena_copy(&p->temp, s.data, s.n);
    for (uint32_t i = 0; i < s.n; i++)
        if ((unsigned char)data[i] < ' ')
            data[i] = ' ';
    while (s.n && data[s.n - 1] == ' ')
        s.n--;
    return (Str){ data, s.n };
}

static void message(Parser *p, const Token *t)
{
    Str s = string_expression(p, false);
    switch (t->directive) {
    case KW_WARNING:
        warn(p->diag, t->loc, "%.*s", STR_ARGS(shortened(p, one_line(p, console_text(p, s)), 160, 124)));
        break;
    case KW_ERROR:
        fail(p->diag, t->loc, "Parse halted by #error directive: %.*s",
             STR_ARGS(shortened(p, one_line(p, console_text(p, s)), 160, 124)));
    case KW_RENDER: case KW_STATISTICS:
        warn_once(p->diag, t->loc,
                  "#render and #statistics streams are no longer available. Redirecting output to #debug stream.");
        debug_text(p, s);
        break;
    default:
        debug_text(p, s);
    }
}

/* -- #version -- */

static void version(Parser *p)
{
    p->suspended = true;
    if (parse_peek(p) == TOK_NAME && str_is(p->token.sym->text, "unofficial"))
        parse_skip(p);
    double v = expr_float(p);
    if (!(v >= 0 && v <= 99))
        fail(p->diag, cursor_loc(p), "%g is not a language version", v);
    int now = (int)(v * 100 + 0.5);
    if (now > 370)
        fail(p->diag, cursor_loc(p), "Your scene file requires POV-Ray version %g or later!", v);
    parse_accept(p, TOK_SEMICOLON);
    p->suspended = false;
    p->version = now;
    p->version_given = true;
    block_version(p);
}

static void include(Parser *p, Loc loc)
{
    parse_peek(p);
    if (!kind_starts_string(p))
        fail(p->diag, loc, "Expecting a string after INCLUDE.");
    Str name = string_expression(p, true);
    cursor_include(p, name, loc);
}

/* -- The switchboard -- */

static void run(Parser *p, const Token *t)
{
    if (flow_directive(p, t))
        return;
    switch (t->directive) {
    case KW_DECLARE: declare(p, false); break;
    case KW_LOCAL: declare(p, true); break;
    case KW_UNDEF: undef(p); break;
    case KW_MACRO: macro_define(p, t); break;
    case KW_INCLUDE: include(p, t->loc); break;
    case KW_VERSION: version(p); break;
    case KW_DEFAULT: block_default(p); break;
    case KW_DEBUG: case KW_WARNING: case KW_ERROR: case KW_RENDER: case KW_STATISTICS: message(p, t); break;
    case KW_FOPEN: file_fopen(p); break;
    case KW_FCLOSE: file_fclose(p); break;
    case KW_READ: file_read_directive(p); break;
    case KW_WRITE: file_write_directive(p); break;
    default: fail(p->diag, t->loc, "'#%.*s' is out of place", STR_ARGS(t->sym->text));
    }
}

/* Whatever a directive makes in temporary memory dies with it. */
void directive_run(Parser *p, const Token *t)
{
    if ((t->directive == KW_DECLARE || t->directive == KW_LOCAL) && fast_declare(p, t->directive == KW_LOCAL))
        return;
    if (t->directive == KW_END && flow_plain_end(p))
        return;
    ArenaMark mark = { p->temp.block, p->temp.next, p->temp.used };
    bool was = p->suspended;
    p->suspended = false;
    cursor_deeper(p);
    run(p, t);
    p->depth--;
    p->suspended = was;
    if (p->temp.used != mark.used)
        arena_rewind(&p->temp, mark);
}

/* At scene level `declare` and the like count without their '#'. */
bool parse_bare_directive(Parser *p)
{
    int kind = parse_peek(p);
    if (kind != KW_DECLARE && kind != KW_INCLUDE && kind != KW_VERSION && kind != KW_DEFAULT)
        return false;
    Token t = p->token;
    if (kind == KW_DECLARE || kind == KW_INCLUDE)
        parse_warn(p, "Should have '#' before '%.*s'.", STR_ARGS(t.sym->text));
    p->have = false;
    t.directive = (uint16_t)kind;
    directive_run(p, &t);
    return true;
}
