/* pavement.h - the table of pavements, and which tile a cell belongs to. */
#ifndef PATTERN_PAVEMENT_H
#define PATTERN_PAVEMENT_H

typedef struct Pavement {
    int sides, cells, number;                  /* sides 0 ends the table */
    int along[2], across[2];                   /* translations in cell coordinates; along[1] is 0 */
    const char *tiles;
} Pavement;

extern const Pavement pavement_table[];

#endif
