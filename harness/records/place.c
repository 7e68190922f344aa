#include "harness/records/place.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_LINKS = 40 }; /* as the kernel follows */

const char *place_leaf(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

static status fail(const char *path, int why, fault *f)
{
    return fault_set(f, STATUS_FAULT, "%.200s: cannot be written (%s); choose another place", path,
                     strerror(why));
}

/* Replaces a path by what the link there says, beside it where that is relative. 0: no link. */
static int follow_link(char path[PATH_MAX])
{
    char text[PATH_MAX], next[2 * PATH_MAX];
    const ssize_t length = readlink(path, text, sizeof text);
    if (length <= 0)
        return 0;
    const int folder = text[0] == '/' ? 0 : (int)(place_leaf(path) - path);
    const int size = snprintf(next, sizeof next, "%.*s%.*s", folder, path, (int)length, text);
    if (size >= PATH_MAX)
        return 0;
    memcpy(path, next, (size_t)size + 1);
    return 1;
}

static int standard_descriptor(const struct stat *there)
{
    for (int i = STDOUT_FILENO; i <= STDERR_FILENO; i++) {
        struct stat own;
        if (fstat(i, &own) == 0 && own.st_dev == there->st_dev && own.st_ino == there->st_ino)
            return i;
    }
    return -1;
}

static void set_kind(const struct stat *there, file_place *out)
{
    out->device = there->st_dev;
    out->inode = there->st_ino;
    out->mode = there->st_mode & 0777;
    out->owner = there->st_uid;
    out->group = there->st_gid;
    out->shared = S_ISCHR(there->st_mode);
    out->descriptor = S_ISREG(there->st_mode) ? standard_descriptor(there) : -1;
    if (S_ISDIR(there->st_mode))
        out->kind = PLACE_FOLDER;
    else
        out->kind = S_ISREG(there->st_mode) && out->descriptor < 0 ? PLACE_FILE : PLACE_STREAM;
}

/* Nothing is at out->path: the folder it would be in. */
static status find_folder(const char *given, file_place *out, fault *f)
{
    char folder[PATH_MAX] = ".";
    struct stat there;
    const size_t length = (size_t)(place_leaf(out->path) - out->path);
    if (length > 0) {
        memcpy(folder, out->path, length);
        folder[length] = '\0';
    }
    if (out->path[length] == '\0')
        return fail(given, EISDIR, f);
    if (stat(folder, &there) != 0)
        return fail(given, errno, f);
    set_kind(&there, out);
    out->kind = PLACE_FREE;
    out->descriptor = -1;
    return STATUS_OK;
}

status place_find(const char *path, file_place *out, fault *f)
{
    struct stat there;
    const size_t length = strlen(path);
    memset(out, 0, sizeof *out);
    if (length == 0)
        return fault_set(f, STATUS_REFUSED, "an output without a name; give the name of a file");
    if (length >= sizeof out->path)
        return fail(path, ENAMETOOLONG, f);
    memcpy(out->path, path, length + 1);
    const int found = stat(path, &there) == 0;
    if (!found && errno != ENOENT)
        return fail(path, errno, f);
    if (found) {
        set_kind(&there, out);
        if (out->kind == PLACE_STREAM)
            return STATUS_OK;
    }
    for (int i = 0; i < MOST_LINKS && follow_link(out->path); i++)
        ;
    return found ? STATUS_OK : find_folder(path, out, f);
}

int place_same(const file_place *a, const file_place *b)
{
    const int is_free = a->kind == PLACE_FREE;
    if (a->device != b->device || a->inode != b->inode || is_free != (b->kind == PLACE_FREE))
        return 0;
    return !is_free || strcmp(place_leaf(a->path), place_leaf(b->path)) == 0;
}
