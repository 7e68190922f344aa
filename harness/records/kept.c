#include "harness/records/kept.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "harness/records/place.h"
#include "harness/records/schema.h"
#include "harness/records/table_reader.h"
#include "harness/study/checksum.h"

hid_t kept_group(record *r, const char *name)
{
    if (name == NULL)
        return record_group(r, r->file, "/");
    const hid_t all = record_group(r, r->file, KEPT_GROUPS), own = record_group(r, all, name);
    H5Gclose(all);
    return own;
}

/* 1: its first bytes are those of HDF5. */
static int is_hdf5(const char *path)
{
    static const unsigned char signature[8] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
    unsigned char head[sizeof signature] = {0};
    FILE *from = fopen(path, "rb");
    const size_t length = from != NULL ? fread(head, 1, sizeof head, from) : 0;
    if (from != NULL)
        fclose(from);
    return length == sizeof head && memcmp(head, signature, sizeof head) == 0;
}

static status unfit(const char *path, fault *f)
{
    return fault_set(f, STATUS_REFUSED,
                     "%.200s: HDF5 that is damaged or no file of results, and what it holds would "
                     "be lost; move it away or give another name",
                     path);
}

/* *file: -1: nothing is there that is to be kept. */
static status open_former(const char *path, hid_t *file, fault *f)
{
    char schema[64];
    *file = -1;
    if (!is_hdf5(path))
        return STATUS_OK;
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    if (checksum_check(path, NULL) == STATUS_OK)
        *file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (*file < 0)
        return unfit(path, f);
    if (table_reader_attribute_text(*file, "schema", schema, sizeof schema) &&
        strcmp(schema, SCHEMA_NAME) == 0)
        return STATUS_OK;
    H5Fclose(*file);
    *file = -1;
    return unfit(path, f);
}

status kept_check(const char *path, fault *f)
{
    hid_t file;
    TRY(open_former(path, &file, f));
    if (file >= 0)
        H5Fclose(file);
    return STATUS_OK;
}

status kept_spare(const char *path, fault *f)
{
    hid_t file;
    if (open_former(path, &file, NULL) != STATUS_OK || file < 0)
        return STATUS_OK;
    H5Fclose(file);
    return fault_set(f, STATUS_REFUSED,
                     "%.200s holds results of verify or of other experiments, which would be "
                     "replaced; give another name",
                     path);
}

static herr_t copy_attribute(hid_t from, const char *name, const H5A_info_t *unused, void *to)
{
    (void)unused;
    record *r = to;
    const hid_t old = H5Aopen(from, name, H5P_DEFAULT), type = H5Aget_type(old),
                space = H5Aget_space(old);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    char *value = calloc((size_t)(count > 0 ? count : 0) + 1, H5Tget_size(type));
    const hid_t own = value != NULL && H5Aread(old, type, value) >= 0
                          ? H5Acreate2(r->file, name, type, space, H5P_DEFAULT, H5P_DEFAULT)
                          : -1;
    r->bad |= own < 0 || H5Awrite(own, type, value) < 0;
    free(value);
    H5Aclose(own);
    H5Sclose(space);
    H5Tclose(type);
    H5Aclose(old);
    return 0;
}

/* Links that are not here yet. */
static void copy_links(record *r, hid_t from, hid_t to)
{
    enum { NAME = 256 };
    char name[NAME];
    H5G_info_t info = {0};
    r->bad |= H5Gget_info(from, &info) < 0;
    for (hsize_t i = 0; i < info.nlinks && !r->bad; i++) {
        const ssize_t length = H5Lget_name_by_idx(from, ".", H5_INDEX_NAME, H5_ITER_INC, i, name,
                                                  sizeof name, H5P_DEFAULT);
        r->bad |= length <= 0 || length >= NAME;
        if (!r->bad && H5Lexists(to, name, H5P_DEFAULT) <= 0)
            r->bad |= H5Ocopy(from, name, to, name, H5P_DEFAULT, H5P_DEFAULT) < 0;
    }
}

static void copy_groups(record *r, hid_t former)
{
    if (H5Lexists(former, KEPT_GROUPS, H5P_DEFAULT) <= 0)
        return;
    const hid_t from = H5Gopen2(former, KEPT_GROUPS, H5P_DEFAULT),
                to = record_group(r, r->file, KEPT_GROUPS);
    copy_links(r, from, to);
    H5Gclose(to);
    H5Gclose(from);
}

static void copy_former(record *r, const char *name, hid_t former)
{
    copy_groups(r, former);
    if (name == NULL)
        return;
    copy_links(r, former, r->file);
    r->bad |= H5Aiterate2(former, H5_INDEX_NAME, H5_ITER_INC, NULL, copy_attribute, r) < 0;
}

/* Of a file that verify has not written into yet. */
static void put_schema(record *r)
{
    if (H5Aexists(r->file, "schema") > 0)
        return;
    record_text(r, r->file, "schema", SCHEMA_NAME);
    record_count(r, r->file, "schema_version", SCHEMA_VERSION);
}

static status merge(record *r, const char *name, const char *path, fault *f)
{
    hid_t former;
    TRY(open_former(path, &former, f));
    if (former >= 0) {
        copy_former(r, name, former);
        H5Fclose(former);
    }
    put_schema(r);
    return STATUS_OK;
}

/* Has whoever held it before taken it away? */
static int is_there(int lock, const char *name)
{
    struct stat own, there;
    return fstat(lock, &own) == 0 && stat(name, &there) == 0 && own.st_dev == there.st_dev &&
           own.st_ino == there.st_ino;
}

/* The file beside is the lock, as the results themselves are replaced. One that a killed run has
 * left is no hindrance: the lock ends with its process. -1 and errno: none. */
static int take_lock(const char *name)
{
    for (;;) {
        const int lock = open(name, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (lock < 0)
            return -1;
        while (flock(lock, LOCK_EX) != 0)
            if (errno != EINTR) {
                close(lock);
                return -1;
            }
        if (is_there(lock, name))
            return lock;
        close(lock);
    }
}

static status close_locked(record *r, const char *name, const place *at, const char *path, fault *f)
{
    char beside[PATH_MAX];
    const int length = snprintf(beside, sizeof beside, "%s.lock", at->path),
              lock = length < PATH_MAX ? take_lock(beside) : -1;
    if (lock < 0)
        return record_drop(r, fault_set(f, STATUS_FAULT, "%.200s: cannot be locked (%s)", path,
                                        strerror(length < PATH_MAX ? errno : ENAMETOOLONG)));
    status outcome = merge(r, name, at->path, f);
    outcome = outcome == STATUS_OK ? record_close(r, path, f) : record_drop(r, outcome);
    unlink(beside);
    close(lock);
    return outcome;
}

status kept_close(record *r, const char *name, const char *path, fault *f)
{
    place at;
    if (path == NULL)
        return record_close(r, NULL, f);
    const status found = place_find(path, &at, f);
    if (found != STATUS_OK)
        return record_drop(r, found);
    return at.kind == PLACE_FREE || at.kind == PLACE_FILE ? close_locked(r, name, &at, path, f)
                                                          : record_close(r, path, f);
}
