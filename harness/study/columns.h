/* Reading a table that is stored as one HDF5 data set per column. Nothing is believed: every size
 * and type is checked. */
#ifndef BEAMWORK_COLUMNS_H
#define BEAMWORK_COLUMNS_H

#include <hdf5.h>

#include "elements/shared/status.h"

typedef struct table_columns {
    const char *path; /* of the file, for messages */
    hid_t group;
    char name[64]; /* of the group, for messages */
    int rows;
    fault *f;
} table_columns;

typedef struct columns_field {
    const char *column;
    int is_text; /* 1: char *, malloced; 0: double */
    size_t offset;
} columns_field;

/* FAULT: the column is missing or damaged. */
status columns_broken(const table_columns *r, const char *column);
/* Number of rows of a column, or -1. */
int columns_length(hid_t group, const char *column);
/* out[rows], of the memory type `type`. */
status columns_numbers(const table_columns *r, const char *column, hid_t type, void *out);
/* Fixed-length strings; out[rows], each malloced. */
status columns_strings(const table_columns *r, const char *column, char **out);
/* One column into a field of an array of structs base[rows]. On failure the strings read so far are
 * in it. */
status columns_read(const table_columns *r, const columns_field *field, void *base, size_t stride);

#endif
