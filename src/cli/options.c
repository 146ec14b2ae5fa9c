/* options.c - the one table of switches and INI keys, and how an argument finds its row.
 *
 * `+W640`, `-A`, `Width=640`, `--check`. A switch fits if its letters begin the argument and it is followed by a
 * parameter exactly when it needs one (02-command-line, section 1), case ignored. */
#include <ctype.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/settings.h"

typedef enum Kind { FLAG, NUMBER, TEXT, LIST, SUFFIX } Kind;
/* FLAG: + or -. NUMBER, TEXT: parameter needed. LIST: text added. SUFFIX: flag whose letters may carry a text. */

typedef struct Row {
    const char *letters, *key;                 /* either may be NULL */
    Kind kind;
    size_t field;
    size_t also;                               /* a bool set when this was given; 0: none */
    const char *help;                          /* NULL: accepted without effect */
} Row;

#define AT(f) offsetof(Settings, f)
#define NOTHING_B AT(ignored_flag), 0, NULL
#define NOTHING_N AT(ignored_number), 0, NULL
#define NOTHING_T AT(ignored), 0, NULL

/* Longer letters stand before their prefixes. */
static const Row rows[] = {
    { "I", "Input_File_Name", TEXT, AT(input), 0, "scene file; - reads standard input" },
    { "O", "Output_File_Name", TEXT, AT(output), 0, "picture file; - writes standard output" },
    { "W", "Width", NUMBER, AT(width), 0, "pixels across (160)" },
    { "H", "Height", NUMBER, AT(height), 0, "pixels down (120)" },
    { "L", "Library_Path", LIST, AT(library), 0, "adds a folder to search for includes, fonts and images" },
    { "MV", "Version", NUMBER, AT(version), 0, "language version, as #version" },
    { "HI", "Include_Header", TEXT, AT(header), 0, "file read before the scene" },
    { NULL, "Declare", LIST, AT(declare), 0, "NAME=value: an identifier for the scene" },
    { "Q", "Quality", NUMBER, AT(quality), 0, "0..11 (9): what is rendered" },
    { "A", "Antialias_Threshold", NUMBER, AT(threshold), AT(antialias), "antialiasing where neighbours differ by more (0.3)" },
    { "A", "Antialias", FLAG, AT(antialias), 0, "antialiasing on or off" },
    { "AM", "Sampling_Method", NUMBER, AT(method), 0, "1 fixed grid, 2 recursive" },
    { "AG", "Antialias_Gamma", NUMBER, AT(antialias_gamma), 0, "gamma of the comparison (2.5)" },
    { "R", "Antialias_Depth", NUMBER, AT(depth), 0, "1..9 (3): samples per pixel side, or levels" },
    { "J", "Jitter_Amount", NUMBER, AT(jitter_amount), AT(jitter), "jitter of antialiasing samples (1)" },
    { "J", "Jitter", FLAG, AT(jitter), 0, "jitter on or off" },
    { "SC", "Start_Column", NUMBER, AT(start_column), AT(has_start_column), "first column; below 1: a share of the width" },
    { "EC", "End_Column", NUMBER, AT(end_column), AT(has_end_column), "last column" },
    { "SR", "Start_Row", NUMBER, AT(start_row), AT(has_start_row), "first row" },
    { "ER", "End_Row", NUMBER, AT(end_row), AT(has_end_row), "last row" },
    { "UA", "Output_Alpha", FLAG, AT(alpha), 0, "write an alpha channel" },
    { "F", "Output_File_Type", TEXT, AT(file_type), AT(to_file), "N png, P ppm, T tga, C tga packed, B bmp, J jpeg; then bits, or g" },
    { "F", "Output_to_File", FLAG, AT(to_file), 0, "write a picture at all" },
    { NULL, "Bits_Per_Color", NUMBER, AT(bits), 0, "5..16 (8)" },
    { NULL, "Bits_Per_Colour", NUMBER, AT(bits), 0, NULL },
    { NULL, "Grayscale_Output", FLAG, AT(grey), 0, "a grey picture" },
    { NULL, "Compression", NUMBER, AT(compression), 0, "JPEG quality (85)" },
    { "TH", "Dither_Method", TEXT, AT(dither_method), AT(dither), "B2 B3 B4 D1 D2 FS" },
    { "TH", "Dither", FLAG, AT(dither), 0, "dithering on or off" },
    { NULL, "File_Gamma", TEXT, AT(file_gamma), 0, "sRGB, or a number" },
    { NULL, "Display_Gamma", TEXT, AT(display_gamma), 0, NULL },
    { "C", "Continue_Trace", FLAG, AT(continue_trace), 0, "skip pictures that exist" },
    { "KFI", "Initial_Frame", NUMBER, AT(initial_frame), AT(has_initial_frame), "animation: first frame" },
    { "KFF", "Final_Frame", NUMBER, AT(final_frame), AT(has_final_frame), "animation: last frame" },
    { "KI", "Initial_Clock", NUMBER, AT(initial_clock), 0, "clock of the first frame (0)" },
    { "KF", "Final_Clock", NUMBER, AT(final_clock), AT(has_final_clock), "clock of the last frame (1)" },
    { "KC", "Cyclic_Animation", FLAG, AT(cyclic), 0, "the last frame is the one before the first" },
    { "KLA", "Clockless_Animation", FLAG, NOTHING_B },
    { "K", "Clock", NUMBER, AT(clock), AT(has_clock), "the value of clock" },
    { "SF", "Subset_Start_Frame", NUMBER, AT(subset_start), AT(has_subset_start), "render from this frame" },
    { "EF", "Subset_End_Frame", NUMBER, AT(subset_end), AT(has_subset_end), "render up to this frame" },
    { "STP", "Frame_Step", NUMBER, AT(frame_step), 0, "every n-th frame" },
    { "WT", "Work_Threads", NUMBER, AT(threads), 0, "threads (one per processor)" },
    { "V", "Verbose", FLAG, AT(verbose), 0, "say what is done" },
    { "SU", "Split_Unions", FLAG, NOTHING_B },
    { "UR", "Remove_Bounds", FLAG, NOTHING_B },
    { "GI", "Create_Ini", TEXT, NOTHING_T },
    { "BM", "Bounding_Method", NUMBER, NOTHING_N },
    { "MB", "Bounding_Threshold", NUMBER, NOTHING_N },
    { "MB", "Bounding", FLAG, NOTHING_B },
    { "B", NULL, FLAG, NOTHING_B },
    { NULL, "BSP_MaxDepth", NUMBER, NOTHING_N },
    { NULL, "BSP_ISectCost", NUMBER, NOTHING_N },
    { NULL, "BSP_BaseAccessCost", NUMBER, NOTHING_N },
    { NULL, "BSP_ChildAccessCost", NUMBER, NOTHING_N },
    { NULL, "BSP_MissChance", NUMBER, NOTHING_N },
    { "UL", "Light_Buffer", FLAG, NOTHING_B },
    { "UV", "Vista_Buffer", FLAG, NOTHING_B },
    { "UD", "Draw_Vistas", FLAG, NOTHING_B },
    { "RVP", "Radiosity_Vain_Pretrace", FLAG, NOTHING_B },
    { "RFI", "Radiosity_From_File", FLAG, NOTHING_B },
    { "RFO", "Radiosity_To_File", FLAG, NOTHING_B },
    { "RF", "Radiosity_File_Name", TEXT, NOTHING_T },
    { "HR", "High_Reproducibility", FLAG, NOTHING_B },
    { "UF", "Field_Render", FLAG, NOTHING_B },
    { "UO", "Odd_Field", FLAG, NOTHING_B },
    { "D", "Display", SUFFIX, NOTHING_B },
    { NULL, "Video_Mode", TEXT, NOTHING_T },
    { NULL, "Palette", TEXT, NOTHING_T },
    { "P", "Pause_When_Done", FLAG, NOTHING_B },
    { "SP", "Preview_Start_Size", NUMBER, NOTHING_N },
    { "EP", "Preview_End_Size", NUMBER, NOTHING_N },
    { "WL", "Warning_Level", NUMBER, NOTHING_N },
    { "BS", "Render_Block_Size", NUMBER, NOTHING_N },
    { "RP", "Render_Pattern", NUMBER, NOTHING_N },
    { "RS", "Render_Block_Step", NUMBER, NOTHING_N },
    { "MI", "Max_Image_Buffer_Memory", NUMBER, NOTHING_N },
    { "X", "Test_Abort", SUFFIX, NOTHING_B },
    { NULL, "Test_Abort_Count", NUMBER, NOTHING_N },
    { "RTR", "Real_Time_Raytracing", FLAG, NOTHING_B },
    { "GA", "All_Console", SUFFIX, NOTHING_B },
    { "GD", "Debug_Console", SUFFIX, NOTHING_B },
    { "GF", "Fatal_Console", SUFFIX, NOTHING_B },
    { "GR", "Render_Console", SUFFIX, NOTHING_B },
    { "GS", "Statistic_Console", SUFFIX, NOTHING_B },
    { "GW", "Warning_Console", SUFFIX, NOTHING_B },
    { NULL, "All_File", TEXT, NOTHING_T },
    { NULL, "Debug_File", TEXT, NOTHING_T },
    { NULL, "Fatal_File", TEXT, NOTHING_T },
    { NULL, "Render_File", TEXT, NOTHING_T },
    { NULL, "Statistic_File", TEXT, NOTHING_T },
    { NULL, "Warning_File", TEXT, NOTHING_T },
    { "GP", "Append_File", FLAG, NOTHING_B },
};

typedef struct LongRow {
    const char *name;
    Kind kind;
    size_t field;
    const char *help;
} LongRow;

static const LongRow long_rows[] = {
    { "check", FLAG, AT(check), "parse and report, render nothing" },
    { "explain", FLAG, AT(explain), "show the plan of the compiled scene, render nothing" },
    { "strict", FLAG, AT(strict), "what is not modelled, and input that would be mended, are errors" },
    { "quiet", FLAG, AT(quiet), "no warnings, no #debug text, no summary" },
    { "allow-read", LIST, AT(allow_read), "scenes may read below this folder" },
    { "allow-write", LIST, AT(allow_write), "scenes may write below this folder" },
    { "memory-limit", NUMBER, AT(memory_limit), "MiB a scene may use" },
    { "accel", TEXT, AT(accel), "bvh, or list (the plain referee)" },
    { "stats", TEXT, AT(stats), "json: one line of figures on standard error when done" },
};

#define COUNT(a) (sizeof(a) / sizeof *(a))

void settings_init(Settings *s)
{
    *s = (Settings){ .width = 160, .height = 120, .quality = 9, .threshold = 0.3, .method = 1, .depth = 3,
                     .antialias_gamma = 2.5, .jitter = true, .jitter_amount = 1, .to_file = true, .bits = 8,
                     .frame_step = 1 };
}

static void text_list_free(TextList *list)
{
    for (size_t i = 0; i < list->n; i++)
        free(list->item[i]);
    free(list->item);
}

void settings_free(Settings *s)
{
    char *texts[] = { s->input, s->output, s->header, s->input_dir, s->file_type, s->dither_method, s->file_gamma,
                      s->display_gamma, s->accel, s->stats, s->ignored };
    for (size_t i = 0; i < COUNT(texts); i++)
        free(texts[i]);
    text_list_free(&s->library);
    text_list_free(&s->declare);
    text_list_free(&s->allow_read);
    text_list_free(&s->allow_write);
}

bool text_list_add(TextList *list, const char *text)
{
    char **more = realloc(list->item, (list->n + 1) * sizeof *more);
    char *copy = strdup(text);
    if (more)
        list->item = more;
    if (!more || !copy) {
        free(copy);
        return false;
    }
    list->item[list->n++] = copy;
    return true;
}

/* POV: true if one of these words agrees with the value up to the shorter of both; so "" and "o" are true. */
static bool is_true(const char *value)
{
    static const char *const words[] = { "on", "true", "yes", "1" };
    for (size_t i = 0; i < COUNT(words); i++) {
        size_t n = strlen(words[i]), m = strlen(value);
        if (strncasecmp(value, words[i], n < m ? n : m) == 0)
            return true;
    }
    return false;
}

/* A number as C reads it, rubbish behind it ignored. Words of sRGB count as 2.2 where a number is wanted. */
static bool number(const char *text, double *out)
{
    char *end;
    double value = strtod(text, &end);
    if (end == text && strcasecmp(text, "srgb") == 0) {
        *out = 2.2;
        return true;
    }
    if (end == text || isnan(value))
        return false;
    *out = value;
    return true;
}

static bool store(Settings *s, Kind kind, size_t field, size_t also, const char *value, bool on, char why[256])
{
    void *at = (char *)s + field;
    if (kind == FLAG || kind == SUFFIX) {
        *(bool *)at = on;
    } else if (kind == NUMBER) {
        if (!number(value, at)) {
            snprintf(why, 256, "'%.80s' is not a number", value);
            return false;
        }
    } else if (kind == LIST) {
        if (!text_list_add(at, value)) {
            snprintf(why, 256, "out of memory");
            return false;
        }
    } else {
        char **text = at;
        free(*text);
        *text = strdup(value);
    }
    if (also)
        *(bool *)((char *)s + also) = on;
    return true;
}

/* POV: `+A0.3` and `+A` exist, `+A.3` and `+A1` do not: a threshold starts with 0. */
static bool takes(const Row *r, const char *rest)
{
    if (r->kind == FLAG)
        return *rest == 0;
    if (r->kind == SUFFIX)
        return true;
    if (*rest == 0)
        return false;
    if (r->kind == NUMBER && r->field == AT(threshold))
        return *rest == '0';
    if (r->kind == NUMBER)
        return isdigit((unsigned char)*rest) || *rest == '.' || *rest == '-' || *rest == '+' || strcasecmp(rest, "srgb") == 0;
    return true;
}

static bool switch_argument(Settings *s, const char *argument, char why[256])
{
    const char *letters = argument + 1;
    const Row *best = NULL;
    size_t best_n = 0;
    for (size_t i = 0; i < COUNT(rows); i++) {
        const Row *r = &rows[i];
        size_t n = r->letters ? strlen(r->letters) : 0;
        if (n > best_n && strncasecmp(letters, r->letters, n) == 0 && takes(r, letters + n)) {
            best = r;
            best_n = n;
        }
    }
    if (!best) {
        snprintf(why, 256, "there is no option '%.80s'; see whit --help", argument);
        return false;
    }
    char value[4096];
    const char *rest = letters + best_n;
    size_t n = strlen(rest);
    if (n >= 2 && (rest[0] == '"' || rest[0] == '\'') && rest[n - 1] == rest[0]) {
        rest++;
        n -= 2;
    }
    if (n >= sizeof value) {
        snprintf(why, 256, "the option '%.80s...' is too long", argument);
        return false;
    }
    memcpy(value, rest, n);
    value[n] = 0;
    return store(s, best->kind, best->field, best->also, value, argument[0] == '+', why);
}

bool settings_key(Settings *s, const char *key, size_t key_n, const char *value, char why[256])
{
    if (key_n == strlen("Include_Ini") && strncasecmp(key, "Include_Ini", key_n) == 0)
        return settings_ini(s, value, why);
    static const char *const commands[] = { "Pre_Scene_", "Post_Scene_", "Pre_Frame_", "Post_Frame_", "User_Abort_",
                                            "Fatal_Error_", "Histogram_", "Create_Histogram", "Buffer_" };
    for (size_t i = 0; i < COUNT(commands); i++)
        if (key_n >= strlen(commands[i]) && strncasecmp(key, commands[i], strlen(commands[i])) == 0) {
            fprintf(stderr, "whit: warning: '%.*s' is ignored: whit runs no commands\n", (int)key_n, key);
            return true;
        }
    for (size_t i = 0; i < COUNT(rows); i++) {
        const Row *r = &rows[i];
        if (!r->key || strlen(r->key) != key_n || strncasecmp(key, r->key, key_n) != 0)
            continue;
        /* An INI key of a type or method does not switch the thing on: `+TH` does. */
        size_t also = r->field == AT(dither_method) || r->field == AT(file_type) || r->field == AT(threshold)
                              || r->field == AT(jitter_amount) ? 0 : r->also;
        return store(s, r->kind, r->field, also, value, r->kind != FLAG && r->kind != SUFFIX ? true : is_true(value), why);
    }
    snprintf(why, 256, "there is no setting '%.*s'; see whit --help", (int)(key_n < 80 ? key_n : 80), key);
    return false;
}

static bool long_argument(Settings *s, const char *argument, char why[256])
{
    const char *name = argument + 2, *equals = strchr(name, '=');
    size_t n = equals ? (size_t)(equals - name) : strlen(name);
    for (size_t i = 0; i < COUNT(long_rows); i++) {
        const LongRow *r = &long_rows[i];
        if (strlen(r->name) != n || strncmp(name, r->name, n) != 0)
            continue;
        if (r->kind != FLAG && !equals) {
            snprintf(why, 256, "--%s needs a value: --%s=...", r->name, r->name);
            return false;
        }
        return store(s, r->kind, r->field, 0, equals ? equals + 1 : "", true, why);
    }
    snprintf(why, 256, "there is no option '%.80s'; see whit --help", argument);
    return false;
}

static bool ends_with_nocase(const char *text, const char *tail)
{
    size_t n = strlen(text), m = strlen(tail);
    return n >= m && strcasecmp(text + n - m, tail) == 0;
}

bool settings_argument(Settings *s, const char *argument, char why[256])
{
    size_t n = strlen(argument);
    if (strncmp(argument, "--", 2) == 0)
        return long_argument(s, argument, why);
    if (n > 1 && (argument[0] == '+' || argument[0] == '-'))
        return switch_argument(s, argument, why);
    const char *equals = strchr(argument, '=');
    if (equals && equals != argument)
        return settings_key(s, argument, (size_t)(equals - argument), equals + 1, why);
    if (ends_with_nocase(argument, ".pov") || strcmp(argument, "-") == 0)
        return store(s, TEXT, AT(input), 0, argument, true, why);
    if (n && argument[n - 1] == '/')
        return store(s, LIST, AT(library), 0, argument, true, why);
    return settings_ini(s, argument, why);
}

static void help_row(FILE *to, const char *name, const char *key, const char *help)
{
    fprintf(to, "  %-12s %-22s %s\n", name, key ? key : "", help);
}

void settings_help(FILE *to, bool all)
{
    static const char *const shown[] = { "I", "O", "W", "H", "L", "A", "AM", "Q", "UA", "F", "WT", "K", "KFF" };
    fputs("whit: renders POV-Ray scenes\n\n"
          "  whit scene.pov [+W640 +H480] [+Opicture.png] [+A0.3]     render a scene\n"
          "  whit --check scene.pov                                   parse only\n"
          "  whit diff A.png B.png                                    compare two pictures\n\n", to);
    for (size_t i = 0; i < COUNT(long_rows); i++) {
        char name[32];
        snprintf(name, sizeof name, "--%s%s", long_rows[i].name, long_rows[i].kind == FLAG ? "" : "=X");
        fprintf(to, "  %-20s %s\n", name, long_rows[i].help);
    }
    fputs("\n  switch       INI key\n", to);
    const char *last = "";
    for (size_t i = 0; i < COUNT(rows); i++) {
        const Row *r = &rows[i];
        bool show = all && r->help;
        for (size_t k = 0; !show && r->help && r->letters && k < COUNT(shown); k++)
            show = strcmp(shown[k], r->letters) == 0;
        if (!show || (!all && r->letters && strcmp(last, r->letters) == 0))
            continue;
        char name[32] = "";
        if (r->letters)
            snprintf(name, sizeof name, "+%s%s", r->letters, r->kind == FLAG ? "" : r->kind == NUMBER ? "n" : "x");
        help_row(to, name, r->key, r->help);
        last = r->letters ? r->letters : "";
    }
    fputs(all ? "\nOther switches and keys of POV-Ray 3.7 are accepted and change nothing.\n"
              : "\n  --help-all           every switch and key\n", to);
    fputs("\nExit codes: 0 done, 1 the scene is wrong (diff: pictures differ), 2 usage, 3 input or output, 130 interrupted.\n", to);
}
