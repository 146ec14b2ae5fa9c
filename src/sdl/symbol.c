/* symbol.c - names and what they hold now (01-language, section 12).
 *
 * Scope is dynamic: a look-up goes from the innermost table outward through all open ones. That is what shallow binding
 * does without any search: each name points at its innermost binding, a new binding hides the older, and closing a table
 * puts back what its bindings hid. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sdl/number.h"
#include "sdl/parser.h"

/* The first 8 bytes, with zeros behind what is shorter. */
static inline uint64_t head_of(const char *text, size_t n)
{
    uint64_t head = 0;
    if (n >= 8) {
        memcpy(&head, text, 8);
    } else if (n >= 4) {                       /* two halves that overlap */
        uint32_t first, last;
        memcpy(&first, text, 4);
        memcpy(&last, text + n - 4, 4);
        head = first | (uint64_t)last << 8 * (n - 4);
    } else {
        for (size_t i = 0; i < n; i++)
            head |= (uint64_t)(unsigned char)text[i] << 8 * i;
    }
    return head;
}

static inline uint32_t hash_of(uint64_t head, const char *text, size_t n)
{
    uint64_t h = n;
    for (; n > 8; n -= 8) {
        h = (h ^ head) * 0x9e3779b97f4a7c15u;
        h ^= h >> 29;
        text += 8;
        head = head_of(text, n - 8);
    }
    return (uint32_t)(((h ^ head) * 0x9e3779b97f4a7c15u) >> 32);
}

static void grow(Parser *p)
{
    uint32_t size = p->sym ? (p->sym_mask + 1) * 2 : 2048;
    Sym **old = p->sym;
    uint32_t n_old = p->sym ? p->sym_mask + 1 : 0;
    p->sym = arena_array(p->arena, Sym *, size);
    p->sym_mask = size - 1;
    for (uint32_t i = 0; i < n_old; i++) {
        if (!old[i])
            continue;
        uint32_t at = old[i]->hash & p->sym_mask;
        while (p->sym[at])
            at = (at + 1) & p->sym_mask;
        p->sym[at] = old[i];
    }
}

Sym *symbol_intern(Parser *p, const char *text, size_t n)
{
    uint64_t head = head_of(text, n);
    uint32_t hash = hash_of(head, text, n), at = hash & p->sym_mask;
    for (Sym *s; (s = p->sym[at]); at = (at + 1) & p->sym_mask)
        if (s->head == head && s->hash == hash && s->text.n == n && (n <= 8 || memcmp(s->text.data, text, n) == 0))
            return s;
    if ((p->n_syms + 1) * 2 > p->sym_mask + 1) {
        grow(p);
        at = hash & p->sym_mask;
        while (p->sym[at])
            at = (at + 1) & p->sym_mask;
    }
    Sym *s = arena_new(p->arena, Sym);
    s->text = str_copy(p->arena, (Str){ text, (uint32_t)n });
    s->head = head;
    s->hash = hash;
    p->sym[at] = s;
    p->n_syms++;
    return s;
}

static const struct { const char *text; uint16_t keyword; } words[] = {
#define KEYWORD(word, kw) { #word, kw },
#include "sdl/keyword.def"
#undef KEYWORD
};

static const uint16_t directives[] = {
    KW_BREAK, KW_CASE, KW_DEBUG, KW_DECLARE, KW_DEFAULT, KW_ELSE, KW_ELSEIF, KW_END, KW_ERROR, KW_FCLOSE, KW_FOPEN, KW_FOR,
    KW_IF, KW_IFDEF, KW_IFNDEF, KW_INCLUDE, KW_LOCAL, KW_MACRO, KW_RANGE, KW_READ, KW_RENDER, KW_STATISTICS, KW_SWITCH,
    KW_UNDEF, KW_VERSION, KW_WARNING, KW_WHILE, KW_WRITE,
};

void symbols_init(Parser *p)
{
    bool is_directive[N_KEYWORDS] = { false };
    for (size_t i = 0; i < sizeof directives / sizeof *directives; i++)
        is_directive[directives[i]] = true;
    grow(p);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        Sym *s = symbol_intern(p, words[i].text, strlen(words[i].text));
        s->keyword = words[i].keyword;
        s->is_directive = is_directive[s->keyword];
    }
    p->n_tables = 1;
}

Binding *binding_new(Parser *p)
{
    Binding *b = p->free_bindings;
    if (!b) {
        b = arena_new(p->arena, Binding);
        b->value = &b->own;
        return b;
    }
    p->free_bindings = b->next;
    b->value = &b->own;
    b->own.kind = VALUE_NONE;
    b->deprecated = b->deprecated_once = false;
    return b;
}

void binding_enter(Parser *p, Binding *b, Sym *s, uint32_t table)
{
    b->sym = s;
    b->table = table;
    b->next = p->table[table];
    p->table[table] = b;
    Binding **at = &s->binding;
    while (*at && (*at)->table > table)
        at = &(*at)->hidden;
    b->hidden = *at;
    *at = b;
}

Binding *symbol_bind(Parser *p, Sym *s, uint32_t table)
{
    Binding *b = binding_new(p);
    binding_enter(p, b, s, table);
    return b;
}

/* A macro that ends with the value of a #declare is still open when that is assigned: its names do not count. */
Binding *symbol_declare(Parser *p, Sym *s, bool local, uint32_t table)
{
    Binding *b = s->binding;
    while (b && b->table > table)
        b = b->hidden;
    if (!b || (local && b->table != table))
        b = symbol_bind(p, s, local ? table : 0);
    b->deprecated = false;
    return b;
}

void symbol_undef(Parser *p, Sym *s)
{
    Binding *b = s->binding;
    if (b->value == &b->own)
        value_clear(p, &b->own);
    s->binding = b->hidden;
    b->sym = NULL;                             /* stays in its table's list until that ends */
}

void symbol_push_table(Parser *p, Loc loc)
{
    if (p->n_tables == MAX_TABLES)
        fail(p->diag, loc, "Too many nested symbol tables");
    p->table[p->n_tables++] = NULL;
}

void symbol_pop_table(Parser *p)
{
    Binding *b = p->table[--p->n_tables];
    p->table[p->n_tables] = NULL;
    while (b) {
        Binding *next = b->next;
        if (b->sym) {
            value_clear(p, &b->own);
            b->sym->binding = b->hidden;
        }
        b->next = p->free_bindings;
        p->free_bindings = b;
        b = next;
    }
}

static void predefine(Parser *p, const char *name, double value)
{
    Num n = { { value }, 1 };
    value_set_number(p, symbol_declare(p, symbol_intern(p, name, strlen(name)), false, 0)->value, &n);
}

static double declared_number(Str text)
{
    const char *at = text.data, *end = at + text.n;
    double v = 0;
    bool negative = at < end && *at == '-';
    at += at < end && (*at == '-' || *at == '+');
    if (number_scan(at, end, &v) == NULL)
        v = 0;
    /* POV: values from the command line go through single precision, and then through six digits of text. */
    char digits[32];
    snprintf(digits, sizeof digits, "%g", (double)(float)(negative ? -v : v));
    return strtod(digits, NULL);
}

/* 01-language, section 2, and 02-command-line, section 2.1. The first declaration of a name wins. */
void symbol_predefined(Parser *p)
{
    const SdlOptions *o = p->options;
    predefine(p, "image_width", o->width);
    predefine(p, "image_height", o->height);
    predefine(p, "clock_delta", o->clock_delta);
    predefine(p, "initial_clock", o->initial_clock);
    predefine(p, "final_clock", o->final_clock);
    predefine(p, "initial_frame", o->initial_frame);
    predefine(p, "final_frame", o->final_frame);
    predefine(p, "frame_number", o->frame_number);
    value_set_string(p, symbol_declare(p, symbol_intern(p, "input_file_name", 15), false, 0)->value,
                     file_base_name(o->input_name));
    for (uint32_t i = o->n_declares; i-- > 0;) {
        const SdlDeclare *d = &o->declare[i];
        Sym *s = symbol_intern(p, d->name.data, d->name.n);
        if (s->keyword)
            continue;
        Value *v = symbol_declare(p, s, false, 0)->value;
        Num n = { { declared_number(d->value) }, 1 };
        if (d->is_string)
            value_set_string(p, v, d->value);
        else
            value_set_number(p, v, &n);
    }
}

/* Damerau-Levenshtein distance (optimal alignment), given up beyond 2. */
static unsigned distance(Str a, Str b)
{
    enum { LONGEST = 40 };
    if (a.n > LONGEST || b.n > LONGEST || a.n > b.n + 2 || b.n > a.n + 2)
        return 9;
    unsigned row[3][LONGEST + 1];
    for (unsigned j = 0; j <= b.n; j++)
        row[0][j] = j;
    for (unsigned i = 1; i <= a.n; i++) {
        unsigned *now = row[i % 3], *last = row[(i + 2) % 3], *older = row[(i + 1) % 3];
        now[0] = i;
        for (unsigned j = 1; j <= b.n; j++) {
            unsigned best = last[j - 1] + (a.data[i - 1] != b.data[j - 1]);
            best = last[j] + 1 < best ? last[j] + 1 : best;
            best = now[j - 1] + 1 < best ? now[j - 1] + 1 : best;
            if (i > 1 && j > 1 && a.data[i - 1] == b.data[j - 2] && a.data[i - 2] == b.data[j - 1] && older[j - 2] + 1 < best)
                best = older[j - 2] + 1;
            now[j] = best;
        }
    }
    return row[a.n % 3][b.n];
}

/* Short names resemble each other by chance: these must differ by one letter, or by case alone. */
Str symbol_nearest(Parser *p, const Sym *s)
{
    const Sym *best = NULL;
    unsigned best_distance = s->text.n < 3 ? 0 : s->text.n < 6 ? 1 : 2;
    for (uint32_t i = 0; i <= p->sym_mask; i++) {
        const Sym *other = p->sym[i];
        if (!other || other == s || !(other->keyword || other->binding))
            continue;
        unsigned d = str_equal_nocase(s->text, other->text) ? 0 : distance(s->text, other->text);
        if (d < best_distance || (d == best_distance && (!best || str_compare(other->text, best->text) < 0))) {
            best = other;
            best_distance = d;
        }
    }
    return best ? best->text : (Str){ 0 };
}

/* Memory of strings and arrays, by powers of two; what is given back is handed out again in the same class. */
struct PoolItem { PoolItem *next; };

static unsigned class_of_size(size_t bytes)
{
    unsigned c = 5;
    while (c < POOL_CLASSES - 1 && (size_t)1 << c < bytes)
        c++;
    return c;
}

void *pool_take(Parser *p, size_t bytes, size_t *capacity)
{
    unsigned c = class_of_size(bytes);
    *capacity = (size_t)1 << c;
    PoolItem *item = p->pool[c];
    if (!item)
        return arena_alloc(p->arena, *capacity >= bytes ? *capacity : bytes);
    p->pool[c] = item->next;
    return memset(item, 0, bytes);
}

void pool_give(Parser *p, void *data, size_t capacity)
{
    PoolItem *item = data;
    unsigned c = class_of_size(capacity);
    item->next = p->pool[c];
    p->pool[c] = item;
}
