/* A folder that appears complete or not at all: its files are written into one beside it, which is
 * then renamed.  Nothing that is there is replaced. */
#ifndef BEAMWORK_OUTPUT_FOLDER_H
#define BEAMWORK_OUTPUT_FOLDER_H

#include <stdio.h>

#include "harness/records/place.h"

typedef struct output_folder {
    file_place to;
    char temporary[PATH_MAX];
} output_folder;

/* Can it be made, at *where? REFUSED: something is there, other than an empty folder. FAULT: it
 * cannot be written. */
status output_folder_try(const char *path, file_place *where, fault *f);
status output_folder_open(const char *path, output_folder *out, fault *f);
/* A folder inside it. */
status output_folder_below(const output_folder *, const char *name, fault *f);
/* A file inside it, "K.mtx" or "state/K.mtx", is what `write` writes of `what`. */
status output_folder_file(const output_folder *, const char *name,
                          void (*write)(FILE *, const void *what), const void *what, fault *f);
/* Renames it where all was written, and else takes away what there is. */
status output_folder_finish(output_folder *, status written, fault *f);

#endif
