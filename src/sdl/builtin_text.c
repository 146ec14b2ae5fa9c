/* builtin_text.c - strings (01-language, sections 1.4 and 10).
 *
 * The language counts 16-bit units. Here a string is UTF-8 of at most three bytes a character, one character for each
 * unit, so that escapes for half of a surrogate pair keep their place. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "sdl/number.h"
#include "sdl/parser.h"

enum { REPLACEMENT = 0xfffd, LONGEST = 1 << 28 };

static char *put(char *out, unsigned c)
{
    if (c < 0x80) {
        *out++ = (char)c;
    } else if (c < 0x800) {
        *out++ = (char)(0xc0 | c >> 6);
        *out++ = (char)(0x80 | (c & 63));
    } else {
        *out++ = (char)(0xe0 | c >> 12);
        *out++ = (char)(0x80 | (c >> 6 & 63));
        *out++ = (char)(0x80 | (c & 63));
    }
    return out;
}

/* The unit at *i of a decoded string, moved behind it. */
static unsigned unit_at(Str s, uint32_t *i)
{
    unsigned char c = (unsigned char)s.data[(*i)++];
    unsigned more = c >= 0xe0 ? 2 : c >= 0xc0 ? 1 : 0;
    unsigned v = more == 2 ? c & 15u : more == 1 ? c & 31u : c;
    while (more-- && *i < s.n)
        v = v << 6 | ((unsigned char)s.data[(*i)++] & 63u);
    return v;
}

static uint32_t unit_count(Str s)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < s.n; i++)
        n += ((unsigned char)s.data[i] & 0xc0) != 0x80;
    return n;
}

/* As it stands in a file whose charset is UTF-8: what is longer than 16 bits, or wrong, becomes U+FFFD. */
static unsigned utf8_at(Str s, uint32_t *i)
{
    unsigned char c = (unsigned char)s.data[(*i)++];
    unsigned more = c >= 0xf0 ? 3 : c >= 0xe0 ? 2 : c >= 0xc0 ? 1 : 0;
    if (c < 0x80)
        return c;
    unsigned v = c & (0x3fu >> more);
    for (unsigned k = 0; k < more; k++) {
        if (*i >= s.n || ((unsigned char)s.data[*i] & 0xc0) != 0x80)
            return REPLACEMENT;
        v = v << 6 | ((unsigned char)s.data[(*i)++] & 63u);
    }
    return more == 0 || more == 3 || v < (more == 1 ? 0x80u : 0x800u) ? REPLACEMENT : v;
}

static int hex(char c)
{
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

static unsigned escape(Parser *p, Str s, uint32_t *i, Loc loc)
{
    static const char letters[] = "abfnrtv\\'\"", values[] = "\a\b\f\n\r\t\v\\'\"";
    char c = *i < s.n ? s.data[(*i)++] : 0;
    const char *at = c ? strchr(letters, c) : NULL;
    if (at)
        return (unsigned char)values[at - letters];
    unsigned v = 0;
    for (int k = 0; k < 4; k++) {
        int digit = c == 'u' && *i < s.n ? hex(s.data[*i]) : -1;
        if (digit < 0)
            fail(p->diag, loc, "Illegal escape sequence in string.");
        v = v << 4 | (unsigned)digit;
        ++*i;
    }
    return v;
}

static unsigned high_byte(Parser *p, Str s, uint32_t *i, Loc loc)
{
    if (p->charset == CHARSET_UTF8)
        return utf8_at(s, i);
    if (p->charset == CHARSET_SYS)
        fail(p->diag, loc, "Cannot convert system specific text format to Unicode.");
    unsigned char c = (unsigned char)s.data[(*i)++];
    if (p->version < 350)
        return c;
    warn_once(p->diag, loc, "Non-ASCII character has been replaced by space character.");
    return ' ';
}

static bool is_plain(Str s)
{
    for (uint32_t i = 0; i < s.n; i++)
        if (s.data[i] == '\\' || (s.data[i] & 0x80))
            return false;
    return true;
}

/* File names are bytes: neither escapes nor charsets apply, but \" . */
Str string_decode(Parser *p, Str written, Loc loc, bool file_name)
{
    if (is_plain(written))
        return written;
    char *data = arena_alloc(&p->temp, (size_t)written.n * 3 + 1), *out = data;
    for (uint32_t i = 0; i < written.n;) {
        char c = written.data[i];
        if (file_name) {
            i += c == '\\' && i + 1 < written.n && written.data[i + 1] == '"';
            *out++ = written.data[i++];
        } else if (c == '\\') {
            i++;
            out = put(out, escape(p, written, &i, loc));
        } else if (c & 0x80) {
            out = put(out, high_byte(p, written, &i, loc));
        } else {
            *out++ = c;
            i++;
        }
    }
    return (Str){ data, (uint32_t)(out - data) };
}

int string_compare(Str a, Str b)
{
    for (uint32_t i = 0, k = 0;;) {
        unsigned c = i < a.n ? unit_at(a, &i) : 0, d = k < b.n ? unit_at(b, &k) : 0;
        if (c != d)
            return (int)c - (int)d;
        if (i >= a.n && k >= b.n)
            return 0;
    }
}

bool kind_starts_string(const Parser *p)
{
    switch (p->token.kind) {
    case TOK_STRING: case KW_STR: case KW_VSTR: case KW_CHR: case KW_CONCAT: case KW_SUBSTR: case KW_STRUPR: case KW_STRLWR:
    case KW_DATETIME:
        return true;
    case TOK_NAME:
        return p->value && p->value->kind == VALUE_STRING;
    default:
        return false;
    }
}

/* -- Numbers as text -- */

typedef struct Text { char *data; size_t n, capacity; } Text;

static void text_add(Parser *p, Text *t, const char *data, size_t n)
{
    if (t->n + n > LONGEST)
        fail(p->diag, cursor_loc(p), "a string of %zu bytes is too long", t->n + n);
    if (t->n + n > t->capacity) {
        size_t capacity = (t->n + n) * 2 + 64;
        char *more = arena_alloc(&p->temp, capacity);
        if (t->n)
            memcpy(more, t->data, t->n);
        t->data = more;
        t->capacity = capacity;
    }
    if (n)
        memcpy(t->data + t->n, data, n);
    t->n += n;
}

/* Precision below 0 is printf's own; a text that would not fit into 255 bytes is written with %g. */
size_t string_of_number(char text[NUMBER_TEXT], double v, int width, int precision)
{
    char format[32];
    int w = width < 0 ? -width : width;
    w = w > 250 || w < 0 ? 250 : w;
    size_t quick = w <= 1 ? number_fixed(v, precision, text) : 0;
    if (quick > 0)
        return quick;
    snprintf(format, sizeof format, width < 0 ? "%%0*.*%s" : "%%*.*%s", "f");
    int n = snprintf(text, NUMBER_TEXT, format, w, precision > 250 ? 250 : precision, v);
    if (n >= 255) {
        snprintf(format, sizeof format, width < 0 ? "%%0*.*%s" : "%%*.*%s", "g");
        n = snprintf(text, NUMBER_TEXT, format, w, precision > 200 ? 200 : precision, v);
    }
    return n < NUMBER_TEXT ? (size_t)n : NUMBER_TEXT - 1;
}

static void format_number(Parser *p, Text *t, double v, int width, int precision)
{
    char text[NUMBER_TEXT];
    text_add(p, t, text, string_of_number(text, v, width, precision));
}

static int int_argument(Parser *p)
{
    return parse_int(p);
}

static Str str_function(Parser *p)
{
    Text t = { 0 };
    double v = expr_float(p);
    parse_comma(p);
    int width = int_argument(p);
    parse_comma(p);
    format_number(p, &t, v, width, int_argument(p));
    return (Str){ t.data, (uint32_t)t.n };
}

static Str vstr_function(Parser *p)
{
    Text t = { 0 };
    int n = int_argument(p);
    n = n < 2 ? 2 : n > 5 ? 5 : n;
    parse_comma(p);
    double v[5];
    parse_terms(p, v);                         /* a float is the first component, the others are 0 */
    parse_comma(p);
    Str separator = string_expression(p, false);
    parse_comma(p);
    int width = int_argument(p);
    parse_comma(p);
    int precision = int_argument(p);
    for (int i = 0; i < n; i++) {
        if (i)
            text_add(p, &t, separator.data, separator.n);
        format_number(p, &t, v[i], width, precision);
    }
    return (Str){ t.data, (uint32_t)t.n };
}

static Str concat_function(Parser *p)
{
    Text t = { 0 };
    do {
        Str s = string_expression(p, false);
        text_add(p, &t, s.data, s.n);
    } while (parse_accept(p, TOK_COMMA) || parse_peek(p) != TOK_RPAREN);
    return (Str){ t.data, (uint32_t)t.n };
}

static Str chr_function(Parser *p, Loc loc)
{
    int c = int_argument(p);
    if (c < 0 || c > 0xffff)
        fail(p->diag, loc, "Value %d cannot be used in chr(...).", c);
    char *data = arena_alloc(&p->temp, 4);
    return (Str){ data, (uint32_t)(put(data, (unsigned)c) - data) };
}

static Str substr_function(Parser *p, Loc loc)
{
    Str s = string_expression(p, false);
    parse_comma(p);
    int from = int_argument(p);
    parse_comma(p);
    int n = int_argument(p);
    if (from < 0 || n < 0 || (long long)from + n - 1 > unit_count(s))
        fail(p->diag, loc, "Illegal parameters in substr.");
    if (from == 0)                             /* POV: nothing, without a word */
        return str_of("");
    uint32_t i = 0;
    for (int k = 1; k < from; k++)
        unit_at(s, &i);
    uint32_t start = i;
    for (int k = 0; k < n; k++)
        unit_at(s, &i);
    return (Str){ s.data + start, i - start };
}

static Str case_function(Parser *p, bool upper)
{
    Str s = string_expression(p, false);
    char *data = arena_alloc(&p->temp, s.n + 1u);
    for (uint32_t i = 0; i < s.n; i++) {
        char c = s.data[i];
        bool letter = upper ? c >= 'a' && c <= 'z' : c >= 'A' && c <= 'Z';
        data[i] = (char)(letter ? c ^ 0x20 : c);
    }
    return (Str){ data, s.n };
}

static Str datetime_function(Parser *p, Loc loc)
{
    double days = expr_float(p);
    Str format = str_of("%Y-%m-%d %H:%M:%SZ");
    parse_comma(p);
    if (parse_peek(p) != TOK_RPAREN)
        format = string_expression(p, false);
    if (format.n == 0)
        fail(p->diag, loc, "Empty format string.");
    if (format.n > 200)
        fail(p->diag, loc, "Format string too long.");
    double seconds = floor(days * 86400 + 0.5) + 946684800.0;
    if (!(fabs(seconds) < 1e15))
        fail(p->diag, loc, "datetime of %g days", days);
    time_t t = (time_t)seconds;
    struct tm utc;
    if (!gmtime_r(&t, &utc))
        fail(p->diag, loc, "datetime of %g days", days);
    enum { ROOM = 4096 };
    char *text = arena_alloc(&p->temp, ROOM);
    const char *pattern = str_c(&p->temp, format);
    size_t n = strftime(text, ROOM, pattern, &utc);
    return (Str){ text, (uint32_t)n };
}

static Str string_function(Parser *p, int keyword, Loc loc)
{
    switch (keyword) {
    case KW_STR: return str_function(p);
    case KW_VSTR: return vstr_function(p);
    case KW_CONCAT: return concat_function(p);
    case KW_CHR: return chr_function(p, loc);
    case KW_SUBSTR: return substr_function(p, loc);
    case KW_STRUPR: return case_function(p, true);
    case KW_STRLWR: return case_function(p, false);
    default: return datetime_function(p, loc);
    }
}

Str string_expression(Parser *p, bool file_name)
{
    bool was = p->suspended;
    p->suspended = false;
    parse_peek(p);
    if (!kind_starts_string(p))
        parse_expected(p, "string expression");
    Token t = p->token;
    Str s;
    p->have = false;
    if (t.kind == TOK_STRING) {
        s = string_decode(p, (Str){ t.text, t.n }, t.loc, file_name);
    } else if (t.kind == TOK_NAME) {
        s = str_copy(&p->temp, value_string(p->value));
    } else {
        cursor_deeper(p);
        parse_expect(p, TOK_LPAREN);
        s = string_function(p, t.kind, t.loc);
        parse_expect(p, TOK_RPAREN);
        p->depth--;
    }
    p->suspended = was;
    return s;
}

/* The leading number, as C's atof reads it. */
static double number_of(Parser *p, Str s)
{
    const char *text = str_c(&p->temp, s);
    return strtod(text, NULL);
}

static bool file_exists(Parser *p, Loc loc)
{
    static const char *const none[] = { NULL };
    Str name = string_expression(p, true);
    return file_find(p, name, none, loc, false, NULL, false).data != NULL;
}

bool builtin_text_number(Parser *p, int keyword, Num *out)
{
    Loc loc = p->token.loc;
    double v = 0;
    if (keyword != KW_ASC && keyword != KW_STRLEN && keyword != KW_STRCMP && keyword != KW_VAL && keyword != KW_FILE_EXISTS)
        return false;
    parse_expect(p, TOK_LPAREN);
    if (keyword == KW_FILE_EXISTS) {
        v = file_exists(p, loc);
    } else {
        Str s = string_expression(p, false);
        uint32_t i = 0;
        switch (keyword) {
        case KW_ASC: v = s.n ? unit_at(s, &i) : 0; break;
        case KW_STRLEN: v = unit_count(s); break;
        case KW_VAL: v = number_of(p, s); break;
        default:
            parse_comma(p);
            v = string_compare(s, string_expression(p, false));
        }
    }
    parse_expect(p, TOK_RPAREN);
    *out = (Num){ { v }, 1 };
    return true;
}
