/* expr.c - expressions, evaluated while they are read (01-language, section 4).
 *
 * Most contexts read only a sum; relations and logic exist inside parentheses and where a full expression is asked for.
 * Values have one to five terms. A directive may stand between any two tokens, so names are taken by value at once. */
#include <limits.h>
#include <math.h>
#include <string.h>

#include "sdl/parser.h"

/* A float goes to all terms, a vector is padded with 0. */
void num_promote(Num *n, int terms)
{
    for (int i = n->terms; i < terms; i++)
        n->v[i] = n->terms == 1 ? n->v[0] : 0;
    if (n->terms < terms)
        n->terms = terms;
}

double num_float(Parser *p, const Num *n)
{
    if (n->terms > 1)
        fail(p->diag, cursor_loc(p), "Float expected but vector or color expression found.");
    return n->v[0];
}

Vec3 num_vec3(Parser *p, const Num *n)
{
    Num v = *n;
    if (v.terms > 3)
        fail(p->diag, cursor_loc(p), "Vector expected but color expression found.");
    num_promote(&v, 3);
    return vec3(v.v[0], v.v[1], v.v[2]);
}

static bool truth(double v)
{
    return fabs(v) > EPSILON;
}

/* The five-term words of the language: what may start a numeric expression besides brackets and signs. */
bool kind_starts_number(const Parser *p)
{
    switch (p->token.kind) {
    case TOK_NUMBER: case TOK_LPAREN: case TOK_PLUS: case TOK_MINUS: case TOK_NOT: case TOK_LESS:
        return true;
    case TOK_NAME:
        return p->value && (p->value->kind == VALUE_NUMBER || p->value->kind == VALUE_FUNCTION
                            || p->value->kind == VALUE_SPLINE);
    default:
        return p->token.kind < N_KEYWORDS && keyword_group(p->token.kind) != NULL;
    }
}

/* -- Operands -- */

static void vector_literal(Parser *p, Num *out)
{
    p->have = false;
    out->terms = 0;
    for (;;) {
        Num n;
        expr_sum(p, &n);
        out->v[out->terms++] = num_float(p, &n);
        if (out->terms > 1 && parse_accept(p, TOK_GREATER))
            return;
        if (out->terms == 5)
            parse_expect(p, TOK_GREATER);
        if (parse_accept(p, TOK_COMMA) && out->terms > 1 && parse_accept(p, TOK_GREATER))
            return;                            /* POV: a comma may stand before the '>' */
    }
}

/* F(a, b): exactly as many floats as the function has parameters. */
static void function_call(Parser *p, const Function *f, Num *out)
{
    double argument[FUNC_MAX_PARAMETERS], v[5] = { 0 };
    int n = func_parameters(f);
    parse_expect(p, TOK_LPAREN);
    for (int i = 0; i < n; i++) {
        argument[i] = expr_float(p);
        if (i + 1 < n)
            parse_comma(p);
    }
    parse_expect(p, TOK_RPAREN);
    int terms = func_terms(f);
    out->terms = terms;
    if (terms == 1) {
        out->v[0] = func_call(f, argument);
        return;
    }
    func_call_vector(f, argument, v);
    memcpy(out->v, v, sizeof v);
}

/* S(t) or S(t, type). */
static void spline_call(Parser *p, const Spline *s, Num *out)
{
    parse_expect(p, TOK_LPAREN);
    double t = expr_float(p);
    SplineKind kind = s->kind;
    parse_comma(p);
    if (spline_kind(cursor_look(p), &kind))
        p->have = false;
    parse_expect(p, TOK_RPAREN);
    spline_at(s, kind, t, out->v);
    out->terms = s->terms;
}

/* At a name. The value is copied before anything else is read. */
static void name_operand(Parser *p, Num *out)
{
    Value *v = p->value;
    if (v && v->kind == VALUE_NUMBER) {
        num_from_value(out, v);
        p->have = false;
    } else if (v && v->kind == VALUE_FUNCTION) {
        const Function *f = v->function;
        p->have = false;
        function_call(p, f, out);
    } else if (v && v->kind == VALUE_SPLINE) {
        const Spline *s = v->spline;
        p->have = false;
        spline_call(p, s, out);
    } else {
        parse_expected(p, "numeric expression");
    }
}

static void set(Num *out, double v)
{
    out->v[0] = v;
    out->terms = 1;
}

static void unit(Num *out, int terms, int axis)
{
    out->terms = terms;
    for (int i = 0; i < terms; i++)
        out->v[i] = i == axis;
}

static void keyword_operand(Parser *p, int kind, Num *out)
{
    switch (kind) {
    case KW_PI: set(out, PI); break;
    case KW_TRUE: case KW_YES: case KW_ON: set(out, 1); break;
    case KW_FALSE: case KW_NO: case KW_OFF: set(out, 0); break;
    case KW_X: unit(out, 3, 0); break;
    case KW_Y: unit(out, 3, 1); break;
    case KW_Z: unit(out, 3, 2); break;
    case KW_T: unit(out, 4, 3); break;
    case KW_U: unit(out, 2, 0); break;
    case KW_V: unit(out, 2, 1); break;
    case KW_CLOCK: set(out, (double)(float)p->options->clock); break;
    case KW_CLOCK_ON: set(out, p->options->clock_on); break;
    case KW_VERSION: set(out, p->version / 100.0); break;
    default: {
        Token word = p->token;
        p->have = false;
        if (builtin_number(p, kind, out) || builtin_text_number(p, kind, out))
            return;
        p->token = word;
        p->have = true;
        if (kind_starts_colour(p)) {
            parse_mend(p, "A color word within an expression");
            colour_parse(p, out, false);
            return;
        }
        parse_expected(p, "numeric expression");
    }
    }
    p->have = false;
}

/* A directive may run where an operand is expected, whatever surrounds it. */
static void operand(Parser *p, Num *out)
{
    bool was = p->suspended;
    p->suspended = false;
    int kind = cursor_look(p);
    switch (kind) {
    case TOK_NUMBER:
        set(out, p->token.number);
        p->have = false;
        break;
    case TOK_NAME:
        name_operand(p, out);
        break;
    case TOK_LPAREN:
        cursor_deeper(p);
        p->have = false;
        expr_full(p, out);
        parse_expect(p, TOK_RPAREN);
        p->depth--;
        break;
    case TOK_LESS:
        cursor_deeper(p);
        vector_literal(p, out);
        p->depth--;
        break;
    default:
        if (kind >= N_KEYWORDS)
            parse_expected(p, "numeric expression");
        cursor_deeper(p);
        keyword_operand(p, kind, out);
        p->depth--;
    }
    p->suspended = was;
}

/* -- Operators -- */

/* .x .red and so on; -1 for another word, 5 for .gray. */
static int component_of(int keyword)
{
    switch (keyword) {
    case KW_X: case KW_U: case KW_RED: return 0;
    case KW_Y: case KW_V: case KW_GREEN: return 1;
    case KW_Z: case KW_BLUE: return 2;
    case KW_T: case KW_FILTER: return 3;
    case KW_TRANSMIT: return 4;
    case KW_GRAY: return 5;
    default: return -1;
    }
}

static void components(Parser *p, Num *n)
{
    for (bool first = true; cursor_look(p) == TOK_DOT; first = false) {
        if (!first)
            parse_mend(p, "A component of a component");
        p->have = false;
        int i = component_of(cursor_look(p));
        if (i < 0)
            parse_expected(p, "x, y, z, t, u, v or color component");
        for (int k = n->terms; i == 5 && k < 3; k++)
            n->v[k] = 0;
        if (i != 5 && i >= n->terms)
            fail(p->diag, p->token.loc, "Bad operands for period operator.");
        p->have = false;
        n->v[0] = i == 5 ? 0.297 * n->v[0] + 0.589 * n->v[1] + 0.114 * n->v[2] : n->v[i];
        n->terms = 1;
    }
}

static void factor(Parser *p, Num *out)
{
    bool was = p->suspended;
    p->suspended = false;
    int kind = cursor_look(p);
    p->suspended = was;
    if (kind == TOK_PLUS || kind == TOK_MINUS || kind == TOK_NOT) {
        cursor_deeper(p);
        p->have = false;
        factor(p, out);
        p->depth--;
        for (int i = 0; i < out->terms && kind != TOK_PLUS; i++)
            out->v[i] = kind == TOK_MINUS ? -out->v[i] : !truth(out->v[i]);
        return;
    }
    operand(p, out);
    components(p, out);
}

static void match_terms(Num *a, Num *b)
{
    if (a->terms == b->terms)
        return;
    num_promote(a, b->terms);
    num_promote(b, a->terms);
}

static void product_rest(Parser *p, Num *out)
{
    for (;;) {
        int kind = cursor_look(p);
        if (kind != TOK_STAR && kind != TOK_SLASH)
            return;
        Loc loc = p->token.loc;
        p->have = false;
        Num b;
        factor(p, &b);
        match_terms(out, &b);
        for (int i = 0; i < out->terms; i++) {
            if (kind == TOK_STAR) {
                out->v[i] *= b.v[i];
                continue;
            }
            if (b.v[i] == 0)                   /* POV: infinity, whatever is divided */
                warn(p->diag, loc, "Divide by zero.");
            out->v[i] = b.v[i] == 0 ? INFINITY : out->v[i] / b.v[i];
        }
    }
}

static void product(Parser *p, Num *out)
{
    factor(p, out);
    product_rest(p, out);
}

static void sum_rest(Parser *p, Num *out)
{
    for (;;) {
        int kind = cursor_look(p);
        if (kind != TOK_PLUS && kind != TOK_MINUS)
            return;
        p->have = false;
        Num b;
        product(p, &b);
        match_terms(out, &b);
        for (int i = 0; i < out->terms; i++)
            out->v[i] = kind == TOK_PLUS ? out->v[i] + b.v[i] : out->v[i] - b.v[i];
    }
}

void expr_sum(Parser *p, Num *out)
{
    if (fast_sum(p, out))
        return;
    factor(p, out);
    if (p->version < 150)                      /* operators need parentheses */
        return;
    product_rest(p, out);
    sum_rest(p, out);
}

void expr_sum_rest(Parser *p, Num *first)
{
    components(p, first);
    product_rest(p, first);
    sum_rest(p, first);
}

double expr_relation(int kind, double a, double b)
{
    switch (kind) {
    case TOK_LESS: return a < b;
    case TOK_GREATER: return a > b;
    case TOK_LESS_EQUAL: return a < b || fabs(a - b) <= EPSILON;
    case TOK_GREATER_EQUAL: return a > b || fabs(a - b) <= EPSILON;
    case TOK_EQUAL: return fabs(a - b) <= EPSILON;
    default: return fabs(a - b) > EPSILON;
    }
}

static void relation_rest(Parser *p, Num *out)
{
    for (;;) {
        int kind = cursor_look(p);
        if (!is_relation(kind))
            return;
        p->have = false;
        Num b;
        product(p, &b);
        sum_rest(p, &b);
        match_terms(out, &b);
        for (int i = 0; i < out->terms; i++)
            out->v[i] = expr_relation(kind, out->v[i], b.v[i]);
    }
}

/* "a" < "b": by character. False, with nothing taken, if no string comes. */
static bool string_relation(Parser *p, Num *out)
{
    bool was = p->suspended;
    p->suspended = false;
    cursor_look(p);
    p->suspended = was;
    if (!kind_starts_string(p))
        return false;
    Str a = string_expression(p, false);
    int kind = cursor_look(p);
    if (!is_relation(kind))
        parse_expected(p, "comparison operator");
    p->have = false;
    Str b = string_expression(p, false);
    set(out, expr_relation(kind, string_compare(a, b), 0));
    return true;
}

static void comparison(Parser *p, Num *out)
{
    if (string_relation(p, out))
        return;
    product(p, out);
    sum_rest(p, out);
    relation_rest(p, out);
}

static void logic_rest(Parser *p, Num *out)
{
    for (;;) {
        int kind = cursor_look(p);
        if (kind != TOK_AND && kind != TOK_OR)
            return;
        p->have = false;
        Num b;
        comparison(p, &b);
        match_terms(out, &b);
        for (int i = 0; i < out->terms; i++)
            out->v[i] = kind == TOK_AND ? truth(out->v[i]) && truth(b.v[i]) : truth(out->v[i]) || truth(b.v[i]);
    }
}

/* `a ? b : c`: both are read and evaluated, whichever is taken. */
static void choice_rest(Parser *p, Num *out)
{
    if (cursor_look(p) != TOK_QUESTION)
        return;
    p->have = false;
    if (out->terms > 1)
        fail(p->diag, cursor_loc(p), "Conditional must evaluate to a float.");
    bool first = truth(out->v[0]);
    Num a, b;
    cursor_deeper(p);
    expr_full(p, &a);
    parse_expect(p, TOK_COLON);
    expr_full(p, &b);
    p->depth--;
    *out = first ? a : b;
}

void expr_full(Parser *p, Num *out)
{
    if (fast_full(p, out))
        return;
    comparison(p, out);
    logic_rest(p, out);
    choice_rest(p, out);
}

double expr_float(Parser *p)
{
    Num n;
    expr_sum(p, &n);
    return num_float(p, &n);
}

double expr_full_float(Parser *p)
{
    Num n;
    expr_full(p, &n);
    return num_float(p, &n);
}

void expr_condition(Parser *p, Num *out)
{
    bool was = p->suspended;
    p->suspended = true;
    parse_expect(p, TOK_LPAREN);
    expr_full(p, out);
    parse_expect(p, TOK_RPAREN);
    p->suspended = was;
}
