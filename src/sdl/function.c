/* function.c - function { ... }: the grammar of user functions, and the blocks that may stand in their place.
 *
 * 01-language, section 17. The expression goes straight into a FuncBuilder; identifiers of the scene are frozen with the value they
 * have now. Pigments, patterns, transforms and splines become FuncHosts. */
#include "sdl/blocks.h"
#include "sdl/parser.h"

typedef struct Parameter { int keyword; const Sym *sym; } Parameter;       /* one of the two */

typedef struct Scope {                         /* of names: the function's, or that of a sum's body */
    FuncBuilder *b;
    int n;
    Parameter parameter[FUNC_MAX_PARAMETERS + 8];
} Scope;

static FuncNode logic(Parser *p, Scope *s);

/* u is another name for x, and v for y. */
static int canonical(int keyword)
{
    return keyword == KW_U ? KW_X : keyword == KW_V ? KW_Y : keyword;
}

static bool is_parameter_word(int keyword)
{
    return keyword == KW_X || keyword == KW_Y || keyword == KW_Z || keyword == KW_U || keyword == KW_V;
}

static int find_parameter(const Scope *s, int kind, const Sym *sym)
{
    for (int i = s->n - 1; i >= 0; i--)
        if (kind == TOK_NAME ? s->parameter[i].sym == sym : s->parameter[i].sym == NULL && s->parameter[i].keyword == canonical(kind))
            return i;
    return -1;
}

static void add_parameter(Parser *p, Scope *s)
{
    int kind = parse_peek(p);
    if (kind != TOK_NAME && !is_parameter_word(kind))
        parse_expected(p, "parameter name");
    if (s->n >= FUNC_MAX_PARAMETERS)
        parse_fail(p, "a function has at most %d parameters", FUNC_MAX_PARAMETERS);
    const Sym *sym = kind == TOK_NAME ? p->token.sym : NULL;
    if (find_parameter(s, kind, sym) >= 0)
        parse_fail(p, "this function has two parameters of that name");
    s->parameter[s->n++] = (Parameter){ canonical(kind), sym };
    parse_skip(p);
}

/* ---- operands ---- */

static FuncNode one_argument(Parser *p, Scope *s)
{
    parse_expect(p, TOK_LPAREN);
    FuncNode a = logic(p, s);
    parse_expect(p, TOK_RPAREN);
    return a;
}

static int arguments(Parser *p, Scope *s, FuncNode *a, int max)
{
    int n = 0;
    parse_expect(p, TOK_LPAREN);
    while (!parse_accept(p, TOK_RPAREN)) {
        if (n == max)
            parse_expect(p, TOK_RPAREN);
        if (n > 0)
            parse_due_comma(p);
        a[n++] = logic(p, s);
    }
    return n;
}

static FuncNode scaled_by(Scope *s, FuncNode a, double k)
{
    return func_binary(s->b, FUNC_MUL, a, func_number(s->b, k));
}

static bool unary_call(Parser *p, Scope *s, int keyword, FuncNode *out)
{
    static const struct { int keyword; FuncOp op; } table[] = {
        { KW_ABS, FUNC_ABS }, { KW_FLOOR, FUNC_FLOOR }, { KW_CEIL, FUNC_CEIL }, { KW_INT, FUNC_INT }, { KW_SQRT, FUNC_SQRT },
        { KW_EXP, FUNC_EXP }, { KW_LN, FUNC_LN }, { KW_LOG, FUNC_LOG }, { KW_SIN, FUNC_SIN }, { KW_COS, FUNC_COS },
        { KW_TAN, FUNC_TAN }, { KW_ASIN, FUNC_ASIN }, { KW_ACOS, FUNC_ACOS }, { KW_ATAN, FUNC_ATAN }, { KW_SINH, FUNC_SINH },
        { KW_COSH, FUNC_COSH }, { KW_TANH, FUNC_TANH }, { KW_ASINH, FUNC_ASINH }, { KW_ACOSH, FUNC_ACOSH },
        { KW_ATANH, FUNC_ATANH },
    };
    if (keyword == KW_RADIANS || keyword == KW_DEGREES) {
        parse_skip(p);
        *out = scaled_by(s, one_argument(p, s), keyword == KW_RADIANS ? PI / 180 : 180 / PI);
        return true;
    }
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (table[i].keyword == keyword) {
            parse_skip(p);
            *out = func_unary(s->b, table[i].op, one_argument(p, s));
            return true;
        }
    return false;
}

static FuncNode power(Parser *p, Scope *s, FuncNode x, FuncNode y)
{
    double v;
    if (func_is_number(s->b, y, &v) && v == 0)
        parse_warn(p, "pow(x,0) is always 1.");
    return func_binary(s->b, FUNC_POW, x, y);
}

static FuncNode select_call(Scope *s, const FuncNode *a, int n)
{
    FuncNode rest = n == 4 ? func_choice(s->b, FUNC_IF_ZERO, a[0], a[2], a[3]) : a[2];
    return func_choice(s->b, FUNC_IF_NEGATIVE, a[0], a[1], rest);
}

static bool many_call(Parser *p, Scope *s, int keyword, FuncNode *out)
{
    enum { MOST = 64 };
    FuncNode a[MOST];
    int least = keyword == KW_SELECT ? 3 : 2, most = keyword == KW_MIN || keyword == KW_MAX ? MOST : keyword == KW_SELECT ? 4 : 2;
    if (keyword != KW_POW && keyword != KW_MOD && keyword != KW_ATAN2 && keyword != KW_DIV && most == 2)
        return false;
    parse_skip(p);
    int n = arguments(p, s, a, most);
    if (n < least)
        parse_fail(p, "'%s' needs %d arguments", parse_word(keyword), least);
    switch (keyword) {
    case KW_POW: *out = power(p, s, a[0], a[1]); break;
    case KW_MOD: *out = func_binary(s->b, FUNC_MOD, a[0], a[1]); break;
    case KW_ATAN2: *out = func_binary(s->b, FUNC_ATAN2, a[0], a[1]); break;
    case KW_DIV: *out = func_unary(s->b, FUNC_INT, func_binary(s->b, FUNC_DIV, a[0], a[1])); break;
    case KW_SELECT: *out = select_call(s, a, n); break;
    default:
        *out = a[0];
        for (int i = 1; i < n; i++)
            *out = func_binary(s->b, keyword == KW_MIN ? FUNC_MIN : FUNC_MAX, *out, a[i]);
        break;
    }
    return true;
}

static const Function *finished(Parser *p, Scope *s, FuncNode result)
{
    const Function *f = func_finish(s->b, result);
    if (f == NULL)
        parse_fail(p, "this function is too complex: it needs too many values at once, or its calls nest too deep");
    return f;
}

/* sum(i, from, to, body), prod(...) */
static FuncNode loop_call(Parser *p, Scope *s, FuncOp op)
{
    parse_skip(p);
    parse_expect(p, TOK_LPAREN);
    int kind = parse_peek(p);
    if (kind != TOK_NAME && !is_parameter_word(kind))
        parse_expected(p, "parameter name");
    Parameter variable = { canonical(kind), kind == TOK_NAME ? p->token.sym : NULL };
    parse_skip(p);
    parse_due_comma(p);
    FuncNode from = logic(p, s);
    parse_due_comma(p);
    FuncNode to = logic(p, s);
    parse_due_comma(p);
    if (s->n >= FUNC_MAX_PARAMETERS)
        parse_fail(p, "too many sums in sums");
    Scope *body = arena_new(&p->temp, Scope);
    *body = *s;
    body->b = func_loop_body(s->b);
    body->parameter[body->n++] = variable;
    FuncNode value = logic(p, body);
    parse_expect(p, TOK_RPAREN);
    return func_loop(s->b, op, from, to, finished(p, body, value));
}

static FuncPart part_of(Parser *p, int terms)
{
    static const struct { int keyword; FuncPart part; } table[] = {
        { KW_X, FUNC_X }, { KW_U, FUNC_X }, { KW_RED, FUNC_X }, { KW_Y, FUNC_Y }, { KW_V, FUNC_Y }, { KW_GREEN, FUNC_Y },
        { KW_Z, FUNC_Z }, { KW_BLUE, FUNC_Z }, { KW_T, FUNC_T }, { KW_FILTER, FUNC_T }, { KW_TRANSMIT, FUNC_FIFTH },
        { KW_GRAY, FUNC_GREY },
    };
    int kind = parse_peek(p);
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (table[i].keyword == kind) {
            if (table[i].part == FUNC_GREY ? terms < 3 : (int)table[i].part >= terms)
                parse_fail(p, "Bad operands for period operator.");
            parse_skip(p);
            return table[i].part;
        }
    if (kind == TOK_NAME && str_is(p->token.sym->text, "hf")) {
        parse_skip(p);
        return FUNC_HF;
    }
    parse_expected(p, "x, y, z, t, u, v or color component");
}

static FuncNode function_call(Parser *p, Scope *s, const Function *f)
{
    FuncNode a[FUNC_MAX_PARAMETERS];
    int n = func_parameters(f);
    parse_expect(p, TOK_LPAREN);
    for (int i = 0; i < n; i++) {
        if (i > 0)
            parse_due_comma(p);
        a[i] = logic(p, s);
    }
    parse_expect(p, TOK_RPAREN);
    if (func_terms(f) == 1)
        return func_apply(s->b, f, a, FUNC_X);
    parse_expect(p, TOK_DOT);
    return func_apply(s->b, f, a, part_of(p, func_terms(f)));
}

/* An identifier of the scene: a function, or a float that is frozen. */
static FuncNode identifier(Parser *p, Scope *s)
{
    const Value *v = p->value;
    if (v != NULL && v->kind == VALUE_FUNCTION) {
        const Function *f = v->function;
        parse_skip(p);
        return function_call(p, s, f);
    }
    if (v == NULL || v->kind != VALUE_NUMBER || v->terms != 1)
        parse_expected(p, "operand");
    double number = v->v[0];
    parse_skip(p);
    return func_number(s->b, number);
}

static FuncNode operand(Parser *p, Scope *s)
{
    int kind = parse_peek(p);
    FuncNode out;
    int i = kind == TOK_NAME || is_parameter_word(kind) ? find_parameter(s, kind, p->token.sym) : -1;
    if (i >= 0) {
        parse_skip(p);
        return func_parameter(s->b, i);
    }
    switch (kind) {
    case TOK_NUMBER:
        out = func_number(s->b, p->token.number);
        parse_skip(p);
        return out;
    case TOK_LPAREN: return one_argument(p, s);
    case KW_PI: parse_skip(p); return func_number(s->b, PI);
    case KW_CLOCK: parse_skip(p); return func_number(s->b, (double)(float)p->options->clock);
    case KW_SUM: return loop_call(p, s, FUNC_SUM);
    case KW_PROD: return loop_call(p, s, FUNC_PROD);
    case TOK_NAME: return identifier(p, s);
    default: break;
    }
    if (unary_call(p, s, kind, &out) || many_call(p, s, kind, &out))
        return out;
    parse_expected(p, "operand");
}

/* ---- operators, from the tightest to the loosest ---- */

static FuncNode factor(Parser *p, Scope *s)
{
    if (parse_accept(p, TOK_MINUS))
        return func_unary(s->b, FUNC_NEG, operand(p, s));
    parse_accept(p, TOK_PLUS);
    return operand(p, s);
}

static FuncNode product(Parser *p, Scope *s)
{
    FuncNode x = factor(p, s);
    for (;;) {
        if (parse_accept(p, TOK_STAR)) {
            x = func_binary(s->b, FUNC_MUL, x, factor(p, s));
        } else if (parse_accept(p, TOK_SLASH)) {
            bool literal = parse_peek(p) == TOK_NUMBER && p->token.number == 0;
            if (literal)
                parse_fail(p, "Division by zero.");
            x = func_binary(s->b, FUNC_DIV, x, factor(p, s));
        } else {
            return x;
        }
    }
}

static FuncNode sum(Parser *p, Scope *s)
{
    FuncNode x = product(p, s);
    for (;;) {
        if (parse_accept(p, TOK_PLUS))
            x = func_binary(s->b, FUNC_ADD, x, product(p, s));
        else if (parse_accept(p, TOK_MINUS))
            x = func_binary(s->b, FUNC_SUB, x, product(p, s));
        else
            return x;
    }
}

static FuncNode relation(Parser *p, Scope *s)
{
    static const struct { int token; FuncOp op; } table[] = {
        { TOK_EQUAL, FUNC_EQ }, { TOK_NOT_EQUAL, FUNC_NE }, { TOK_LESS, FUNC_LT }, { TOK_LESS_EQUAL, FUNC_LE },
        { TOK_GREATER, FUNC_GT }, { TOK_GREATER_EQUAL, FUNC_GE },
    };
    FuncNode x = sum(p, s);
    for (size_t i = 0; i < sizeof table / sizeof *table;) {
        if (parse_accept(p, table[i].token)) {
            x = func_binary(s->b, table[i].op, x, sum(p, s));
            i = 0;
        } else {
            i++;
        }
    }
    return x;
}

static FuncNode conjunction(Parser *p, Scope *s)
{
    FuncNode x = relation(p, s);
    while (parse_accept(p, TOK_AND))
        x = func_binary(s->b, FUNC_AND, x, relation(p, s));
    return x;
}

static FuncNode logic(Parser *p, Scope *s)
{
    cursor_deeper(p);
    FuncNode x = conjunction(p, s);
    while (parse_accept(p, TOK_OR))
        x = func_binary(s->b, FUNC_OR, x, conjunction(p, s));
    p->depth--;
    return x;
}

/* ---- blocks in place of an expression ---- */

typedef struct Ask {                           /* what a FuncHost of this file knows */
    const SdlHost *host;
    const Pattern *pattern;
    const Pigment *pigment;
    const Spline *spline;
    Affine place;
} Ask;

static void ask_pattern(const void *data, const double *a, double *out)
{
    const Ask *ask = data;
    out[0] = ask->host->pattern(ask->host->user, ask->pattern, vec3(a[0], a[1], a[2]));
}

_Static_assert((int)FUNC_MANY <= (int)PATTERN_MANY, "patterns take as many points as functions ask for");

static void points_of(const double *const *a, Vec3 *p, int n)
{
    for (int i = 0; i < n; i++)
        p[i] = vec3(a[0][i], a[1][i], a[2][i]);
}

static void ask_patterns(const void *data, const double *const *a, double (*out)[5], int n)
{
    const Ask *ask = data;
    Vec3 p[FUNC_MANY];
    double v[FUNC_MANY];
    points_of(a, p, n);
    ask->host->patterns(ask->host->user, ask->pattern, p, v, n);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 5; k++)
            out[i][k] = k == 0 ? v[i] : 0;
}

static void give_colour(Colour c, double *out)
{
    out[0] = (double)c.r;
    out[1] = (double)c.g;
    out[2] = (double)c.b;
    out[3] = (double)c.f;
    out[4] = (double)c.t;
}

static void ask_pigment(const void *data, const double *a, double *out)
{
    const Ask *ask = data;
    give_colour(ask->host->pigment(ask->host->user, ask->pigment, vec3(a[0], a[1], a[2])), out);
}

static void ask_pigments(const void *data, const double *const *a, double (*out)[5], int n)
{
    const Ask *ask = data;
    Vec3 p[FUNC_MANY];
    Colour c[FUNC_MANY];
    points_of(a, p, n);
    ask->host->pigments(ask->host->user, ask->pigment, p, c, n);
    for (int i = 0; i < n; i++)
        give_colour(c[i], out[i]);
}

static void ask_transform(const void *data, const double *a, double *out)
{
    Vec3 v = affine_point(&((const Ask *)data)->place, vec3(a[0], a[1], a[2]));
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

static void ask_spline(const void *data, const double *a, double *out)
{
    const Spline *s = ((const Ask *)data)->spline;
    spline_at(s, s->kind, a[0], out);
}

static const Pattern *pattern_block(Parser *p)
{
    parse_skip(p);
    parse_open(p);
    int keyword = parse_peek(p);
    const PatternOps *ops = pattern_row(p, keyword);
    switch (keyword) {
    case KW_SQUARE: case KW_TRIANGULAR: case KW_PAVEMENT: case KW_TILING: case KW_SLOPE: case KW_AOI: case KW_FACETS:
        ops = NULL;
        break;
    default:
        break;
    }
    if (ops == NULL)
        parse_fail(p, "Invalid pattern for function.");
    parse_skip(p);
    PatternDraft d;
    unsigned outer = pattern_depth_begin(p);
    pattern_begin(&d, NULL);
    pattern_choose(p, &d, ops);
    pattern_list_end(p, ops);
    while (pattern_modifier(p, &d))
        continue;
    const Pattern *pattern = pattern_close(p, &d);
    pattern_depth_end(p, outer, pattern->depth);
    parse_close(p);
    return pattern;
}

static const Function *internal(Parser *p)
{
    parse_skip(p);
    parse_expect(p, TOK_LPAREN);
    int n = parse_int(p);
    parse_expect(p, TOK_RPAREN);
    const Function *f = func_internal(p->arena, n, &parse_blocks(p)->scene->globals.noise_generator);
    if (f == NULL)
        parse_fail(p, "Function 'internal(%d)' does not exist.", n);
    return f;
}

/* Patterns may call functions that ask patterns: what uses a function from now on goes deeper by this. */
static void function_holds(Parser *p, const Pattern *pattern)
{
    Blocks *b = parse_blocks(p);
    if (pattern_depth(pattern) > b->function_depth)
        b->function_depth = pattern_depth(pattern);
}

/* NULL, and nothing taken, if no such block comes. */
static const Function *special(Parser *p)
{
    int kind = parse_peek(p);
    if (kind == KW_INTERNAL)
        return internal(p);
    if (kind != KW_PATTERN && kind != KW_PIGMENT && kind != KW_TRANSFORM && kind != KW_SPLINE)
        return NULL;
    Ask *ask = arena_new(p->arena, Ask);
    ask->host = arena_copy(p->arena, p->host, sizeof *p->host);
    FuncHost host = { .data = ask, .parameters = 3, .terms = 1 };
    if (kind == KW_PATTERN) {
        host.call = ask_pattern;
        host.calls = ask_patterns;
        ask->pattern = pattern_block(p);
    } else if (kind == KW_PIGMENT) {
        host.call = ask_pigment;
        host.calls = ask_pigments;
        host.terms = 5;
        ask->pigment = parse_pigment(p);
        function_holds(p, ask->pigment->pattern);
    } else if (kind == KW_TRANSFORM) {
        host.call = ask_transform;
        host.terms = 3;
        ask->place = affine_identity();
        parse_transform(p, &ask->place);
    } else {
        Value v = { 0 };
        spline_parse(p, &v);
        ask->spline = v.spline;
        host.call = ask_spline;
        host.parameters = 1;
        host.terms = v.spline->terms;
    }
    return func_of_host(p->arena, &host);
}

static const Function *body(Parser *p, Scope *s, bool may_be_special)
{
    parse_open(p);
    const Function *f = may_be_special ? special(p) : NULL;
    if (f == NULL) {
        s->b = func_builder(p->arena, s->n);
        f = finished(p, s, logic(p, s));
    }
    parse_close(p);
    return f;
}

const Function *parse_function(Parser *p, const char *const *parameters, int n_parameters)
{
    Scope s = { 0 };
    for (int i = 0; i < n_parameters; i++) {
        char c = parameters[i][0];
        s.parameter[s.n++].keyword = c == 'x' || c == 'u' ? KW_X : c == 'y' || c == 'v' ? KW_Y : KW_Z;
    }
    parse_accept(p, KW_FUNCTION);
    return body(p, &s, true);
}

const Function *function_declaration(Parser *p)
{
    Scope s = { 0 };
    parse_expect(p, KW_FUNCTION);
    bool listed = parse_accept(p, TOK_LPAREN);
    while (listed && !parse_accept(p, TOK_RPAREN)) {
        add_parameter(p, &s);
        if (parse_accept(p, TOK_COMMA) && parse_peek(p) == TOK_RPAREN)
            parse_expected(p, "parameter identifier");
    }
    if (!listed) {
        static const int names[] = { KW_X, KW_Y, KW_Z };
        for (s.n = 0; s.n < 3; s.n++)
            s.parameter[s.n].keyword = names[s.n];
    }
    return body(p, &s, !listed);
}
