/* Reading columns of a table of HDF5 into rows of one's own. Nothing is believed of the file. */
#ifndef BEAMWORK_TABLE_READER_H
#define BEAMWORK_TABLE_READER_H

#include <hdf5.h>
#include <stddef.h>

#include "harness/records/schema.h"

/* Into a member of the row: INT, LONG, DOUBLE, FLAG (a signed char), or a text of at most room - 1
 * bytes (an ENUM is stored as its word). */
typedef struct table_column {
    const char *name;
    field_kind kind;
    size_t offset, room; /* room: of a text */
} table_column;

/* Rows of `size` bytes, which the caller frees; their number. -1: the table, a column of that kind,
 * or memory is missing. */
int table_reader_rows(hid_t at, const char *name, int columns, const table_column column[],
                      size_t size, void **rows);

/* Text attribute of fixed length; 0: it is not there, too long or of another type. */
int table_reader_attribute_text(hid_t at, const char *name, char *text, size_t size);
/* Whole number of a scalar attribute; 0: it is not there or of another type. */
int table_reader_attribute_count(hid_t at, const char *name, long *out);

#endif
