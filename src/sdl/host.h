/* host.h - reading a scene: what sdl needs from rooms further down, given as values, and its one entry. */
#ifndef SDL_HOST_H
#define SDL_HOST_H

#include "base/file.h"
#include "scene/ops.h"

/* What parse-time built-ins ask of rooms that sdl may not include. Points are in scene space. */
typedef struct SdlHost {
    const Registry *registry;
    void *user;
    bool (*trace)(void *user, const Object *o, Vec3 from, Vec3 direction, Vec3 *point, Vec3 *normal);
    bool (*inside)(void *user, const Object *o, Vec3 p);
    Bounds (*extent)(void *user, const Object *o);
    Colour (*pigment)(void *user, const Pigment *pigment, Vec3 p);
    void (*pigments)(void *user, const Pigment *pigment, Vec3 *p, Colour *out, int n);     /* of n <= PATTERN_MANY points; uses up p */
    /* The object as an item of a World of its own, for patterns that ask "inside?" of it later, from any thread: it must live
     * as long as the scene is rendered. NULL: it contains nothing. */
    const struct World *(*world)(void *user, const Object *o, uint32_t *item);
    double (*pattern)(void *user, const Pattern *pattern, Vec3 p);     /* through its chain; after wave, frequency, phase */
    void (*patterns)(void *user, const Pattern *pattern, Vec3 *p, double *out, int n);
} SdlHost;

typedef struct SdlDeclare { Str name, value; bool is_string; } SdlDeclare;

typedef struct SdlOptions {
    int width, height, version;                /* version: of the option, 0 = not given */
    double clock, initial_clock, final_clock, clock_delta;
    bool clock_on;
    int frame_number, initial_frame, final_frame;
    const SdlDeclare *declare;      uint32_t n_declares;
    const Str *library_path;        uint32_t n_library_paths;
    const Str *allow_read;          uint32_t n_allow_read;
    const Str *allow_write;         uint32_t n_allow_write;
    bool strict;
    Str input_name;                            /* value of input_file_name */
    FileFeed *feed;                            /* NULL, or: the text is the window of this, and there is more behind it */
    const volatile int *stop;                  /* NULL, or: parsing fails where it stands once this is not 0 */
} SdlOptions;

/* Parses `text` of the file `path`; a zero stands behind it. The caller has set the landing of diag (diag_landing); mistakes jump there. */
void sdl_parse(Arena *scene_arena, Diag *diag, const SdlHost *host, const SdlOptions *options, Str path, Str text,
               Scene *out);

#endif
