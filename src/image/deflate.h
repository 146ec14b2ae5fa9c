/* deflate.h - zlib streams (RFC 1950 and 1951) of what pictures leave when each pixel is told from its neighbours: every block with
 * Huffman codes of its own, and repetition of single bytes only. */
#ifndef IMAGE_DEFLATE_H
#define IMAGE_DEFLATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct Deflate {
    uint64_t bits;                             /* not yet written: n_bits, the first lowest */
    int n_bits;
    uint32_t adler[2];
    uint16_t *token;                           /* room for as many as a block has bytes */
} Deflate;

/* A stream begins; block_bytes: the largest of its blocks. False: out of memory. */
bool deflate_start(Deflate *d, size_t block_bytes);
void deflate_free(Deflate *d);

/* The next block, n > 0; how many bytes it gave. `out` has room for deflate_most(n). `last`: the stream ends with it. */
size_t deflate_block(Deflate *d, const uint8_t *bytes, size_t n, bool last, uint8_t *out);

static inline size_t deflate_most(size_t n) { return 2 * n + 1024; }

#endif
