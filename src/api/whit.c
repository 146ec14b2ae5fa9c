/* whit.c - the public functions of include/whit.h: read, compile, render, write. */
#include "whit.h"

#include <setjmp.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "base/file.h"
#include "base/thread.h"
#include "compile/compile.h"
#include "image/compare.h"
#include "pattern/pattern.h"
#include "registry.h"
#include "render/render.h"
#include "sdl/host.h"
#include "texture/texture.h"

struct Whit {
    WhitOptions options;
    Arena arena;                               /* scene: lives as long as the World, which points into it */
    World world;
    Scene scene;
    Diag *diag;
    Query *query;
    bool loaded;
    int exit_code;
    volatile int interrupted;                  /* a sig_atomic_t, which is int */
    float *rgba;
    WhitShow *show;
    void *show_user;
    char *summary, *plan;
};

static void show_message(void *user, const DiagMessage *m)
{
    static const WhitKind kinds[] = { WHIT_ERROR, WHIT_WARNING, WHIT_DEBUG, WHIT_RENDER, WHIT_STATISTICS };
    Whit *w = user;
    if (!w->show)
        return;
    char *text = strndup(m->text.data, m->text.n);
    if (text)
        w->show(w->show_user, &(WhitMessage){ kinds[m->kind], text });
    free(text);
}

static void memory_ran_out(void *user)
{
    Whit *w = user;
    w->arena.limit = 0;                        /* so that the message itself has room */
    w->world.arena.limit = 0;
    Loc nowhere = { 0 };
    if (w->options.memory_limit)
        fail_io(w->diag, nowhere, "the scene needs more than the memory limit of %zu MiB", w->options.memory_limit >> 20);
    fail_io(w->diag, nowhere, "out of memory");
}

Whit *whit_new(const WhitOptions *options)
{
    Whit *w = calloc(1, sizeof *w);
    if (!w)
        return NULL;
    w->options = options ? *options : (WhitOptions){ 0 };
    WhitOptions *o = &w->options;
    o->width = o->width > 0 ? o->width : 160;
    o->height = o->height > 0 ? o->height : 120;
    o->quality = o->quality == 0 ? 9 : o->quality < 0 ? 0 : o->quality;
    arena_init(&w->arena);
    arena_init(&w->world.arena);
    w->diag = diag_new(&w->arena);
    diag_sink(w->diag, show_message, w);
    w->arena.limit = w->world.arena.limit = o->memory_limit;
    w->arena.out_of_memory = w->world.arena.out_of_memory = memory_ran_out;
    w->arena.user = w->world.arena.user = w;
    return w;
}

void whit_show(Whit *w, WhitShow *show, void *user)
{
    w->show = show;
    w->show_user = user;
}

void whit_free(Whit *w)
{
    if (!w)
        return;
    arena_free(&w->world.arena);
    arena_free(&w->arena);
    free(w->rgba);
    free(w->summary);
    free(w->plan);
    free(w);
}

/* The one landing of fail(): runs a step that may fail; false if it did. */
static bool attempt(Whit *w, void (*step)(Whit *w, void *with), void *with)
{
    if (setjmp(*diag_landing(w->diag)) == 0) {
        step(w, with);
        return true;
    }
    w->exit_code = diag_exit_code(w->diag);
    return false;
}

typedef struct Trouble { const char *path, *why; } Trouble;

static void tell_trouble(Whit *w, void *with)
{
    const Trouble *t = with;
    fail_io(w->diag, (Loc){ 0 }, "%s: %s", t->path, t->why);
}

/* ---- reading ---- */

static Colour host_pigment(void *user, const Pigment *pigment, Vec3 p)
{
    (void)user;
    return pigment_colour(pigment, p, NULL, NULL);
}

static void host_pigments(void *user, const Pigment *pigment, Vec3 *p, Colour *out, int n)
{
    (void)user;
    pigment_colours(pigment, p, out, n);
}

static double host_pattern(void *user, const Pattern *pattern, Vec3 p)
{
    (void)user;
    return pattern_value_at(pattern, pattern_point(pattern, p), NULL);
}

static void host_patterns(void *user, const Pattern *pattern, Vec3 *p, double *out, int n)
{
    (void)user;
    pattern_points(pattern, p, n);
    pattern_values(pattern, p, out, n);
}

static const Str *strings(Arena *a, const char *const *list, size_t n)
{
    Str *out = arena_array(a, Str, n);
    for (size_t i = 0; i < n; i++)
        out[i] = str_of(list[i]);
    return out;
}

static SdlOptions sdl_options(Whit *w, Str path)
{
    const WhitOptions *o = &w->options;
    Arena *a = &w->arena;
    SdlDeclare *declare = arena_array(a, SdlDeclare, o->n_declares);
    for (size_t i = 0; i < o->n_declares; i++)
        declare[i] = (SdlDeclare){ str_of(o->declare[i].name), str_of(o->declare[i].value), o->declare[i].is_string };
    Str name = o->input_name ? str_of(o->input_name) : file_base_name(path);
    return (SdlOptions){
        .width = o->width, .height = o->height, .version = o->version, .clock = o->clock, .initial_clock = o->initial_clock,
        .final_clock = o->final_clock, .clock_delta = o->clock_delta, .clock_on = o->clock_on,
        .frame_number = o->frame_number, .initial_frame = o->initial_frame, .final_frame = o->final_frame,
        .declare = declare, .n_declares = (uint32_t)o->n_declares,
        .library_path = strings(a, o->library_path, o->n_library_paths), .n_library_paths = (uint32_t)o->n_library_paths,
        .allow_read = strings(a, o->allow_read, o->n_allow_read), .n_allow_read = (uint32_t)o->n_allow_read,
        .allow_write = strings(a, o->allow_write, o->n_allow_write), .n_allow_write = (uint32_t)o->n_allow_write,
        .strict = o->strict, .stop = &w->interrupted, .input_name = name,
    };
}

/* What the scene asks for and whit leaves out, one warning each; with strict, an error. */
static void tell_unmodelled(Whit *w)
{
    static const struct { unsigned bit; const char *name; } features[] = {
        { SCENE_HAS_PHOTONS, "photons" },
        { SCENE_HAS_SUBSURFACE, "subsurface" },
    };
    Loc nowhere = { 0 };
    char all[128] = "";
    for (size_t i = 0; i < sizeof features / sizeof *features; i++) {
        if (!(w->scene.unmodelled & features[i].bit))
            continue;
        if (w->options.strict)
            fail(w->diag, nowhere, "%s is not modelled yet", features[i].name);
        warn(w->diag, nowhere, "%s is not modelled yet: rendered without it", features[i].name);
        strcat(strcat(all, *all ? ", " : ""), features[i].name);
    }
    if (*all) {
        free(w->summary);
        w->summary = malloc(sizeof all + 32);
        if (w->summary)
            sprintf(w->summary, "left out: %s\n", all);
    }
}

typedef struct Reading {
    Str path, text;
    bool compile;
    FileFeed *feed;                            /* of which the text is the window */
} Reading;

static void read_scene(Whit *w, void *with)
{
    const Reading *r = with;
    SdlHost host = { .registry = &registry, .user = w->query, .trace = query_trace, .inside = query_inside,
                     .extent = query_extent, .world = query_world, .pigment = host_pigment, .pigments = host_pigments,
                     .pattern = host_pattern, .patterns = host_patterns };
    SdlOptions options = sdl_options(w, r->path);
    options.feed = r->feed != NULL && !file_feed_is_whole(r->feed) ? r->feed : NULL;
    sdl_parse(&w->arena, w->diag, &host, &options, r->path, r->text, &w->scene);
    tell_unmodelled(w);
    if (r->compile)
        compile_world(&w->world, &w->scene, &registry, w->options.accel, w->diag);
    w->loaded = r->compile;
}

static bool load(Whit *w, Reading *r)
{
    if (w->query)
        return false;                          /* one scene each */
    w->query = query_new(&w->arena, &registry, w->diag);
    return attempt(w, read_scene, r);
}

static bool load_file(Whit *w, const char *path, bool compile)
{
    Str name = str_of(path);
    FileFeed feed;
    FileResult result = file_feed_open(&w->arena, name, &feed);
    if (result == FILE_MISSING) {              /* `whit scene` finds scene.pov */
        Str with_tail = str_concat(&w->arena, name, str_of(".pov"));
        if (file_feed_open(&w->arena, with_tail, &feed) == FILE_OK) {
            name = with_tail;
            result = FILE_OK;
        }
    }
    if (result != FILE_OK)
        return attempt(w, tell_trouble, &(Trouble){ path, file_result_text(result) });
    Reading reading = { str_copy(&w->arena, name), { feed.data, (uint32_t)feed.n }, compile, &feed };
    bool loaded = load(w, &reading);
    file_feed_close(&feed);
    return loaded;
}

bool whit_load(Whit *w, const char *path)
{
    return load_file(w, path, true);
}

bool whit_check(Whit *w, const char *path)
{
    return load_file(w, path, false);
}

bool whit_load_text(Whit *w, const char *name, const char *text, size_t bytes)
{
    Str own = str_copy(&w->arena, (Str){ text, (uint32_t)bytes });
    return load(w, &(Reading){ str_copy(&w->arena, str_of(name)), own, true, NULL });
}

/* ---- rendering ---- */

/* POV: Start: below 1 a share of the size, else a number from 1; End: up to 1 a share, else a number (03, section 7). Shares are of
 * single precision: 0.9 of 60 rows ends with row 52. */
static int region_start(double s, int size)
{
    return s < 1 ? (int)((double)(float)s * size) : (int)s - 1;
}

static int region_end(double e, int size)
{
    return e <= 0 ? size - 1 : e <= 1 ? (int)((double)(float)e * size) - 1 : (int)e - 1;
}

static bool region(Whit *w, RenderOptions *r)
{
    const WhitOptions *o = &w->options;
    r->first_column = region_start(o->start_column, o->width);
    r->last_column = region_end(o->end_column, o->width);
    r->first_row = region_start(o->start_row, o->height);
    r->last_row = region_end(o->end_row, o->height);
    return r->first_column >= 0 && r->first_row >= 0 && r->last_column < o->width && r->last_row < o->height
           && r->first_column <= r->last_column && r->first_row <= r->last_row;
}

/* On huge pages where the system has them: the faults of small ones are a tenth of what an empty scene takes. */
static float *pixels_new(size_t n)
{
    enum { HUGE_PAGE = 1 << 21 };
    size_t bytes = n * 4 * sizeof(float);
    if (bytes < HUGE_PAGE / 2)
        return malloc(bytes);
    bytes = (bytes + HUGE_PAGE - 1) & ~(size_t)(HUGE_PAGE - 1);
    float *pixels = aligned_alloc(HUGE_PAGE, bytes);
#ifdef MADV_HUGEPAGE
    if (pixels)
        madvise(pixels, bytes, MADV_HUGEPAGE);
#endif
    return pixels;
}

static void drop_picture(Whit *w)
{
    free(w->rgba);
    w->rgba = NULL;
}

static void prepare_picture(Whit *w, void *with)
{
    const WhitOptions *o = &w->options;
    RenderOptions *r = with;
    if (!region(w, r))
        fail(w->diag, (Loc){ 0 }, "the region of columns and rows does not lie within the picture");
    drop_picture(w);
    size_t pixels = (size_t)o->width * (size_t)o->height;
    w->rgba = pixels_new(pixels);
    if (!w->rgba)
        fail_io(w->diag, (Loc){ 0 }, "no memory for %d x %d pixels", o->width, o->height);
    bool whole = r->first_column == 0 && r->first_row == 0 && r->last_column == o->width - 1 && r->last_row == o->height - 1;
    for (size_t i = 0; !whole && i < pixels; i++)      /* outside the region: black and opaque */
        memcpy(w->rgba + 4 * i, (const float[4]){ 0, 0, 0, 1 }, 4 * sizeof *w->rgba);
}

void whit_interrupt(Whit *w)
{
    w->interrupted = 1;
}

typedef struct Telling { const Whit *w; WhitProgress *progress; void *user; } Telling;

static bool tell_progress(void *user, int done, int all)
{
    const Telling *t = user;
    return !t->w->interrupted && (!t->progress || t->progress(t->user, done, all));
}

bool whit_render(Whit *w, WhitProgress *progress, void *user)
{
    const WhitOptions *o = &w->options;
    RenderOptions r = {
        .width = o->width, .height = o->height, .threads = o->threads > 0 ? o->threads : thread_processors(),
        .quality = o->quality, .antialias = o->antialias,
        .threshold = o->antialias_threshold > 0 ? o->antialias_threshold : 0.3,
        .depth = o->antialias_depth > 0 ? o->antialias_depth : 3,
        .jitter = o->jitter == 0 ? 1 : o->jitter < 0 ? 0 : o->jitter,
        .antialias_gamma = o->antialias_gamma > 0 ? o->antialias_gamma : 2.5, .output_alpha = o->output_alpha,
    };
    if (!w->loaded || !attempt(w, prepare_picture, &r))
        return false;
    if (render(&w->world, &r, w->rgba, tell_progress, &(Telling){ w, progress, user }))
        return true;
    drop_picture(w);                           /* parts of it were never written */
    return false;
}

WhitImage whit_image(const Whit *w)
{
    static const WhitGamma kinds[] = { [GAMMA_NONE] = WHIT_GAMMA_NONE, [GAMMA_POWER] = WHIT_GAMMA_POWER, [GAMMA_SRGB] = WHIT_GAMMA_SRGB };
    const Globals *g = &w->scene.globals;
    return (WhitImage){ w->options.width, w->options.height, w->rgba, kinds[g->assumed_gamma], g->assumed_gamma_value };
}

static Transfer transfer(WhitGamma kind, double value)
{
    return kind == WHIT_GAMMA_SRGB ? (Transfer){ TRANSFER_SRGB, 0 }
           : kind == WHIT_GAMMA_POWER ? (Transfer){ TRANSFER_POWER, value } : (Transfer){ TRANSFER_NONE, 1 };
}

bool whit_write(Whit *w, const char *path, const WhitFileOptions *o)
{
    static const ImageFormat formats[] = { IMAGE_PNG, IMAGE_PPM, IMAGE_TGA, IMAGE_TGA, IMAGE_BMP, IMAGE_JPEG };
    static const DitherKind dithers[] = { DITHER_NONE, DITHER_B2, DITHER_B3, DITHER_B4, DITHER_D1, DITHER_D2, DITHER_FS };
    if (!w->rgba)
        return false;
    WhitImage im = whit_image(w);
    ImageWriting how = {
        .format = formats[o->format], .run_length = o->format == WHIT_TGA_RLE, .quality = o->quality,
        .quantising = { .working = transfer(im.working, im.working_gamma),
                        .file = o->gamma == WHIT_GAMMA_NONE ? (Transfer){ TRANSFER_SRGB, 0 } : transfer(o->gamma, o->gamma_value),
                        .bits = o->bits > 0 ? o->bits : 8, .alpha = o->alpha, .grey = o->grey, .dither = dithers[o->dither] },
    };
    char error[IMAGE_ERROR];
    if (image_write(path, w->rgba, im.width, im.height, &how, error))
        return true;
    return attempt(w, tell_trouble, &(Trouble){ path, error });
}

/* ---- telling ---- */

int whit_exit_code(const Whit *w)
{
    return w->exit_code;
}

const char *whit_summary(const Whit *w)
{
    return w->summary ? w->summary : "";
}

const char *whit_explain(Whit *w)
{
    if (!w->loaded)
        return "";
    free(w->plan);
    w->plan = strdup(str_c(&w->arena, compile_explain(&w->arena, &w->world)));
    return w->plan ? w->plan : "";
}

/* ---- comparing ---- */

static const Image *read_picture(Arena *a, const char *path, char error[256])
{
    Str bytes;
    char why[IMAGE_ERROR];
    FileResult result = file_read(a, NULL, str_of(path), &bytes);
    const char *trouble = result == FILE_OK ? NULL : file_result_text(result);
    const Image *im = trouble ? NULL : image_read(a, bytes, IMAGE_BY_CONTENT, &(ImageReading){ .exact = true, .version = 370 }, why);
    if (!im)
        snprintf(error, 256, "%.100s: %.150s", path, trouble ? trouble : why);
    return im;
}

static bool compare(Arena *arena, const char *a, const char *b, const char *heat, WhitDifference *out, char error[256])
{
    const Image *left = read_picture(arena, a, error), *right = left ? read_picture(arena, b, error) : NULL;
    if (!right)
        return false;
    if (left->width != right->width || left->height != right->height) {
        snprintf(error, 256, "the pictures differ in size: %d x %d and %d x %d", left->width, left->height, right->width, right->height);
        return false;
    }
    float *map = heat ? arena_array(arena, float, (size_t)left->width * (size_t)left->height * 4) : NULL;
    Comparison c;
    image_compare(left, right, &c, map);
    *out = (WhitDifference){ .width = left->width, .height = left->height, .over_1 = c.over_1, .over_4 = c.over_4, .mean = c.mean,
                             .max = c.max, .rmse = c.rmse, .psnr = c.psnr, .blocks_over_6 = c.blocks_over_6, .verdict = c.verdict };
    char why[IMAGE_ERROR];
    ImageWriting how = { .format = IMAGE_PNG, .quantising = { .working = { TRANSFER_NONE, 1 }, .file = { TRANSFER_SRGB, 0 }, .bits = 8 } };
    if (heat && !image_write(heat, map, left->width, left->height, &how, why)) {
        snprintf(error, 256, "%.100s: %.150s", heat, why);
        return false;
    }
    return true;
}

bool whit_compare(const char *a, const char *b, const char *heat, WhitDifference *out, char error[256])
{
    Arena arena;
    arena_init(&arena);
    bool ok = compare(&arena, a, b, heat, out, error);
    arena_free(&arena);
    return ok;
}
