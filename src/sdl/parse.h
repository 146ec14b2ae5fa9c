/* parse.h - what shape and pattern files may call to read their part of a block.
 *
 * Token kinds: a reserved word is its KW_ constant, other tokens are the TOK_ constants below. Every parse_* that wants
 * something fails with a clear message when it is not there; nothing here returns an error. Commas between items are
 * optional everywhere, as in POV-Ray. */
#ifndef SDL_PARSE_H
#define SDL_PARSE_H

#include "scene/ops.h"
#include "sdl/keyword.h"

enum {                                         /* beyond the keywords */
    TOK_END = N_KEYWORDS,                        /* of the input */
    TOK_NUMBER, TOK_STRING, TOK_NAME,          /* name: an identifier, declared or not */
    TOK_OPEN, TOK_CLOSE,                       /* { } */
    TOK_LPAREN, TOK_RPAREN, TOK_LBRACKET, TOK_RBRACKET,
    TOK_LESS, TOK_GREATER, TOK_LESS_EQUAL, TOK_GREATER_EQUAL, TOK_NOT_EQUAL, TOK_EQUAL,        /* the relations stand together */
    TOK_NOT, TOK_AND, TOK_OR, TOK_PLUS, TOK_MINUS, TOK_STAR, TOK_SLASH, TOK_COMMA,
    TOK_SEMICOLON, TOK_COLON, TOK_QUESTION, TOK_DOT, TOK_HASH, TOK_OTHER
};

Arena *parse_arena(Parser *p);                 /* the scene's: lives until compile has run */
Diag *parse_diag(Parser *p);
Loc parse_loc(Parser *p);                      /* of the next token */
int parse_version(const Parser *p);            /* language version * 100 */

int parse_peek(Parser *p);                     /* kind of the next token; directives have run */
void parse_skip(Parser *p);                    /* takes it */
bool parse_accept(Parser *p, int kind);        /* takes the next token if it is of that kind */
void parse_expect(Parser *p, int kind);        /* ... or fails */
void parse_open(Parser *p);                    /* { */
void parse_close(Parser *p);                   /* } */
bool parse_at_close(Parser *p);                /* ... without taking it */
void parse_comma(Parser *p);                   /* optional */
bool parse_at_number(Parser *p);               /* could a numeric expression start here? (not after a comma) */

/* Expressions. The _next_ forms take an optional comma first. */
double parse_float(Parser *p);
double parse_next_float(Parser *p);
double parse_optional_float(Parser *p, double otherwise);      /* `[,] [f]`: either may lack */
int parse_int(Parser *p);                      /* truncated toward zero; fails on NaN, clamps to int */
bool parse_bool(Parser *p);
bool parse_optional_bool(Parser *p, bool otherwise);           /* `hollow`, `hollow off`, `hollow (A > B)` */
Vec2 parse_vec2(Parser *p);
Vec3 parse_vec3(Parser *p);
Vec3 parse_next_vec3(Parser *p);
Vec4 parse_vec4(Parser *p);
/* A vector of 2 to 5 terms exactly as long as written (poly coefficients have their own loop): returns the count. */
int parse_terms(Parser *p, double out[5]);
Colour parse_colour(Parser *p);                /* all forms of 01-language section 5 */
Rgb parse_rgb(Parser *p);                      /* warns when filter or transmit are given */
Str parse_string(Parser *p);
Str parse_file_name(Parser *p);                /* a string expression read without escapes */

/* Whole blocks, keyword included, or an identifier where the language allows one. Results live in the scene arena. */
const Object *parse_object(Parser *p);         /* NULL if the next token starts no object */
const Pigment *parse_pigment(Parser *p);       /* at `pigment` */
const Normal *parse_normal(Parser *p);         /* at `normal` */
const Texture *parse_texture(Parser *p);       /* at `texture`: one block; its layers */
ListedTexture parse_listed_texture(Parser *p); /* the same, or an identifier */
/* One texture, pigment, normal, finish or transform of a part with a texture of its own (component of a blob). *texture begins as
 * NULL and already carries what was written after it; *place is composed on. */
bool parse_part_item(Parser *p, const Texture **texture, Affine *place);
const Interior *parse_interior(Parser *p);
const struct World *parse_world_of(Parser *p, const Object *o, uint32_t *item);       /* SdlHost.world */
/* The inside of a pigment block without braces or keyword, as in map entries: starts from the default pigment. */
const Pigment *parse_pigment_body(Parser *p);
bool parse_transform(Parser *p, Affine *composed);     /* one translate/rotate/scale/matrix/transform item, composed on */
/* At `function` or `{`: a user function with parameters x,y,z (or u,v), or a function identifier. */
const Function *parse_function(Parser *p, const char *const *parameters, int n_parameters);
const ImageMap *parse_image(Parser *p);        /* `[type] "file" [gamma g]...` or `function w,h {...}`; see scene/image_map.h */
const ImageMap *parse_image_pattern(Parser *p);        /* `{ image modifiers }`, as of image_pattern */
bool parse_at_float(Parser *p);                /* could a float begin here? (a number, or a name that holds a float) */

/* Bytes of a file found by the library path, within the allowed folders. Fails if it is not there. */
Str parse_read_file(Parser *p, Str name, Loc where);
/* The same, also with one of the extensions (ended by NULL) appended; false if there is none. */
bool parse_find_file(Parser *p, Str name, const char *const *extensions, Loc where, Str *out);
/* A pointer of that key's own for the rest of the parse, NULL at first: what was made of a file need not be made twice. */
void **parse_kept(Parser *p, const void *key, uint32_t variant);
bool parse_is_strict(const Parser *p);         /* nothing is mended: as the reference or not at all */
/* At what the reference refuses though it has one meaning only: an error if strict, else a warning, once. */
void parse_mend(Parser *p, const char *what);
void parse_stray_comma(Parser *p);             /* mends one, if there is one */
void parse_due_comma(Parser *p);               /* takes one, or mends its lack */
bool parse_charset_is_ascii(const Parser *p);  /* as global_settings said; strings are UTF-8 in any case */

_Noreturn void parse_fail(Parser *p, const char *format, ...) __attribute__((format(printf, 2, 3)));
void parse_warn(Parser *p, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
