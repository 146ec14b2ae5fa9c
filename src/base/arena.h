/* arena.h - a bump allocator: things that die together live together.
 *
 * Three lifetimes use it: scene (parse to compile), world (compile to end), scratch (a worker's, rewound per pixel).
 * Nothing is freed singly. Only arena.c and image buffers call malloc. */
#ifndef BASE_ARENA_H
#define BASE_ARENA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct ArenaBlock ArenaBlock;

typedef struct Arena {
    ArenaBlock *block;                         /* newest block; older ones hang behind it */
    char *next, *end;                          /* free part of the newest block */
    char *clean;                               /* from here on it was never written: it is zero still */
    size_t used, limit;                        /* bytes handed out; 0 = no limit */
    void (*out_of_memory)(void *user);         /* must not return (longjmp); NULL prints and exits with 3 */
    void *user;
} Arena;

typedef struct ArenaMark {
    ArenaBlock *block;
    char *next;
    size_t used;
} ArenaMark;

void arena_init(Arena *a);
void arena_free(Arena *a);

void *arena_alloc_slow(Arena *a, size_t bytes);

/* Sizes are multiples of what their types are aligned to. */
static inline size_t arena_align(size_t bytes)
{
    size_t power = bytes & -bytes;             /* the largest power of two that divides it */
    return bytes % 64 == 0 ? 64 : power < 16 ? power : 16;
}

/* Zeroed. Aligned to 64 bytes when `bytes` is a multiple of it (whole lines of the cache), otherwise to the power of two that divides
 * `bytes`, 16 at most: what is no multiple of the alignment it needs, asks for more bytes. Never NULL. */
static inline void *arena_alloc(Arena *a, size_t bytes)
{
    size_t room = (size_t)(a->end - a->next), gap = -(uintptr_t)a->next & (arena_align(bytes) - 1);
    if (room <= gap || room - gap <= bytes || a->next < a->clean || a->limit != 0)
        return arena_alloc_slow(a, bytes);
    char *p = a->next + gap;
    a->next = a->clean = p + bytes;
    a->used += bytes;
    return p;
}

/* Gives back what is behind the first `bytes` of the newest allocation, and was not written to. */
void arena_trim(Arena *a, void *newest, size_t bytes);

/* A copy of `bytes` bytes at `from`. */
void *arena_copy(Arena *a, const void *from, size_t bytes);

ArenaMark arena_mark(const Arena *a);
void arena_rewind(Arena *a, ArenaMark mark);   /* everything allocated since the mark is gone */

#define arena_new(a, T) ((T *)arena_alloc((a), sizeof(T)))
#define arena_array(a, T, n) ((T *)arena_alloc_array((a), (n), sizeof(T)))

/* n * size, checked for overflow. */
void *arena_alloc_array(Arena *a, size_t n, size_t size);

#endif
