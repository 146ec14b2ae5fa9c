/* cursor.c - hands out the next token that counts: the stack of readers, includes, conditionals and loops.
 *
 * A loop in a file is captured once, from its directive to its #end, as an array of tokens in which every directive knows
 * the index of its next branch; turning and skipping is then a matter of setting an index. Conditionals outside of
 * loops and macros run straight off the text. */
#include "sdl/parser.h"

static inline Reader *top(Parser *p)
{
    return &p->reader[p->n_readers - 1];
}

void cursor_stop_check(Parser *p)
{
    if (p->options->stop && *p->options->stop)
        fail(p->diag, cursor_loc(p), "stopped");
}

void cursor_deeper(Parser *p)
{
    if (++p->depth > MAX_DEPTH)
        fail(p->diag, cursor_loc(p), "nested too deeply: more than %d levels", MAX_DEPTH);
}

Loc cursor_loc(Parser *p)
{
    if (p->have)
        return p->token.loc;
    if (!p->n_readers)
        return (Loc){ 0 };
    Reader *r = top(p);
    return r->is_file ? lex_loc(&r->lexer) : r->at < r->n ? r->tokens[r->at].loc : r->called;
}

static Reader *push_reader(Parser *p, Loc loc)
{
    if (p->n_readers == MAX_READERS)
        fail(p->diag, loc, "Too many nested conditionals or macros.");
    Reader *r = &p->reader[p->n_readers++];
    *r = (Reader){ .called = loc, .n_conditionals = p->n_conditionals };
    return r;
}

static Conditional *push_conditional(Parser *p, ConditionalKind kind, Loc loc)
{
    if (p->n_conditionals == MAX_CONDITIONALS)
        fail(p->diag, loc, "Too many nested conditionals or macros.");
    Conditional *c = &p->conditional[p->n_conditionals++];
    *c = (Conditional){ .kind = kind, .reader = p->n_readers - 1, .loc = loc, .busy = kind != COND_MACRO };
    return c;
}

/* The reader on top has nothing left. False at the end of the main file. */
static bool end_reader(Parser *p)
{
    Reader *r = top(p);
    if (p->n_readers == 1)
        return false;
    if (r->macro)
        p->n_conditionals = r->n_conditionals - 1;             /* the call's own, and what a break left open */
    /* An #if may begin in an include and end behind it; a loop may not, nor may it inside a captured body. */
    for (uint32_t i = p->n_conditionals; i-- > 0 && p->conditional[i].reader == p->n_readers - 1;) {
        Conditional *c = &p->conditional[i];
        if (!r->is_file || !p->reader[p->n_readers - 2].is_file || c->kind != COND_IF)
            fail(p->diag, c->loc, "#%s did not end in the file where it started.",
                 c->kind == COND_SWITCH ? "switch" : c->kind == COND_IF ? "if" : "while loop");
        c->reader--;
    }
    if (r->is_file)
        p->n_includes--;
    if (r->has_table)
        symbol_pop_table(p);
    p->n_readers--;
    return true;
}

/* The parentheses of the conditional on top have been read. They must end in the same text or array as they began: what
 * follows goes on with an index into it. */
static Conditional *settled(Parser *p)
{
    for (Reader *r = top(p); r->macro && r->at == r->n; r = top(p))
        end_reader(p);
    Conditional *c = &p->conditional[p->n_conditionals - 1];
    if (c->kind == COND_MACRO || p->n_readers - 1 != c->reader)
        fail(p->diag, c->loc, "the parentheses of a directive must end in the file or macro where they began");
    c->busy = false;
    return c;
}

void cursor_raw(Parser *p, Token *out)
{
    for (;;) {
        Reader *r = top(p);
        if (r->is_file) {
            lex_next(p, &r->lexer, out);
            if (out->kind != TOK_END)
                return;
        } else if (r->at < r->n) {
            *out = r->tokens[r->at++];
            return;
        } else {
            out->loc = r->called;
        }
        if (!end_reader(p)) {
            out->kind = TOK_END;
            return;
        }
    }
}

bool cursor_raw_at(Parser *p, int kind, char c)
{
    if (p->have)
        return p->token.kind == kind;
    Reader *r = top(p);
    if (r->is_file)
        return lex_peek_char(p, &r->lexer) == c;
    return r->at < r->n && r->tokens[r->at].kind == kind;
}

bool cursor_raw_accept(Parser *p, int kind, char c)
{
    if (!p->have)
        for (Reader *r = top(p); !r->is_file && r->at == r->n && r->macro && end_reader(p);)
            r = top(p);
    if (!cursor_raw_at(p, kind, c))
        return false;
    if (p->have) {
        p->have = false;
        return true;
    }
    Token taken;
    cursor_raw(p, &taken);
    return true;
}

/* The value of the name in the look-ahead, through subscripts if it is an array. */
static void resolve(Parser *p)
{
    Binding *b = p->token.sym->binding;
    p->value = b ? b->value : NULL;
    if (!b)
        return;
    if (b->deprecated) {
        warn(p->diag, p->token.loc, "%.*s", STR_ARGS(b->message));
        b->deprecated = !b->deprecated_once;
    }
    if (p->value->kind == VALUE_ARRAY && cursor_raw_at(p, TOK_LBRACKET, '[')) {
        Token name = p->token;
        p->value = array_subscript(p, p->value);
        p->token = name;
        p->have = true;
        if (p->value->kind == VALUE_NONE)
            fail(p->diag, name.loc, "Attempt to access uninitialized array element.");
    }
}

void cursor_fetch(Parser *p)
{
    for (;;) {
        Reader *r = top(p);
        if (!p->have && !r->is_file && !p->suspended && r->at < r->n && r->tokens[r->at].kind == TOK_HASH) {
            directive_run(p, &r->tokens[r->at++]);             /* the common case in loops, without copies */
            if (p->have && p->token.kind != TOK_HASH)
                return;
            continue;
        }
        if (!p->have)
            cursor_raw(p, &p->token);
        p->have = true;
        p->value = NULL;
        if (p->token.kind == TOK_HASH) {
            if (p->suspended)
                return;
            Token directive = p->token;
            p->have = false;
            directive_run(p, &directive);
            if (p->have && p->token.kind != TOK_HASH)
                return;                        /* the directive looked ahead: that has been through here already */
        } else if (p->token.kind == TOK_NAME) {
            Value *v = symbol_value(p->token.sym);
            if (!v || v->kind != VALUE_MACRO) {
                p->have = false;
                Token name = p->token;
                resolve(p);
                p->token = name;
                p->have = true;
                return;
            }
            Loc loc = p->token.loc;
            p->have = false;
            macro_call(p, v->macro, loc);
            if (p->have)
                return;
        } else {
            return;
        }
    }
}

/* -- Includes -- */

/* The chain of includes and macro calls that leads to where the parser stands, innermost first. */
static Str chain(void *user, Arena *a)
{
    enum { SHOWN = 12 };
    Parser *p = user;
    Str text = { 0 };
    uint32_t shown = 0;
    for (uint32_t i = p->n_readers; i-- > 1;) {
        const Reader *r = &p->reader[i];
        if (!r->is_file && !r->macro)
            continue;
        if (++shown > SHOWN)
            return str_concat(a, text, str_of("\n  ..."));
        Str place = str_format(a, "%.*s:%u:%u", STR_ARGS(diag_source_name(p->diag, r->called.source)), r->called.line,
                               r->called.column);
        Str line = r->macro ? str_format(a, "\n  in macro %.*s called at %.*s", STR_ARGS(r->macro->name->text), STR_ARGS(place))
                            : str_format(a, "\n  in %.*s included at %.*s",
                                         STR_ARGS(diag_source_name(p->diag, r->lexer.source)), STR_ARGS(place));
        text = str_concat(a, text, line);
    }
    return text;
}

void cursor_start(Parser *p, uint16_t source, Str text)
{
    Reader *r = push_reader(p, (Loc){ 0 });
    r->is_file = true;
    lex_start(&r->lexer, source, text);
    p->n_includes = 1;
    diag_chain(p->diag, chain, p);
}

void cursor_include(Parser *p, Str name, Loc loc)
{
    cursor_stop_check(p);
    if (p->n_includes == MAX_INCLUDES)
        fail(p->diag, loc, "Too many nested include files.");
    uint16_t source = 0;
    Str text = file_find(p, name, FILE_INCLUDE_EXTENSIONS, loc, true, &source, true);
    symbol_push_table(p, loc);
    Reader *r = push_reader(p, loc);
    r->is_file = true;
    r->has_table = true;
    lex_start(&r->lexer, source, text);
    p->n_includes++;
}

void cursor_enter_macro(Parser *p, const Macro *macro, Loc called)
{
    Conditional *c = push_conditional(p, COND_MACRO, called);
    Reader *r = push_reader(p, called);
    r->tokens = macro->token;
    r->at = macro->first;
    r->n = macro->last;
    r->macro = macro;
    r->has_table = true;                       /* pushed by the caller, with the parameters in it */
    c->reader = p->n_readers - 1;
}

/* -- Captured bodies -- */

static bool opens(int directive)
{
    switch (directive) {
    case KW_IF: case KW_IFDEF: case KW_IFNDEF: case KW_WHILE: case KW_FOR: case KW_SWITCH: case KW_MACRO: return true;
    default: return false;
    }
}

static bool branches(int directive)
{
    return directive == KW_ELSE || directive == KW_ELSEIF || directive == KW_CASE || directive == KW_RANGE;
}

static uint64_t capture_key(const Parser *p, const Lexer *l)
{
    return (uint64_t)l->source << 40 | (uint64_t)(l->at - diag_source_text(p->diag, l->source).data);
}

static const Capture *find_capture(Parser *p, uint64_t key, uint32_t *slot)
{
    if ((p->capture.n + 1) * 2 > p->capture_mask + 1 || !p->capture_slot) {
        uint32_t size = p->capture_slot ? (p->capture_mask + 1) * 2 : 64;
        p->capture_slot = arena_array(p->arena, uint32_t, size);
        p->capture_mask = size - 1;
        for (uint32_t i = 0; i < p->capture.n; i++) {
            uint32_t at = (uint32_t)((p->capture.data[i].key * 0x9e3779b97f4a7c15u) >> 32) & p->capture_mask;
            while (p->capture_slot[at])
                at = (at + 1) & p->capture_mask;
            p->capture_slot[at] = i + 1;
        }
    }
    uint32_t at = (uint32_t)((key * 0x9e3779b97f4a7c15u) >> 32) & p->capture_mask;
    for (; p->capture_slot[at]; at = (at + 1) & p->capture_mask)
        if (p->capture.data[p->capture_slot[at] - 1].key == key)
            return &p->capture.data[p->capture_slot[at] - 1];
    *slot = at;
    return NULL;
}

/* Lexes on to the #end that belongs to `first`, which has been read, and links the directives. The same place of the same
 * file gives the same array again: an include that is read a thousand times is captured once. */
static const Capture *capture(Parser *p, Lexer *l, const Token *first)
{
    uint64_t key = capture_key(p, l);
    uint32_t slot = 0, open[MAX_CONDITIONALS], n_open = 0;
    const Capture *known = find_capture(p, key, &slot);
    if (known)
        return known;
    ARRAY(Token) tokens = { 0 };
    ArenaMark mark = arena_mark(&p->temp);
    array_push(&p->temp, &tokens, *first);
    open[n_open++] = 0;
    while (n_open) {
        Token t;
        lex_next(p, l, &t);
        if (t.kind == TOK_END && p->n_includes > 1 && (first->directive == KW_WHILE || first->directive == KW_FOR))
            fail(p->diag, first->loc, "#%s loop did not end in file where it started.",
                 first->directive == KW_FOR ? "for" : "while");
        if (t.kind == TOK_END)
            fail(p->diag, first->loc, "End of file reached but #end expected.");
        uint32_t at = tokens.n;
        array_push(&p->temp, &tokens, t);
        if (t.kind != TOK_HASH)
            continue;
        if (opens(t.directive)) {
            if (n_open == MAX_CONDITIONALS)
                fail(p->diag, t.loc, "Too many nested conditionals or macros.");
            open[n_open++] = at;
        } else if (t.directive == KW_END) {
            tokens.data[open[--n_open]].n = at;
        } else if (branches(t.directive)) {
            tokens.data[open[n_open - 1]].n = at;
            open[n_open - 1] = at;
        }
    }
    Capture c = { .key = key, .n = tokens.n, .after = *l };
    c.token = arena_copy(p->arena, tokens.data, (size_t)tokens.n * sizeof(Token));
    arena_rewind(&p->temp, mark);
    array_push(p->arena, &p->capture, c);
    p->capture_slot[slot] = p->capture.n;
    return &p->capture.data[p->capture.n - 1];
}

/* Index of the #end that closes the directive at i. */
static uint32_t end_of(const Token *tokens, uint32_t i)
{
    while (tokens[i].directive != KW_END)
        i = tokens[i].n;
    return i;
}

const Token *cursor_body(Parser *p, const Token *directive, uint32_t at, uint32_t *first, uint32_t *last)
{
    Reader *r = top(p);
    if (r->is_file) {
        const Capture *c = capture(p, &r->lexer, directive);
        r->lexer = c->after;
        *first = 1;
        *last = c->n - 1;
        return c->token;
    }
    *first = r->at;
    *last = end_of(r->tokens, at);
    r->at = *last + 1;
    return r->tokens;
}

/* -- Skipping -- */

/* In a file: lexes on to the directive that ends a skipped branch, a branch of this level or (levels further out) an #end.
 * An include that ends meanwhile hands over to the file that included it. */
static void skip_text(Parser *p, bool to_branch, uint32_t levels, Token *out)
{
    Loc start = cursor_loc(p);
    uint32_t nested = 0;
    for (;;) {
        Reader *r = top(p);
        lex_next(p, &r->lexer, out);
        if (out->kind == TOK_END) {
            if (p->n_readers == 1 || !p->reader[p->n_readers - 2].is_file)
                fail(p->diag, start, "End of file reached but #end expected.");
            end_reader(p);
        }
        if (out->kind != TOK_HASH)
            continue;
        if (opens(out->directive)) {
            nested++;
        } else if (out->directive == KW_END) {
            if (nested == 0 && levels == 0)
                return;
            if (nested)
                nested--;
            else
                levels--;
        } else if (nested == 0 && levels == 0 && to_branch && branches(out->directive)) {
            return;
        }
    }
}

/* To the next branch of the conditional on top, or its #end: returned, and taken. `from` is the directive of the
 * branch that is left, at_index its place if the reader is an array. */
static void skip_branch(Parser *p, uint32_t at_index, Token *out)
{
    Reader *r = top(p);
    if (r->is_file) {
        skip_text(p, true, 0, out);
        return;
    }
    uint32_t next = r->tokens[at_index].n;
    *out = r->tokens[next];
    r->at = next + 1;
}

static _Noreturn void mismatched(Parser *p, const Token *t)
{
    if (t->directive == KW_CASE || t->directive == KW_RANGE)
        fail(p->diag, t->loc, "Mis-matched '#case' or '#range'.");
    fail(p->diag, t->loc, "Mis-matched '#%s'.", token_keyword_text(t->directive));
}

/* -- #if, #ifdef, #ifndef, #switch -- */

uint32_t cursor_here(Parser *p)
{
    Reader *r = top(p);
    return r->is_file ? 0 : r->at - 1;
}

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
bool cursor_is_defined(Parser *p)
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
    } else if (t.kind >= N_KEYWORDS) {
        p->token = t;
        p->have = true;
        parse_expected(p, "identifier");
    }
    parse_expect(p, TOK_RPAREN);
    p->suspended = was;
    return defined;
}

static bool test_of(Parser *p, int directive)
{
    if (directive == KW_IFDEF || directive == KW_IFNDEF)
        return cursor_is_defined(p) == (directive == KW_IFDEF);
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
    push_conditional(p, COND_IF, t->loc);
    if (!test(p, t->directive))
        choose_branch(p, at);
}

static void skip_to_end(Parser *p, uint32_t at)
{
    Reader *r = top(p);
    Token t;
    if (r->is_file)
        skip_text(p, false, 0, &t);
    else
        r->at = end_of(r->tokens, at) + 1;
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
    push_conditional(p, COND_SWITCH, t->loc);
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
    return c->reader == p->n_readers - 1 || (c->kind == COND_IF && top(p)->is_file) ? c : NULL;
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
    Reader *r = top(p);
    if (r->is_file) {
        const Capture *c = capture(p, &r->lexer, t);
        r->lexer = c->after;
        const Token *token = c->token;
        uint32_t n = c->n;
        r = push_reader(p, t->loc);
        r->tokens = token;
        r->n = n;
        r->at = 1;
    }
    return r->at - 1;
}

static void end_loop(Parser *p, uint32_t start)
{
    Reader *r = top(p);
    r->at = end_of(r->tokens, start) + 1;
    p->n_conditionals--;
}

static void while_turn(Parser *p, uint32_t start)
{
    cursor_stop_check(p);
    top(p)->at = start + 1;
    if (!test(p, KW_WHILE))
        end_loop(p, start);
}

static void run_while(Parser *p, const Token *t)
{
    uint32_t start = loop_start(p, t);
    push_conditional(p, COND_WHILE, t->loc)->start = start;
    while_turn(p, start);
}

static void for_turn(Parser *p, Conditional *c, double value)
{
    cursor_stop_check(p);
    bool runs = c->step > 0 ? value <= c->end + EPSILON : value >= c->end - EPSILON;
    if (runs)
        top(p)->at = c->body;
    else
        end_loop(p, c->start);
}

static void run_for(Parser *p, const Token *t)
{
    uint32_t start = loop_start(p, t);
    push_conditional(p, COND_FOR, t->loc)->start = start;
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
    if (parse_accept(p, TOK_COMMA))
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
    c->body = top(p)->at;
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
        end_reader(p);
    Reader *r = top(p);
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
            if (opens(r->tokens[at].directive))
                depth++;
            else if (r->tokens[at].directive == KW_END && depth-- == 0)
                break;
        }
        r->at = at + 1;
        p->n_conditionals--;
    }
}

/* Every loop turns on directives, and endless recursion ends by itself: asking here is enough. */
static void check_interrupt(Parser *p, Loc loc)
{
    if (p->options->interrupted != NULL && *p->options->interrupted)
        fail(p->diag, loc, "Interrupted.");
}

bool cursor_directive(Parser *p, const Token *t)
{
    check_interrupt(p, t->loc);
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
