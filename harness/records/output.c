#include "harness/records/records_impl.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_TRIES = 100, LEAF = 100 };

/* Existing temporary files and folders, up to MOST_OPEN. owner: their process; 0: unused; -1: a
 * name is being written. */
enum { MOST_OPEN = 16 };
static struct {
    atomic_int owner;
    char path[PATH_MAX];
} unfinished[MOST_OPEN];

static void output_register(const char *path)
{
    for (int i = 0; i < MOST_OPEN; i++) {
        int nobody = 0;
        if (atomic_compare_exchange_strong(&unfinished[i].owner, &nobody, -1)) {
            snprintf(unfinished[i].path, PATH_MAX, "%s", path);
            atomic_store(&unfinished[i].owner, getpid());
            return;
        }
    }
}

static void output_unregister(const char *path)
{
    for (int i = 0; i < MOST_OPEN; i++)
        if (atomic_load(&unfinished[i].owner) == getpid() && strcmp(unfinished[i].path, path) == 0)
            atomic_store(&unfinished[i].owner, 0);
}

/* Functions that remove incomplete outputs. They use only system calls, as a signal handler
 * requires. */
static void remove_all(int at, const char *name);

/* Removes the entries of a folder. Returns the number of entries that were found. */
static int empty_once(int folder)
{
    _Alignas(struct dirent64) char room[4096];
    int entries = 0;
    ssize_t length = 0;
    lseek(folder, 0, SEEK_SET);
    while ((length = getdents64(folder, room, sizeof room)) > 0)
        for (ssize_t k = 0; k < length;) {
            const struct dirent64 *one = (const void *)&room[k];
            const char *name = one->d_name;
            k += one->d_reclen;
            if (strcmp(name, ".") == 0 || strcmp(name, "..") == 0)
                continue;
            entries++;
            remove_all(folder, name);
        }
    return entries;
}

static void remove_all(int at, const char *name)
{
    if (unlinkat(at, name, 0) == 0 || errno == ENOENT)
        return;
    const int folder = openat(at, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    for (int i = 0; folder >= 0 && i < MOST_TRIES && empty_once(folder) > 0; i++)
        continue;
    if (folder >= 0)
        close(folder);
    unlinkat(at, name, AT_REMOVEDIR);
}

static void output_remove(const char *temporary)
{
    remove_all(AT_FDCWD, temporary);
}

void output_abandon(void)
{
    for (int i = 0; i < MOST_OPEN; i++)
        if (atomic_load(&unfinished[i].owner) == getpid())
            output_remove(unfinished[i].path);
}

/* Calls `make` with an unpredictable name next to `path`. Returns its result, or -1 with errno set.
 * The file counts as incomplete until output_unregister is called. */
static int output_beside(const char *path, int (*make)(const char *name), char temporary[PATH_MAX])
{
    const char *leaf = place_leaf(path);
    for (int i = 0; i < MOST_TRIES; i++) {
        uint64_t word = 0;
        if (getrandom(&word, sizeof word, 0) != (ssize_t)sizeof word)
            return -1;
        const int length = snprintf(temporary, PATH_MAX, "%.*s%.*s.part-%016llx",
                                    (int)(leaf - path), path, LEAF, leaf, (unsigned long long)word);
        if (length >= PATH_MAX) {
            errno = ENAMETOOLONG;
            return -1;
        }
        output_register(temporary);
        const int made = make(temporary);
        if (made >= 0)
            return made;
        output_unregister(temporary);
        if (errno != EEXIST)
            return -1;
    }
    return -1;
}

static int make_file(const char *name)
{
    return open(name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
}

static void keep_permissions(const file_place *to, int file)
{
    if (to->kind == PLACE_FILE &&
        (fchown(file, to->owner, to->group) != 0 || fchmod(file, to->mode) != 0))
        fchmod(file, to->mode);
}

static int open_stream(const file_place *to)
{
    if (to->descriptor < 0)
        return open(to->path, O_WRONLY | O_NOCTTY | O_CLOEXEC);
    fflush(to->descriptor == STDOUT_FILENO ? stdout : stderr);
    return dup(to->descriptor);
}

int output_is_hdf5(const char *path)
{
    const char *dot = strrchr(place_leaf(path), '.');
    return dot != NULL && (strcasecmp(dot, ".h5") == 0 || strcasecmp(dot, ".hdf5") == 0);
}

static status check_form(const char *path, const file_place *to, output_form form, fault *f)
{
    if (to->kind == PLACE_FOLDER)
        return place_unwritable(path, EISDIR, f);
    if (form == OUTPUT_TEXT && output_is_hdf5(path))
        return fault_set(f, STATUS_REFUSED,
                         "%.200s: this output is text, not HDF5; give a name that does not end in "
                         "%s, such as output.txt ('solve --shapes' writes HDF5)",
                         path, strrchr(path, '.'));
    if (to->kind == PLACE_STREAM && form == OUTPUT_WHOLE_FILE)
        return fault_set(
            f, STATUS_REFUSED,
            "%.200s is %s, but HDF5 requires a regular file; give a file name such as results.h5",
            path,
            to->descriptor >= 0 ? "the file of standard output or error" : "a pipe or a device");
    if (to->kind != PLACE_FREE && access(to->path, W_OK) != 0)
        return place_unwritable(path, errno, f);
    return STATUS_OK;
}

static void discard(output *out)
{
    if (out->stream != NULL && out->stream != stdout)
        fclose(out->stream);
    out->stream = NULL;
    if (out->temporary[0] != '\0') {
        unlink(out->temporary);
        output_unregister(out->temporary);
    }
}

static status open_as(const char *path, output_form form, output *out, fault *f)
{
    memset(out, 0, sizeof *out);
    TRY(place_find(path, &out->to, f));
    TRY(check_form(path, &out->to, form, f));
    const int direct = out->to.kind == PLACE_STREAM;
    const int file =
        direct ? open_stream(&out->to) : output_beside(out->to.path, make_file, out->temporary);
    out->stream = file >= 0 ? fdopen(file, "w") : NULL;
    if (out->stream == NULL) {
        const int why = errno;
        if (file >= 0) {
            close(file);
            discard(out);
        }
        return place_unwritable(path, why, f);
    }
    if (!direct)
        keep_permissions(&out->to, file);
    return STATUS_OK;
}

status output_open(const char *path, output *out, fault *f)
{
    if (path != NULL)
        return open_as(path, OUTPUT_TEXT, out, f);
    *out = (output){.stream = stdout};
    return STATUS_OK;
}

status output_open_whole(const char *path, output *out, fault *f)
{
    return open_as(path, OUTPUT_WHOLE_FILE, out, f);
}

/* Writes the file to the disk. Returns 0 after an error. A file that cannot be synchronised, such
 * as a pipe or a device, is not an error. */
static int is_stored(FILE *stream)
{
    if (ferror(stream) || fflush(stream) != 0)
        return 0;
    return fsync(fileno(stream)) == 0 || errno == EINVAL || errno == EROFS || errno == ENOTSUP;
}

static status stdout_unwritable(int why, fault *f)
{
    return fault_set(f, STATUS_FAULT,
                     "standard output cannot be written (%s); free disk space, or redirect the "
                     "output to another file",
                     why != 0 ? strerror(why) : "an earlier write failed");
}

status output_flush(fault *f)
{
    return fflush(stdout) == 0 ? STATUS_OK : stdout_unwritable(errno, f);
}

status output_all_written(fault *f)
{
    errno = 0;
    return fflush(stdout) == 0 && !ferror(stdout) ? STATUS_OK : stdout_unwritable(errno, f);
}

status output_close(output *out, fault *f)
{
    if (out->stream == stdout)
        return output_flush(f);
    errno = 0;
    int good = is_stored(out->stream);
    int why = good ? 0 : errno;
    const int closed = fclose(out->stream) == 0;
    why = good && !closed ? errno : why;
    good = good && closed;
    out->stream = NULL;
    if (good && out->temporary[0] != '\0' && rename(out->temporary, out->to.path) != 0) {
        good = 0;
        why = errno;
    }
    if (good) {
        output_unregister(out->temporary);
        return STATUS_OK;
    }
    discard(out);
    return fault_set(
        f, STATUS_FAULT,
        "%.200s cannot be written (%s)%s; free disk space, or give a path on another disk",
        out->to.path, why != 0 ? strerror(why) : "no space left",
        out->temporary[0] != '\0' ? "; no file was left" : "");
}

status output_finish(output *out, status written, fault *f)
{
    if (written == STATUS_OK)
        return output_close(out, f);
    discard(out);
    return written;
}

status output_try(const char *path, output_form form, file_place *where, fault *f)
{
    char temporary[PATH_MAX];
    TRY(place_find(path, where, f));
    TRY(check_form(path, where, form, f));
    if (where->kind == PLACE_STREAM)
        return STATUS_OK;
    const int file = output_beside(where->path, make_file, temporary);
    if (file < 0)
        return place_unwritable(path, errno, f);
    close(file);
    unlink(temporary);
    output_unregister(temporary);
    return STATUS_OK;
}

status output_partial(const char *path, char partial[PATH_MAX], fault *f)
{
    file_place to;
    const char *leaf = place_leaf(path), *dot = strrchr(leaf, '.');
    if (place_find(path, &to, f) == STATUS_OK && to.kind == PLACE_STREAM) {
        memcpy(partial, path, strlen(path) + 1);
        return STATUS_OK;
    }
    const size_t stem = dot != NULL && dot > leaf ? (size_t)(dot - path) : strlen(path);
    const int length = snprintf(partial, PATH_MAX, "%.*s.partial%s", (int)stem, path, path + stem);
    return length < PATH_MAX ? STATUS_OK : place_unwritable(path, ENAMETOOLONG, f);
}

static status folder_fail(const output_folder *out, int why, fault *f)
{
    return fault_set(f, STATUS_FAULT,
                     "%.200s cannot be written (%s); no file was left; free disk space, or give a "
                     "path in another, writable folder",
                     out->to.path, why != 0 ? strerror(why) : "no space left");
}

static status find(const char *path, output_folder *out, fault *f)
{
    char plain[PATH_MAX];
    size_t length = strlen(path);
    memset(out, 0, sizeof *out);
    if (length == 0)
        return fault_set(f, STATUS_REFUSED,
                         "the name of an output folder is empty; give a name such as folder");
    if (length >= sizeof plain)
        return place_unwritable(path, ENAMETOOLONG, f);
    while (length > 1 && path[length - 1] == '/')
        length--;
    memcpy(plain, path, length);
    plain[length] = '\0';
    return place_find(plain, &out->to, f);
}

static int make_folder(const char *name)
{
    return mkdir(name, S_IRWXU);
}

static status create(output_folder *out, fault *f)
{
    if (output_beside(out->to.path, make_folder, out->temporary) < 0) {
        out->temporary[0] = '\0';
        return folder_fail(out, errno, f);
    }
    const mode_t hidden = umask(0);
    umask(hidden);
    chmod(out->temporary, out->to.kind == PLACE_FOLDER ? out->to.mode : 0777 & ~hidden);
    return STATUS_OK;
}

static int is_empty(const char *path)
{
    DIR *folder = opendir(path);
    int entries = 0;
    if (folder == NULL)
        return 0;
    while (readdir(folder) != NULL)
        entries++;
    closedir(folder);
    return entries <= 2;
}

status output_folder_open(const char *path, output_folder *out, fault *f)
{
    TRY(find(path, out, f));
    if (out->to.kind == PLACE_FILE || out->to.kind == PLACE_STREAM)
        return fault_set(f, STATUS_REFUSED,
                         "%.200s already exists and is not a folder; give a new name", path);
    if (out->to.kind == PLACE_FOLDER && !is_empty(out->to.path))
        return fault_set(
            f, STATUS_REFUSED,
            "%.200s already exists and is not empty; give a new name, or empty the folder", path);
    return create(out, f);
}

status output_folder_try(const char *path, file_place *where, fault *f)
{
    output_folder out;
    TRY(output_folder_open(path, &out, f));
    output_remove(out.temporary);
    output_unregister(out.temporary);
    *where = out.to;
    return STATUS_OK;
}

/* Sets the path of a file in the folder. Returns 0 if the path is too long. */
static int name_inside(const output_folder *out, const char *name, char path[PATH_MAX])
{
    return snprintf(path, PATH_MAX, "%s/%s", out->temporary, name) < PATH_MAX;
}

status output_folder_below(const output_folder *out, const char *name, fault *f)
{
    char path[PATH_MAX];
    if (!name_inside(out, name, path))
        return folder_fail(out, ENAMETOOLONG, f);
    return mkdir(path, 0777) == 0 ? STATUS_OK : folder_fail(out, errno, f);
}

status output_folder_file(const output_folder *out, const char *name,
                          void (*write)(FILE *, const void *what), const void *what, fault *f)
{
    char path[PATH_MAX];
    if (!name_inside(out, name, path))
        return folder_fail(out, ENAMETOOLONG, f);
    FILE *file = fopen(path, "wxe");
    if (file == NULL)
        return folder_fail(out, errno, f);
    errno = 0;
    write(file, what);
    const int stored = !ferror(file) && fflush(file) == 0 && fsync(fileno(file)) == 0;
    int why = stored ? 0 : errno;
    const int closed = fclose(file) == 0;
    why = stored && !closed ? errno : why;
    return stored && closed ? STATUS_OK : folder_fail(out, why, f);
}

status output_folder_finish(output_folder *out, status written, fault *f)
{
    status outcome = written;
    if (out->temporary[0] == '\0')
        return outcome;
    if (outcome == STATUS_OK && rename(out->temporary, out->to.path) != 0)
        outcome = folder_fail(out, errno, f);
    if (outcome != STATUS_OK)
        output_remove(out->temporary);
    output_unregister(out->temporary);
    out->temporary[0] = '\0';
    return outcome;
}
