/* whit.h - the library: read a scene, render it, take the pixels. */
#ifndef WHIT_H
#define WHIT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define WHIT_VERSION "0.1.0"

typedef struct Whit Whit;

typedef struct WhitDeclare { const char *name, *value; bool is_string; } WhitDeclare;

typedef struct WhitOptions {                   /* zeroed options are the defaults */
    int width, height;                         /* 160 x 120 */
    int threads;                               /* 0: one per processor */
    int quality;                               /* 0: 9; 1..11 as +Q; use -1 for +Q0 */
    int antialias;                             /* 0 off, 1 or 2: the method */
    double antialias_threshold;                /* 0: 0.3 */
    int antialias_depth;                       /* 0: 3 (method 1 and 2), 1..9 */
    double jitter;                             /* 0: 1.0; negative: off */
    double antialias_gamma;                    /* 0: 2.5 */
    bool output_alpha;
    int version;                               /* 0: not given; 370 as +MV3.7 */
    double clock;
    int frame_number, initial_frame, final_frame;
    double initial_clock, final_clock, clock_delta;
    bool clock_on;
    double start_column, end_column, start_row, end_row;       /* as +SC +EC +SR +ER; all 0: the whole picture */
    const char *const *library_path;  size_t n_library_paths;
    const char *const *allow_read;    size_t n_allow_read;
    const char *const *allow_write;   size_t n_allow_write;
    const WhitDeclare *declare;       size_t n_declares;
    bool strict;                               /* warnings about what is not modelled become errors; no mending of input */
    size_t memory_limit;                       /* bytes; 0: none */
    const char *accel;                         /* "bvh" (default), "list" */
    const char *input_name;                    /* what input_file_name reads; NULL: from the path */
} WhitOptions;

typedef enum WhitKind { WHIT_ERROR, WHIT_WARNING, WHIT_DEBUG, WHIT_RENDER, WHIT_STATISTICS } WhitKind;
typedef struct WhitMessage { WhitKind kind; const char *text; } WhitMessage;

/* Told each message at once, on the calling thread. */
typedef void WhitShow(void *user, const WhitMessage *message);
/* Told now and then from one thread; returns false to cancel. */
typedef bool WhitProgress(void *user, int done_tiles, int all_tiles);

typedef enum WhitGamma { WHIT_GAMMA_NONE, WHIT_GAMMA_POWER, WHIT_GAMMA_SRGB } WhitGamma;

typedef struct WhitImage {                     /* owned by Whit */
    int width, height;
    const float *rgba;                         /* working space, premultiplied, unclipped; alpha = 1 - transmit; NULL: none */
    WhitGamma working;  double working_gamma;  /* how to decode to linear; NONE: legacy, no correction */
} WhitImage;

Whit *whit_new(const WhitOptions *options);    /* copies what it needs; NULL: out of memory */
void whit_show(Whit *w, WhitShow *show, void *user);
bool whit_load(Whit *w, const char *path);     /* parse and compile; false: see the messages and whit_exit_code */
bool whit_load_text(Whit *w, const char *name, const char *text, size_t bytes);
bool whit_check(Whit *w, const char *path);    /* parse only */
/* From a signal handler or another thread: parsing fails where it stands, rendering ends without a picture. */
void whit_interrupt(Whit *w);
bool whit_render(Whit *w, WhitProgress *progress, void *user);
WhitImage whit_image(const Whit *w);

typedef enum WhitFormat {
    WHIT_PNG, WHIT_PPM, WHIT_TGA, WHIT_TGA_RLE, WHIT_BMP, WHIT_JPEG
} WhitFormat;
typedef enum WhitDither { WHIT_DITHER_NONE, WHIT_DITHER_B2, WHIT_DITHER_B3, WHIT_DITHER_B4, WHIT_DITHER_D1, WHIT_DITHER_D2,
                          WHIT_DITHER_FS } WhitDither;

typedef struct WhitFileOptions {               /* zeroed: 8-bit PNG, sRGB */
    WhitFormat format;
    int bits;                                  /* 0: 8; 5..16 */
    bool alpha, grey;
    WhitGamma gamma;  double gamma_value;      /* of the file; NONE: sRGB. Not used when the scene has no working gamma */
    WhitDither dither;
    int quality;                               /* JPEG, 0: 85 */
} WhitFileOptions;

/* Writes the picture, whole or not at all ("-": standard output). False: see the messages. */
bool whit_write(Whit *w, const char *path, const WhitFileOptions *options);

typedef struct WhitDifference {                /* of two pictures, per channel, in units of 1/255 */
    int width, height;
    double over_1, over_4;                     /* share of pixels that differ by more than 1 and 4 in some channel */
    double mean, max, rmse;                    /* of the absolute difference over channels red, green, blue, alpha */
    double psnr;                               /* dB; INFINITY for equal pictures */
    double blocks_over_6;                      /* share of 4x4 blocks whose means differ by more than 6 */
    const char *verdict;                       /* "exact", "match", "close" or "off" */
} WhitDifference;

/* Compares two picture files of one size. `heat`: NULL, or the PNG to write (black: equal, white: 32 or more apart).
 * False: `error` holds why. */
bool whit_compare(const char *a, const char *b, const char *heat, WhitDifference *out, char error[256]);

int whit_exit_code(const Whit *w);             /* 0 fine, 1 the scene, 3 input or output */
const char *whit_explain(Whit *w);             /* a readable plan of the compiled scene */
const char *whit_summary(const Whit *w);       /* what was left out, or "" */
void whit_free(Whit *w);

#endif
