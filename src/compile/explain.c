/* explain.c - a World in words: what it holds, how it is searched, which shortcuts are on. */
#include <stdio.h>

#include "base/array.h"
#include "compile/compile.h"

typedef struct Text {
    Arena *arena;
    Str all;
} Text;

static void line(Text *t, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void line(Text *t, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    Str s = str_vformat(t->arena, format, args);
    va_end(args);
    t->all = str_concat(t->arena, t->all, str_concat(t->arena, s, str_of("\n")));
}

static void shapes(Text *t, const World *w)
{
    for (const ShapeOps *const *row = w->registry->shape; *row != NULL; row++) {
        uint32_t n = 0;
        for (uint32_t i = 0; i < w->n_prims; i++)
            n += w->prim[i].ops == *row;
        if (n > 0)
            line(t, "  %u %s", n, (*row)->keyword);
    }
}

Str compile_explain(Arena *a, const World *w)
{
    static const struct { unsigned bit; const char *with, *without; } shortcuts[] = {
        { WORLD_HAS_CSG, "set operations: hits ask their siblings", "no set operations: every hit counts" },
        { WORLD_HAS_TRANSPARENT, "transparent things: shadow rays look for all hits", "all opaque: shadow rays stop at any hit" },
        { WORLD_HAS_REFLECTION, "reflection: rays go on", "no reflection" },
        { WORLD_HAS_FLAGS, "some things are hidden from some rays", NULL },
        { WORLD_HAS_FOG, "fog", NULL },
    };
    uint32_t helpers = 0;
    for (uint32_t i = 0; i < w->n_prims; i++)
        helpers += (w->prim[i].flags & PRIM_HELPER) != 0;
    Text t = { .arena = a };
    line(&t, "prims: %u, %u of them clip, bound or project only", w->n_prims, helpers);
    shapes(&t, w);
    line(&t, "set operations: %u", w->n_csg > 0 ? w->n_csg - 1 : 0);
    line(&t, "search: %s over %u, %u tried by every ray", w->accel_ops->name, w->n_accel_prims, w->n_unbounded);
    line(&t, "materials: %u, placed textures: %u, interiors: %u", w->n_materials, w->n_textures - 1, w->n_interiors - 2);
    line(&t, "lights: %u, %u of them in groups", w->n_lights, w->n_lights - w->n_global_lights);
    line(&t, "scale: scene times %g", w->unit);
    line(&t, "memory: %zu KiB", w->arena.used >> 10);
    for (size_t i = 0; i < sizeof shortcuts / sizeof *shortcuts; i++) {
        const char *text = w->features & shortcuts[i].bit ? shortcuts[i].with : shortcuts[i].without;
        if (text != NULL)
            line(&t, "%s", text);
    }
    return t.all;
}
