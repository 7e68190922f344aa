#include "harness/record/record_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Where a column stands in a row. */
typedef struct column {
    const schema_field *field;
    size_t offset, size;
} column;

static size_t fixed_size(const schema_field *which)
{
    switch (which->kind) {
    case FIELD_INT:
        return sizeof(int);
    case FIELD_LONG:
        return sizeof(long);
    case FIELD_DOUBLE:
        return sizeof(double) * (size_t)(which->count > 0 ? which->count : 1);
    case FIELD_FLAG:
        return 1;
    case FIELD_TEXT:
    case FIELD_ENUM:
    case FIELD_KINDS:
        break;
    }
    return 0;
}

static size_t longest_text(const schema_field *which, int count, const subject row[])
{
    size_t longest = 1;
    for (int i = 0; i < count; i++) {
        field_value v;
        field_read(&row[i], which, &v);
        const size_t length = strlen(v.text);
        longest = length > longest ? length : longest;
    }
    return longest;
}

/* Fills the columns; size of a row. */
static size_t lay_out(int fields, const schema_field *const list[], int count, const subject row[], column out[])
{
    size_t size = 0;
    for (int i = 0; i < fields; i++) {
        const size_t fixed = fixed_size(list[i]);
        out[i] = (column){list[i], size, fixed > 0 ? fixed : longest_text(list[i], count, row)};
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

static hid_t type_of(const column *c)
{
    const hsize_t side = (hsize_t)lround(sqrt(c->field->count)), square[2] = {side, side};
    switch (c->field->kind) {
    case FIELD_INT:
        return H5Tcopy(H5T_NATIVE_INT);
    case FIELD_LONG:
        return H5Tcopy(H5T_NATIVE_LONG);
    case FIELD_DOUBLE:
        return c->field->count > 0 ? H5Tarray_create2(H5T_NATIVE_DOUBLE, 2, square) : H5Tcopy(H5T_NATIVE_DOUBLE);
    case FIELD_FLAG:
        return boolean_type();
    case FIELD_TEXT:
    case FIELD_ENUM:
    case FIELD_KINDS:
        break;
    }
    return record_text_type(c->size);
}

static hid_t row_type(int fields, const column list[], size_t size)
{
    const hid_t type = H5Tcreate(H5T_COMPOUND, size);
    for (int i = 0; i < fields; i++) {
        const hid_t one = type_of(&list[i]);
        H5Tinsert(type, list[i].field->name, list[i].offset, one);
        H5Tclose(one);
    }
    return type;
}

static void pack(const column *c, const subject *s, char *to)
{
    field_value v;
    field_read(s, c->field, &v);
    const int whole = (int)v.whole;
    switch (c->field->kind) {
    case FIELD_INT:
        memcpy(to, &whole, sizeof whole);
        return;
    case FIELD_LONG:
        memcpy(to, &v.whole, sizeof v.whole);
        return;
    case FIELD_DOUBLE:
        memcpy(to, v.numbers, c->size);
        return;
    case FIELD_FLAG:
        *to = (char)(v.whole != 0);
        return;
    case FIELD_TEXT:
    case FIELD_ENUM:
    case FIELD_KINDS:
        memcpy(to, v.text, strlen(v.text));
    }
}

static void put_attributes(record *r, hid_t set, int fields, const schema_field *const list[])
{
    const char *unit[SCHEMA_MOST_FIELDS], *summary[SCHEMA_MOST_FIELDS];
    for (int i = 0; i < fields; i++) {
        unit[i] = list[i]->unit;
        summary[i] = list[i]->summary;
    }
    record_text_list(r, set, "units", fields, unit);
    record_text_list(r, set, "summaries", fields, summary);
}

void record_rows(record *r, hid_t at, const char *name, int fields, const schema_field *const list[], int count,
                 const subject row[])
{
    column columns[SCHEMA_MOST_FIELDS];
    const size_t size = lay_out(fields, list, count, row, columns);
    char *rows = calloc((size_t)count + 1, size);
    r->bad |= rows == NULL;
    for (int i = 0; i < count && rows != NULL; i++)
        for (int k = 0; k < fields; k++)
            pack(&columns[k], &row[i], rows + (size_t)i * size + columns[k].offset);
    if (rows != NULL) {
        const hid_t type = row_type(fields, columns, size), set = record_table(r, at, name, type, count, rows);
        put_attributes(r, set, fields, list);
        H5Dclose(set);
        H5Tclose(type);
    }
    free(rows);
}

void record_records(record *r, hid_t at, const record_type *type, int count, const subject row[])
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int fields = schema_fields(type, KEY, list);
    record_rows(r, at, type->table, fields, list, count, row);
}
