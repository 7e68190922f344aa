/* A temporary folder for a test, and its contents. */
#ifndef BEAMWORK_TEST_FOLDER_H
#define BEAMWORK_TEST_FOLDER_H

#include <dirent.h>
#include <gsl/gsl_test.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "harness/records/records.h"

static inline int folder_entries(const char *folder)
{
    int count = 0;
    DIR *d = opendir(folder);
    for (struct dirent *e = d != NULL ? readdir(d) : NULL; e != NULL; e = readdir(d))
        count += e->d_name[0] != '.';
    if (d != NULL)
        closedir(d);
    return count;
}

typedef struct test_folder {
    char path[64];
} test_folder;

static inline test_folder folder_make(void)
{
    test_folder out = {"/tmp/beamwork-output-XXXXXX"};
    gsl_test(mkdtemp(out.path) == NULL, "a folder");
    return out;
}

static inline void folder_remove(const test_folder *of)
{
    char command[100];
    snprintf(command, sizeof command, "rm -rf '%s'", of->path);
    gsl_test(system(command) != 0, "the folder is removed");
}

typedef struct folder_entry {
    char text[400];
} folder_entry;

static inline folder_entry folder_path(const test_folder *of, const char *name)
{
    folder_entry out;
    snprintf(out.text, sizeof out.text, "%s/%s", of->path, name);
    return out;
}

static inline status folder_write_text(const char *to, const char *text, fault *f)
{
    output o;
    TRY(output_open(to, &o, f));
    fputs(text, o.stream);
    return output_close(&o, f);
}

static inline int folder_holds(const char *file, const char *text)
{
    char content[200] = "";
    FILE *from = fopen(file, "r");
    const size_t size = from != NULL ? fread(content, 1, sizeof content - 1, from) : 0;
    if (from != NULL)
        fclose(from);
    return size == strlen(text) && strcmp(content, text) == 0;
}

static inline mode_t folder_mode_of(const char *file)
{
    struct stat there;
    return lstat(file, &there) == 0 ? there.st_mode : 0;
}

#endif
