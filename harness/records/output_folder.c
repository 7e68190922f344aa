#include "harness/records/output_folder.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "harness/records/output.h"

static status folder_fail(const output_folder *out, int why, fault *f)
{
    return fault_set(f, STATUS_FAULT, "%.200s: cannot be written (%s); nothing was left",
                     out->to.path, why != 0 ? strerror(why) : "no room");
}

static status find(const char *path, output_folder *out, fault *f)
{
    char plain[PATH_MAX];
    size_t length = strlen(path);
    memset(out, 0, sizeof *out);
    if (length == 0)
        return fault_set(f, STATUS_REFUSED, "an output without a name; give the name of a folder");
    if (length >= sizeof plain)
        return fault_set(f, STATUS_FAULT, "%.200s: cannot be written (%s); choose another place",
                         path, strerror(ENAMETOOLONG));
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

/* There may be an empty one in its place. */
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

/* 1: a folder with nothing in it. */
static int is_empty(const char *path)
{
    DIR *folder = opendir(path);
    int entries = 0;
    if (folder == NULL)
        return 0;
    while (readdir(folder) != NULL)
        entries++;
    closedir(folder);
    return entries <= 2; /* itself and the one above */
}

status output_folder_open(const char *path, output_folder *out, fault *f)
{
    TRY(find(path, out, f));
    if (out->to.kind == PLACE_FILE || out->to.kind == PLACE_STREAM)
        return fault_set(f, STATUS_REFUSED,
                         "%.200s is there already and is no folder; give another name", path);
    if (out->to.kind == PLACE_FOLDER && !is_empty(out->to.path))
        return fault_set(f, STATUS_REFUSED,
                         "%.200s is there already and not empty; give another name", path);
    return create(out, f);
}

status output_folder_try(const char *path, file_place *where, fault *f)
{
    output_folder out;
    TRY(output_folder_open(path, &out, f));
    output_remove(out.temporary);
    output_forget(out.temporary);
    *where = out.to;
    return STATUS_OK;
}

/* 0: too long. */
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
    output_forget(out->temporary);
    out->temporary[0] = '\0';
    return outcome;
}
