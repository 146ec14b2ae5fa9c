/* flow.c - the directives that steer the cursor: conditionals, switches, loops (01-language, section 13). */
#include <math.h>

#include "sdl/parser.h"

/* -- Skipping -- */

/* In a file: lexes on to the directive that ends a skipped branch, a branch of this level or (levels further out) an #end.
 * An include that ends meanwhile hands over to the file that included it. */
static void skip_text(Parser *p, bool to_branch, uint32_t levels, Token *out)
{
    Loc start = cursor_loc(p);
    uint32_t nested = 0;
    for (;;) {
        Reader *r = cursor_top(p);
        lex_next(p, &r->lexer, out);
        if (out->kind == TOK_END) {
            if (p->n_readers == 1 || !p->reader[p->n_readers - 2].is_file)
                fail(p->diag, start, "End of file reached but #end expected.");
            cursor_end_reader(p);
        }
        if (out->kind != TOK_HASH)
            continue;
        if (cursor_opens(out->directive)) {
            nested++;
        } else if (out->directive == KW_END) {
            if (nested == 0 && levels == 0)
                return;
            if (nested)
                nested--;
            else
                levels--;
        } else if (nested == 0 && levels == 0 && to_branch && cursor_branches(out->directive)) {
            return;
        }
    }
}

/* To the next branch of the conditional on top, or its #end: returned, and taken. `from` is the directive of the
 * branch that is left, at_index its place if the reader is an array. */
static void skip_branch(Parser *p, uint32_t at_index, Token *out)
{
    Reader *r = cursor_top(p);
    if (r->is_file) {
        skip_text(p, true, 0, out);
        return;
    }
    uint32_t next = r->tokens[at_index].n;
    *out = r->tokens[next];
    r->at = next + 1;
}

/* The parentheses of the conditional on top have been read. They must end in the same text or array as they began: what
 * follows goes on with an index into it. */
static Conditional *settled(Parser *p)
{
    for (Reader *r = cursor_top(p); r->macro && r->at == r->n; r = cursor_top(p))
        cursor_end_reader(p);
    Conditional *c = &p->conditional[p->n_conditionals - 1];
    if (c->kind == COND_MACRO || p->n_readers - 1 != c->reader)
        fail(p->diag, c->loc, "the parentheses of a directive must end in the file or macro where they began");
    c->busy = false;
    return c;
}

static _Noreturn void mismatched(Parser *p, const Token *t)
{
    if (t->directive == KW_CASE || t->directive == KW_RANGE)
        fail(p->diag, t->loc, "Mis-matched '#case' or '#range'.");
    fail(p->diag, t->loc, "Mis-matched '#%s'.", token_keyword_text(t->directive));
}

/* -- #if, #ifdef, #ifndef, #switch -- */

static bool condition(Parser *p)
{
    Num n;
    bool plain;
    if (fast_condition(p, &plain))
        return plain;
    expr_condition(p, &n);
    return fabs(num_float(p, &n)) > EPSILON;
}

/* (X) or (A[i]): the word is not evaluated, and no macro of that name is called. */
bool flow_is_defined(Parser *p)
{
    bool was = p->suspended;
    p->suspended = true;
    parse_expect(p, TOK_LPAREN);
    Token t;
    cursor_raw(p, &t);
    bool defined = false;
    if (t.kind == TOK_NAME) {
        Value *v = symbol_value(t.sym);
        if (v && v->kind == VALUE_ARRAY && cursor_raw_at(p, TOK_LBRACKET, '['))
            v = array_subscript(p, v);
        defined = v && v->kind != VALUE_NONE;
    }
    parse_expect(p, TOK_RPAREN);
    p->suspended = was;
    return defined;
}

static bool test_of(Parser *p, int directive)
{
    if (directive == KW_IFDEF || directive == KW_IFNDEF)
        return flow_is_defined(p) == (directive == KW_IFDEF);
    return condition(p);
}

/* The test of an #if, #elseif or #while. */
static bool test(Parser *p, int directive)
{
    p->conditional[p->n_conditionals - 1].busy = true;
    bool holds = test_of(p, directive);
    settled(p);
    return holds;
}

/* `at` is the place of the directive whose test has failed; goes on to the branch that runs, or behind the #end. */
static void choose_branch(Parser *p, uint32_t at)
{
    Token t;
    for (;;) {
        uint32_t conditionals = p->n_conditionals;
        skip_branch(p, at, &t);
        Conditional *c = &p->conditional[conditionals - 1];
        if (t.directive == KW_END) {
            p->n_conditionals--;
            return;
        }
        at = cursor_here(p);
        if (c->was_else || t.directive == KW_CASE || t.directive == KW_RANGE)
            mismatched(p, &t);
        c->was_else = t.directive == KW_ELSE;
        if (t.directive == KW_ELSE || test(p, KW_IF))
            return;
    }
}

static void run_if(Parser *p, const Token *t)
{
    uint32_t at = cursor_here(p);
    cursor_push_conditional(p, COND_IF, t->loc);
    if (!test(p, t->directive))
        choose_branch(p, at);
}

static void skip_to_end(Parser *p, uint32_t at)
{
    Reader *r = cursor_top(p);
    Token t;
    if (r->is_file)
        skip_text(p, false, 0, &t);
    else
        r->at = cursor_end_of(r->tokens, at) + 1;
    p->n_conditionals--;
}

/* Whether the #case or #range just read fits; its parentheses are taken. */
static bool case_fits(Parser *p, int directive, double value)
{
    bool was = p->suspended;
    p->conditional[p->n_conditionals - 1].busy = true;
    p->suspended = true;
    parse_expect(p, TOK_LPAREN);
    double low = expr_full_float(p), high = low;
    if (directive == KW_RANGE) {
        parse_comma(p);
        high = expr_full_float(p);
    }
    parse_expect(p, TOK_RPAREN);
    p->suspended = was;
    settled(p);
    return directive == KW_RANGE ? low <= value && value <= high : fabs(value - low) <= EPSILON;
}

/* From the branch just read on: to the first that fits, or behind the #end. */
static void choose_case(Parser *p, Token t, uint32_t at)
{
    for (;;) {
        if (t.directive == KW_END) {
            p->n_conditionals--;
            return;
        }
        if (t.directive == KW_ELSEIF)
            mismatched(p, &t);
        if (t.directive == KW_ELSE || case_fits(p, t.directive, p->conditional[p->n_conditionals - 1].end))
            return;
        skip_branch(p, at, &t);
        at = cursor_here(p);
    }
}

/* Directives before the first #case run; anything else there is an error. */
static void run_switch(Parser *p, const Token *t)
{
    Num value;
    cursor_push_conditional(p, COND_SWITCH, t->loc);
    expr_condition(p, &value);
    settled(p)->end = num_float(p, &value);
    for (;;) {
        Token next;
        if (p->have) {
            next = p->token;
            p->have = false;
        } else {
            cursor_raw(p, &next);
        }
        if (next.kind != TOK_HASH)
            fail(p->diag, next.loc, "#switch not followed by #case or #range.");
        if (next.directive == KW_CASE || next.directive == KW_RANGE) {
            settled(p);
            choose_case(p, next, cursor_here(p));
            return;
        }
        if (next.directive == KW_END || next.directive == KW_ELSE || next.directive == KW_ELSEIF)
            fail(p->diag, next.loc, "#switch not followed by #case or #range.");
        directive_run(p, &next);
    }
}

/* Does the conditional on top belong to what is being read? An #if may begin in a file and end in one it includes. */
static Conditional *innermost(Parser *p)
{
    if (!p->n_conditionals || p->conditional[p->n_conditionals - 1].busy)
        return NULL;
    Conditional *c = &p->conditional[p->n_conditionals - 1];
    for (uint32_t i = c->reader; c->kind == COND_IF && i < p->n_readers; i++)
        if (!p->reader[i].is_file && i != p->n_readers - 1)
            return NULL;
    return c->reader == p->n_readers - 1 || (c->kind == COND_IF && cursor_top(p)->is_file) ? c : NULL;
}

/* A branch ends where the next begins: #else, #elseif, #case, #range while something runs. */
static void run_branch(Parser *p, const Token *t)
{
    uint32_t at = cursor_here(p);
    Conditional *c = innermost(p);
    if (!c || (c->kind != COND_IF && c->kind != COND_SWITCH))
        mismatched(p, t);
    if (c->kind == COND_SWITCH) {              /* no #break: falls through */
        if (t->directive == KW_CASE || t->directive == KW_RANGE)
            case_fits(p, t->directive, c->end);
        return;
    }
    if (t->directive == KW_CASE || t->directive == KW_RANGE || c->was_else)
        mismatched(p, t);
    skip_to_end(p, at);
}

/* -- Loops -- */

/* A loop in a file moves into an array: its tokens are read there again from the directive on. */
static uint32_t loop_start(Parser *p, const Token *t)
{
    Reader *r = cursor_top(p);
    if (r->is_file) {
        const Capture *c = cursor_capture(p, &r->lexer, t);
        r->lexer = c->after;
        const Token *token = c->token;
        uint32_t n = c->n;
        r = cursor_push_reader(p, t->loc);
        r->tokens = token;
        r->n = n;
        r->at = 1;
    }
    return r->at - 1;
}

static void end_loop(Parser *p, uint32_t start)
{
    Reader *r = cursor_top(p);
    r->at = cursor_end_of(r->tokens, start) + 1;
    p->n_conditionals--;
}

static void while_turn(Parser *p, uint32_t start)
{
    cursor_stop_check(p);
    cursor_top(p)->at = start + 1;
    if (!test(p, KW_WHILE))
        end_loop(p, start);
}

static void run_while(Parser *p, const Token *t)
{
    uint32_t start = loop_start(p, t);
    cursor_push_conditional(p, COND_WHILE, t->loc)->start = start;
    while_turn(p, start);
}

static void for_turn(Parser *p, Conditional *c, double value)
{
    cursor_stop_check(p);
    bool runs = c->step > 0 ? value <= c->end + EPSILON : value >= c->end - EPSILON;
    if (runs)
        cursor_top(p)->at = c->body;
    else
        end_loop(p, c->start);
}

static void run_for(Parser *p, const Token *t)
{
    uint32_t start = loop_start(p, t);
    cursor_push_conditional(p, COND_FOR, t->loc)->start = start;
    bool was = p->suspended;
    p->suspended = true;
    parse_expect(p, TOK_LPAREN);
    Token name;
    cursor_raw(p, &name);
    if (name.kind != TOK_NAME)
        fail(p->diag, name.loc, "expected the name of a variable after '#for ('");
    parse_comma(p);
    double from = expr_full_float(p);
    parse_comma(p);
    double end = expr_full_float(p), step = 1;
    parse_comma(p);
    if (parse_peek(p) != TOK_RPAREN)           /* POV: the comma before the step may stand or lack */
        step = expr_full_float(p);
    parse_expect(p, TOK_RPAREN);
    p->suspended = was;
    if (fabs(step) < EPSILON)
        fail(p->diag, t->loc, "#for loop increment must be non-zero.");
    Value *v = symbol_declare(p, name.sym, true, p->n_tables - 1)->value;
    if (v->kind == VALUE_MACRO || v->kind == VALUE_FUNCTION)
        fail(p->diag, name.loc, "the variable of #for is already a %s", value_type_name(v));
    value_set_number(p, v, &(Num){ { from }, 1 });
    Conditional *c = settled(p);
    c->variable = name.sym;
    c->end = end;
    c->step = step;
    c->body = cursor_top(p)->at;
    for_turn(p, c, from);
}

static void run_end(Parser *p, const Token *t)
{
    Conditional *c = innermost(p);
    if (!c || c->kind == COND_MACRO)
        mismatched(p, t);
    if (c->kind == COND_WHILE) {
        while_turn(p, c->start);
    } else if (c->kind == COND_FOR) {
        Value *v = symbol_value(c->variable);
        if (!v || v->kind != VALUE_NUMBER || v->terms != 1)
            fail(p->diag, t->loc, "the variable '%.*s' of #for is no longer a float", STR_ARGS(c->variable->text));
        v->v[0] += c->step;
        for_turn(p, c, v->v[0]);
    } else {
        p->n_conditionals--;
    }
}

/* Most #ends: of what is read now, with a plain condition if it is a #while. */
bool flow_plain_end(Parser *p)
{
    Conditional *c = p->n_conditionals ? &p->conditional[p->n_conditionals - 1] : NULL;
    if (c == NULL || c->busy || c->reader != p->n_readers - 1 || c->kind == COND_MACRO)
        return false;
    if (c->kind == COND_FOR) {
        Value *v = symbol_value(c->variable);
        if (!v || v->kind != VALUE_NUMBER || v->terms != 1)
            return false;
        v->v[0] += c->step;
        for_turn(p, c, v->v[0]);
    } else if (c->kind == COND_WHILE) {
        Reader *r = cursor_top(p);
        uint32_t here = r->at;
        bool again;
        cursor_stop_check(p);
        r->at = c->start + 1;
        if (!fast_condition(p, &again)) {
            r->at = here;
            return false;
        }
        if (!again)
            end_loop(p, c->start);
    } else {
        p->n_conditionals--;
    }
    return true;
}

/* Leaves the innermost loop or switch, or ends the macro. */
static void run_break(Parser *p, const Token *t)
{
    uint32_t i = p->n_conditionals;
    while (i > 0 && p->conditional[i - 1].kind == COND_IF && !p->conditional[i - 1].busy)
        i--;
    if (i == 0 || p->conditional[i - 1].busy)
        fail(p->diag, t->loc, "Invalid context for #break");
    Conditional *c = &p->conditional[i - 1];
    uint32_t nested = 0;                       /* conditionals to be left that are in the same reader */
    for (uint32_t k = i; k < p->n_conditionals; k++)
        nested += p->conditional[k].reader == c->reader;
    p->n_conditionals = i;
    while (p->n_readers - 1 > c->reader)
        cursor_end_reader(p);
    Reader *r = cursor_top(p);
    if (c->kind == COND_MACRO) {
        r->at = r->n;
    } else if (r->is_file) {
        Token end;
        p->n_conditionals--;
        skip_text(p, false, nested, &end);
    } else {
        /* Only a loop knows where it starts; a switch in an array is left by way of the #end that follows from here. */
        uint32_t depth = nested, at = r->at;
        for (;; at++) {
            if (r->tokens[at].kind != TOK_HASH)
                continue;
            if (cursor_opens(r->tokens[at].directive))
                depth++;
            else if (r->tokens[at].directive == KW_END && depth-- == 0)
                break;
        }
        r->at = at + 1;
        p->n_conditionals--;
    }
}

bool flow_directive(Parser *p, const Token *t)
{
    switch (t->directive) {
    case KW_IF: case KW_IFDEF: case KW_IFNDEF: run_if(p, t); return true;
    case KW_SWITCH: run_switch(p, t); return true;
    case KW_WHILE: run_while(p, t); return true;
    case KW_FOR: run_for(p, t); return true;
    case KW_ELSE: case KW_ELSEIF: case KW_CASE: case KW_RANGE: run_branch(p, t); return true;
    case KW_END: run_end(p, t); return true;
    case KW_BREAK: run_break(p, t); return true;
    default: return false;
    }
}
