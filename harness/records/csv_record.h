/* Records as lines of CSV: full precision, empty where there is no number. */
#ifndef BEAMWORK_CSV_RECORD_H
#define BEAMWORK_CSV_RECORD_H

#include <stdio.h>

#include "harness/records/schema.h"

/* A line is made of several records of one subject each; of fields of the same name the first
 * stands. Matrices are left out. */
typedef struct csv_part {
    const record_type *type;
    subject s;
} csv_part;

void csv_record_head(FILE *to, int parts, const csv_part part[]);
void csv_record_line(FILE *to, int parts, const csv_part part[]);

/* A field, in quotes where it must be. */
void csv_record_text(FILE *to, const char *text);

#endif
