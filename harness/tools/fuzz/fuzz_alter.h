/* Alters a valid HDF5 file according to the input bytes: deletes or renames links and attributes,
 * replaces them by objects of another kind, type or shape, or makes cycles. The result is a
 * well-formed file with a valid checksum and unexpected contents. Damaged files would be rejected
 * because of their checksum. */
#ifndef BEAMWORK_FUZZ_ALTER_H
#define BEAMWORK_FUZZ_ALTER_H

#include <hdf5.h>

#include "harness/study/study.h"
#include "harness/tools/fuzz/fuzz_file.h"

enum { ALTER_OBJECTS = 400, ALTER_NAME = 200, ALTER_BYTES = 1 << 20, ALTER_STEP = 4 };

typedef struct alter_list {
    int count;
    char name[ALTER_OBJECTS][ALTER_NAME];
} alter_list;

static herr_t alter_collect(hid_t at, const char *name, const H5L_info_t *info, void *context)
{
    alter_list *list = context;
    (void)at;
    (void)info;
    if (list->count < ALTER_OBJECTS && strlen(name) < ALTER_NAME)
        strcpy(list->name[list->count++], name);
    return 0;
}

/* Returns a type: 0 double, 1 byte, 2 text, 3 text of any length, 4 compound, 5 array, 6 opaque. */
static hid_t alter_type(unsigned what, unsigned size)
{
    const hsize_t three = 3;
    hid_t type = H5Tcopy(what % 7 == 1 ? H5T_NATIVE_SCHAR : H5T_NATIVE_DOUBLE);
    if (what % 7 == 2 || what % 7 == 3) {
        H5Tclose(type);
        type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, what % 7 == 3 ? H5T_VARIABLE : size + 1);
    } else if (what % 7 == 4) {
        H5Tclose(type);
        type = H5Tcreate(H5T_COMPOUND, 16);
        H5Tinsert(type, size & 1 ? "value" : "point", 0, H5T_NATIVE_DOUBLE);
        H5Tinsert(type, size & 2 ? "error" : "elements", 8, H5T_NATIVE_LONG);
    } else if (what % 7 == 5) {
        H5Tclose(type);
        type = H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, &three);
    } else if (what % 7 == 6) {
        H5Tclose(type);
        type = H5Tcreate(H5T_OPAQUE, size + 1);
    }
    return type;
}

static hid_t alter_space(unsigned what)
{
    const hsize_t size[2] = {what % 5, what % 3};
    if (what % 4 < 2)
        return H5Screate(what % 4 == 0 ? H5S_SCALAR : H5S_NULL);
    return H5Screate_simple(1 + what % 2, size, NULL);
}

static void alter_attribute(hid_t file, const char *name, unsigned index, unsigned what)
{
    char attribute[ALTER_NAME];
    if (H5Aget_name_by_idx(file, name, H5_INDEX_NAME, H5_ITER_INC, index % 16, attribute,
                           sizeof attribute, H5P_DEFAULT) < 0)
        return;
    H5Adelete_by_name(file, name, attribute, H5P_DEFAULT);
    if (what % 8 == 7)
        return;
    const hid_t type = alter_type(what, what / 8), space = alter_space(what / 7),
                a = H5Acreate_by_name(file, name, attribute, type, space, H5P_DEFAULT, H5P_DEFAULT,
                                      H5P_DEFAULT);
    H5Aclose(a);
    H5Sclose(space);
    H5Tclose(type);
}

static void alter_data(hid_t file, const char *name, unsigned what, unsigned size)
{
    const hid_t type = alter_type(what, size), space = alter_space(size);
    H5Ldelete(file, name, H5P_DEFAULT);
    const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dclose(set);
    H5Sclose(space);
    H5Tclose(type);
}

/* Makes the type of a table column in memory: numbers, or strings of eight bytes. */
static hid_t alter_column(hid_t set, unsigned what)
{
    const hid_t stored = H5Dget_type(set);
    const unsigned member = what % (unsigned)H5Tget_nmembers(stored);
    char *name = H5Tget_member_name(stored, member);
    const hid_t column = H5Tget_member_type(stored, member), type = H5Tcreate(H5T_COMPOUND, 8);
    const int is_text = H5Tget_class(column) == H5T_STRING;
    const hid_t own = H5Tcopy(is_text ? H5T_C_S1 : H5T_NATIVE_DOUBLE);
    if (is_text) {
        H5Tset_size(own, 8);
        H5Tset_cset(own, H5Tget_cset(column));
    }
    H5Tinsert(type, name, 0, own);
    H5free_memory(name);
    H5Tclose(own);
    H5Tclose(column);
    H5Tclose(stored);
    return type;
}

static void alter_values(hid_t file, const char *name, unsigned what, unsigned where)
{
    static const double odd[] = {0, -1, 1e308, 1e-320, 4294967296.0, -9e18};
    static double values[4096];
    const hid_t set =
        H5Oexists_by_name(file, name, H5P_DEFAULT) > 0 ? H5Dopen2(file, name, H5P_DEFAULT) : -1;
    const hid_t space = set >= 0 ? H5Dget_space(set) : -1,
                stored = set >= 0 ? H5Dget_type(set) : -1;
    const int is_table = stored >= 0 && H5Tget_class(stored) == H5T_COMPOUND;
    const hid_t type = is_table ? alter_column(set, where) : H5Tcopy(H5T_NATIVE_DOUBLE);
    for (int i = 0; i < 4096; i++)
        values[i] = odd[what % 6];
    if (space >= 0 && H5Sget_simple_extent_npoints(space) <= 4096)
        H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    H5Tclose(type);
    H5Tclose(stored);
    H5Sclose(space);
    H5Dclose(set);
}

static void alter_step(hid_t file, const alter_list *list, const uint8_t step[ALTER_STEP])
{
    char longer[3 * ALTER_NAME];
    const char *name = list->name[(step[1] | (step[0] & 0xf0u) << 4) % (unsigned)list->count];
    switch (step[0] % 7) {
    case 0:
        H5Ldelete(file, name, H5P_DEFAULT);
        break;
    case 1:
        H5Ldelete(file, name, H5P_DEFAULT);
        H5Gclose(H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
        break;
    case 2:
        alter_data(file, name, step[2], step[3]);
        break;
    case 3:
        alter_attribute(file, name, step[2], step[3]);
        break;
    case 4:
        alter_values(file, name, step[2], step[3]);
        break;
    case 5:
        snprintf(longer, sizeof longer, "%s%0*d", name, step[2] * 2 + 1, step[3]);
        H5Lmove(file, name, file, longer, H5P_DEFAULT, H5P_DEFAULT);
        break;
    default:
        snprintf(longer, sizeof longer, "%s/n%d", name, step[2]);
        if (step[3] & 1)
            H5Lcreate_hard(file, list->name[step[3] % (unsigned)list->count], file, longer,
                           H5P_DEFAULT, H5P_DEFAULT);
        else
            H5Lcreate_soft("/nowhere", file, longer, H5P_DEFAULT, H5P_DEFAULT);
    }
}

/* Returns the path of the altered copy of the file that the environment variable FUZZ_BASE
 * names. */
static const char *alter_file(const uint8_t *data, size_t size)
{
    static char all[ALTER_BYTES];
    static size_t length;
    static alter_list list;
    char line[CHECKSUM_LENGTH + 1];
    if (length == 0) {
        FILE *base = fopen(getenv("FUZZ_BASE") != NULL ? getenv("FUZZ_BASE") : "", "rb");
        fuzz_must(base != NULL, "FUZZ_BASE names a good file");
        length = fread(all, 1, sizeof all, base);
        fclose(base);
    }
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const char *path = fuzz_file((const uint8_t *)all, length);
    const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    if (list.count == 0)
        H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, alter_collect, &list);
    fuzz_must(file >= 0 && list.count > 0, "the base is a good file");
    for (size_t i = 0; i + ALTER_STEP <= size && i < 8 * ALTER_STEP; i += ALTER_STEP)
        alter_step(file, &list, data + i);
    H5Fclose(file);
    FILE *again = fopen(path, "rb+");
    static char altered[2 * ALTER_BYTES];
    const size_t now = fread(altered, 1, sizeof altered, again);
    checksum_write(altered, now, line);
    fseek(again, 0, SEEK_END);
    fputs(line, again);
    fclose(again);
    return path;
}

#endif
