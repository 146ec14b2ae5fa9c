/* random.c - see random.h. */
#include "trace/random.h"

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
