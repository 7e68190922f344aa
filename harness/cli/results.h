/* What the files of results consist of: the records with their places, and what no table says. */
#ifndef BEAMWORK_MANUAL_RESULTS_H
#define BEAMWORK_MANUAL_RESULTS_H

#include "harness/records/schema.h"

typedef struct results_record {
    const char *place; /* before the name of its table */
    const record_type *type;
} results_record;

/* Number i, or a type of NULL behind the last one. */
results_record results_record_at(int i);
extern const char *const results_about[]; /* paragraphs, ending with NULL */
/* "text *", "int", ...; the unit as it is shown; what it is, with its words. */
typedef struct results_field {
    const char *kind, *unit;
    char text[1000];
} results_field;
results_field results_field_of(const schema_field *f);

#endif
