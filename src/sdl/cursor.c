/* cursor.c - hands out the next token that counts: the stack of readers, includes, and captured bodies.
 *
 * A loop in a file is captured once, from its directive to its #end, as an array of tokens in which every directive knows
 * the index of its next branch; turning and skipping is then a matter of setting an index. Conditionals outside of
 * loops and macros run straight off the text. What the directives do with all this is in flow.c. */
#include <string.h>

#include "sdl/parser.h"

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
    Reader *r = cursor_top(p);
    return r->is_file ? lex_loc(&r->lexer) : r->at < r->n ? r->tokens[r->at].loc : r->called;
}

Reader *cursor_push_reader(Parser *p, Loc loc)
{
    if (p->n_readers == MAX_READERS)
        fail(p->diag, loc, "Too many nested conditionals or macros.");
    Reader *r = &p->reader[p->n_readers++];
    r->is_file = r->has_table = false;         /* one by one: the lexer is set by who reads a file */
    r->tokens = NULL;
    r->at = r->n = 0;
    r->macro = NULL;
    r->called = loc;
    r->n_conditionals = p->n_conditionals;
    return r;
}

Conditional *cursor_push_conditional(Parser *p, ConditionalKind kind, Loc loc)
{
    if (p->n_conditionals == MAX_CONDITIONALS)
        fail(p->diag, loc, "Too many nested conditionals or macros.");
    Conditional *c = &p->conditional[p->n_conditionals++];
    *c = (Conditional){ .kind = kind, .reader = p->n_readers - 1, .loc = loc, .busy = kind != COND_MACRO };
    return c;
}

/* The reader on top has nothing left. False at the end of the main file. */
bool cursor_end_reader(Parser *p)
{
    Reader *r = cursor_top(p);
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

void cursor_raw(Parser *p, Token *out)
{
    for (;;) {
        Reader *r = cursor_top(p);
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
        if (!cursor_end_reader(p)) {
            out->kind = TOK_END;
            return;
        }
    }
}

bool cursor_raw_at(Parser *p, int kind, char c)
{
    if (p->have)
        return p->token.kind == kind;
    Reader *r = cursor_top(p);
    if (r->is_file)
        return lex_peek_char(p, &r->lexer) == c;
    return r->at < r->n && r->tokens[r->at].kind == kind;
}

bool cursor_raw_accept(Parser *p, int kind, char c)
{
    if (!p->have)
        for (Reader *r = cursor_top(p); !r->is_file && r->at == r->n && r->macro && cursor_end_reader(p);)
            r = cursor_top(p);
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
    Reader *top = cursor_top(p);
    if (!p->have && top->is_file) {            /* most tokens are what they are */
        lex_next(p, &top->lexer, &p->token);
        p->have = p->token.kind != TOK_END;
        p->value = NULL;
        if (p->have && p->token.kind != TOK_HASH && p->token.kind != TOK_NAME)
            return;
    }
    for (;;) {
        Reader *r = cursor_top(p);
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

static void start_file(Parser *p, Reader *r, uint16_t source, Str text)
{
    r->is_file = true;
    lex_start(&r->lexer, source, text);
    if (text.n && r->lexer.at != text.data)    /* a UTF-8 mark says how strings are written */
        p->charset = CHARSET_UTF8;
}

void cursor_start(Parser *p, uint16_t source, Str text)
{
    Reader *r = cursor_push_reader(p, (Loc){ 0 });
    start_file(p, r, source, text);
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
    Reader *r = cursor_push_reader(p, loc);
    r->has_table = true;
    start_file(p, r, source, text);
    p->n_includes++;
}

void cursor_enter_macro(Parser *p, const Macro *macro, Loc called)
{
    Conditional *c = cursor_push_conditional(p, COND_MACRO, called);
    Reader *r = cursor_push_reader(p, called);
    r->tokens = macro->token;
    r->at = macro->first;
    r->n = macro->last;
    r->macro = macro;
    r->has_table = true;                       /* pushed by the caller, with the parameters in it */
    c->reader = p->n_readers - 1;
}

/* -- Captured bodies -- */

bool cursor_opens(int directive)
{
    switch (directive) {
    case KW_IF: case KW_IFDEF: case KW_IFNDEF: case KW_WHILE: case KW_FOR: case KW_SWITCH: case KW_MACRO: return true;
    default: return false;
    }
}

bool cursor_branches(int directive)
{
    return directive == KW_ELSE || directive == KW_ELSEIF || directive == KW_CASE || directive == KW_RANGE;
}

static uint64_t capture_key(const Parser *p, const Lexer *l)
{
    const char *start = l->feed != NULL ? l->feed->data : diag_source_text(p->diag, l->source).data;
    return (uint64_t)l->source << 40 | (lex_base(l) + (uint64_t)(l->at - start));
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

/* The tokens that a body begins with: most are not longer, and are lexed only once. */
enum { BEGINNING = 500 };
typedef struct Beginning {
    Token token[BEGINNING];
    uint32_t n;
    Lexer after;
    uint64_t base;                             /* of that */
} Beginning;

/* How many tokens there are from `first`, which has been read, to its #end. */
static uint32_t count_body(Parser *p, Lexer l, const Token *first, Beginning *b)
{
    uint32_t n = 1, n_open = 1;
    b->token[0] = *first;
    while (n_open) {
        Token t;
        lex_next(p, &l, &t);
        if (n < BEGINNING) {
            b->token[n] = t;
            b->n = n + 1;
            b->after = l;
            b->base = lex_base(&l);
        }
        if (t.kind == TOK_END && p->n_includes > 1 && (first->directive == KW_WHILE || first->directive == KW_FOR))
            fail(p->diag, first->loc, "#%s loop did not end in file where it started.",
                 first->directive == KW_FOR ? "for" : "while");
        if (t.kind == TOK_END)
            fail(p->diag, first->loc, "End of file reached but #end expected.");
        n++;
        if (t.kind != TOK_HASH)
            continue;
        if (cursor_opens(t.directive) && ++n_open > MAX_CONDITIONALS)
            fail(p->diag, t.loc, "Too many nested conditionals or macros.");
        n_open -= t.directive == KW_END;
    }
    return n;
}

/* Lexes on to that #end, what is long twice: a body may be a mesh of millions of tokens, for which no array is allowed to grow by
 * copying. Links the directives. The same place of the same file gives the same array again: an include that is read a
 * thousand times is captured once. */
const Capture *cursor_capture(Parser *p, Lexer *l, const Token *first)
{
    uint64_t key = capture_key(p, l);
    uint32_t slot = 0, open[MAX_CONDITIONALS], n_open = 0;
    const Capture *known = find_capture(p, key, &slot);
    if (known)
        return known;
    Beginning beginning;
    uint32_t n = count_body(p, *l, first, &beginning);
    Token *tokens = arena_array(p->arena, Token, (size_t)n + 1);
    tokens[n].kind = TOK_END;
    memcpy(tokens, beginning.token, beginning.n * sizeof *tokens);
    *l = beginning.after;
    lex_resume(l, beginning.base);
    open[n_open++] = 0;
    for (uint32_t at = 1; at < n; at++) {
        Token *t = &tokens[at];
        if (at >= beginning.n)
            lex_next(p, l, t);
        if (t->kind != TOK_HASH)
            continue;
        if (t->directive == KW_END)
            tokens[open[--n_open]].n = at;
        else if (cursor_branches(t->directive))
            open[n_open - 1] = tokens[open[n_open - 1]].n = at;
        else if (cursor_opens(t->directive))
            open[n_open++] = at;
    }
    array_push(p->arena, &p->capture, (Capture){ .key = key, .token = tokens, .n = n, .after = *l });
    p->capture_slot[slot] = p->capture.n;
    return &p->capture.data[p->capture.n - 1];
}

/* Index of the #end that closes the directive at i. */
uint32_t cursor_end_of(const Token *tokens, uint32_t i)
{
    while (tokens[i].directive != KW_END)
        i = tokens[i].n;
    return i;
}

const Token *cursor_body(Parser *p, const Token *directive, uint32_t at, uint32_t *first, uint32_t *last)
{
    Reader *r = cursor_top(p);
    if (r->is_file) {
        const Capture *c = cursor_capture(p, &r->lexer, directive);
        r->lexer = c->after;
        *first = 1;
        *last = c->n - 1;
        return c->token;
    }
    *first = r->at;
    *last = cursor_end_of(r->tokens, at);
    r->at = *last + 1;
    return r->tokens;
}

uint32_t cursor_here(Parser *p)
{
    Reader *r = cursor_top(p);
    return r->is_file ? 0 : r->at - 1;
}
