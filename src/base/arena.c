/* arena.c - blocks of doubling size, chained; see arena.h.
 *
 * Large blocks come straight from the system: they are born zeroed, and what was never handed out need not be cleared. Huge pages
 * are not asked for: where a virtual machine gives free ones back to its host, they cost more to get than they save. */
#include "base/arena.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "base/array.h"

enum { FIRST_BLOCK = 1 << 14, LARGEST_STEP = 1 << 24, LINE = 64, MAPPED_FROM = 1 << 21 };

struct ArenaBlock {
    ArenaBlock *older;
    size_t size;                               /* bytes behind this header */
    bool mapped;                               /* by the system; else by malloc */
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

static void drop_newest(Arena *a)
{
    ArenaBlock *b = a->block;
    a->block = b->older;
    if (b->mapped)
        munmap(b, sizeof *b + b->size);
    else
        free(b);
}

void arena_free(Arena *a)
{
    while (a->block)
        drop_newest(a);
    a->next = a->clean = a->end = NULL;
    a->used = 0;
}

static void *map_block(size_t bytes)
{
    void *b = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return b != MAP_FAILED ? b : NULL;
}

static void add_block(Arena *a, size_t bytes)
{
    size_t size = a->block ? a->block->size * 2 : FIRST_BLOCK;
    if (size > LARGEST_STEP)
        size = LARGEST_STEP;
    if (size < bytes + LINE)
        size = bytes + LINE;
    bool mapped = size >= MAPPED_FROM;
    ArenaBlock *b = mapped ? map_block(sizeof *b + size) : malloc(sizeof *b + size);
    if (!b)
        out_of_memory(a);
    *b = (ArenaBlock){ a->block, size, mapped };
    a->block = b;
    a->next = (char *)(b + 1);
    a->end = a->next + size;
    a->clean = mapped ? a->next : a->end;
}

static char *align_up(char *p, size_t align)
{
    uintptr_t over = (uintptr_t)p & (align - 1);
    return over ? p + (align - over) : p;
}

/* A new block, memory that has been used before, or nothing out of the ordinary. */
void *arena_alloc_slow(Arena *a, size_t bytes)
{
    if (bytes > SIZE_MAX / 4 || (a->limit && a->used + bytes > a->limit))
        out_of_memory(a);
    size_t align = arena_align(bytes);
    if (!a->block)
        add_block(a, bytes);
    char *p = align_up(a->next, align);
    if (p > a->end || (size_t)(a->end - p) < bytes) {
        add_block(a, bytes);
        p = align_up(a->next, align);
    }
    a->next = p + bytes;
    a->used += bytes;
    if (p < a->clean)
        memset(p, 0, a->next < a->clean ? bytes : (size_t)(a->clean - p));
    if (a->clean < a->next)
        a->clean = a->next;
    return p;
}

void *arena_alloc_array(Arena *a, size_t n, size_t size)
{
    if (size && n > SIZE_MAX / 4 / size)
        out_of_memory(a);
    return arena_alloc(a, n * size);
}

void arena_trim(Arena *a, void *newest, size_t bytes)
{
    char *end = (char *)newest + bytes;
    a->used -= (size_t)(a->next - end);
    if (a->clean == a->next)                   /* behind it nothing was written to either */
        a->clean = end;
    a->next = end;
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
        while (a->block && a->block->older)
            drop_newest(a);
        if (a->block) {
            a->next = (char *)(a->block + 1);
            a->clean = a->end = a->next + a->block->size;
        }
        a->used = 0;
        return;
    }
    while (a->block != mark.block)
        drop_newest(a);
    a->next = mark.next;
    a->clean = a->end = (char *)(a->block + 1) + a->block->size;
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
