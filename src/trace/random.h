/* random.h - the sources of chance of 03-camera-and-sampling: streams, the position hash, sub-random sequences.
 *
 * POV-Ray's streams run on through a thread's work, so its pictures depend on who rendered what. Here every tile starts its
 * streams anew at a place that depends on the tile alone; the first tile starts where POV-Ray's only thread does. */
#ifndef TRACE_RANDOM_H
#define TRACE_RANDOM_H

#include <stdbool.h>
#include <stdint.h>

#include "math/vec.h"

enum { STREAM_SIZE = 32768, HASH_SIZE = 4096 };

/* Streams A (area lights and rainbows) and M (media), each read at its own place. */
typedef struct Streams {
    const double *table;                       /* [STREAM_SIZE], by mersenne_fill */
    uint32_t at, media_at;                     /* last entries used */
    uint32_t grain;                            /* state of the generator behind crand */
    bool used;                                 /* since the start */
} Streams;

void streams_start(Streams *s, const double *table, uint32_t tile);

static inline double streams_uniform(Streams *s)       /* [0, 1) */
{
    s->used = true;
    s->at = (s->at + 1) % STREAM_SIZE;
    return s->table[s->at];
}

static inline void streams_skip(Streams *s, uint32_t n)       /* as n of the above */
{
    s->used |= n > 0;
    s->at = (s->at + n) % STREAM_SIZE;
}

static inline double streams_media(Streams *s)         /* [0, 1) */
{
    s->used = true;
    s->media_at = (s->media_at + 1) % STREAM_SIZE;
    return s->table[s->media_at];
}

static inline double streams_crand(Streams *s)         /* [0, 1] */
{
    s->used = true;
    s->grain = s->grain * 1812433253u + 12345u;
    return s->grain * (1.0 / 4294967295.0);
}

/* The hash of a sample position that all jitter of pixels comes from. */
typedef struct PositionHash {
    uint16_t permutation[HASH_SIZE];
    float jitter[256];
} PositionHash;

void position_hash_fill(PositionHash *h);

static inline double position_hashed(const PositionHash *h, int a, int b)
{
    int first = h->permutation[a & (HASH_SIZE - 1)];
    return (double)h->jitter[h->permutation[(first ^ b) & (HASH_SIZE - 1)] & 255];
}

static inline Vec2 position_jitter(const PositionHash *h, double x, double y)
{
    return (Vec2){ position_hashed(h, (int)(1021 * x), (int)(1019 * y)), position_hashed(h, (int)(1019 * x), (int)(1021 * y)) };
}

double radical_inverse(uint32_t base, uint32_t i);     /* Halton's sequence in one dimension: h_base(i) */

#endif
