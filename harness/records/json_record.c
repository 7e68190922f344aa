#include "harness/records/json_record.h"

#include <math.h>

static json_t *number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *json_record_numbers(int count, const double value[])
{
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(list, number(value[i]));
    return list;
}

/* A square matrix row by row. */
static json_t *matrix(int count, const double value[])
{
    const int size = (int)lround(sqrt(count));
    json_t *rows = json_array();
    for (int i = 0; i < size; i++)
        json_array_append_new(rows, json_record_numbers(size, value + size * i));
    return rows;
}

static json_t *json_of(const schema_field *which, const field_value *v)
{
    if (which->kind == FIELD_INT || which->kind == FIELD_LONG)
        return json_integer(v->whole);
    if (which->kind == FIELD_FLAG)
        return json_boolean(v->whole);
    if (which->kind == FIELD_DOUBLE)
        return which->count > 0 ? matrix(which->count, v->numbers) : number(*v->numbers);
    return json_string(v->text);
}

json_t *json_record(const record_type *type, const subject *s, int keys)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int count = schema_fields(type, keys, list);
    json_t *out = json_object();
    for (int i = 0; i < count; i++) {
        field_value v;
        schema_read(s, list[i], &v);
        json_object_set_new(out, list[i]->name, json_of(list[i], &v));
    }
    return out;
}

void json_record_add(json_t *list, const record_type *type, const subject *s, int keys)
{
    json_array_append_new(list, json_record(type, s, keys));
}

static json_t *json_field(const schema_field *which)
{
    json_t *out = json_pack("{s:s,s:s,s:s,s:s,s:b}", "name", which->name, "kind",
                            schema_kind_name(which->kind), "unit", which->unit, "summary",
                            which->summary, "key", which->key != 0);
    json_object_set_new(out, "said_around", json_boolean(which->key == KEY_AROUND));
    json_t *words = json_array();
    for (int i = 0; i < which->words; i++)
        json_array_append_new(words, json_string(which->word(i)));
    json_object_set_new(out, "words", words);
    json_object_set_new(out, "count", json_integer(which->count > 0 ? which->count : 1));
    return out;
}

json_t *json_record_type(const record_type *type)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int count = schema_fields(type, KEY_AROUND, list);
    json_t *fields = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(fields, json_field(list[i]));
    return json_pack("{s:s,s:s,s:s,s:o}", "record", type->name, "table", type->table, "summary",
                     type->summary, "fields", fields);
}
