/* value.h - what an identifier can hold.
 *
 * Numbers stand in place, so declaring one in a loop costs no memory. Strings and arrays own pool memory that goes back
 * when they are overwritten; blocks, splines, functions and macros are immutable and shared by pointer. */
#ifndef SDL_VALUE_H
#define SDL_VALUE_H

#include <stdio.h>

#include "func/func.h"
#include "sdl/block.h"
#include "sdl/token.h"

typedef enum ValueKind {
    VALUE_NONE, VALUE_NUMBER, VALUE_STRING, VALUE_ARRAY, VALUE_SPLINE, VALUE_FUNCTION, VALUE_FILE, VALUE_MACRO, VALUE_BLOCK
} ValueKind;

typedef struct Num {                           /* a number, vector or colour on its way through an expression */
    double v[5];
    int terms;                                 /* 1 float, 2 uv vector, 3 vector, 4 four-vector, 5 colour */
} Num;

typedef struct Value Value;
typedef struct ValueArray ValueArray;
typedef struct Spline Spline;
typedef struct Macro Macro;
typedef struct FileHandle FileHandle;

struct Value {
    uint8_t kind;                              /* ValueKind */
    uint8_t terms;                             /* NUMBER: 1..5; the rest of v is 0 */
    uint8_t block;                             /* BLOCK: BlockKind */
    uint32_t n;                                /* STRING: bytes in use */
    union {
        double v[5];
        struct { char *text; size_t capacity; } string;        /* UTF-8, one character per 16-bit unit */
        ValueArray *array;
        const Spline *spline;
        const Function *function;
        FileHandle *file;
        Macro *macro;
        const void *pointer;                   /* BLOCK */
        Value *next_free;                      /* NONE: of items not in use */
    };
};

enum { ARRAY_MAX_DIMENSIONS = 5 };

struct ValueArray {
    Value *item;
    uint32_t n, n_dimensions, size[ARRAY_MAX_DIMENSIONS];
    Value type;                                /* kind, terms and block of the items; NONE before the first */
    ValueArray *next_free;
};

struct Macro {
    Sym *name;
    Sym **parameter;
    uint32_t n_parameters;
    const Token *token;                        /* of the array that holds the body: [first, last) */
    uint32_t first, last;
    Loc loc;
};

struct FileHandle {
    FILE *out;                                 /* writing */
    Str text;                                  /* reading: the whole file, and where it stands */
    Lexer lexer;
    bool reading, closed;
    Str name;
    FileHandle *next;                          /* all of a parser, to be closed at its end */
};

typedef enum SplineKind { SPLINE_LINEAR, SPLINE_QUADRATIC, SPLINE_CUBIC, SPLINE_NATURAL } SplineKind;

typedef struct SplineEntry {
    double t, v[5];
    double bend[5];                            /* natural: second derivative */
    double work;                               /* of spline_prepare */
} SplineEntry;

struct Spline {
    SplineKind kind;
    int terms;
    uint32_t n;
    const SplineEntry *entry;                  /* sorted by t */
};

const char *value_type_name(const Value *v);   /* "float identifier", "pigment identifier"... */
bool value_same_type(const Value *a, const Value *b);
void value_give_back(Parser *p, Value *v);     /* the string or array that it owns */
ValueArray *value_array_new(Parser *p, uint32_t n);        /* n > 0 empty items */
void value_set_number(Parser *p, Value *v, const Num *n);
void value_set_string(Parser *p, Value *v, Str s);
void value_copy(Parser *p, Value *to, const Value *from);  /* deep; `to` holds a value or is zeroed */
void value_move(Parser *p, Value *to, Value *from);

static inline void value_clear(Parser *p, Value *v)
{
    if (v->kind == VALUE_STRING || v->kind == VALUE_ARRAY)
        value_give_back(p, v);
    v->kind = VALUE_NONE;
}

static inline Str value_string(const Value *v) { return (Str){ v->string.text, v->n }; }

void spline_prepare(Spline *s, SplineEntry *entry);        /* second derivatives, when all entries are in */
void spline_at(const Spline *s, SplineKind kind, double t, double out[5]);

#endif
