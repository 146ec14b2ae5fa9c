/* csv.h - rows of the measured vectors in tests/vectors. Tests run in the root of the repository. */
#ifndef LIB_CSV_H
#define LIB_CSV_H

#include <stdbool.h>
#include <stdio.h>

enum { CSV_MAX_FIELDS = 32 };

typedef struct Csv {
    FILE *file;
    int line;                                  /* of the row read last */
    int n;                                     /* its fields */
    char *field[CSV_MAX_FIELDS];
    char text[65536];
} Csv;

void csv_open(Csv *c, const char *path);       /* skips the header; exits with a message if the file is not there */
bool csv_next(Csv *c);                         /* closes the file at its end */
double csv_number(const Csv *c, int field);

#endif
