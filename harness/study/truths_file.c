#include "harness/study/truths_file.h"

#include <string.h>

#include "harness/study/checksum.h"
#include "harness/study/handles.h"
#include "harness/study/truths.h"

/* Is it ours, and of this version? */
static status check_schema(hid_t file, const char *path, fault *f)
{
    char name[64] = "";
    int version = 0;
    const hid_t schema = H5Aexists(file, "schema") > 0 ? H5Aopen(file, "schema", H5P_DEFAULT) : -1;
    const hid_t type = schema >= 0 ? H5Aget_type(schema) : -1;
    if (type >= 0 && H5Tget_class(type) == H5T_STRING && !H5Tis_variable_str(type) &&
        H5Tget_size(type) < sizeof name)
        H5Aread(schema, type, name);
    const hid_t number =
        H5Aexists(file, "version") > 0 ? H5Aopen(file, "version", H5P_DEFAULT) : -1;
    if (number >= 0)
        H5Aread(number, H5T_NATIVE_INT, &version);
    handles_close(3, (const hid_t[]){number, type, schema});
    if (strcmp(name, "beamwork-truths") != 0)
        return fault_set(f, STATUS_FAULT, "%s: not a file of truths; build it with 'make all'",
                         path);
    if (version != TRUTHS_VERSION)
        return fault_set(
            f, STATUS_FAULT,
            "%s: truths of version %d, this program reads %d; build it again ('make all')", path,
            version, TRUTHS_VERSION);
    return STATUS_OK;
}

status truths_file_open(const char *path, hid_t *file, fault *f)
{
    *file = -1;
    TRY(checksum_check(path, f));
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    *file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (*file < 0)
        return fault_set(f, STATUS_FAULT, "%s: cannot be read as HDF5; build it with 'make all'",
                         path);
    return check_schema(*file, path, f);
}
