/* str.c - string views; see str.h. */
#include "base/str.h"

#include <stdio.h>
#include <string.h>

Str str_of(const char *text)
{
    return (Str){ text, text ? (uint32_t)strlen(text) : 0 };
}

bool str_equal(Str a, Str b)
{
    return a.n == b.n && (a.n == 0 || memcmp(a.data, b.data, a.n) == 0);
}

bool str_is(Str a, const char *text)
{
    return str_equal(a, str_of(text));
}

static int lower(char c)
{
    return c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c;
}

bool str_equal_nocase(Str a, Str b)
{
    if (a.n != b.n)
        return false;
    for (uint32_t i = 0; i < a.n; i++)
        if (lower(a.data[i]) != lower(b.data[i]))
            return false;
    return true;
}

bool str_ends_with(Str a, const char *tail)
{
    size_t n = strlen(tail);
    return a.n >= n && memcmp(a.data + (a.n - n), tail, n) == 0;
}

int str_compare(Str a, Str b)
{
    uint32_t n = a.n < b.n ? a.n : b.n;
    int order = n ? memcmp(a.data, b.data, n) : 0;
    return order ? order : (a.n > b.n) - (a.n < b.n);
}

Str str_concat(Arena *a, Str left, Str right)
{
    char *p = arena_alloc(a, (size_t)left.n + right.n + 1);
    if (left.n)
        memcpy(p, left.data, left.n);
    if (right.n)
        memcpy(p + left.n, right.data, right.n);
    return (Str){ p, left.n + right.n };
}

Str str_copy(Arena *a, Str s)
{
    return str_concat(a, s, (Str){ 0 });
}

const char *str_c(Arena *a, Str s)
{
    return str_copy(a, s).data;
}

Str str_vformat(Arena *a, const char *format, va_list args)
{
    va_list again;
    va_copy(again, args);
    int n = vsnprintf(NULL, 0, format, again);
    va_end(again);
    if (n < 0)
        return (Str){ "", 0 };
    char *p = arena_alloc(a, (size_t)n + 1);
    vsnprintf(p, (size_t)n + 1, format, args);
    return (Str){ p, (uint32_t)n };
}

Str str_format(Arena *a, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    Str s = str_vformat(a, format, args);
    va_end(args);
    return s;
}
