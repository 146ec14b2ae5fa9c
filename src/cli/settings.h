/* settings.h - all that the command line and INI files can say, and where it is read. */
#ifndef CLI_SETTINGS_H
#define CLI_SETTINGS_H

#include <stdio.h>

#include "whit.h"

enum { CLI_OK = 0, CLI_SCENE = 1, CLI_USAGE = 2, CLI_IO = 3, CLI_INTERRUPTED = 130 };

typedef struct TextList {
    char **item;
    size_t n;
} TextList;

typedef struct Settings {
    char *input, *output, *header, *input_dir;
    TextList library, declare, allow_read, allow_write;
    double version;
    double width, height;
    double start_column, end_column, start_row, end_row;
    bool has_start_column, has_end_column, has_start_row, has_end_row;
    double quality;
    bool antialias;
    double threshold, method, depth, antialias_gamma, jitter_amount;
    bool jitter;
    bool to_file;
    char *file_type;                           /* first character counts; digits: bits; g: grey */
    double bits, compression;
    bool grey, alpha, dither;
    char *dither_method, *file_gamma, *display_gamma;
    bool continue_trace;
    double clock, initial_clock, final_clock, initial_frame, final_frame, subset_start, subset_end, frame_step;
    bool has_clock, has_final_clock, has_initial_frame, has_final_frame, has_subset_start, has_subset_end, cyclic;
    double threads;
    bool verbose, explain, check, strict, quiet;
    char *accel, *stats;
    double memory_limit;                       /* MiB */
    char *ignored;                             /* where settings that whit has no use for are put */
    double ignored_number;
    bool ignored_flag;
} Settings;

void settings_init(Settings *s);
void settings_free(Settings *s);

/* One argument of the command line (not argv[0]). False: `why` says what is wrong with it. */
bool settings_argument(Settings *s, const char *argument, char why[256]);

/* Key = value of an INI file or the command line. */
bool settings_key(Settings *s, const char *key, size_t key_n, const char *value, char why[256]);

/* Reads an INI file, `name` or `name[section]`; found relative to the current folder, then on the library path. */
bool settings_ini(Settings *s, const char *name, char why[256]);

bool text_list_add(TextList *list, const char *text);
void settings_help(FILE *to, bool all);        /* made from the one table of options */

/* Frames to render: first, last and the clock of each; not an animation: one frame, animated = false. */
typedef struct Frames {
    bool animated;
    int first, last, step, digits;             /* digits: of the number appended to the file name */
    int initial, final;                        /* as the scene sees them */
    double initial_clock, final_clock, delta;
} Frames;

Frames frames_of(const Settings *s);
double frame_clock(const Frames *f, const Settings *s, int frame);

int cli_render(const Settings *s);             /* renders what the settings say: exit code */
int cli_diff(int argc, char **argv);           /* whit diff ... */

#endif
