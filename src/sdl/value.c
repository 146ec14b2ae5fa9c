/* value.c - what an identifier can hold; see value.h. */
#include "sdl/value.h"

#include <string.h>

#include "sdl/parser.h"

const char *value_type_name(const Value *v)
{
    static const char *const number[] = { "", "float identifier", "uv vector identifier", "vector identifier",
                                          "4d vector identifier", "color identifier" };
    static const char *const block[] = {
        "", "pigment identifier", "normal identifier", "finish identifier", "texture identifier", "material identifier",
        "interior identifier", "media identifier", "density identifier", "color_map identifier", "pigment_map identifier",
        "normal_map identifier", "slope_map identifier", "texture_map identifier", "density_map identifier",
        "transform identifier", "camera identifier", "fog identifier", "rainbow identifier", "sky_sphere identifier",
        "object identifier",
    };
    switch ((ValueKind)v->kind) {
    case VALUE_NONE: return "undeclared identifier";
    case VALUE_NUMBER: return number[v->terms];
    case VALUE_STRING: return "string identifier";
    case VALUE_ARRAY: return "array identifier";
    case VALUE_SPLINE: return "spline identifier";
    case VALUE_FUNCTION: return "function identifier";
    case VALUE_FILE: return "file identifier";
    case VALUE_MACRO: return "macro identifier";
    case VALUE_BLOCK: return block[v->block];
    }
    return "identifier";
}

bool value_same_type(const Value *a, const Value *b)
{
    return a->kind == b->kind && (a->kind != VALUE_NUMBER || a->terms == b->terms)
        && (a->kind != VALUE_BLOCK || a->block == b->block);
}

/* Arrays come from lists of their own: whoever still points at an item of an array that is gone (a parameter passed by
 * reference, whose array was declared anew) finds memory that holds Values, perhaps empty ones, and nothing else. */
static unsigned item_class(uint32_t n)
{
    unsigned c = 0;
    while ((uint64_t)1 << c < n)
        c++;
    return c;
}

ValueArray *value_array_new(Parser *p, uint32_t n)
{
    ValueArray *a = p->free_arrays;
    if (a) {
        p->free_arrays = a->next_free;
        *a = (ValueArray){ 0 };
    } else {
        a = arena_new(p->arena, ValueArray);
    }
    unsigned c = item_class(n);
    Value *item = p->free_items[c];
    if (item) {
        p->free_items[c] = item->next_free;
        memset(item, 0, n * sizeof *item);
    } else {
        item = arena_array(p->arena, Value, (size_t)1 << c);
    }
    a->item = item;
    a->n = n;
    return a;
}

static void array_free(Parser *p, ValueArray *a)
{
    for (uint32_t i = 0; i < a->n; i++)
        value_clear(p, &a->item[i]);
    unsigned c = item_class(a->n);
    a->item->next_free = p->free_items[c];
    p->free_items[c] = a->item;
    a->n = 0;
    a->next_free = p->free_arrays;
    p->free_arrays = a;
}

void value_give_back(Parser *p, Value *v)
{
    Value old = *v;
    *v = (Value){ 0 };                         /* first: an array may, by a reference, be cleared from within */
    if (old.kind == VALUE_STRING && old.string.text)
        pool_give(p, old.string.text, old.string.capacity);
    else if (old.kind == VALUE_ARRAY)
        array_free(p, old.array);
}

void value_set_number(Parser *p, Value *v, const Num *n)
{
    if (v->kind != VALUE_NUMBER)
        value_clear(p, v);
    v->kind = VALUE_NUMBER;
    v->terms = (uint8_t)n->terms;
    v->v[0] = n->v[0];
    if (n->terms == 1)
        return;
    for (int i = 1; i < 5; i++)
        v->v[i] = i < n->terms ? n->v[i] : 0;
    if (n->terms == 5)                         /* colours are kept in single precision */
        for (int i = 0; i < 5; i++)
            v->v[i] = (double)(float)v->v[i];
}

void value_set_string(Parser *p, Value *v, Str s)
{
    Value old = *v;
    if (v->kind != VALUE_STRING || v->string.capacity < (size_t)s.n + 1) {
        if (v->kind != VALUE_STRING)
            value_clear(p, v);
        *v = (Value){ .kind = VALUE_STRING };
        v->string.text = pool_take(p, (size_t)s.n + 1, &v->string.capacity);
    }
    if (s.n)
        memmove(v->string.text, s.data, s.n);
    v->string.text[s.n] = 0;
    v->n = s.n;
    if (old.kind == VALUE_STRING && old.string.text != v->string.text)
        pool_give(p, old.string.text, old.string.capacity);
}

static void copy_array(Parser *p, Value *to, const ValueArray *from)
{
    ValueArray *a = value_array_new(p, from->n);
    a->n_dimensions = from->n_dimensions;
    memcpy(a->size, from->size, sizeof a->size);
    a->type = from->type;
    for (uint32_t i = 0; i < from->n; i++)
        value_copy(p, &a->item[i], &from->item[i]);
    *to = (Value){ .kind = VALUE_ARRAY, .array = a };
}

void value_copy(Parser *p, Value *to, const Value *from)
{
    if (to == from)
        return;
    if (from->kind == VALUE_STRING) {
        value_set_string(p, to, value_string(from));
    } else if (from->kind == VALUE_ARRAY) {
        Value copy;
        cursor_deeper(p);                      /* arrays in arrays */
        copy_array(p, &copy, from->array);
        p->depth--;
        value_clear(p, to);
        *to = copy;
    } else {
        if (to->kind != from->kind)
            value_clear(p, to);
        *to = *from;
    }
}

void value_move(Parser *p, Value *to, Value *from)
{
    value_clear(p, to);
    *to = *from;
    *from = (Value){ 0 };
}
