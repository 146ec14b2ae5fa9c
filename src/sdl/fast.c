/* fast.c - the plain arithmetic of loops and macros, straight from their tokens.
 *
 * Most expressions in a loop are sums and products of floats. These are evaluated here without the look-ahead, in the same
 * order and with the same results as expr.c. Whatever is not as plain (vectors, macros, directives, warnings, mistakes)
 * makes the attempt fail before anything has been taken, and expr.c starts from the same token. */
#include <math.h>

#include "sdl/parser.h"

enum { DEEPEST = 50 };

typedef struct Fast {
    const Token *at, *end;
    bool failed;
    int depth;
} Fast;

static double sum(Fast *f);

static double give_up(Fast *f)
{
    f->failed = true;
    return 0;
}

static inline int next_kind(const Fast *f)
{
    return f->at < f->end ? f->at->kind : TOK_END;
}

static inline bool take(Fast *f, int kind)
{
    if (next_kind(f) != kind)
        return false;
    f->at++;
    return true;
}

static double component(Fast *f, const Value *v)
{
    if (v->kind != VALUE_NUMBER)
        return give_up(f);
    if (next_kind(f) != TOK_DOT)
        return v->terms == 1 ? v->v[0] : give_up(f);
    f->at++;
    int i;
    switch (next_kind(f)) {
    case KW_X: case KW_U: case KW_RED: i = 0; break;
    case KW_Y: case KW_V: case KW_GREEN: i = 1; break;
    case KW_Z: case KW_BLUE: i = 2; break;
    case KW_T: case KW_FILTER: i = 3; break;
    case KW_TRANSMIT: i = 4; break;
    default: return give_up(f);
    }
    f->at++;
    return i < v->terms && next_kind(f) != TOK_DOT ? v->v[i] : give_up(f);
}

static double name(Fast *f, const Sym *s)
{
    const Binding *b = s->binding;
    if (!b || b->deprecated)
        return give_up(f);
    const Value *v = b->value;
    while (v->kind == VALUE_ARRAY) {
        const ValueArray *a = v->array;
        uint32_t at = 0;
        for (uint32_t i = 0; i < a->n_dimensions; i++) {
            if (!take(f, TOK_LBRACKET))
                return give_up(f);
            double k = sum(f) + EPSILON;
            if (f->failed || !(k >= 0 && k < a->size[i]) || !take(f, TOK_RBRACKET))
                return give_up(f);
            at = at * a->size[i] + (uint32_t)k;
        }
        v = &a->item[at];
    }
    return component(f, v);
}

static double parenthesised(Fast *f)
{
    if (!take(f, TOK_LPAREN))
        return give_up(f);
    double v = sum(f);
    return take(f, TOK_RPAREN) && next_kind(f) != TOK_DOT ? v : give_up(f);
}

static double function(Fast *f, int keyword)
{
    double v = parenthesised(f);
    switch (keyword) {
    case KW_ABS: return fabs(v);
    case KW_CEIL: return ceil(v);
    case KW_COS: return cos(v);
    case KW_DEGREES: return v / (PI / 180);
    case KW_EXP: return exp(v);
    case KW_FLOOR: return floor(v);
    case KW_RADIANS: return v * (PI / 180);
    case KW_SIN: return sin(v);
    case KW_SQRT: return v >= 0 ? sqrt(v) : give_up(f);
    case KW_TAN: return tan(v);
    default: return give_up(f);
    }
}

static double factor(Fast *f)
{
    if (f->at == f->end || f->failed || ++f->depth > DEEPEST)
        return give_up(f);
    const Token *t = f->at++;
    double v;
    switch (t->kind) {
    case TOK_NUMBER: v = t->number; break;
    case TOK_NAME: v = name(f, t->sym); break;
    case TOK_MINUS: v = -factor(f); break;
    case TOK_PLUS: v = factor(f); break;
    case TOK_LPAREN:
        f->at--;
        v = parenthesised(f);
        break;
    case KW_PI: v = PI; break;
    default: v = t->kind < N_KEYWORDS ? function(f, t->kind) : give_up(f);
    }
    f->depth--;
    return v;
}

static double product(Fast *f)
{
    double v = factor(f);
    for (;;) {
        if (take(f, TOK_STAR)) {
            v *= factor(f);
        } else if (take(f, TOK_SLASH)) {
            double w = factor(f);
            if (w == 0)
                return give_up(f);             /* worth a warning */
            v /= w;
        } else {
            return v;
        }
    }
}

static double sum(Fast *f)
{
    double v = product(f);
    for (;;) {
        if (take(f, TOK_PLUS))
            v += product(f);
        else if (take(f, TOK_MINUS))
            v -= product(f);
        else
            return v;
    }
}

static inline bool start(Parser *p, Fast *f)
{
    const Reader *r = &p->reader[p->n_readers - 1];
    if (p->have || r->is_file || p->version < 350)
        return false;
    *f = (Fast){ .at = r->tokens + r->at, .end = r->tokens + r->n };
    return true;
}

static inline void finish(Parser *p, const Fast *f)
{
    Reader *r = &p->reader[p->n_readers - 1];
    r->at = (uint32_t)(f->at - r->tokens);
}

/* What comes next certainly ends a sum: no macro or directive that might go on with it. */
static bool at_end_of_sum(const Fast *f)
{
    switch (next_kind(f)) {
    case TOK_SEMICOLON: case TOK_COMMA: case TOK_RPAREN: case TOK_RBRACKET: case TOK_GREATER: case TOK_CLOSE: return true;
    default: return false;
    }
}

bool fast_sum(Parser *p, double *out)
{
    Fast f;
    if (!start(p, &f))
        return false;
    *out = sum(&f);
    if (f.failed || !at_end_of_sum(&f))
        return false;
    finish(p, &f);
    return true;
}

/* ( sum [relation sum] ) */
bool fast_condition(Parser *p, bool *out)
{
    Fast f;
    if (!start(p, &f) || !take(&f, TOK_LPAREN))
        return false;
    double a = sum(&f), b;
    int kind = next_kind(&f);
    switch (f.failed ? TOK_END : kind) {
    case TOK_RPAREN:
        *out = fabs(a) > EPSILON;
        break;
    case TOK_LESS: case TOK_GREATER: case TOK_LESS_EQUAL: case TOK_GREATER_EQUAL: case TOK_EQUAL: case TOK_NOT_EQUAL:
        f.at++;
        b = sum(&f);
        *out = expr_relation(kind, a, b);
        break;
    default:
        return false;
    }
    if (!take(&f, TOK_RPAREN) || f.failed)
        return false;
    finish(p, &f);
    return true;
}

/* NAME = sum ; for a name that holds a number already, where the new value will be kept. */
bool fast_declare(Parser *p, bool local)
{
    Fast f;
    if (!start(p, &f) || next_kind(&f) != TOK_NAME)
        return false;
    Binding *b = f.at++->sym->binding;
    if (!b || b->value->kind != VALUE_NUMBER || b->deprecated || (local && b->table != p->n_tables - 1) || !take(&f, TOK_EQUAL))
        return false;
    double v = sum(&f);
    if (f.failed || !take(&f, TOK_SEMICOLON) || next_kind(&f) == TOK_SEMICOLON)
        return false;
    value_set_number(p, b->value, &(Num){ { v }, 1 });
    finish(p, &f);
    return true;
}
