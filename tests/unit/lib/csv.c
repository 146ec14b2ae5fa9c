/* csv.c - reads comma separated rows; a field may stand in quotes, with "" for a quote. */
#include "lib/csv.h"

#include <stdlib.h>
#include <string.h>

void csv_open(Csv *c, const char *path)
{
    c->file = fopen(path, "r");
    c->line = 0;
    if (c->file == NULL) {
        fprintf(stderr, "cannot read %s: run tests in the root of the repository\n", path);
        exit(1);
    }
    if (!csv_next(c))
        exit(1);
}

bool csv_next(Csv *c)
{
    if (fgets(c->text, sizeof c->text, c->file) == NULL) {
        fclose(c->file);
        return false;
    }
    c->line++;
    c->text[strcspn(c->text, "\r\n")] = 0;
    c->n = 0;
    char *read = c->text, *write = c->text;
    bool more = true;
    while (more && c->n < CSV_MAX_FIELDS) {
        c->field[c->n++] = write;
        bool quoted = *read == '"';
        if (quoted)
            read++;
        for (; *read != 0; read++) {
            if (quoted && *read == '"') {
                if (read[1] != '"')
                    quoted = false;
                else
                    *write++ = *read++;
            } else if (!quoted && *read == ',') {
                break;
            } else {
                *write++ = *read;
            }
        }
        more = *read == ',';
        read++;
        *write++ = 0;
    }
    return true;
}

double csv_number(const Csv *c, int field)
{
    return field < c->n ? strtod(c->field[field], NULL) : 0;
}
