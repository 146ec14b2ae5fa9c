/* fast.c - the plain arithmetic of loops and macros, straight from their tokens.
 *
 * Most expressions in a loop are sums and products of floats and vectors. These are evaluated here without the look-ahead, in the
 * same order and with the same results as expr.c. Whatever is not as plain (macros, directives, warnings, mistakes) makes the
 * attempt fail before anything has been taken, and expr.c starts from the same token. */
#include <math.h>
#include <string.h>

#include "sdl/parser.h"

enum { DEEPEST = 50, MAX_UNDO = 8 };

typedef struct Fast {
    Parser *p;
    const Token *at, *end;
    bool failed;
    int depth;
    unsigned n_undo;                           /* random streams that were asked: put back if the attempt fails */
    struct { uint32_t stream, state; } undo[MAX_UNDO];
    Value *target;                             /* of trace(): takes the normal when all is well; may not be read before */
    Vec3 normal;
} Fast;

static void sum(Fast *f, Num *out);
static void full(Fast *f, Num *out);

/* Nothing comes behind a failure, so that all loops end: what stands at the end of an array is part of no expression (token.h). */
static double give_up(Fast *f)
{
    f->failed = true;
    f->at = f->end;
    return 0;
}

static void set(Num *out, double v)
{
    out->v[0] = v;
    out->terms = 1;
}

static inline int next_kind(const Fast *f)
{
    return f->at->kind;
}

static inline bool take(Fast *f, int kind)
{
    if (next_kind(f) != kind)
        return false;
    f->at++;
    return true;
}

static inline void expect(Fast *f, int kind)
{
    if (!take(f, kind))
        give_up(f);
}

static double float_sum(Fast *f)
{
    Num n;
    sum(f, &n);
    return n.terms == 1 ? n.v[0] : give_up(f);
}

static Vec3 vec3_sum(Fast *f)
{
    Num n;
    sum(f, &n);
    if (n.terms > 3) {
        give_up(f);
        n.terms = 3;
    }
    num_promote(&n, 3);
    return vec3(n.v[0], n.v[1], n.v[2]);
}

/* ---- names ---- */

static void component(Fast *f, Num *out)
{
    int i;
    f->at++;
    switch (next_kind(f)) {
    case KW_X: case KW_U: case KW_RED: i = 0; break;
    case KW_Y: case KW_V: case KW_GREEN: i = 1; break;
    case KW_Z: case KW_BLUE: i = 2; break;
    case KW_T: case KW_FILTER: i = 3; break;
    case KW_TRANSMIT: i = 4; break;
    default: give_up(f); return;
    }
    if (i >= out->terms) {
        give_up(f);
        return;
    }
    f->at++;
    set(out, out->v[i]);
}

/* At the '[' behind an array: the item. */
static Value *subscripts(Fast *f, Value *v, ValueArray **owner)
{
    do {
        ValueArray *a = *owner = v->array;
        uint32_t at = 0;
        for (uint32_t i = 0; i < a->n_dimensions; i++) {
            expect(f, TOK_LBRACKET);
            double k = float_sum(f) + EPSILON;
            expect(f, TOK_RBRACKET);
            if (f->failed || !(k >= 0 && k < a->size[i])) {
                give_up(f);
                return v;
            }
            at = at * a->size[i] + (uint32_t)k;
        }
        v = &a->item[at];
    } while (v->kind == VALUE_ARRAY);
    return v;
}

/* F(a, b) */
static __attribute__((noinline)) void function_call(Fast *f, const Function *function, Num *out)
{
    double argument[FUNC_MAX_PARAMETERS];
    int n = func_parameters(function);
    expect(f, TOK_LPAREN);
    for (int i = 0; i < n; i++) {
        argument[i] = float_sum(f);
        expect(f, i + 1 < n ? TOK_COMMA : TOK_RPAREN);
    }
    if (f->failed)
        return;
    out->terms = func_terms(function);
    if (out->terms == 1)
        out->v[0] = func_call(function, argument);
    else
        func_call_vector(function, argument, out->v);
}

static void name(Fast *f, const Sym *s, Num *out)
{
    const Binding *b = s->binding;
    if (!b || b->deprecated) {
        give_up(f);
        return;
    }
    Value *v = b->value;
    ValueArray *owner;
    if (v->kind == VALUE_ARRAY)
        v = subscripts(f, v, &owner);
    if (v->kind == VALUE_NUMBER && v != f->target)
        num_from_value(out, v);
    else if (v->kind == VALUE_FUNCTION)
        function_call(f, v->function, out);
    else
        give_up(f);
}

/* ---- functions ---- */

static double parenthesised(Fast *f)
{
    Num n;
    expect(f, TOK_LPAREN);
    full(f, &n);
    expect(f, TOK_RPAREN);
    return n.terms == 1 ? n.v[0] : give_up(f);
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

static double of_two(Fast *f, int keyword)
{
    double out = 0;
    expect(f, TOK_LPAREN);
    double a = float_sum(f);
    expect(f, TOK_COMMA);
    double b = float_sum(f);
    expect(f, TOK_RPAREN);
    return !f->failed && math_of_two(keyword, a, b, &out) ? out : give_up(f);
}

static void of_vectors(Fast *f, int keyword, Num *out)
{
    expect(f, TOK_LPAREN);
    Vec3 a = vec3_sum(f), b = a;
    double angle = 0;
    if (keyword != KW_VLENGTH && keyword != KW_VNORMALIZE) {
        expect(f, TOK_COMMA);
        b = vec3_sum(f);
    }
    if (keyword == KW_VAXIS_ROTATE) {
        expect(f, TOK_COMMA);
        angle = float_sum(f);
    }
    expect(f, TOK_RPAREN);
    if (f->failed || !math_of_vectors(keyword, a, b, angle, out))
        give_up(f);
}

/* What a name alone holds. */
static Value *held(Fast *f)
{
    const Binding *b = next_kind(f) == TOK_NAME ? f->at->sym->binding : NULL;
    if (!b || b->deprecated) {
        give_up(f);
        return NULL;
    }
    f->at++;
    return b->value;
}

static void trace(Fast *f, Num *out)
{
    expect(f, TOK_LPAREN);
    const Value *o = held(f);
    if (o == NULL || o->kind != VALUE_BLOCK || o->block != BLOCK_OBJECT || f->target) {
        give_up(f);
        return;
    }
    expect(f, TOK_COMMA);
    Vec3 from = vec3_sum(f);
    expect(f, TOK_COMMA);
    Vec3 direction = vec3_sum(f), normal;
    Value *target = NULL;
    if (take(f, TOK_COMMA)) {
        target = held(f);
        if (target == NULL || target->kind != VALUE_NUMBER || target->terms != 3)
            give_up(f);
    }
    expect(f, TOK_RPAREN);
    if (f->failed)
        return;
    Vec3 point = math_trace(f->p, o->pointer, from, direction, &normal);
    f->target = target;
    f->normal = normal;
    *out = (Num){ { point.x, point.y, point.z }, 3 };
}

static void function(Fast *f, int keyword, Num *out)
{
    switch (keyword) {
    case KW_RAND: set(out, rand_of(f)); return;
    case KW_TRACE: trace(f, out); return;
    case KW_ATAN2: case KW_DIV: case KW_MAX: case KW_MIN: case KW_MOD: case KW_POW: set(out, of_two(f, keyword)); return;
    case KW_VLENGTH: case KW_VDOT: case KW_VNORMALIZE: case KW_VCROSS: case KW_VROTATE: case KW_VAXIS_ROTATE:
        of_vectors(f, keyword, out);
        return;
    default: break;
    }
    double v = next_kind(f) == TOK_LPAREN ? parenthesised(f) : give_up(f);
    if (f->failed || !math_of_one(keyword, v, &out->v[0]))
        give_up(f);
}

/* ---- operators ---- */

static void vector_literal(Fast *f, Num *out)
{
    int n = 0;
    do {
        if (n == 5) {
            give_up(f);
            return;
        }
        out->v[n++] = float_sum(f);
    } while (take(f, TOK_COMMA));
    expect(f, TOK_GREATER);
    if (n < 2)
        give_up(f);
    out->terms = n;
}

static void unit(Num *out, int axis)
{
    *out = (Num){ { axis == 0, axis == 1, axis == 2 }, 3 };
}

static __attribute__((noinline)) void any_factor(Fast *f, Num *out)
{
    set(out, 0);
    if (++f->depth > DEEPEST) {
        give_up(f);
        return;
    }
    const Token *t = f->at++;
    switch (t->kind) {
    case TOK_NUMBER: out->v[0] = t->number; break;
    case TOK_NAME: name(f, t->sym, out); break;
    case TOK_MINUS:
        any_factor(f, out);
        for (int i = 0; i < out->terms; i++)
            out->v[i] = -out->v[i];
        break;
    case TOK_PLUS: any_factor(f, out); break;
    case TOK_LPAREN:
        full(f, out);
        expect(f, TOK_RPAREN);
        break;
    case TOK_LESS: vector_literal(f, out); break;
    case KW_PI: out->v[0] = PI; break;
    case KW_X: unit(out, 0); break;
    case KW_Y: unit(out, 1); break;
    case KW_Z: unit(out, 2); break;
    case KW_TRUE: case KW_YES: case KW_ON: out->v[0] = 1; break;
    case KW_FALSE: case KW_NO: case KW_OFF: break;
    default:
        if (t->kind < N_KEYWORDS)
            function(f, t->kind, out);
        else
            give_up(f);
    }
    while (next_kind(f) == TOK_DOT)
        component(f, out);
    f->depth--;
}

/* Most are literals and floats: a third of the time of a plain loop. */
static inline void factor(Fast *f, Num *out)
{
    const Token *t = f->at;
    if (t->kind == TOK_NUMBER && t[1].kind != TOK_DOT) {
        f->at++;
        set(out, t->number);
        return;
    }
    if (t->kind == TOK_NAME && t[1].kind != TOK_DOT) {
        const Binding *b = t->sym->binding;
        if (b && !b->deprecated && b->value->kind == VALUE_NUMBER && b->value->terms == 1) {
            f->at++;
            set(out, b->value->v[0]);
            return;
        }
    }
    any_factor(f, out);
}

/* A division by zero is worth a warning. */
static inline double quotient(Fast *f, double a, double b)
{
    return b == 0 ? give_up(f) : a / b;
}

static void match_terms(Num *a, Num *b)
{
    if (a->terms != b->terms) {
        num_promote(a, b->terms);
        num_promote(b, a->terms);
    }
}

static __attribute__((noinline)) void product_of_vectors(Fast *f, int kind, Num *a, Num *b)
{
    match_terms(a, b);
    for (int i = 0; i < a->terms; i++)
        a->v[i] = kind == TOK_STAR ? a->v[i] * b->v[i] : quotient(f, a->v[i], b->v[i]);
}

static __attribute__((noinline)) void product_rest(Fast *f, Num *out)
{
    for (int kind; (kind = next_kind(f)) == TOK_STAR || kind == TOK_SLASH;) {
        Num b;
        f->at++;
        factor(f, &b);
        if (out->terms != 1 || b.terms != 1)
            product_of_vectors(f, kind, out, &b);
        else
            out->v[0] = kind == TOK_STAR ? out->v[0] * b.v[0] : quotient(f, out->v[0], b.v[0]);
    }
}

static inline void product(Fast *f, Num *out)
{
    factor(f, out);
    int kind = next_kind(f);
    if (kind == TOK_STAR || kind == TOK_SLASH)
        product_rest(f, out);
}

static __attribute__((noinline)) void sum_of_vectors(int kind, Num *a, Num *b)
{
    match_terms(a, b);
    for (int i = 0; i < a->terms; i++)
        a->v[i] = kind == TOK_PLUS ? a->v[i] + b->v[i] : a->v[i] - b->v[i];
}

static void sum(Fast *f, Num *out)
{
    product(f, out);
    for (int kind; (kind = next_kind(f)) == TOK_PLUS || kind == TOK_MINUS;) {
        Num b;
        f->at++;
        product(f, &b);
        if (out->terms != 1 || b.terms != 1)
            sum_of_vectors(kind, out, &b);
        else
            out->v[0] = kind == TOK_PLUS ? out->v[0] + b.v[0] : out->v[0] - b.v[0];
    }
}

static void comparison(Fast *f, Num *out)
{
    sum(f, out);
    for (int kind; is_relation(kind = next_kind(f));) {
        Num b;
        f->at++;
        sum(f, &b);
        match_terms(out, &b);
        for (int i = 0; i < out->terms; i++)
            out->v[i] = expr_relation(kind, out->v[i], b.v[i]);
    }
}

static bool truth(Fast *f, const Num *n)
{
    return n->terms == 1 ? fabs(n->v[0]) > EPSILON : give_up(f) > 0;
}

/* comparison { &| comparison } [ ? full : full ]: the logic on one level, from left to right. */
static void full(Fast *f, Num *out)
{
    comparison(f, out);
    for (int kind; (kind = next_kind(f)) == TOK_AND || kind == TOK_OR;) {
        Num b;
        f->at++;
        comparison(f, &b);
        bool left = truth(f, out), right = truth(f, &b);
        set(out, kind == TOK_AND ? left && right : left || right);
    }
    if (!take(f, TOK_QUESTION))
        return;
    bool first = truth(f, out);
    Num other;
    full(f, first ? out : &other);
    expect(f, TOK_COLON);
    full(f, first ? &other : out);
}

/* ---- what the others call ---- */

/* A look-ahead that has just been taken from the array can be had there again. */
static inline bool start(Parser *p, Fast *f)
{
    const Reader *r = cursor_top(p);
    if (r->is_file || p->version < 350)
        return false;
    f->at = r->tokens + r->at;
    if (p->have && (r->at == 0 || memcmp(--f->at, &p->token, sizeof p->token) != 0))
        return false;
    f->p = p;
    f->end = r->tokens + r->n;
    f->failed = false;
    f->depth = 0;
    f->n_undo = 0;
    f->target = NULL;
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
    Reader *r = cursor_top(p);
    p->have = false;
    r->at = (uint32_t)(f->at - r->tokens);
    if (f->target)
        value_set_number(p, f->target, &(Num){ { f->normal.x, f->normal.y, f->normal.z }, 3 });
}

/* What comes next certainly ends an expression: it is no macro or directive that might go on with it. */
static bool at_end(const Fast *f)
{
    int kind = next_kind(f);
    return kind != TOK_NAME && kind != TOK_HASH && kind != TOK_END;
}

static inline bool whole(Parser *p, void (*part)(Fast *f, Num *out), Num *out)
{
    Fast f;
    if (!start(p, &f))
        return false;
    part(&f, out);
    if (f.failed || !at_end(&f))
        return abandon(&f);
    finish(p, &f);
    return true;
}

bool fast_sum(Parser *p, Num *out)
{
    return whole(p, sum, out);
}

bool fast_full(Parser *p, Num *out)
{
    return whole(p, full, out);
}

bool fast_condition(Parser *p, bool *out)
{
    Fast f;
    if (!start(p, &f))
        return false;
    *out = fabs(parenthesised(&f)) > EPSILON;
    if (f.failed)
        return abandon(&f);
    finish(p, &f);
    return true;
}

/* Is an item or argument over here, with nothing that might go on with it? The comma behind it is taken. */
static bool end_item(Fast *f)
{
    return take(f, TOK_COMMA) || next_kind(f) == TOK_RPAREN;
}

bool fast_argument(Parser *p, Num *number, Value **by_reference)
{
    Fast f;
    *by_reference = NULL;
    if (!start(p, &f))
        return false;
    const Binding *b = next_kind(&f) == TOK_NAME ? f.at->sym->binding : NULL;
    int kind = b ? b->value->kind : VALUE_NONE;
    if (kind == VALUE_ARRAY)                   /* perhaps an item by reference */
        return false;
    if (kind == VALUE_NUMBER || kind == VALUE_STRING || kind == VALUE_BLOCK) {
        const Token *first = f.at++;
        if (!b->deprecated && end_item(&f)) {
            *by_reference = b->value;
            finish(p, &f);
            return true;
        }
        f.at = first;
    }
    sum(&f, number);
    if (f.failed || !end_item(&f))
        return abandon(&f);
    finish(p, &f);
    return true;
}

const Token *fast_text_item(Parser *p)
{
    Fast f;
    if (!start(p, &f))
        return NULL;
    const Token *text = f.at;
    if (!take(&f, TOK_STRING) || !end_item(&f))
        return NULL;
    finish(p, &f);
    return text;
}

bool fast_str_item(Parser *p, double argument[3])
{
    Fast f;
    if (!start(p, &f) || !take(&f, KW_STR) || !take(&f, TOK_LPAREN))
        return false;
    for (int i = 0; i < 3; i++) {
        argument[i] = float_sum(&f);
        expect(&f, i < 2 ? TOK_COMMA : TOK_RPAREN);
    }
    bool fit = fabs(argument[1]) < 1000 && fabs(argument[2]) < 1000;
    if (f.failed || !fit || !end_item(&f))
        return abandon(&f);
    finish(p, &f);
    return true;
}

/* [subscripts] = sum ; into an item that may hold numbers like this one. */
static bool declare_item(Parser *p, Fast *f, Value *array)
{
    ValueArray *owner;
    Num n;
    Value *item = subscripts(f, array, &owner);
    expect(f, TOK_EQUAL);
    sum(f, &n);
    expect(f, TOK_SEMICOLON);
    if (f->failed || next_kind(f) == TOK_SEMICOLON || owner->type.kind != VALUE_NUMBER || owner->type.terms != n.terms)
        return abandon(f);
    finish(p, f);
    value_set_number(p, item, &n);
    return true;
}

/* NAME = sum ; for a name that holds a number or nothing. */
bool fast_declare(Parser *p, bool local)
{
    Fast f;
    Num n;
    if (!start(p, &f) || next_kind(&f) != TOK_NAME)
        return false;
    Sym *s = f.at++->sym;
    Binding *b = s->binding;
    if (b && !b->deprecated && b->value->kind == VALUE_ARRAY && next_kind(&f) == TOK_LBRACKET)
        return declare_item(p, &f, b->value);
    if ((b && (b->deprecated || (b->value->kind != VALUE_NUMBER && b->value->kind != VALUE_NONE))) || !take(&f, TOK_EQUAL))
        return false;
    sum(&f, &n);
    if (f.failed || !take(&f, TOK_SEMICOLON) || next_kind(&f) == TOK_SEMICOLON)
        return abandon(&f);
    finish(p, &f);
    if (!b || (local && b->table != p->n_tables - 1))
        b = symbol_declare(p, s, local, p->n_tables - 1);
    value_set_number(p, b->value, &n);
    return true;
}
