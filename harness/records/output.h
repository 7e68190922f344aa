/* Files that appear complete or not at all: written beside, then renamed onto the place that links
 * lead to. Pipes and devices are written to directly, and take text only. */
#ifndef BEAMWORK_OUTPUT_H
#define BEAMWORK_OUTPUT_H

#include <stdio.h>

#include "harness/records/place.h"

/* A whole file needs a regular file: it is read at any place, not from its beginning to its end. */
typedef enum output_form { OUTPUT_TEXT, OUTPUT_WHOLE_FILE } output_form;

typedef struct output {
    FILE *stream;
    file_place to;
    char temporary[PATH_MAX]; /* empty: written directly */
} output;

/* 1: its name says that it is HDF5. */
int output_is_hdf5(const char *path);
/* Text; path NULL: onto standard output. */
status output_open(const char *path, output *out, fault *f);
status output_open_whole(const char *path, output *out, fault *f);
/* Flushes and renames; every error is found here. On failure nothing is left. */
status output_close(output *out, fault *f);
/* Closes what was written and discards what was not. */
status output_finish(output *out, status written, fault *f);
/* Standard output has gone where it goes, or FAULT. */
status output_flush(fault *f);
/* An output that cannot be written is noticed before anything is computed: REFUSED what is no name
 * or takes no such form, FAULT what cannot be written. *where: the place, for comparison with
 * others. */
status output_try(const char *path, output_form form, file_place *where, fault *f);
/* Deletes the files and folders of this process that were written beside their places and are not
 * complete; a signal handler may call it. */
void output_abandon(void);
/* What `make` makes of a name beside `path` that nobody can guess (-1 and errno: nothing). It is
 * not complete until it is forgotten. */
int output_beside(const char *path, int (*make)(const char *name), char temporary[PATH_MAX]);
void output_forget(const char *temporary);
/* A file, or a folder with all that is in it. */
void output_remove(const char *temporary);
/* "results.partial.h5" of "results.h5": of a run that was interrupted. A stream keeps its name. */
status output_partial(const char *path, char partial[PATH_MAX], fault *f);

#endif
