/* fast.c - the plain arithmetic of loops and macros, straight from their tokens.
 *
 * Most expressions in a loop are sums and products of floats. These are evaluated here without the look-ahead, in the same
 * order and with the same results as expr.c. Whatever is not as plain (vectors, macros, directives, warnings, mistakes)
 * makes the attempt fail before anything has been taken, and expr.c starts from the same token. */
#include <math.h>

#include "sdl/parser.h"

enum { DEEPEST = 50, MAX_UNDO = 8 };

typedef struct Fast {
    Parser *p;
    const Token *at, *end;
    bool failed;
    int depth;
    unsigned n_undo;                           /* random streams that were asked: put back if the attempt fails */
    struct { uint32_t stream, state; } undo[MAX_UNDO];
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

static double rand_of(Fast *f)
{
    double k = parenthesised(f);
    if (f->failed || f->n_undo == MAX_UNDO || !(k >= 0 && k < f->p->random.n))
        return give_up(f);
    uint32_t stream = (uint32_t)k;
    f->undo[f->n_undo].stream = stream;
    f->undo[f->n_undo++].state = f->p->random.data[stream];
    return random_next(&f->p->random.data[stream]);
}

/* Of two floats with a comma between them. */
static double of_two(Fast *f, int keyword)
{
    if (!take(f, TOK_LPAREN))
        return give_up(f);
    double a = sum(f);
    if (!take(f, TOK_COMMA))
        return give_up(f);
    double b = sum(f);
    if (!take(f, TOK_RPAREN) || next_kind(f) == TOK_DOT)
        return give_up(f);
    return keyword == KW_MOD ? fmod(a, b) : keyword == KW_MIN ? (b < a ? b : a) : b > a ? b : a;
}

static double function(Fast *f, int keyword)
{
    if (keyword == KW_RAND)
        return rand_of(f);
    if (keyword == KW_MOD || keyword == KW_MIN || keyword == KW_MAX)
        return of_two(f, keyword);
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
    f->p = p;
    f->at = r->tokens + r->at;
    f->end = r->tokens + r->n;
    f->failed = false;
    f->depth = 0;
    f->n_undo = 0;
    return true;
}

static bool abandon(Fast *f)
{
    while (f->n_undo--)
        f->p->random.data[f->undo[f->n_undo].stream] = f->undo[f->n_undo].state;
    return false;
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
        return abandon(&f);
    finish(p, &f);
    return true;
}

static bool is_relation(int kind)
{
    return kind == TOK_LESS || kind == TOK_GREATER || kind == TOK_LESS_EQUAL || kind == TOK_GREATER_EQUAL || kind == TOK_EQUAL
        || kind == TOK_NOT_EQUAL;
}

static double comparison(Fast *f)
{
    double v = sum(f);
    for (int kind; is_relation(kind = next_kind(f)) && !f->failed;) {
        f->at++;
        v = expr_relation(kind, v, sum(f));
    }
    return v;
}

/* ( comparison { &| comparison } ): all on one level, from left to right. */
bool fast_condition(Parser *p, bool *out)
{
    Fast f;
    if (!start(p, &f) || !take(&f, TOK_LPAREN))
        return false;
    bool truth = fabs(comparison(&f)) > EPSILON;
    while (!f.failed && (next_kind(&f) == TOK_AND || next_kind(&f) == TOK_OR)) {
        bool both = f.at++->kind == TOK_AND, other = fabs(comparison(&f)) > EPSILON;
        truth = both ? truth && other : truth || other;
    }
    if (!take(&f, TOK_RPAREN) || f.failed)
        return abandon(&f);
    *out = truth;
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
        return abandon(&f);
    value_set_number(p, b->value, &(Num){ { v }, 1 });
    finish(p, &f);
    return true;
}
