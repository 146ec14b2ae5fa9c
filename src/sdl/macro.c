/* macro.c - macros: bodies of tokens that are read in the place of the call (01-language, section 14). */
#include "sdl/parser.h"

static _Noreturn void not_expected(Parser *p, const Token *t, Value *value, const char *what)
{
    p->token = *t;
    p->value = value;
    p->have = true;
    p->suspended = true;                       /* '#' is told, not obeyed */
    parse_expected(p, what);
}

/* #macro NAME ( p1, p2 ... ) body #end; what `directive` says is the #macro itself, just read. */
void macro_define(Parser *p, const Token *directive)
{
    uint32_t at = cursor_here(p);
    Token name, t;
    if (p->version < 310)
        fail(p->diag, directive->loc, "Macros require a language version of at least 3.1.");
    cursor_raw(p, &name);
    Value *old = name.kind == TOK_NAME ? symbol_value(name.sym) : NULL;
    if (name.kind != TOK_NAME || (old && old->kind != VALUE_MACRO && old->kind != VALUE_NONE))
        not_expected(p, &name, old, "undeclared identifier");
    Macro m = { 0 };
    Sym *parameter[MAX_PARAMETERS];
    cursor_raw(p, &t);
    if (t.kind != TOK_LPAREN)
        not_expected(p, &t, NULL, "identifier or expression.");
    for (cursor_raw(p, &t); t.kind != TOK_RPAREN; cursor_raw(p, &t)) {
        if (t.kind == TOK_COMMA)
            continue;
        if (t.kind != TOK_NAME)
            not_expected(p, &t, NULL, "identifier or expression.");
        if (m.n_parameters == MAX_PARAMETERS)
            fail(p->diag, t.loc, "Too many parameters: a macro can have at most %d.", MAX_PARAMETERS);
        parameter[m.n_parameters++] = t.sym;
    }
    m.name = name.sym;
    m.loc = name.loc;
    m.token = cursor_body(p, directive, at, &m.first, &m.last);
    if (old && old->kind == VALUE_MACRO && old->macro->token == m.token && old->macro->first == m.first)
        return;                                /* the same once more, in a loop */
    m.parameter = arena_copy(p->arena, parameter, m.n_parameters * sizeof *parameter);
    Value *v = old ? old : symbol_bind(p, name.sym, 0)->value;
    value_clear(p, v);
    *v = (Value){ .kind = VALUE_MACRO, .macro = arena_copy(p->arena, &m, sizeof m) };
}

/* An identifier alone goes by reference, any other expression by value; functions always by value. */
static void argument(Parser *p, Binding *b)
{
    int kind = parse_peek(p);
    Value *v = p->value;
    if (kind != TOK_NAME) {
        value_parse(p, &b->own, false);
        return;
    }
    if (!v || v->kind == VALUE_NONE) {
        Str near = symbol_nearest(p, p->token.sym);
        fail(p->diag, p->token.loc, "Cannot pass uninitialized identifier as macro parameter. Initialize identifier first.%s%.*s%s",
             near.n ? " (did you mean '" : "", STR_ARGS(near), near.n ? "'?)" : "");
    }
    if (v->kind == VALUE_NUMBER) {
        Num n;
        num_from_value(&n, v);
        parse_skip(p);
        switch (parse_peek(p)) {
        case TOK_DOT: case TOK_PLUS: case TOK_MINUS: case TOK_STAR: case TOK_SLASH:
            expr_sum_rest(p, &n);
            value_set_number(p, &b->own, &n);
            break;
        default:
            b->value = v;
        }
    } else if (v->kind == VALUE_FUNCTION || v->kind == VALUE_SPLINE) {
        value_parse(p, &b->own, false);
    } else {
        parse_skip(p);
        b->value = v;
    }
}

/* The same for most arguments: literals in files, plain numbers and names in loops and macros. Takes the comma behind it, too. */
static bool plain_argument(Parser *p, Binding *b)
{
    Reader *r = cursor_top(p);
    Num n;
    if (p->have)
        return false;
    if (r->is_file)
        n.terms = literal_argument(&r->lexer, n.v);
    Value *by_reference = NULL;
    if (r->is_file ? n.terms == 0 : !fast_argument(p, &n, &by_reference))
        return false;
    if (by_reference)
        b->value = by_reference;
    else
        value_set_number(p, &b->own, &n);
    return true;
}

void macro_call(Parser *p, const Macro *m, Loc loc)
{
    bool was = p->suspended;
    p->suspended = false;
    cursor_stop_check(p);
    cursor_deeper(p);
    Binding *all[MAX_PARAMETERS];
    parse_expect(p, TOK_LPAREN);
    for (uint32_t i = 0; i < m->n_parameters; i++) {
        Binding *b = all[i] = binding_new(p);
        if (plain_argument(p, b))
            continue;
        if (parse_peek(p) == TOK_RPAREN)
            fail(p->diag, loc, "Expected %u parameters but only %u found.", m->n_parameters, i);
        argument(p, b);
        parse_comma(p);
    }
    parse_expect(p, TOK_RPAREN);
    symbol_push_table(p, loc);
    for (uint32_t i = 0; i < m->n_parameters; i++)
        binding_enter(p, all[i], m->parameter[i], p->n_tables - 1);
    cursor_enter_macro(p, m, loc);
    p->depth--;
    p->suspended = was;
}
