/* A table of one's own project: CSV with declared columns, a record in each line. Nothing is
 * believed of it. */
#ifndef BEAMWORK_OWN_TABLE_H
#define BEAMWORK_OWN_TABLE_H

#include "cases/format/mistakes.h"

enum { OWN_TABLE_COLUMNS = 16 };

typedef struct own_table_row {
    int line;                       /* counted from 1 */
    char *text;                     /* that the fields are pieces of */
    char *field[OWN_TABLE_COLUMNS]; /* trimmed, without quotes */
} own_table_row;

typedef struct own_table {
    int rows;
    own_table_row *row;
} own_table;

/* columns: their names in their order, between commas, as the first line must have them. What is
 * wrong with lines goes to `m`, and they are left out; FAULT: the file cannot be read. The caller
 * frees *out in any case. */
status own_table_read(const char *path, const char *columns, own_table *out, mistakes *m, fault *f);
void own_table_free(own_table *);
#endif
