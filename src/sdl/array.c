/* array.c - arrays (01-language, section 11). */
#include "sdl/parser.h"

enum { MAX_ITEMS = 1 << 24 };

static int64_t whole(Parser *p)
{
    double v = expr_float(p) + EPSILON;
    return v >= 0 && v <= 1e15 ? (int64_t)v : -1;
}

/* The value is looked at again after each subscript: reading one may run directives that declare the array anew. */
Value *array_target(Parser *p, Value *array, ValueArray **owner)
{
    bool was = p->suspended;
    p->suspended = false;
    cursor_deeper(p);
    Value *v = array;
    do {
        uint32_t n_dimensions = v->array->n_dimensions, at = 0;
        for (uint32_t i = 0; i < n_dimensions; i++) {
            parse_expect(p, TOK_LBRACKET);
            int64_t k = whole(p);
            Loc loc = cursor_loc(p);
            parse_expect(p, TOK_RBRACKET);
            if (k < 0)
                fail(p->diag, loc, "Negative subscript");
            if (v->kind != VALUE_ARRAY || v->array->n_dimensions != n_dimensions || k >= v->array->size[i])
                fail(p->diag, loc, "Array subscript out of range");
            at = at * v->array->size[i] + (uint32_t)k;
        }
        if (at >= v->array->n)
            fail(p->diag, cursor_loc(p), "Array subscript out of range");
        *owner = v->array;
        v = &v->array->item[at];
    } while (v->kind == VALUE_ARRAY && cursor_raw_at(p, TOK_LBRACKET, '['));
    p->depth--;
    p->suspended = was;
    return v;
}

Value *array_subscript(Parser *p, Value *array)
{
    ValueArray *owner;
    return array_target(p, array, &owner);
}

void array_check_type(Parser *p, ValueArray *array, const Value *v, Loc loc)
{
    if (array->type.kind == VALUE_NONE)
        array->type = (Value){ .kind = v->kind, .terms = v->terms, .block = v->block };
    else if (!value_same_type(&array->type, v))
        fail(p->diag, loc, "Attempted to redefine %s as %s.", value_type_name(&array->type), value_type_name(v));
}

/* POV: an item may call macros and run directives further on, but not begin with one. Here loops may write items. */
static void begin_item(Parser *p)
{
    if (p->have)
        return;
    cursor_raw(p, &p->token);
    p->have = true;
    const Value *v = p->token.kind == TOK_NAME ? symbol_value(p->token.sym) : NULL;
    if (p->token.kind == TOK_HASH || (v != NULL && v->kind == VALUE_MACRO))
        parse_mend(p, "An item of an array that begins with a directive or a macro call");
    cursor_fetch(p);                           /* from where it stands: runs what it names */
}

static void initialise(Parser *p, ValueArray *a, uint32_t dimension, uint32_t *at)
{
    parse_open(p);
    for (uint32_t i = 0; i < a->size[dimension]; i++) {
        begin_item(p);
        if (dimension + 1 < a->n_dimensions) {
            initialise(p, a, dimension + 1, at);
        } else {
            Value *item = &a->item[(*at)++];
            Loc loc = parse_loc(p);
            value_parse(p, item, false);
            array_check_type(p, a, item, loc);
        }
        parse_comma(p);
    }
    if (parse_peek(p) != TOK_CLOSE)
        fail(p->diag, parse_loc(p), "No matching } in '{', %s found instead", token_description(p));
    parse_close(p);
}

void array_parse(Parser *p, Value *out)
{
    Loc loc = parse_loc(p);
    uint32_t size[ARRAY_MAX_DIMENSIONS], n_dimensions = 0;
    int64_t n = 1;
    parse_skip(p);
    do {
        if (n_dimensions == ARRAY_MAX_DIMENSIONS)
            fail(p->diag, loc, "Too many array dimensions");
        parse_expect(p, TOK_LBRACKET);
        int64_t k = whole(p);
        parse_expect(p, TOK_RBRACKET);
        if (k <= 0)
            fail(p->diag, loc, "Invalid dimension size for an array");
        if (k > MAX_ITEMS || (n *= k) > MAX_ITEMS)
            fail(p->diag, loc, "an array can have at most %d items", MAX_ITEMS);
        size[n_dimensions++] = (uint32_t)k;
    } while (cursor_raw_at(p, TOK_LBRACKET, '['));
    ValueArray *a = value_array_new(p, (uint32_t)n);
    a->n_dimensions = n_dimensions;
    for (uint32_t i = 0; i < n_dimensions; i++)
        a->size[i] = size[i];
    *out = (Value){ .kind = VALUE_ARRAY, .array = a };
    uint32_t at = 0;
    if (cursor_raw_at(p, TOK_OPEN, '{'))
        initialise(p, a, 0, &at);
}
