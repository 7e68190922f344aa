#include "harness/study/data_place.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Data of an installed copy; defined in one place only, as the prefix is a matter of the build. */
#ifndef BEAMWORK_DATA
#define BEAMWORK_DATA "/usr/local/share/beamwork"
#endif

/* Is it in a folder? */
static int is_in(const char *folder, const char *below, const char *name, char path[PATH_MAX])
{
    const int length = snprintf(path, PATH_MAX, "%s/%s%s", folder, below, name);
    return length < PATH_MAX && access(path, R_OK) == 0;
}

/* bin/ and lib/ stand beside share/; lib/x86_64-linux-gnu one deeper. */
static int is_near(const char *folder, const char *name, char path[PATH_MAX])
{
    static const char *const below[] = {"", "../", "../share/beamwork/", "../../share/beamwork/"};
    for (size_t i = 0; i < sizeof below / sizeof below[0]; i++)
        if (is_in(folder, below[i], name, path))
            return 1;
    return 0;
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
    static const char here = 0;
    Dl_info about;
    if (dladdr(&here, &about) == 0 || about.dli_fname == NULL ||
        strstr(about.dli_fname, ".so") == NULL || realpath(about.dli_fname, out) == NULL)
        return 0;
    *strrchr(out, '/') = '\0';
    return 1;
}

int data_place(const char *name, char path[PATH_MAX])
{
    char folder[PATH_MAX];
    if (library_folder(folder) && is_near(folder, name, path))
        return 1;
    program_folder(folder);
    if (is_near(folder, name, path) || is_in(BEAMWORK_DATA, "", name, path))
        return 1;
    is_in(folder, "", name, path);
    return 0;
}

void data_place_truths(char path[PATH_MAX])
{
    const char *given = getenv("BEAMWORK_TRUTHS");
    if (given != NULL)
        snprintf(path, PATH_MAX, "%s", given);
    else
        data_place("truths.h5", path);
}

void data_place_modules(void)
{
    char path[PATH_MAX];
    const char *given = getenv("PYTHONPATH");
    if (!data_place("elements/examples/beamwork_element.py", path) &&
        !data_place("examples/elements/beamwork_element.py", path))
        return;
    *strrchr(path, '/') = '\0';
    if (given != NULL && strstr(given, path) != NULL)
        return;
    const size_t room = (given != NULL ? strlen(given) : 0) + strlen(path) + 2;
    char *both = malloc(room);
    if (both == NULL)
        return;
    snprintf(both, room, "%s%s%s", given != NULL ? given : "",
             given != NULL && given[0] != '\0' ? ":" : "", path);
    setenv("PYTHONPATH", both, 1);
    setenv("PYTHONDONTWRITEBYTECODE", "1", 0); /* nothing is written into an installed copy */
    free(both);
}
