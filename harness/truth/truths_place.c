#include "harness/truth/truths_place.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifndef BEAMWORK_PREFIX
#define BEAMWORK_PREFIX "/usr/local"
#endif

static const char name[] = "truths.h5";

/* The file of a folder where it is there. */
static int is_in(const char *folder, const char *below, char path[PATH_MAX])
{
    const int length = snprintf(path, PATH_MAX, "%s/%s%s", folder, below, name);
    return length < PATH_MAX && access(path, R_OK) == 0;
}

/* bin/ and lib/ stand beside share/; lib/x86_64-linux-gnu one deeper. */
static int is_near(const char *folder, char path[PATH_MAX])
{
    return is_in(folder, "", path) || is_in(folder, "../share/beamwork/", path) ||
           is_in(folder, "../../share/beamwork/", path);
}

/* The folder of this program. */
static void program_folder(char out[PATH_MAX])
{
    const ssize_t length = readlink("/proc/self/exe", out, PATH_MAX - 1);
    out[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(out, '/');
    if (slash != NULL)
        *slash = '\0';
    else
        snprintf(out, PATH_MAX, ".");
}

/* The folder of the shared library that this code is part of; 0: it is part of a program. */
static int library_folder(char out[PATH_MAX])
{
    Dl_info about;
    if (dladdr(name, &about) == 0 || about.dli_fname == NULL ||
        strstr(about.dli_fname, ".so") == NULL || realpath(about.dli_fname, out) == NULL)
        return 0;
    *strrchr(out, '/') = '\0';
    return 1;
}

void truths_place(char path[PATH_MAX])
{
    char folder[PATH_MAX];
    const char *given = getenv("BEAMWORK_TRUTHS");
    if (given != NULL) {
        snprintf(path, PATH_MAX, "%s", given);
        return;
    }
    if (library_folder(folder) && is_near(folder, path))
        return;
    program_folder(folder);
    if (!is_near(folder, path) && !is_in(BEAMWORK_PREFIX, "share/beamwork/", path))
        snprintf(path, PATH_MAX, "%.*s/%s", PATH_MAX - 16, folder, name);
}
