#include "harness/records/records_impl.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

hid_t kept_group(record_file *r, const char *name)
{
    if (name == NULL)
        return record_group(r, r->file, "/");
    const hid_t all = record_group(r, r->file, KEPT_GROUPS), own = record_group(r, all, name);
    H5Gclose(all);
    return own;
}

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
                     "%.200s would be overwritten, but it is damaged or is not a results file; "
                     "move it, or give -o another name",
                     path);
}

/* Locks a file, waiting at most `most_waits` tenths of a second; -1: no limit. Returns 0, or -1
 * with errno set. */
static int hold(int file, int kind, int most_waits)
{
    const int wait = most_waits < 0 ? 0 : LOCK_NB;
    while (flock(file, kind | wait) != 0) {
        if (errno != EINTR && (errno != EWOULDBLOCK || most_waits-- <= 0))
            return -1;
        usleep(100000);
    }
    return 0;
}

static status await_writer(const char *path, int most_waits, fault *f)
{
    const int file = open(path, O_RDONLY | O_CLOEXEC), held = hold(file, LOCK_SH, most_waits),
              why = errno;
    close(file);
    return held == 0 || why != EWOULDBLOCK
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "%.200s is being written by another program; wait until that program "
                           "has closed it, or give -o another name",
                           path);
}

static int is_ours(hid_t file)
{
    char schema[64];
    return H5Aexists(file, KEPT_SWEEP_MARK) > 0 ||
           (table_reader_attribute_text(file, "schema", schema, sizeof schema) &&
            strcmp(schema, SCHEMA_NAME) == 0);
}

static status open_former(const char *path, int most_waits, hid_t *file, fault *f)
{
    *file = -1;
    if (!is_hdf5(path))
        return STATUS_OK;
    TRY(await_writer(path, most_waits, f));
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    if (checksum_check(path, NULL) == STATUS_OK)
        *file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (*file >= 0 && is_ours(*file))
        return STATUS_OK;
    if (*file >= 0)
        H5Fclose(*file);
    *file = -1;
    return unfit(path, f);
}

void kept_names(hid_t file, char text[KEPT_NAMES])
{
    char name[KEPT_NAMES];
    H5G_info_t info = {0};
    snprintf(text, KEPT_NAMES, "%s",
             H5Aexists(file, KEPT_SWEEP_MARK) > 0        ? KEPT_SWEEP
             : H5Lexists(file, "cases", H5P_DEFAULT) > 0 ? "verify"
                                                         : "");
    const hid_t all = H5Lexists(file, KEPT_GROUPS, H5P_DEFAULT) > 0
                          ? H5Gopen2(file, KEPT_GROUPS, H5P_DEFAULT)
                          : -1;
    for (hsize_t i = 0; all >= 0 && H5Gget_info(all, &info) >= 0 && i < info.nlinks; i++) {
        const size_t used = strlen(text);
        if (H5Lget_name_by_idx(all, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name,
                               H5P_DEFAULT) > 0)
            snprintf(text + used, KEPT_NAMES - used, "%s%s", used > 0 ? ", " : "", name);
    }
    handles_close(1, &all);
    if (text[0] == '\0')
        snprintf(text, KEPT_NAMES, "no experiment");
}

typedef struct target {
    record_file *r;
    hid_t at;
} target;

static herr_t copy_attribute(hid_t from, const char *name, const H5A_info_t *unused, void *to)
{
    (void)unused;
    const target *t = to;
    const hid_t old = H5Aopen(from, name, H5P_DEFAULT), type = H5Aget_type(old),
                space = H5Aget_space(old);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    char *value = calloc((size_t)(count > 0 ? count : 0) + 1, H5Tget_size(type));
    const hid_t own = value != NULL && H5Aread(old, type, value) >= 0
                          ? H5Acreate2(t->at, name, type, space, H5P_DEFAULT, H5P_DEFAULT)
                          : -1;
    t->r->bad |= own < 0 || H5Awrite(own, type, value) < 0;
    free(value);
    H5Aclose(own);
    H5Sclose(space);
    H5Tclose(type);
    H5Aclose(old);
    return 0;
}

static void copy_links(record_file *r, hid_t from, hid_t to)
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

static void copy_all(record_file *r, hid_t from, hid_t to)
{
    target t = {r, to};
    copy_links(r, from, to);
    r->bad |= H5Aiterate2(from, H5_INDEX_NAME, H5_ITER_INC, NULL, copy_attribute, &t) < 0;
}

static void copy_groups(record_file *r, hid_t former)
{
    if (H5Lexists(former, KEPT_GROUPS, H5P_DEFAULT) <= 0)
        return;
    const hid_t from = H5Gopen2(former, KEPT_GROUPS, H5P_DEFAULT),
                to = record_group(r, r->file, KEPT_GROUPS);
    copy_links(r, from, to);
    H5Gclose(to);
    H5Gclose(from);
}

static void copy_former(record_file *r, const char *name, hid_t former)
{
    const int is_sweep = H5Aexists(former, KEPT_SWEEP_MARK) > 0;
    copy_groups(r, former);
    if (is_sweep && (name == NULL || strcmp(name, KEPT_SWEEP) != 0)) {
        const hid_t to = kept_group(r, KEPT_SWEEP);
        copy_all(r, former, to);
        H5Gclose(to);
    }
    if (!is_sweep && name != NULL)
        copy_all(r, former, r->file);
}

static void put_schema(record_file *r)
{
    if (H5Aexists(r->file, "schema") > 0)
        return;
    record_text(r, r->file, "schema", SCHEMA_NAME);
    record_count(r, r->file, "schema_version", SCHEMA_VERSION);
}

static status merge(record_file *r, const char *name, hid_t former, const char *path, fault *f)
{
    record_file all;
    if (r->to.stream == NULL) {
        const status opened = record_open_beside(&all, path, f);
        if (opened != STATUS_OK)
            return record_drop(r, opened);
        all.bad = r->bad;
        copy_all(&all, r->file, all.file);
        record_drop(r, STATUS_OK);
        *r = all;
    }
    copy_former(r, name, former);
    return STATUS_OK;
}

static status close_merged(record_file *r, const char *name, const file_place *at, const char *path,
                           fault *f)
{
    hid_t former;
    status outcome = open_former(at->path, -1, &former, f);
    if (outcome != STATUS_OK)
        return record_drop(r, outcome);
    if (former >= 0) {
        outcome = merge(r, name, former, path, f);
        H5Fclose(former);
        TRY(outcome);
    }
    put_schema(r);
    return record_close(r, path, f);
}

/* Returns 1 if the locked file still has this name, and 0 if its previous owner has removed it. */
static int is_there(int lock, const char *name)
{
    struct stat own, there;
    return fstat(lock, &own) == 0 && stat(name, &there) == 0 && own.st_dev == there.st_dev &&
           own.st_ino == there.st_ino;
}

/* A lock file that a killed run has left is harmless, because the lock ends with its process.
 * Returns the descriptor of the lock file, or -1 with errno set. */
static int take_lock(const char *name, int most_waits)
{
    for (;;) {
        const int lock = open(name, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (lock < 0)
            return -1;
        if (hold(lock, LOCK_EX, most_waits) != 0) {
            const int why = errno;
            close(lock);
            errno = why;
            return -1;
        }
        if (is_there(lock, name))
            return lock;
        close(lock);
    }
}

static status lock_beside(const file_place *at, int most_waits, char beside[PATH_MAX], int *lock,
                          fault *f)
{
    const int length = snprintf(beside, PATH_MAX, "%s.lock", at->path);
    *lock = length < PATH_MAX ? take_lock(beside, most_waits) : -1;
    if (*lock >= 0)
        return STATUS_OK;
    if (length < PATH_MAX && errno == EWOULDBLOCK)
        return fault_set(f, STATUS_REFUSED,
                         "%.200s is in use by another beamwork run, which holds %.200s; wait until "
                         "it ends, or give -o another name",
                         at->path, beside);
    return fault_set(f, STATUS_FAULT,
                     "%.100s: the lock file %.110s cannot be opened (%s); remove it, or give -o a "
                     "path in another, writable folder",
                     at->path, beside, strerror(length < PATH_MAX ? errno : ENAMETOOLONG));
}

static void unlock(const char *beside, int lock)
{
    unlink(beside);
    close(lock);
}

status kept_check(const char *path, fault *f)
{
    enum { MOST_WAITS = 100 };
    char beside[PATH_MAX];
    hid_t file;
    file_place at;
    int lock;
    TRY(place_find(path, &at, f));
    if (at.kind != PLACE_FREE && at.kind != PLACE_FILE)
        return STATUS_OK;
    TRY(lock_beside(&at, MOST_WAITS, beside, &lock, f));
    const status outcome = open_former(at.path, MOST_WAITS, &file, f);
    if (file >= 0)
        H5Fclose(file);
    unlock(beside, lock);
    return outcome;
}

static status close_locked(record_file *r, const char *name, const file_place *at, const char *path,
                           fault *f)
{
    char beside[PATH_MAX];
    int lock;
    const status locked = lock_beside(at, -1, beside, &lock, f);
    if (locked != STATUS_OK)
        return record_drop(r, locked);
    const status outcome = close_merged(r, name, at, path, f);
    unlock(beside, lock);
    return outcome;
}

status kept_close(record_file *r, const char *name, const char *path, fault *f)
{
    file_place at;
    if (path == NULL)
        return record_close(r, NULL, f);
    const status found = place_find(path, &at, f);
    if (found != STATUS_OK)
        return record_drop(r, found);
    return at.kind == PLACE_FREE || at.kind == PLACE_FILE ? close_locked(r, name, &at, path, f)
                                                          : record_close(r, path, f);
}
