/* ini.c - INI files (02-command-line, section 3): keys, switches, sections, comments. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/settings.h"

enum { LINE_MAX_BYTES = 4096, INCLUDE_MAX = 16 };

/* name, name.ini, name.INI; then the same below each library path. */
static FILE *open_ini(const Settings *s, const char *name, char *path, size_t path_n)
{
    static const char *const tails[] = { "", ".ini", ".INI" };
    for (size_t dir = 0; dir <= s->library.n; dir++)
        for (size_t k = 0; k < 3; k++) {
            if (dir == 0)
                snprintf(path, path_n, "%s%s", name, tails[k]);
            else
                snprintf(path, path_n, "%s/%s%s", s->library.item[dir - 1], name, tails[k]);
            FILE *f = fopen(path, "r");
            if (f)
                return f;
        }
    return NULL;
}

static char *trimmed(char *text)
{
    while (isspace((unsigned char)*text))
        text++;
    size_t n = strlen(text);
    while (n && isspace((unsigned char)text[n - 1]))
        text[--n] = 0;
    return text;
}

/* A comment begins at ; or # outside quotes. */
static void cut_comment(char *line)
{
    char quote = 0;
    for (char *p = line; *p; p++) {
        if (quote)
            quote = *p == quote ? 0 : quote;
        else if (*p == '"' || *p == '\'')
            quote = *p;
        else if (*p == ';' || *p == '#') {
            *p = 0;
            return;
        }
    }
}

/* Values of one key: quoted, or up to a comma; commas go on with the same key. */
static bool key_values(Settings *s, const char *key, size_t key_n, char *rest, char why[256])
{
    for (;;) {
        rest = trimmed(rest);
        char *value = rest, *next = NULL;
        if (*rest == '"' || *rest == '\'') {
            char *close = strchr(rest + 1, *rest);
            if (!close) {
                snprintf(why, 256, "the quote is not closed");
                return false;
            }
            value = rest + 1;
            *close = 0;
            next = trimmed(close + 1);
            next = *next == ',' ? next + 1 : NULL;
        } else {
            char quote = 0;
            for (char *p = rest; *p && !next; p++) {       /* Declare=NAME='text, text' keeps its comma */
                if (quote)
                    quote = *p == quote ? 0 : quote;
                else if (*p == '"' || *p == '\'')
                    quote = *p;
                else if (*p == ',') {
                    *p = 0;
                    next = p + 1;
                }
            }
            value = trimmed(value);
        }
        if (!settings_key(s, key, key_n, value, why))
            return false;
        if (!next)
            return true;
        rest = next;
    }
}

static bool words(Settings *s, char *line, char why[256])
{
    for (char *word = strtok(line, " \t"); word; word = strtok(NULL, " \t"))
        if (!settings_argument(s, word, why))
            return false;
    return true;
}

static bool ini_line(Settings *s, char *line, char why[256])
{
    if (*line == '+' || *line == '-')
        return words(s, line, why);
    char *equals = strchr(line, '=');
    if (!equals)
        return words(s, line, why);
    size_t n = (size_t)(equals - line);
    while (n && isspace((unsigned char)line[n - 1]))
        n--;
    return key_values(s, line, n, equals + 1, why);
}

bool settings_ini(Settings *s, const char *name, char why[256])
{
    char file[LINE_MAX_BYTES], section[256] = "", path[LINE_MAX_BYTES * 2], line[LINE_MAX_BYTES];
    static _Thread_local int depth;
    if (strlen(name) >= sizeof file) {
        snprintf(why, 256, "the name of the INI file is too long");
        return false;
    }
    strcpy(file, name);
    size_t n = strlen(file);
    char *bracket = strrchr(file, '[');
    if (bracket && n && file[n - 1] == ']') {
        file[n - 1] = 0;
        snprintf(section, sizeof section, "%s", bracket + 1);
        *bracket = 0;
    }
    FILE *f = open_ini(s, file, path, sizeof path);
    if (!f) {
        snprintf(why, 256, "cannot find the INI file '%.120s'", file);
        return false;
    }
    if (++depth > INCLUDE_MAX) {
        snprintf(why, 256, "INI files include each other without end");
        fclose(f);
        depth--;
        return false;
    }
    bool ok = true, active = true;
    for (int number = 1; ok && fgets(line, sizeof line, f); number++) {
        cut_comment(line);
        char *text = trimmed(line);
        if (!*text)
            continue;
        if (*text == '[') {
            char *close = strchr(text, ']');
            if (close)
                *close = 0;
            active = close && strcasecmp(trimmed(text + 1), section) == 0;
            continue;
        }
        char inner[200] = "";
        char reason[256];
        if (active && !ini_line(s, text, reason)) {
            snprintf(inner, sizeof inner, "%.190s", reason);
            snprintf(why, 256, "%.120s:%d: %.120s", path, number, inner);
            ok = false;
        }
    }
    fclose(f);
    depth--;
    return ok;
}
