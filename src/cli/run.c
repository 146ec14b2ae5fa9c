/* run.c - renders what the settings say: every frame of it, to its file.
 *
 * Standard output carries picture data alone; messages and progress go to standard error. Nothing is said on success,
 * except warnings and what the scene itself prints. */
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "cli/settings.h"

static volatile sig_atomic_t interrupted;
static Whit *volatile running;                 /* what a signal interrupts */

static void on_signal(int number)
{
    if (interrupted)                           /* the second time: at once */
        _exit(128 + number);
    interrupted = 1;
    if (running)
        whit_interrupt(running);
}

static void show(void *user, const WhitMessage *m)
{
    const Settings *s = user;
    if (s->quiet && m->kind != WHIT_ERROR)
        return;
    fputs(m->text, stderr);
    size_t n = strlen(m->text);
    if ((m->kind == WHIT_ERROR || m->kind == WHIT_WARNING) && (n == 0 || m->text[n - 1] != '\n'))
        fputc('\n', stderr);
}

typedef struct Progress {
    struct timespec last;
    bool shown, on;
} Progress;

static bool progress(void *user, int done, int all)
{
    Progress *p = user;
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    double passed = (double)(now.tv_sec - p->last.tv_sec) + 1e-9 * (double)(now.tv_nsec - p->last.tv_nsec);
    if (p->on && passed >= 0.1) {
        fprintf(stderr, "\r%3d %%", all ? (int)(100.0 * done / all) : 100);
        fflush(stderr);
        p->last = now;
        p->shown = true;
    }
    return !interrupted;
}

/* The format, its bits and grey from "N16", "Ng", "P"; false: unknown letter. */
static bool file_type(const Settings *s, WhitFileOptions *out, char why[256])
{
    static const char letters[] = "NPTCBJ";
    static const WhitFormat formats[] = { WHIT_PNG, WHIT_PPM, WHIT_TGA, WHIT_TGA_RLE, WHIT_BMP, WHIT_JPEG };
    const char *type = s->file_type && *s->file_type ? s->file_type : "N";
    const char *at = strchr(letters, type[0] >= 'a' && type[0] <= 'z' ? type[0] - 'a' + 'A' : type[0]);
    if (!at) {
        snprintf(why, 256, "whit cannot write pictures of type '%.40s': N png, P ppm, T and C tga, B bmp, J jpeg", type);
        return false;
    }
    out->format = formats[at - letters];
    out->bits = (int)fmin(fmax(s->bits, 5), 16);
    if (type[1] >= '0' && type[1] <= '9')
        out->bits = (int)fmin(fmax(atof(type + 1), 5), 16);
    out->grey = s->grey || ((type[1] == 'g' || type[1] == 'G') && !type[2]);
    out->alpha = s->alpha;
    out->quality = (int)fmin(fmax(s->compression, 0), 100);
    return true;
}

static bool file_options(const Settings *s, WhitFileOptions *out, char why[256])
{
    *out = (WhitFileOptions){ 0 };
    if (!file_type(s, out, why))
        return false;
    if (s->file_gamma && strcasecmp(s->file_gamma, "srgb") != 0) {
        out->gamma = WHIT_GAMMA_POWER;
        out->gamma_value = atof(s->file_gamma);
        if (!(out->gamma_value > 0)) {
            snprintf(why, 256, "File_Gamma must be sRGB or a number over 0, not '%.80s'", s->file_gamma);
            return false;
        }
    }
    static const char *const names[] = { "B2", "B3", "B4", "D1", "D2", "FS" };
    if (s->dither) {
        out->dither = WHIT_DITHER_FS;
        for (int i = 0; s->dither_method && i < 6; i++)
            if (strcasecmp(names[i], s->dither_method) == 0)
                out->dither = (WhitDither)(WHIT_DITHER_B2 + i);
    }
    return true;
}

static const char *extension(WhitFormat format)
{
    static const char *const tails[] = { ".png", ".ppm", ".tga", ".tga", ".bmp", ".jpg" };
    return tails[format];
}

/* Where the picture goes (02-command-line, section 6): next to the scene, or as +O says; "-" is standard output. */
static void output_path(const Settings *s, WhitFormat format, const Frames *f, int frame, char path[4096])
{
    const char *tail = extension(format), *given = s->output ? s->output : "";
    if (strcmp(given, "-") == 0 || strcasecmp(given, "stdout") == 0) {
        strcpy(path, "-");
        return;
    }
    char base[2048];
    const char *scene = strcmp(s->input, "-") == 0 ? "stdin" : s->input, *slash = strrchr(scene, '/');
    size_t n = strlen(given);
    if (n == 0)
        snprintf(base, sizeof base, "%s", scene);
    else if (given[n - 1] == '/')
        snprintf(base, sizeof base, "%s%s", given, slash ? slash + 1 : scene);
    else
        snprintf(base, sizeof base, "%s", given);
    /* The scene's own extension goes; of a given name only the format's own, or a dot at the end. */
    char *file = strrchr(base, '/'), *dot = strrchr(file ? file : base, '.');
    bool whole_name = n != 0 && given[n - 1] != '/';
    if (dot && dot != base && (!whole_name || strcasecmp(dot, tail) == 0 || dot[1] == 0))
        *dot = 0;
    if (f->animated)
        snprintf(path, 4096, "%s%0*d%s", base, f->digits, frame, tail);
    else
        snprintf(path, 4096, "%s%s", base, tail);
}

static bool exists(const char *path)
{
    struct stat st;
    return stat(path, &st) == 0;
}

/* The standard includes, where POV-Ray's packages put them, after all other paths. */
static void default_paths(TextList *list)
{
    static const char *const paths[] = { "/usr/share/povray-3.7/include", "/usr/local/share/povray-3.7/include",
                                         "/usr/share/povray/include", "/opt/homebrew/share/povray-3.7/include" };
    if (getenv("POVINC"))
        text_list_add(list, getenv("POVINC"));
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++)
        if (exists(paths[i]))
            text_list_add(list, paths[i]);
}

static WhitOptions render_options(const Settings *s, const TextList *library, const WhitDeclare *declare, size_t n_declares)
{
    WhitOptions o = {
        .width = (int)s->width, .height = (int)s->height, .threads = (int)fmin(fmax(s->threads, 0), 512),
        .quality = s->quality >= 1 ? (int)fmin(s->quality, 11) : -1,
        .antialias = s->antialias ? (s->method >= 2 ? 2 : s->method >= 1 ? 1 : 0) : 0,
        .antialias_threshold = fmin(fmax(s->threshold, 0), 1), .antialias_depth = (int)fmin(fmax(s->depth, 1), 9),
        .jitter = s->jitter && s->jitter_amount > 0 ? s->jitter_amount : -1, .antialias_gamma = s->antialias_gamma,
        .output_alpha = s->alpha, .version = (int)lround(s->version * 100),
        .start_column = s->has_start_column ? s->start_column : 0, .end_column = s->has_end_column ? s->end_column : 0,
        .start_row = s->has_start_row ? s->start_row : 0, .end_row = s->has_end_row ? s->end_row : 0,
        .library_path = (const char *const *)library->item, .n_library_paths = library->n,
        .allow_read = (const char *const *)s->allow_read.item, .n_allow_read = s->allow_read.n,
        .allow_write = (const char *const *)s->allow_write.item, .n_allow_write = s->allow_write.n,
        .declare = declare, .n_declares = n_declares, .strict = s->strict,
        .memory_limit = (size_t)(fmax(s->memory_limit, 0) * 1048576), .accel = s->accel,
    };
    /* Zero means "default" to the library; these are given, and may be zero. */
    if (s->antialias && s->threshold <= 0)
        o.antialias_threshold = 1e-30;
    if (s->antialias_gamma <= 0)
        o.antialias_gamma = 2.5;
    return o;
}

/* NAME=value or NAME="text"; the first declaration of a name wins. The lists point into the settings. */
static size_t declares(const Settings *s, WhitDeclare *out, char *why)
{
    size_t n = 0;
    for (size_t i = 0; i < s->declare.n; i++) {
        char *text = s->declare.item[i], *equals = strchr(text, '=');
        if (!equals) {
            snprintf(why, 256, "Declare needs NAME=value, not '%.80s'", text);
            return (size_t)-1;
        }
        *equals = 0;
        char *value = equals + 1;
        size_t m = strlen(value);
        bool quoted = m >= 2 && value[0] == '"' && value[m - 1] == '"';
        if (quoted) {
            value[m - 1] = 0;
            value++;
        }
        bool known = false;
        for (size_t k = 0; k < n; k++)
            known = known || strcmp(out[k].name, text) == 0;
        if (!known)
            out[n++] = (WhitDeclare){ text, value, quoted };
    }
    return n;
}

static char *read_all(FILE *f, size_t *n)
{
    size_t room = 1 << 16, have = 0;
    char *data = malloc(room);
    for (size_t got; data && (got = fread(data + have, 1, room - have, f)) > 0;) {
        have += got;
        if (have == room) {
            char *more = realloc(data, room *= 2);
            if (!more)
                free(data);
            data = more;
        }
    }
    *n = have;
    return data;
}

static bool load(Whit *w, const Settings *s)
{
    if (s->check && strcmp(s->input, "-") != 0)
        return whit_check(w, s->input);
    if (strcmp(s->input, "-") != 0)
        return whit_load(w, s->input);
    size_t n;
    char *text = read_all(stdin, &n);
    bool ok = text && whit_load_text(w, "stdin", text, n);
    free(text);
    return ok;
}

static void stats(double parse, double render)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    double cpu = (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec)
                 + 1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    fprintf(stderr, "{\"load_s\":%.4f,\"render_s\":%.4f,\"cpu_s\":%.4f,\"peak_kib\":%ld}\n", parse, render, cpu, usage.ru_maxrss);
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int render_loaded(Whit *w, const Settings *s, const WhitFileOptions *file, const char *path)
{
    Progress p = { .on = isatty(STDERR_FILENO) && !s->quiet };
    bool done = whit_render(w, progress, &p);
    if (p.shown)
        fputs("\r      \r", stderr);
    if (!done)
        return interrupted ? CLI_INTERRUPTED : whit_exit_code(w) ? whit_exit_code(w) : CLI_SCENE;
    if (s->to_file && !whit_write(w, path, file))
        return CLI_IO;
    if (s->verbose && s->to_file)
        fprintf(stderr, "whit: wrote %s\n", path);
    return CLI_OK;
}

static int frame_render(const Settings *s, WhitOptions *options, const WhitFileOptions *file, const Frames *f, int frame)
{
    char path[4096];
    output_path(s, file->format, f, frame, path);
    if (s->continue_trace && strcmp(path, "-") != 0 && exists(path)) {
        fprintf(stderr, "whit: %s exists; skipped\n", path);
        return CLI_OK;
    }
    options->clock = frame_clock(f, s, frame);
    options->clock_on = f->animated || s->has_clock;
    options->frame_number = f->animated ? frame : 0;
    options->initial_frame = f->animated ? f->initial : 0;
    options->final_frame = f->animated ? f->final : 0;
    options->initial_clock = f->initial_clock;
    options->final_clock = f->final_clock;
    options->clock_delta = f->delta;
    Whit *w = whit_new(options);
    if (!w) {
        fputs("whit: out of memory\n", stderr);
        return CLI_IO;
    }
    whit_show(w, show, (void *)s);
    running = w;
    double start = now(), loaded = start;
    int code = CLI_OK;
    if (!load(w, s)) {
        code = interrupted ? CLI_INTERRUPTED : whit_exit_code(w);
    } else if (s->explain) {
        fputs(whit_explain(w), stdout);
    } else if (!s->check) {
        loaded = now();
        code = render_loaded(w, s, file, path);
    }
    if (!s->quiet && code == CLI_OK)
        fputs(whit_summary(w), stderr);
    if (s->stats)
        stats(loaded - start, now() - loaded);
    running = NULL;
    whit_free(w);
    return code;
}

int cli_render(const Settings *s)
{
    char why[256] = "";
    WhitFileOptions file;
    WhitDeclare *declare = calloc(s->declare.n + 1, sizeof *declare);
    size_t n_declares = declare ? declares(s, declare, why) : (size_t)-1;
    bool sizes = s->width >= 1 && s->height >= 1 && s->width <= 100000 && s->height <= 100000;
    if (!sizes)
        snprintf(why, sizeof why, "the picture must be 1 to 100000 pixels wide and high, not %g x %g", s->width, s->height);
    if (!sizes || n_declares == (size_t)-1 || !file_options(s, &file, why)) {
        fprintf(stderr, "whit: %s\n", why);
        free(declare);
        return CLI_USAGE;
    }
    signal(SIGINT, on_signal);
    signal(SIGTERM, on_signal);
    TextList library = { 0 };
    for (size_t i = 0; i < s->library.n; i++)
        text_list_add(&library, s->library.item[i]);
    default_paths(&library);
    WhitOptions options = render_options(s, &library, declare, n_declares);
    Frames f = frames_of(s);
    int code = CLI_OK;
    for (int frame = f.first; code == CLI_OK && frame <= f.last; frame += f.step)
        code = interrupted ? CLI_INTERRUPTED : frame_render(s, &options, &file, &f, frame);
    for (size_t i = 0; i < library.n; i++)
        free(library.item[i]);
    free(library.item);
    free(declare);
    return code;
}
