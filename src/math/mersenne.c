/* mersenne.c - see mersenne.h. */
#include "math/mersenne.h"

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

void mersenne_fill(double *out, uint32_t n)
{
    Mersenne m;
    mersenne_seed(&m, MERSENNE_SEED);
    for (uint32_t done = 0; done < n;) {
        mersenne_turn(&m);
        for (uint32_t i = 0; i < MERSENNE_N && done < n; i++)
            out[done++] = tempered(m.state[i]) / 4294967296.0;
    }
}
