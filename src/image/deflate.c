/* deflate.c - see deflate.h. About fifteen instructions a byte, where zlib with the same strategy takes a hundred.
 *
 * A block becomes tokens first: bytes, and lengths of runs. Counting them gives the codes, and a table from token to bits writes them. */
#include "image/deflate.h"

#include <stdlib.h>
#include <string.h>

enum {
    RUN_MIN = 3, RUN_MAX = 258,                /* bytes of a run that one token tells */
    RUN_TOKEN = 256 - RUN_MIN,                 /* its token: RUN_TOKEN + length */
    TOKENS = RUN_TOKEN + RUN_MAX + 1,
    END = 256,                                 /* symbols: 0..255 bytes, END, then groups of lengths */
    SYMBOLS = 286, SYMBOL_BITS = 15,
    LENGTHS = 19, LENGTH_BITS = 7              /* symbols that tell the lengths of codes */
};

bool deflate_start(Deflate *d, size_t block_bytes)
{
    /* A zlib header: deflate with a window of 32 KB, fastest. */
    *d = (Deflate){ .bits = 0x0178, .n_bits = 16, .adler = { 1, 0 }, .token = malloc(block_bytes * sizeof *d->token) };
    return d->token != NULL;
}

void deflate_free(Deflate *d)
{
    free(d->token);
}

/* The first byte of memory lowest, whatever the machine. */
static inline uint64_t first_lowest(uint64_t v)
{
    return __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? __builtin_bswap64(v) : v;
}

static inline uint64_t load64(const uint8_t *b)
{
    uint64_t v;
    memcpy(&v, b, sizeof v);
    return first_lowest(v);
}

/* ---- tokens ---- */

/* The upper bit of each byte that is zero. */
static inline uint64_t zero_bytes(uint64_t v)
{
    const uint64_t low = 0x7f7f7f7f7f7f7f7f;
    return ~(((v & low) + low) | v | low);
}

/* How many of the n bytes at b, at most RUN_MAX, are like the one before them. */
static size_t run_at(const uint8_t *b, size_t n)
{
    size_t most = n < RUN_MAX ? n : RUN_MAX, i = 0;
    uint64_t same = b[-1] * 0x0101010101010101u;
    while (i + 8 <= most && load64(b + i) == same)
        i += 8;
    while (i < most && b[i] == b[-1])
        i++;
    return i;
}

static size_t find_tokens(const uint8_t *b, size_t n, uint16_t *token)
{
    enum { STEP = 9 - RUN_MIN };               /* places in eight bytes where a run may begin */
    uint16_t *out = token;
    size_t i = 0;
    *out++ = b[i++];
    while (i + 8 <= n) {
        uint64_t same = zero_bytes(load64(b + i) ^ load64(b + i - 1)), starts = same & same >> 8 & same >> 16;
        int plain = starts != 0 ? __builtin_ctzll(starts) / 8 : STEP;
#pragma GCC unroll 8
        for (int k = 0; k < STEP; k++)
            out[k] = b[i + (size_t)k];
        out += plain;
        i += (size_t)plain;
        if (starts != 0) {
            size_t run = run_at(b + i, n - i);
            *out++ = (uint16_t)(RUN_TOKEN + run);
            i += run;
        }
    }
    while (i < n)
        *out++ = b[i++];
    return (size_t)(out - token);
}

/* ---- Huffman codes ---- */

/* Lengths of the best code for n > 1 weights that rise; they take the weights' place and fall (Moffat and Katajainen, In-place
 * calculation of minimum-redundancy codes, 1995). */
static void best_lengths(uint32_t *a, int n)
{
    a[0] += a[1];                              /* inner nodes; those that have a parent turn into its number */
    for (int next = 1, root = 0, leaf = 2; next < n - 1; next++) {
        a[next] = 0;
        for (int k = 0; k < 2; k++)
            if (leaf >= n || (root < next && a[root] < a[leaf])) {
                a[next] += a[root];
                a[root++] = (uint32_t)next;
            } else {
                a[next] += a[leaf++];
            }
    }
    a[n - 2] = 0;                              /* the depths of inner nodes */
    for (int next = n - 3; next >= 0; next--)
        a[next] = a[a[next]] + 1;
    for (int depth = 0, root = n - 2, next = n - 1, free = 1; free > 0; depth++) {
        int used = 0;
        for (; root >= 0 && (int)a[root] == depth; root--)
            used++;
        for (; free > used; free--)
            a[next--] = (uint32_t)depth;
        free = 2 * used;
    }
}

typedef struct Weighed { uint32_t weight, symbol; } Weighed;

static void sort_by_weight(Weighed *w, int n)
{
    static const int gaps[] = { 132, 57, 23, 10, 4, 1 };       /* Ciura 2001 */
    for (size_t g = 0; g < sizeof gaps / sizeof *gaps; g++)
        for (int gap = gaps[g], i = gap; i < n; i++) {
            Weighed x = w[i];
            int j = i;
            for (; j >= gap && w[j - gap].weight > x.weight; j -= gap)
                w[j] = w[j - gap];
            w[j] = x;
        }
}

static uint32_t reversed(uint32_t code, int n)
{
    uint32_t r = 0;
    for (; n > 0; n--, code >>= 1)
        r = r << 1 | (code & 1);
    return r;
}

/* From the lengths alone, as the reader of the stream does it; first bit lowest. */
static void number_codes(const uint8_t *length, int n, uint16_t *code)
{
    uint32_t next[SYMBOL_BITS + 2] = { 0 }, of_length[SYMBOL_BITS + 1] = { 0 };
    for (int i = 0; i < n; i++)
        of_length[length[i]]++;
    of_length[0] = 0;
    for (int k = 0; k <= SYMBOL_BITS; k++)
        next[k + 1] = (next[k] + of_length[k]) << 1;
    for (int i = 0; i < n; i++)
        code[i] = length[i] != 0 ? (uint16_t)reversed(next[length[i]]++, length[i]) : 0;
}

/* Codes for n symbols by how often they come, none longer than `most`; at least two get one. Changes the counts. */
static void make_codes(uint32_t *count, int n, int most, uint8_t *length, uint16_t *code)
{
    Weighed used[SYMBOLS];
    uint32_t depth[SYMBOLS];
    int n_used;
    for (;;) {
        n_used = 0;
        for (int i = 0; i < n; i++)
            if (count[i] != 0)
                used[n_used++] = (Weighed){ count[i], (uint32_t)i };
        for (int i = 0; n_used < 2; i++)
            if (count[i] == 0)
                used[n_used++] = (Weighed){ 0, (uint32_t)i };
        sort_by_weight(used, n_used);
        for (int i = 0; i < n_used; i++)
            depth[i] = used[i].weight;
        best_lengths(depth, n_used);
        if ((int)depth[0] <= most)
            break;
        for (int i = 0; i < n; i++)            /* flatter counts give a flatter tree */
            count[i] = (count[i] + 1) / 2;
    }
    memset(length, 0, (size_t)n);
    for (int i = 0; i < n_used; i++)
        length[used[i].symbol] = (uint8_t)depth[i];
    number_codes(length, n, code);
}

/* ---- groups of lengths ---- */

/* The symbol of a run, and what is left of its length in so many bits. */
static int group_of(int run, int *extra, int *n_extra)
{
    int x = run - RUN_MIN, k = x < 8 ? 0 : 29 - __builtin_clz((unsigned)x);    /* groups of four, twice as wide from 8 on */
    if (run == RUN_MAX) {
        *extra = *n_extra = 0;
        return SYMBOLS - 1;
    }
    *n_extra = k;
    *extra = x & ((1 << k) - 1);
    return END + 1 + 4 * k + (x >> k);
}

/* ---- writing ---- */

static inline void put(Deflate *d, uint32_t bits, int n)
{
    d->bits |= (uint64_t)bits << d->n_bits;
    d->n_bits += n;
}

/* Whole bytes go out. Seven beyond them are written, too. */
static inline uint8_t *put_out(Deflate *d, uint8_t *out)
{
    int n = d->n_bits / 8;
    uint64_t bits = first_lowest(d->bits);
    memcpy(out, &bits, sizeof bits);
    d->bits >>= 8 * n;                         /* n < 8: nobody puts more than 56 bits between */
    d->n_bits &= 7;
    return out + n;
}

typedef struct Codes {
    uint8_t length[SYMBOLS + 1];               /* the last is the code of the only distance, one byte back */
    uint16_t code[SYMBOLS];
} Codes;

/* The codes' lengths, zeros in a row put together, and Huffman coded themselves. */
static uint8_t *put_codes(Deflate *d, const Codes *c, uint8_t *out)
{
    enum { ZEROS = 17, MANY_ZEROS = 18 };      /* 3 to 10, 11 to 138 of them */
    static const uint8_t order[LENGTHS] = { 16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15 };
    uint8_t told[SYMBOLS + 1], more[SYMBOLS + 1], length[LENGTHS];
    uint32_t count[LENGTHS] = { 0 };
    uint16_t code[LENGTHS];
    int n = 0;
    for (int i = 0, zeros; i <= SYMBOLS; i += zeros > 0 ? zeros : 1, n++) {
        for (zeros = 0; i + zeros <= SYMBOLS && c->length[i + zeros] == 0 && zeros < 138;)
            zeros++;
        if (zeros < 3)
            zeros = 0;
        told[n] = zeros == 0 ? c->length[i] : zeros <= 10 ? ZEROS : MANY_ZEROS;
        more[n] = (uint8_t)(zeros <= 10 ? zeros - 3 : zeros - 11);
        count[told[n]]++;
    }
    make_codes(count, LENGTHS, LENGTH_BITS, length, code);
    put(d, SYMBOLS - 257, 5);
    put(d, 0, 5);                              /* one distance */
    put(d, LENGTHS - 4, 4);
    for (int i = 0; i < LENGTHS; i++) {
        put(d, length[order[i]], 3);
        out = put_out(d, out);
    }
    for (int i = 0; i < n; i++) {
        put(d, code[told[i]], length[told[i]]);
        if (told[i] >= ZEROS)
            put(d, more[i], told[i] == ZEROS ? 3 : 7);
        out = put_out(d, out);
    }
    return out;
}

/* What is written for each token: the bits below, their number in the upper eight. */
static void token_bits(const Codes *c, uint32_t *bits)
{
    for (int i = 0; i < END; i++)
        bits[i] = c->code[i] | (uint32_t)c->length[i] << 24;
    for (int run = RUN_MIN; run <= RUN_MAX; run++) {
        int extra, n_extra, symbol = group_of(run, &extra, &n_extra), n = c->length[symbol];
        uint32_t all = c->code[symbol] | (uint32_t)extra << n;         /* then a 0 for the distance */
        bits[RUN_TOKEN + run] = all | (uint32_t)(n + n_extra + 1) << 24;
    }
}

static uint8_t *put_tokens(Deflate *state, const uint32_t *bits, size_t n, uint8_t *out)
{
    Deflate d = *state;
    const uint16_t *token = d.token;
    size_t i = 0;
    for (; i + 2 <= n; i += 2) {               /* at most 21 bits each */
        uint32_t a = bits[token[i]], b = bits[token[i + 1]];
        put(&d, a & 0xffffff, (int)(a >> 24));
        put(&d, b & 0xffffff, (int)(b >> 24));
        out = put_out(&d, out);
    }
    if (i < n)
        put(&d, bits[token[i]] & 0xffffff, (int)(bits[token[i]] >> 24));
    out = put_out(&d, out);
    *state = d;
    return out;
}

static void count_symbols(const uint16_t *token, size_t n, uint32_t count[SYMBOLS])
{
    uint32_t even[TOKENS] = { 0 }, odd[TOKENS] = { 0 };    /* two, as equal neighbours would wait for each other */
    size_t i = 0;
    for (; i + 2 <= n; i += 2) {
        even[token[i]]++;
        odd[token[i + 1]]++;
    }
    if (i < n)
        even[token[i]]++;
    memset(count, 0, SYMBOLS * sizeof *count);
    for (int k = 0; k < END; k++)
        count[k] = even[k] + odd[k];
    for (int run = RUN_MIN; run <= RUN_MAX; run++) {
        int extra, n_extra;
        count[group_of(run, &extra, &n_extra)] += even[RUN_TOKEN + run] + odd[RUN_TOKEN + run];
    }
    count[END] = 1;
}

/* The sum that ends a zlib stream. */
static void add_to_sum(uint32_t adler[2], const uint8_t *bytes, size_t n)
{
    enum { MODULUS = 65521, FEW = 5552 };      /* so many cannot overflow 32 bits */
    uint32_t a = adler[0], b = adler[1];
    while (n > 0) {
        size_t now = n < FEW ? n : FEW, i = 0;
        for (; i + 4 <= now; i += 4) {
            const uint8_t *x = bytes + i;
            b += 4 * a + 4u * x[0] + 3u * x[1] + 2u * x[2] + x[3];
            a += (uint32_t)x[0] + x[1] + x[2] + x[3];
        }
        for (; i < now; i++) {
            a += bytes[i];
            b += a;
        }
        a %= MODULUS;
        b %= MODULUS;
        bytes += now;
        n -= now;
    }
    adler[0] = a;
    adler[1] = b;
}

size_t deflate_block(Deflate *d, const uint8_t *bytes, size_t n, bool last, uint8_t *out)
{
    enum { OWN_CODES = 2 };                    /* the kind of block */
    uint32_t count[SYMBOLS], bits[TOKENS];
    Codes codes;
    uint8_t *const start = out;
    size_t n_tokens = find_tokens(bytes, n, d->token);
    count_symbols(d->token, n_tokens, count);
    make_codes(count, SYMBOLS, SYMBOL_BITS, codes.length, codes.code);
    codes.length[SYMBOLS] = 1;
    add_to_sum(d->adler, bytes, n);
    put(d, last, 1);
    put(d, OWN_CODES, 2);
    out = put_codes(d, &codes, out);
    token_bits(&codes, bits);
    out = put_tokens(d, bits, n_tokens, out);
    put(d, codes.code[END], codes.length[END]);
    if (last) {
        d->n_bits = (d->n_bits + 7) & ~7;
        out = put_out(d, out);
        for (int i = 1; i >= 0; i--) {
            put(d, d->adler[i] >> 8, 8);
            put(d, d->adler[i] & 255, 8);
        }
    }
    return (size_t)(put_out(d, out) - start);
}
