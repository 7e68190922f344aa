/* Records as objects of JSON, field by field. */
#ifndef BEAMWORK_JSON_RECORD_H
#define BEAMWORK_JSON_RECORD_H

#include <jansson.h>

#include "harness/records/schema.h"

/* JSON has no NaN: a value that does not exist is null. */
json_t *json_record_numbers(int count, const double value[]);
/* keys: KEY_AROUND where nothing around the record says where it belongs; 0: all of it is said. */
json_t *json_record(const record_type *type, const subject *s, int keys);
void json_record_add(json_t *list, const record_type *type, const subject *s, int keys);
json_t *json_record_type(const record_type *type); /* what a record consists of */

#endif
