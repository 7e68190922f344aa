#include "harness/records/table_reader.h"
#include "harness/study/study.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_ROWS = 50000000 };
static const size_t most_bytes = (size_t)1 << 31;

/* In memory, of a stored member of the type; -1: it is of another kind. */
static hid_t memory_type(hid_t member, const table_column *c)
{
    const H5T_class_t class = H5Tget_class(member);
    if (c->kind == FIELD_INT)
        return class == H5T_INTEGER ? H5Tcopy(H5T_NATIVE_INT) : -1;
    if (c->kind == FIELD_LONG)
        return class == H5T_INTEGER ? H5Tcopy(H5T_NATIVE_LONG) : -1;
    if (c->kind == FIELD_FLAG)
        return class == H5T_ENUM && H5Tget_size(member) == 1 ? H5Tcopy(member) : -1;
    if (c->kind == FIELD_DOUBLE)
        return class == H5T_FLOAT ? H5Tcopy(H5T_NATIVE_DOUBLE) : -1;
    if (class != H5T_STRING || H5Tis_variable_str(member) != 0 || H5Tget_size(member) >= c->room)
        return -1;
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, c->room);
    H5Tset_cset(type, H5Tget_cset(member)); /* the library does not convert from ASCII to UTF-8 */
    return type;
}

/* 0: the stored type has no such column. */
static int add_column(hid_t type, hid_t stored, const table_column *c)
{
    const int index = H5Tget_member_index(stored, c->name);
    const hid_t member = index >= 0 ? H5Tget_member_type(stored, (unsigned)index) : -1;
    const hid_t own = member >= 0 ? memory_type(member, c) : -1;
    const int good = own >= 0 && H5Tinsert(type, c->name, c->offset, own) >= 0;
    handles_close(2, (const hid_t[]){own, member});
    return good;
}

/* The type of a row in memory, or -1. */
static hid_t row_type(hid_t stored, int columns, const table_column column[], size_t size)
{
    if (stored < 0 || H5Tget_class(stored) != H5T_COMPOUND)
        return -1;
    const hid_t type = H5Tcreate(H5T_COMPOUND, size);
    for (int i = 0; i < columns; i++)
        if (!add_column(type, stored, &column[i])) {
            H5Tclose(type);
            return -1;
        }
    return type;
}

static int read_rows(hid_t set, hid_t type, hid_t stored, size_t size, void **rows)
{
    hsize_t count = 0;
    const hid_t space = H5Dget_space(set);
    const int good = space >= 0 && H5Sget_simple_extent_ndims(space) == 1 &&
                     H5Sget_simple_extent_dims(space, &count, NULL) == 1 && count <= MOST_ROWS &&
                     count * (size + H5Tget_size(stored)) <= most_bytes;
    if (space >= 0)
        H5Sclose(space);
    *rows = good ? calloc((size_t)count + 1, size) : NULL;
    if (*rows == NULL ||
        (count > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, *rows) < 0))
        return -1;
    return (int)count;
}

int table_reader_rows(hid_t at, const char *name, int columns, const table_column column[],
                      size_t size, void **rows)
{
    *rows = NULL;
    const hid_t set = H5Lexists(at, name, H5P_DEFAULT) > 0 ? H5Dopen2(at, name, H5P_DEFAULT) : -1;
    const hid_t stored = set >= 0 ? H5Dget_type(set) : -1,
                type = row_type(stored, columns, column, size);
    const int count = type >= 0 ? read_rows(set, type, stored, size, rows) : -1;
    if (count < 0) {
        free(*rows);
        *rows = NULL;
    }
    handles_close(3, (const hid_t[]){type, stored, set});
    return count;
}

int table_reader_attribute_text(hid_t at, const char *name, char *text, size_t size)
{
    const hid_t a = H5Aexists(at, name) > 0 ? H5Aopen(at, name, H5P_DEFAULT) : -1;
    const hid_t type = a >= 0 ? H5Aget_type(a) : -1, space = a >= 0 ? H5Aget_space(a) : -1;
    const int good = type >= 0 && H5Tget_class(type) == H5T_STRING && !H5Tis_variable_str(type) &&
                     H5Tget_size(type) < size && H5Sget_simple_extent_npoints(space) == 1;
    memset(text, 0, size);
    const int read = good && H5Aread(a, type, text) >= 0;
    handles_close(3, (const hid_t[]){space, type, a});
    return read;
}

int table_reader_attribute_count(hid_t at, const char *name, long *out)
{
    const hid_t a = H5Aexists(at, name) > 0 ? H5Aopen(at, name, H5P_DEFAULT) : -1;
    const hid_t space = a >= 0 ? H5Aget_space(a) : -1;
    const int good = space >= 0 && H5Sget_simple_extent_npoints(space) == 1 &&
                     H5Aread(a, H5T_NATIVE_LONG, out) >= 0;
    handles_close(2, (const hid_t[]){space, a});
    return good;
}
