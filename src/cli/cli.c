/* cli.c - the program: what the arguments ask for, done. */
#include <string.h>

#include "cli/settings.h"

int cli_main(int argc, char **argv);

static bool is_one_of(const char *a, const char *const *words)
{
    for (; *words; words++)
        if (strcmp(a, *words) == 0)
            return true;
    return false;
}

int cli_main(int argc, char **argv)
{
    static const char *const help[] = { "--help", "-help", "-h", "-?", NULL };
    static const char *const version[] = { "--version", "-version", "--V", NULL };
    if (argc >= 2 && strcmp(argv[1], "diff") == 0)
        return cli_diff(argc - 2, argv + 2);
    Settings s;
    settings_init(&s);
    bool only_files = false;
    for (int i = 1; i < argc; i++) {
        if (!only_files && is_one_of(argv[i], help)) {
            settings_help(stdout, false);
            settings_free(&s);
            return CLI_OK;
        }
        if (!only_files && strcmp(argv[i], "--help-all") == 0) {
            settings_help(stdout, true);
            settings_free(&s);
            return CLI_OK;
        }
        if (!only_files && is_one_of(argv[i], version)) {
            puts("whit " WHIT_VERSION);
            settings_free(&s);
            return CLI_OK;
        }
        if (!only_files && strcmp(argv[i], "--") == 0) {
            only_files = true;
            continue;
        }
        char why[256];
        bool ok = only_files ? settings_key(&s, "Input_File_Name", strlen("Input_File_Name"), argv[i], why)
                             : settings_argument(&s, argv[i], why);
        if (!ok) {
            fprintf(stderr, "whit: %s\n", why);
            settings_free(&s);
            return CLI_USAGE;
        }
    }
    if (!s.input) {
        fputs("whit: no scene given\n\n", stderr);
        settings_help(stderr, false);
        settings_free(&s);
        return CLI_USAGE;
    }
    int code = cli_render(&s);
    settings_free(&s);
    return code;
}
