/* str.h - strings as views: bytes and a length, UTF-8, not owned, not always ended by a zero. */
#ifndef BASE_STR_H
#define BASE_STR_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"

typedef struct Str {
    const char *data;
    uint32_t n;
} Str;

Str str_of(const char *text);                              /* views text, NULL is empty */
bool str_equal(Str a, Str b);
bool str_is(Str a, const char *text);
bool str_equal_nocase(Str a, Str b);                       /* ASCII letters only */
bool str_ends_with(Str a, const char *tail);
int str_compare(Str a, Str b);                             /* as memcmp, then by length */
Str str_copy(Arena *a, Str s);                             /* the copy is followed by a zero byte */
Str str_concat(Arena *a, Str left, Str right);             /* followed by a zero byte */
const char *str_c(Arena *a, Str s);                        /* a copy ended by a zero byte */
Str str_format(Arena *a, const char *format, ...) __attribute__((format(printf, 2, 3)));
Str str_vformat(Arena *a, const char *format, va_list args);

#define STR_ARGS(s) (int)(s).n, (s).data                   /* for "%.*s" */

#endif
