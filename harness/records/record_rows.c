#include "harness/records/record_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Offset of a column in a row. */
typedef struct rows_column {
    const schema_field *field;
    size_t offset, size;
} rows_column;

/* [bytes] of one value; of a text: those of the longest in its column. */
static const size_t size_of_kind[FIELD_KINDS] = {[FIELD_INT] = sizeof(int),
                                                 [FIELD_LONG] = sizeof(long),
                                                 [FIELD_DOUBLE] = sizeof(double),
                                                 [FIELD_FLAG] = 1};

static size_t times(const schema_field *which)
{
    return which->count > 0 ? (size_t)which->count : 1;
}

static size_t longest_text(const schema_field *which, int count, const subject row[])
{
    size_t longest = 1;
    for (int i = 0; i < count; i++) {
        field_value v;
        schema_read(&row[i], which, &v);
        const size_t length = strlen(v.text);
        longest = length > longest ? length : longest;
    }
    return longest;
}

/* Fills the columns; size of a row. */
static size_t lay_out(int fields, const schema_field *const list[], int count, const subject row[],
                      rows_column out[])
{
    size_t size = 0;
    for (int i = 0; i < fields; i++) {
        const size_t fixed = size_of_kind[list[i]->kind] * times(list[i]);
        out[i] =
            (rows_column){list[i], size, fixed > 0 ? fixed : longest_text(list[i], count, row)};
        size += out[i].size;
    }
    return size;
}

/* As h5py and others have it. */
static hid_t boolean_type(void)
{
    const hid_t type = H5Tenum_create(H5T_NATIVE_INT8);
    H5Tenum_insert(type, "FALSE", &(signed char){0});
    H5Tenum_insert(type, "TRUE", &(signed char){1});
    return type;
}

static hid_t type_of(const rows_column *c)
{
    const hsize_t side = (hsize_t)lround(sqrt(c->field->count)), square[2] = {side, side};
    if (c->field->count > 0)
        return H5Tarray_create2(H5T_NATIVE_DOUBLE, 2, square);
    if (c->field->kind == FIELD_INT || c->field->kind == FIELD_LONG)
        return H5Tcopy(c->field->kind == FIELD_INT ? H5T_NATIVE_INT : H5T_NATIVE_LONG);
    if (c->field->kind == FIELD_DOUBLE)
        return H5Tcopy(H5T_NATIVE_DOUBLE);
    return c->field->kind == FIELD_FLAG ? boolean_type() : record_text_type(c->size);
}

static hid_t row_type(int fields, const rows_column list[], size_t size)
{
    const hid_t type = H5Tcreate(H5T_COMPOUND, size);
    for (int i = 0; i < fields; i++) {
        const hid_t one = type_of(&list[i]);
        H5Tinsert(type, list[i].field->name, list[i].offset, one);
        H5Tclose(one);
    }
    return type;
}

static void pack(const rows_column *c, const subject *s, char *to)
{
    field_value v;
    schema_read(s, c->field, &v);
    const int whole = (int)v.whole;
    if (c->field->kind == FIELD_INT)
        memcpy(to, &whole, sizeof whole);
    else if (c->field->kind == FIELD_LONG)
        memcpy(to, &v.whole, sizeof v.whole);
    else if (c->field->kind == FIELD_DOUBLE)
        memcpy(to, v.numbers, c->size);
    else if (c->field->kind == FIELD_FLAG)
        *to = (char)(v.whole != 0);
    else
        memcpy(to, v.text, strlen(v.text));
}

static void put_attributes(record_file *r, hid_t set, int fields, const schema_field *const list[])
{
    const char *unit[SCHEMA_MOST_FIELDS], *summary[SCHEMA_MOST_FIELDS];
    for (int i = 0; i < fields; i++) {
        unit[i] = list[i]->unit;
        summary[i] = list[i]->summary;
    }
    record_text_list(r, set, "units", fields, unit);
    record_text_list(r, set, "summaries", fields, summary);
}

void record_rows(record_file *r, hid_t at, const char *name, int fields,
                 const schema_field *const list[], int count, const subject row[])
{
    rows_column columns[SCHEMA_MOST_FIELDS];
    const size_t size = lay_out(fields, list, count, row, columns);
    char *rows = calloc((size_t)count + 1, size);
    r->bad |= rows == NULL;
    if (rows != NULL)
        for (int i = 0; i < count; i++)
            for (int k = 0; k < fields; k++)
                pack(&columns[k], &row[i], rows + (size_t)i * size + columns[k].offset);
    if (rows != NULL) {
        const hid_t type = row_type(fields, columns, size),
                    set = record_table(r, at, name, type, count, rows);
        put_attributes(r, set, fields, list);
        H5Dclose(set);
        H5Tclose(type);
    }
    free(rows);
}

static void rows_with(record_file *r, hid_t at, const record_type *type, int keys, int count,
                      const subject row[])
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int fields = schema_fields(type, keys, list);
    record_rows(r, at, type->table, fields, list, count, row);
}

void record_rows_of_type(record_file *r, hid_t at, const record_type *type, int count,
                         const subject row[])
{
    rows_with(r, at, type, KEY, count, row);
}

void record_rows_alone(record_file *r, hid_t at, const record_type *type, int count,
                       const subject row[])
{
    rows_with(r, at, type, KEY_AROUND, count, row);
}

static void put_field(record_file *r, hid_t at, const schema_field *which, const field_value *v)
{
    if (which->kind == FIELD_TEXT || which->kind == FIELD_ENUM)
        record_text(r, at, which->name, v->text);
    else if (which->kind == FIELD_DOUBLE)
        record_number(r, at, which->name, *v->numbers);
    else
        record_count(r, at, which->name, v->whole);
}

void record_fields(record_file *r, hid_t at, const record_type *type, const subject *s)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int fields = schema_fields(type, KEY_AROUND, list);
    for (int i = 0; i < fields; i++) {
        field_value v;
        schema_read(s, list[i], &v);
        put_field(r, at, list[i], &v);
    }
}
