/* parser.h - the state of a parse, shared among the files of sdl and by nobody else.
 *
 * Tokens come from a stack of readers (files, and arrays of tokens for loops and macros). One token of look-ahead is kept
 * in `token`; filling it runs directives and expands macros, so whoever peeks must be ready for the world to change. */
#ifndef SDL_PARSER_H
#define SDL_PARSER_H

#include <string.h>

#include "base/array.h"
#include "base/file.h"
#include "sdl/host.h"
#include "sdl/lex.h"
#include "sdl/literal.h"
#include "sdl/value.h"

enum {                                         /* 01-language, section 34 */
    MAX_INCLUDES = 32, MAX_TABLES = 100, MAX_CONDITIONALS = 200, MAX_PARAMETERS = 55, MAX_LITERAL = 255,
    MAX_READERS = 400,
    MAX_DEPTH = 600,                           /* of parentheses, signs and directives inside expressions: the C stack */
    MAX_BRACES = 1000
};

#define EPSILON 1e-10                          /* of comparisons in the language */

struct Binding {
    Sym *sym;                                  /* NULL: undefined since */
    Value *value;                              /* own, or the caller's for a parameter passed by reference */
    Value own;
    Binding *hidden;                           /* the binding of sym that this one hides */
    Binding *next;                             /* in the same table */
    uint32_t table;
    bool deprecated, deprecated_once;
    Str message;
};

typedef struct Reader {
    bool is_file;
    Lexer lexer;                               /* file */
    const Token *tokens;                       /* array: [at, n) is still to come */
    uint32_t at, n;
    const Macro *macro;                        /* array: of this macro's body */
    Loc called;                                /* where the macro call or the include stands */
    bool has_table;                            /* a table of symbols ends with this reader */
    uint32_t n_conditionals;                   /* open when it began */
} Reader;

typedef enum ConditionalKind { COND_IF, COND_WHILE, COND_FOR, COND_SWITCH, COND_MACRO } ConditionalKind;

typedef struct Conditional {
    ConditionalKind kind;
    uint32_t reader;                           /* index of the reader it is in */
    bool busy;                                 /* its parentheses are being read: no directive may end or leave it */
    bool was_else;
    uint32_t start;                            /* WHILE, FOR: index of the directive in the reader's array */
    uint32_t body;                             /* FOR: first token of the body */
    Sym *variable;                             /* FOR */
    double end, step;                          /* FOR; SWITCH: `end` is the value */
    Loc loc;
} Conditional;

typedef struct Capture {                       /* the tokens from an opening directive of a file to its #end */
    uint64_t key;                              /* source and offset */
    Token *token;
    uint32_t n;
    Lexer after;
} Capture;

enum { NO_SOURCE = UINT16_MAX };
/* A name that has been searched for already, and the number of the file it meant; forgotten when the scene writes files. */
typedef struct FileSearch { Str name; const char *const *extensions; uint32_t file; } FileSearch;
typedef struct FileText { Str path; Str text; uint16_t source; } FileText;   /* source: NO_SOURCE until it is read as one */

typedef struct KeptPointer { const void *key; uint32_t variant; void *pointer; } KeptPointer;          /* parse_kept() */

typedef struct PoolItem PoolItem;
enum { POOL_CLASSES = 40 };

typedef enum Charset { CHARSET_ASCII, CHARSET_UTF8, CHARSET_SYS } Charset;

struct Blocks;                                 /* of the block grammars */

struct Parser {
    /* The look-ahead. value: what the identifier in it holds (an array element if subscripts followed), NULL if nothing. */
    bool have, suspended;
    Token token;
    Value *value;

    Arena *arena;                              /* scene */
    Arena temp;                                /* strings and such of the directive that runs; freed by parser_free */
    Diag *diag;
    const SdlHost *host;
    const SdlOptions *options;
    struct Blocks *blocks;

    uint32_t n_readers;
    Reader reader[MAX_READERS];
    uint32_t n_includes;
    uint32_t n_conditionals;
    Conditional conditional[MAX_CONDITIONALS];
    uint32_t n_tables;                         /* the global one included */
    Binding *table[MAX_TABLES];
    Binding *free_bindings;
    PoolItem *pool[POOL_CLASSES];
    ValueArray *free_arrays;
    Value *free_items[33];
    int depth;
    int braces;

    Sym **sym;                                 /* hash table, open addressing */
    uint32_t n_syms, sym_mask;
    ARRAY(Capture) capture;
    uint32_t *capture_slot;                    /* hash table of indices + 1 */
    uint32_t capture_mask;
    ARRAY(FileText) file;
    ARRAY(FileSearch) searched;
    ARRAY(KeptPointer) kept;
    FileAccess access;
    Str scene_folder;
    FileHandle *handles;
    ARRAY(uint32_t) random;                    /* states of the seeds */

    int version;                               /* in force, *100; 370 when the scene says nothing */
    bool version_given;                        /* by the scene or an option */
    Charset charset;
    bool has_gamma;                            /* assumed_gamma is known, for srgb */
    GammaMode gamma_mode;
    double gamma;
    uint32_t debug_n;                          /* text of #debug that waits for its end of line */
    char debug_text[1024];
};

/* Life of a parser: the main file is on the reader stack when parser_new returns. parser_free closes files and frees
 * what is not in the scene arena; call it also when parsing has failed. */
Parser *parser_new(Arena *scene_arena, Diag *diag, const SdlHost *host, const SdlOptions *options, Str path, Str text);
void parser_free(Parser *p);
void parser_end(Parser *p);                    /* at TOK_END: open conditionals, warnings due at the end of parsing */

/* cursor.c: what the directives need of it. */
void cursor_fetch(Parser *p);                  /* fills the look-ahead */
void cursor_raw(Parser *p, Token *out);        /* the next token as it stands: no directive runs, no macro expands */
bool cursor_raw_accept(Parser *p, int kind, char c);       /* takes it if it is next; ends finished macros on the way */
bool cursor_raw_at(Parser *p, int kind, char c);
void cursor_enter_macro(Parser *p, const Macro *macro, Loc called);
void cursor_include(Parser *p, Str name, Loc loc);

static inline Reader *cursor_top(Parser *p)
{
    return &p->reader[p->n_readers - 1];
}

Reader *cursor_push_reader(Parser *p, Loc loc);
bool cursor_end_reader(Parser *p);             /* the reader on top has nothing left; false at the end of the main file */
Conditional *cursor_push_conditional(Parser *p, ConditionalKind kind, Loc loc);
/* From a directive in a file, just read, to its #end: as an array. */
const Capture *cursor_capture(Parser *p, Lexer *l, const Token *first);
bool cursor_opens(int directive);              /* does it want an #end? */
bool cursor_branches(int directive);           /* #else and the like */
uint32_t cursor_end_of(const Token *tokens, uint32_t i);   /* index of the #end that closes the directive at i */

uint32_t cursor_here(Parser *p);               /* index of the directive just read, if the reader is an array */
void cursor_start(Parser *p, uint16_t source, Str text);
Loc cursor_loc(Parser *p);
void cursor_stop_check(Parser *p);             /* fails if somebody asked to stop */
/* After a #macro header, with cursor_here of its directive: the body, which is skipped. */
const Token *cursor_body(Parser *p, const Token *directive, uint32_t at, uint32_t *first, uint32_t *last);
void cursor_deeper(Parser *p);                 /* p->depth++, within the limit */

/* Fills the look-ahead, if it is empty, and returns its kind. */
static inline int cursor_look(Parser *p)
{
    if (p->have && (p->token.kind != TOK_HASH || p->suspended))
        return p->token.kind;
    Reader *r = cursor_top(p);
    if (!p->have && !r->is_file && r->at < r->n && r->tokens[r->at].kind != TOK_HASH && r->tokens[r->at].kind != TOK_NAME) {
        p->token = r->tokens[r->at++];
        p->have = true;
        p->value = NULL;
        return p->token.kind;
    }
    cursor_fetch(p);
    return p->token.kind;
}

/* The mark `c`, of that kind, is taken if it can be seen to be next: most braces and commas need no token. False: look. */
static inline bool cursor_take_mark(Parser *p, int kind, char c)
{
    Reader *r = cursor_top(p);
    if (p->have)
        return false;
    if (r->is_file)
        return lex_mark(&r->lexer, c);
    if (r->at == r->n || r->tokens[r->at].kind != kind)
        return false;
    r->at++;
    return true;
}

/* Can it be seen that neither a word comes next nor a directive or comment? Then there is nothing to run or to look up. */
static inline bool cursor_sees_no_word(Parser *p)
{
    Reader *r = cursor_top(p);
    if (p->have || !r->is_file)
        return false;
    const char *s = r->lexer.at = lex_blank(&r->lexer, r->lexer.at);
    unsigned char class = class_at(s);
    return class == C_MARK || class == C_LESS || class == C_DIGIT;
}

/* flow.c */
bool flow_directive(Parser *p, const Token *t);            /* false if it is not one of the flow of control */
bool flow_plain_end(Parser *p);                /* at #end: false if nothing has been done */
bool flow_is_defined(Parser *p);               /* (X) or (A[i]) */

/* directive.c */
void directive_flush_debug(Parser *p);
void directive_run(Parser *p, const Token *t);
bool parse_bare_directive(Parser *p);          /* `declare`, `include`... without '#', at scene level */

/* macro.c */
void macro_define(Parser *p, const Token *directive);
void macro_call(Parser *p, const Macro *macro, Loc loc);

/* symbol.c */
Sym *symbol_intern(Parser *p, const char *text, size_t n);
void symbols_init(Parser *p);
static inline Value *symbol_value(const Sym *s)            /* NULL: undeclared; of kind NONE: holds nothing any more */
{
    return s->binding ? s->binding->value : NULL;
}
Binding *symbol_bind(Parser *p, Sym *s, uint32_t table);   /* a new binding that hides the others ... */
Binding *binding_new(Parser *p);               /* ... in two steps: one that holds nothing, ... */
void binding_enter(Parser *p, Binding *b, Sym *s, uint32_t table);     /* ... and from now on is seen */
/* Of #declare and #local in that table: the innermost binding from there on outward, or a new one. */
Binding *symbol_declare(Parser *p, Sym *s, bool local, uint32_t table);
void symbol_undef(Parser *p, Sym *s);
void symbol_push_table(Parser *p, Loc loc);
void symbol_pop_table(Parser *p);
void symbol_predefined(Parser *p);
Str symbol_nearest(Parser *p, const Sym *s);   /* a declared name or keyword much like this one, or empty */
void *pool_take(Parser *p, size_t bytes, size_t *capacity);
void pool_give(Parser *p, void *data, size_t capacity);

/* expr.c */
void expr_sum(Parser *p, Num *out);            /* what most contexts take */
void expr_sum_rest(Parser *p, Num *first);     /* ... when its first operand has been taken */
void expr_full(Parser *p, Num *out);           /* with relations, logic and ?: */
double expr_float(Parser *p);                  /* sum, must be a float */
double expr_full_float(Parser *p);
double num_float(Parser *p, const Num *n);
void num_promote(Num *n, int terms);
Vec3 num_vec3(Parser *p, const Num *n);
bool kind_starts_number(const Parser *p);      /* of the look-ahead */
static inline void num_from_value(Num *out, const Value *v)
{
    memcpy(out->v, v->v, sizeof out->v);       /* more than its terms, but at once */
    out->terms = v->terms;
}
void expr_condition(Parser *p, Num *out);      /* ( full ), the outermost level suspended */

static inline bool is_relation(int kind)
{
    return kind >= TOK_LESS && kind <= TOK_EQUAL;
}

double expr_relation(int kind, double a, double b);        /* TOK_LESS...: 0 or 1 */

static inline double random_next(uint32_t *state)         /* 01-language, section 8 */
{
    *state = 1812433253u * *state + 12345u;
    return *state / 4294967295.0;
}

/* fast.c: true if it could be done on the spot; else nothing has been taken. */
bool fast_sum(Parser *p, Num *out);
bool fast_full(Parser *p, Num *out);
bool fast_condition(Parser *p, bool *out);
bool fast_declare(Parser *p, bool local);
/* A macro's argument and the comma behind it: a number, or the value of a name alone. */
bool fast_argument(Parser *p, Num *number, Value **by_reference);
/* An item of #write and the comma behind it: a literal string, or str() and its arguments, |width| and |precision| below 1000. */
const Token *fast_text_item(Parser *p);        /* NULL if it is none */
bool fast_str_item(Parser *p, double argument[3]);

/* builtin_math.c, builtin_text.c: false if the keyword in the look-ahead is not theirs. */
bool builtin_number(Parser *p, int keyword, Num *out);
bool builtin_text_number(Parser *p, int keyword, Num *out);
/* Their arithmetic alone: false if it is another function, or has something to say about these arguments. */
bool math_of_one(int keyword, double v, double *out);
bool math_of_two(int keyword, double a, double b, double *out);
bool math_of_vectors(int keyword, Vec3 a, Vec3 b, double angle, Num *out);
Vec3 math_trace(Parser *p, const Object *o, Vec3 from, Vec3 direction, Vec3 *normal);   /* the point; both 0 if nothing is met */
bool kind_starts_string(const Parser *p);
Str string_expression(Parser *p, bool file_name);          /* in temp memory; fails if no string comes */
enum { NUMBER_TEXT = 512 };
size_t string_of_number(char text[NUMBER_TEXT], double v, int width, int precision);      /* as str() does */
int string_compare(Str a, Str b);              /* by character: the difference, as strcmp() of the language */
Str string_decode(Parser *p, Str written, Loc loc, bool file_name);

/* builtin_file.c */
void file_fopen(Parser *p);
void file_fclose(Parser *p);
void file_read_directive(Parser *p);
void file_write_directive(Parser *p);
Str file_find(Parser *p, Str name, const char *const *extensions, Loc loc, bool report, uint16_t *source, bool read);
void file_close(FileHandle *h);
extern const char *const FILE_INCLUDE_EXTENSIONS[];

/* array.c */
Value *array_subscript(Parser *p, Value *array);           /* at '[': the element; may be an empty one */
void array_parse(Parser *p, Value *out);       /* at `array` */
Value *array_target(Parser *p, Value *array, ValueArray **owner);      /* ... and the array it is directly in */
void array_check_type(Parser *p, ValueArray *array, const Value *v, Loc loc);

/* spline.c */
void spline_parse(Parser *p, Value *out);      /* at `spline` */
bool spline_kind(int keyword, SplineKind *kind);

/* value parsing: the right side of a #declare, an array element or a macro argument passed by value. Returns true if a
 * semicolon must follow. */
bool value_parse(Parser *p, Value *out, bool suspended);

/* colour.c */
bool kind_starts_colour(const Parser *p);
void colour_parse(Parser *p, Num *out, bool rgb_only);

/* primitive.c */
const char *token_description(Parser *p);      /* of the look-ahead, as in "Expected 'A', B found instead" */
const char *token_keyword_text(int kind);      /* how a keyword or mark is written */
const char *keyword_group(int keyword);        /* of words that can start a numeric expression: "float function"...; or NULL */

/* function.c: at `function`, with its parameter list and braces, for #declare. */
const Function *function_declaration(Parser *p);

#endif
