/* number.h - decimal literals: the short ones in place, all others by number.c.
 *
 * Up to 7 digits in front of the point and 8 behind it are below 2^53, and dividing by a power of ten below 10^22 rounds once
 * (Clinger, "How to read floating point numbers accurately", 1990). The fraction is read eight characters at a time (Lemire), since
 * a loop over them ends with a branch that cannot be foreseen. */
#ifndef SDL_NUMBER_H
#define SDL_NUMBER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum { NUMBER_SHORT = 17 };                    /* characters that are looked at: 7 digits, the point, 8 digits, what follows */

const char *number_scan_any(const char *s, const char *end, double *out);

static inline bool is_digit(char c)
{
    return (unsigned char)(c - '0') < 10;
}

/* The digits that 8 characters begin with, as an integer; *n: how many, or 8 for 8 and more. */
static inline uint64_t digits_of_8(const char *s, unsigned *n)
{
    uint64_t c;
    memcpy(&c, s, 8);
    if (__BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__)
        c = __builtin_bswap64(c);
    c ^= 0x3030303030303030u;
    uint64_t other = ((c + 0x7676767676767676u) | c) & 0x8080808080808080u;        /* bytes above 9; right up to the first */
    unsigned bits = other ? (unsigned)__builtin_ctzll(other) & 56 : 64;
    *n = bits / 8;
    if (bits < 64)
        c = c << (56 - bits) << 8;             /* zeros in front */
    c = c * 10 + (c >> 8);                     /* pairs, then all eight */
    return ((c & 0xff000000ff) * 0xf424000000064 + (c >> 16 & 0xff000000ff) * 0x271000000001) >> 32;
}

/* A decimal literal at `s`, correctly rounded: what is behind it; NULL if there is none. */
static inline const char *number_scan(const char *s, const char *end, double *out)
{
    static const double ten[] = { 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8 };
    static const uint32_t power[] = { 1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000 };
    const char *first = s, *last = s + 7;
    uint64_t w = 0;
    unsigned n = 0;
    if (end - s < NUMBER_SHORT || !is_digit(*s))
        return number_scan_any(first, end, out);
    do
        w = w * 10 + (uint64_t)(*s++ - '0');
    while (is_digit(*s) && s < last);
    if (*s == '.') {
        uint64_t fraction = digits_of_8(++s, &n);
        w = w * power[n] + fraction;
        s += n;
    }
    if (is_digit(*s) || (*s | 0x20) == 'e')
        return number_scan_any(first, end, out);
    *out = n > 0 ? (double)(int64_t)w / ten[n] : (double)(int64_t)w;
    return s;
}

/* What printf makes of "%.*f"; the number of characters, or 0 for what only printf can do: large numbers and many digits. */
enum { NUMBER_FIXED = 48 };
size_t number_fixed(double v, int digits, char out[NUMBER_FIXED]);

#endif
