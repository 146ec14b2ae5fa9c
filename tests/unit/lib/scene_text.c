/* scene_text.c - see scene_text.h. */
#include "lib/scene_text.h"

#include <stdio.h>
#include <string.h>

#include "base/diag.h"
#include "pattern/pattern.h"
#include "registry.h"
#include "sdl/host.h"
#include "texture/texture.h"

static void show(void *user, const DiagMessage *m)
{
    SceneText *s = user;
    size_t n = strlen(s->messages);
    snprintf(s->messages + n, sizeof s->messages - n, "%.*s\n", STR_ARGS(m->text));
}

static Colour host_pigment(void *user, const Pigment *pigment, Vec3 p)
{
    (void)user;
    return pigment_colour(pigment, p, NULL, NULL);
}

static double host_pattern(void *user, const Pattern *pattern, Vec3 p)
{
    (void)user;
    return pattern_value_at(pattern, p, NULL);
}

static void host_pigments(void *user, const Pigment *pigment, Vec3 *p, Colour *out, int n)
{
    (void)user;
    pigment_colours(pigment, p, out, n);
}

static void host_patterns(void *user, const Pattern *pattern, Vec3 *p, double *out, int n)
{
    (void)user;
    pattern_values(pattern, p, out, n);
}

bool scene_text(SceneText *s, const char *text)
{
    const char *accel = s->accel;
    memset(s, 0, sizeof *s);
    s->accel = accel;
    arena_init(&s->arena);
    arena_init(&s->world.arena);
    s->diag = diag_new(&s->arena);
    diag_sink(s->diag, show, s);
    s->query = query_new(&s->arena, &registry, s->diag);
    if (setjmp(*diag_landing(s->diag)) != 0)
        return false;
    static const Str path[] = { { "/usr/share/povray-3.7/include", 29 }, { "tests/vectors/inputs", 20 } };
    SdlHost host = { .registry = &registry, .user = s->query, .trace = query_trace, .inside = query_inside,
                     .extent = query_extent, .world = query_world, .pigment = host_pigment, .pigments = host_pigments,
                     .pattern = host_pattern, .patterns = host_patterns };
    SdlOptions options = { .width = 160, .height = 120, .version = 370, .input_name = str_of("test"), .library_path = path,
                           .n_library_paths = 2 };
    sdl_parse(&s->arena, s->diag, &host, &options, str_of("test.pov"), str_of(text), &s->scene);
    compile_world(&s->world, &s->scene, &registry, s->accel, s->diag);
    return true;
}

void scene_text_end(SceneText *s)
{
    arena_free(&s->world.arena);
    arena_free(&s->arena);
}

bool scene_text_trace(const SceneText *s, Vec3 o, Vec3 d, Vec3 *point, Vec3 *normal)
{
    return query_trace(s->query, s->scene.object[0], o, d, point, normal);
}
