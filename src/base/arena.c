/* arena.c - blocks of doubling size, chained; see arena.h. */
#include "base/arena.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/array.h"

enum { FIRST_BLOCK = 1 << 14, LARGEST_STEP = 1 << 24, SMALL_ALIGN = 16, LARGE_ALIGN = 64 };

struct ArenaBlock {
    ArenaBlock *older;
    size_t size;                               /* bytes behind this header */
};

static void out_of_memory(Arena *a)
{
    if (a->out_of_memory)
        a->out_of_memory(a->user);
    fputs("whit: out of memory\n", stderr);
    exit(3);
}

void arena_init(Arena *a)
{
    *a = (Arena){ 0 };
}

void arena_free(Arena *a)
{
    for (ArenaBlock *b = a->block; b;) {
        ArenaBlock *older = b->older;
        free(b);
        b = older;
    }
    a->block = NULL;
    a->next = a->end = NULL;
    a->used = 0;
}

static void add_block(Arena *a, size_t bytes)
{
    size_t size = a->block ? a->block->size * 2 : FIRST_BLOCK;
    if (size > LARGEST_STEP)
        size = LARGEST_STEP;
    if (size < bytes + LARGE_ALIGN)
        size = bytes + LARGE_ALIGN;
    ArenaBlock *b = malloc(sizeof *b + size);
    if (!b)
        out_of_memory(a);
    b->older = a->block;
    b->size = size;
    a->block = b;
    a->next = (char *)(b + 1);
    a->end = a->next + size;
}

static char *align_up(char *p, size_t align)
{
    uintptr_t over = (uintptr_t)p & (align - 1);
    return over ? p + (align - over) : p;
}

void *arena_alloc(Arena *a, size_t bytes)
{
    if (bytes > SIZE_MAX / 4 || (a->limit && a->used + bytes > a->limit))
        out_of_memory(a);
    size_t align = bytes >= LARGE_ALIGN ? LARGE_ALIGN : SMALL_ALIGN;
    if (!a->block)
        add_block(a, bytes);
    char *p = align_up(a->next, align);
    if (p > a->end || (size_t)(a->end - p) < bytes) {
        add_block(a, bytes);
        p = align_up(a->next, align);
    }
    a->next = p + bytes;
    a->used += bytes;
    return memset(p, 0, bytes);
}

void *arena_alloc_array(Arena *a, size_t n, size_t size)
{
    if (size && n > SIZE_MAX / 4 / size)
        out_of_memory(a);
    return arena_alloc(a, n * size);
}

void *arena_copy(Arena *a, const void *from, size_t bytes)
{
    void *to = arena_alloc(a, bytes);
    if (bytes)
        memcpy(to, from, bytes);
    return to;
}

ArenaMark arena_mark(const Arena *a)
{
    return (ArenaMark){ a->block, a->next, a->used };
}

void arena_rewind(Arena *a, ArenaMark mark)
{
    if (!mark.block) {                         /* marked when empty: keep the oldest block for the next round */
        while (a->block && a->block->older) {
            ArenaBlock *older = a->block->older;
            free(a->block);
            a->block = older;
        }
        if (a->block) {
            a->next = (char *)(a->block + 1);
            a->end = a->next + a->block->size;
        }
        a->used = 0;
        return;
    }
    while (a->block != mark.block) {
        ArenaBlock *older = a->block->older;
        free(a->block);
        a->block = older;
    }
    a->next = mark.next;
    a->end = (char *)(a->block + 1) + a->block->size;
    a->used = mark.used;
}

void *array_grow(Arena *a, const void *data, uint32_t n, uint32_t *capacity, size_t size)
{
    uint32_t more = *capacity ? *capacity * 2 : 8;
    if (more <= n)                             /* 32 bits of items are used up */
        out_of_memory(a);
    void *to = arena_alloc_array(a, more, size);
    if (n)
        memcpy(to, data, n * size);
    *capacity = more;
    return to;
}
