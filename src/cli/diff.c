/* diff.c - whit diff A B: how far two pictures are apart, and a verdict. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/settings.h"

enum { DIFF_WITHIN = 0, DIFF_BEYOND = 1, DIFF_TROUBLE = 2 };

typedef struct Limits {
    const char *verdict;                       /* at least this good */
    double max_rmse, max_abs, max_pixels;      /* negative: not asked */
    bool json, quiet;
    const char *heat;
} Limits;

static int rank(const char *verdict)
{
    static const char *const order[] = { "exact", "match", "close", "off" };
    for (int i = 0; i < 4; i++)
        if (strcmp(verdict, order[i]) == 0)
            return i;
    return -1;
}

static void usage(FILE *to)
{
    fputs("whit diff A B [options]: compares two pictures of one size, in units of 1/255\n\n"
          "  -o HEAT.png        write a heat map: black equal, white 32 or more apart\n"
          "  --verdict=V        exact, match (default), close: exit 0 if at least that good\n"
          "  --max-rmse=X  --max-abs=X  --max-pixels=P%     further limits; P: share of pixels over 1\n"
          "  --json             one line of JSON\n"
          "  -q                 no output, only the exit code\n\n"
          "exact: 99.9 % of pixels within 1.  match: 98 % within 4 and mean at most 0.6.\n"
          "close: 97 % of 4x4 blocks within 6.  Exit codes: 0 within, 1 beyond, 2 trouble.\n", to);
}

static bool option(Limits *l, const char *a)
{
    if (strncmp(a, "--verdict=", 10) == 0) {
        l->verdict = a + 10;
        return rank(l->verdict) >= 0;
    }
    if (strncmp(a, "--max-rmse=", 11) == 0)
        l->max_rmse = atof(a + 11);
    else if (strncmp(a, "--max-abs=", 10) == 0)
        l->max_abs = atof(a + 10);
    else if (strncmp(a, "--max-pixels=", 13) == 0)
        l->max_pixels = atof(a + 13) / 100;
    else if (strcmp(a, "--json") == 0)
        l->json = true;
    else if (strcmp(a, "-q") == 0)
        l->quiet = true;
    else
        return false;
    return true;
}

static void report(const Limits *l, const WhitDifference *d)
{
    if (l->quiet)
        return;
    if (l->json) {
        printf("{\"verdict\":\"%s\",\"width\":%d,\"height\":%d,\"over_1\":%.6g,\"over_4\":%.6g,\"mean\":%.6g,\"max\":%.6g,"
               "\"rmse\":%.6g,\"psnr\":%.6g,\"blocks_over_6\":%.6g}\n",
               d->verdict, d->width, d->height, d->over_1, d->over_4, d->mean, d->max, d->rmse,
               isinf(d->psnr) ? 999.0 : d->psnr, d->blocks_over_6);
        return;
    }
    printf("%s: %.3f %% of pixels over 1, %.3f %% over 4, %.3f %% of blocks over 6\n"
           "mean %.4f, max %.1f, rmse %.4f of 255; psnr %.2f dB\n",
           d->verdict, 100 * d->over_1, 100 * d->over_4, 100 * d->blocks_over_6, d->mean, d->max, d->rmse, d->psnr);
}

int cli_diff(int argc, char **argv)
{
    Limits l = { .verdict = "match", .max_rmse = -1, .max_abs = -1, .max_pixels = -1 };
    const char *file[2];
    int n = 0;
    for (int i = 0; i < argc; i++) {
        const char *a = argv[i];
        if (strcmp(a, "--help") == 0) {
            usage(stdout);
            return DIFF_WITHIN;
        }
        if (strcmp(a, "-o") == 0 && i + 1 < argc) {
            l.heat = argv[++i];
        } else if (a[0] == '-' && a[1]) {
            if (!option(&l, a)) {
                fprintf(stderr, "whit diff: cannot use '%s'; see whit diff --help\n", a);
                return DIFF_TROUBLE;
            }
        } else if (n < 2) {
            file[n++] = a;
        } else {
            n++;
        }
    }
    if (n != 2) {
        usage(stderr);
        return DIFF_TROUBLE;
    }
    WhitDifference d;
    char error[256];
    if (!whit_compare(file[0], file[1], l.heat, &d, error)) {
        fprintf(stderr, "whit diff: %s\n", error);
        return DIFF_TROUBLE;
    }
    report(&l, &d);
    bool within = rank(d.verdict) <= rank(l.verdict) && (l.max_rmse < 0 || d.rmse <= l.max_rmse)
                  && (l.max_abs < 0 || d.max <= l.max_abs) && (l.max_pixels < 0 || d.over_1 <= l.max_pixels);
    return within ? DIFF_WITHIN : DIFF_BEYOND;
}
