/* Records as rows of a typed, compressed table; units and summaries of the columns are its
 * attributes. */
#ifndef BEAMWORK_RECORD_ROWS_H
#define BEAMWORK_RECORD_ROWS_H

#include "harness/records/record.h"
#include "harness/records/schema.h"

/* New table `name` below `at`; texts have the length of the longest in their column. */
void record_rows(record_file *r, hid_t at, const char *name, int fields,
                 const schema_field *const list[], int count, const subject row[]);
/* The table of a kind of record, with its keys. */
void record_rows_of_type(record_file *r, hid_t at, const record_type *type, int count,
                         const subject row[]);
/* The same where nothing around it says what the records belong to. */
void record_rows_alone(record_file *r, hid_t at, const record_type *type, int count,
                       const subject row[]);
/* A record as attributes. */
void record_fields(record_file *r, hid_t at, const record_type *type, const subject *s);

#endif
