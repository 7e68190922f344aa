/* Where a record belongs: the first fields of the tables of fields_*.c, and what these share. */
#ifndef BEAMWORK_FIELDS_KEYS_H
#define BEAMWORK_FIELDS_KEYS_H

#include <stddef.h>

#include "harness/records/schema.h"

extern const schema_field keys_of_point[];     /* case, parameter point */
extern const schema_field keys_of_series[];    /* its parameters, formulation */
extern const schema_field key_of_mesh[];       /* elements of each member */
extern const schema_field names_of_quantity[]; /* its name and unit */

enum { STATUSES = STATUS_NO_VALUE + 1 };
/* ENUM fields: their words. */
const char *fields_keys_word_of_status(int status);
const char *fields_keys_word_of_moments(int convention);

/* Of the quantity that s->index counts. */
const scene_quantity *fields_keys_quantity(const subject *s);
const cell_result *fields_keys_cell(const subject *s);
/* What the scene leaves out, in words. */
void fields_keys_omitted(const subject *s, field_value *out);

/* What is assumed of its sections, in words. */
void fields_keys_assumed(const subject *s, field_value *out);

#endif
