/* random.c - see random.h. The Mersenne Twister is that of Matsumoto and Nishimura (1998), as std::mt19937. */
#include "trace/random.h"

void mersenne_seed(Mersenne *m, uint32_t seed)
{
    m->state[0] = seed;
    for (uint32_t i = 1; i < MERSENNE_N; i++)
        m->state[i] = 1812433253u * (m->state[i - 1] ^ (m->state[i - 1] >> 30)) + i;
    m->next = MERSENNE_N;
}

static inline uint32_t twisted(const uint32_t *at, uint32_t next, uint32_t far)
{
    uint32_t y = (*at & 0x80000000u) | (next & 0x7fffffffu);
    return far ^ (y >> 1) ^ (-(y & 1) & 0x9908b0dfu);
}

/* The next after the last is the first; what is far off is so round the end, too. */
static void mersenne_turn(Mersenne *m)
{
    enum { FAR = 397 };
    uint32_t *s = m->state, i = 0;
    for (; i < MERSENNE_N - FAR; i++)
        s[i] = twisted(&s[i], s[i + 1], s[i + FAR]);
    for (; i < MERSENNE_N - 1; i++)
        s[i] = twisted(&s[i], s[i + 1], s[i + FAR - MERSENNE_N]);
    s[i] = twisted(&s[i], s[0], s[FAR - 1]);
    m->next = 0;
}

static inline uint32_t tempered(uint32_t y)
{
    y ^= y >> 11;
    y ^= (y << 7) & 0x9d2c5680u;
    y ^= (y << 15) & 0xefc60000u;
    return y ^ (y >> 18);
}

uint32_t mersenne_next(Mersenne *m)
{
    if (m->next == MERSENNE_N)
        mersenne_turn(m);
    return tempered(m->state[m->next++]);
}

void stream_fill(double table[STREAM_SIZE])
{
    Mersenne m;
    mersenne_seed(&m, 5489);
    for (uint32_t done = 0; done < STREAM_SIZE;) {
        mersenne_turn(&m);
        for (uint32_t i = 0; i < MERSENNE_N && done < STREAM_SIZE; i++)
            table[done++] = tempered(m.state[i]) / 4294967296.0;
    }
}

/* Tiles start far apart in the table, so that neighbours do not repeat each other's grain. 20021 is odd, hence it visits every
 * entry before it comes back to one. */
void streams_start(Streams *s, const double *table, uint32_t tile)
{
    s->table = table;
    s->used = false;
    s->at = s->media_at = tile * 20021u % STREAM_SIZE;
    uint32_t h = tile * 0x9e3779b9u;           /* 0 stays 0 */
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    s->grain = h ^ (h >> 13);
}

/* POV: jitter is read from the table of a 16-bit CRC, written down there with six decimals. */
static float crc_jitter(uint32_t i)
{
    uint32_t c = i;
    for (int bit = 0; bit < 8; bit++)
        c = (c & 1) != 0 ? (c >> 1) ^ 0xa001u : c >> 1;
    double exact = (c & 0x7fff) / 32768.0 - 0.5;
    return (float)(round(exact * 1e6) / 1e6);
}

void position_hash_fill(PositionHash *h)
{
    for (uint32_t i = 0; i < HASH_SIZE; i++)
        h->permutation[i] = (uint16_t)i;
    uint32_t s = 0;
    for (uint32_t i = HASH_SIZE; i-- > 0;) {
        s = s * 1812433253u + 12345u;
        uint32_t j = ((s >> 16) & 0x7fff) % HASH_SIZE;
        uint16_t swapped = h->permutation[i];
        h->permutation[i] = h->permutation[j];
        h->permutation[j] = swapped;
    }
    for (uint32_t i = 0; i < 256; i++)
        h->jitter[i] = crc_jitter(i);
}

double radical_inverse(uint32_t base, uint32_t i)
{
    double result = 0, digit = 1.0 / base;
    for (; i > 0; i /= base, digit /= base)
        result += (i % base) * digit;
    return result;
}
