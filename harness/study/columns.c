#include "harness/study/columns.h"
#include "harness/study/handles.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

status columns_broken(const table_columns *r, const char *column)
{
    return fault_set(r->f, STATUS_FAULT,
                     "%s: column %s of %s is missing or damaged; build it again ('make all')",
                     r->path, column, r->name);
}

/* Rows of an open column; -1: it is no list. */
static int length_of(hid_t set)
{
    hsize_t size = 0;
    const hid_t space = set >= 0 ? H5Dget_space(set) : -1;
    const int good = space >= 0 && H5Sget_simple_extent_ndims(space) == 1 &&
                     H5Sget_simple_extent_dims(space, &size, NULL) == 1 && size < 10000000;
    handles_close(1, &space);
    return good ? (int)size : -1;
}

int columns_length(hid_t group, const char *column)
{
    const hid_t set = H5Dopen2(group, column, H5P_DEFAULT);
    const int length = length_of(set);
    handles_close(1, &set);
    return length;
}

status columns_numbers(const table_columns *r, const char *column, hid_t type, void *out)
{
    const hid_t set = H5Dopen2(r->group, column, H5P_DEFAULT);
    const int good =
        length_of(set) == r->rows && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out) >= 0;
    handles_close(1, &set);
    return good ? STATUS_OK : columns_broken(r, column);
}

status columns_strings(const table_columns *r, const char *column, char **out)
{
    const hid_t set = H5Dopen2(r->group, column, H5P_DEFAULT);
    const hid_t stored = length_of(set) == r->rows ? H5Dget_type(set) : -1;
    int good = stored >= 0 && H5Tget_class(stored) == H5T_STRING && !H5Tis_variable_str(stored);
    const size_t size = good ? H5Tget_size(stored) : 1;
    char *all = good && size < 100000 ? calloc((size_t)r->rows + 1, size) : NULL;
    /* as they are stored: HDF5 clears a large buffer for each conversion */
    good = good && all != NULL && H5Dread(set, stored, H5S_ALL, H5S_ALL, H5P_DEFAULT, all) >= 0;
    for (int i = 0; i < r->rows && good; i++)
        good = (out[i] = strndup(all + (size_t)i * size, size)) != NULL;
    free(all);
    handles_close(2, (const hid_t[]){stored, set});
    return good ? STATUS_OK : columns_broken(r, column);
}

status columns_read(const table_columns *r, const columns_field *field, void *base, size_t stride)
{
    assert(r->rows >= 0);
    const size_t size = field->is_text ? sizeof(char *) : sizeof(double);
    char *all = calloc((size_t)r->rows + 1, size);
    if (all == NULL)
        return fault_set(r->f, STATUS_FAULT, "out of memory for column %s of %s", field->column,
                         r->name);
    const status outcome = field->is_text
                               ? columns_strings(r, field->column, (char **)(void *)all)
                               : columns_numbers(r, field->column, H5T_NATIVE_DOUBLE, all);
    for (int i = 0; i < r->rows; i++)
        memcpy((char *)base + (size_t)i * stride + field->offset, all + (size_t)i * size, size);
    free(all);
    return outcome;
}
