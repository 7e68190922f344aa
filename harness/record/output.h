/* Text files that appear complete or not at all: written beside, then renamed. */
#ifndef BEAMWORK_OUTPUT_H
#define BEAMWORK_OUTPUT_H

#include <stdio.h>

#include "elements/math/status.h"

typedef struct output {
    FILE *stream;
    char path[480], temporary[512];
} output;

status output_open(const char *path, output *out, fault *f);
/* Flushes and renames; every error is found here. On failure nothing is left. */
status output_close(output *out, fault *f);
void output_discard(output *out);
/* An output that cannot be written is noticed before anything is computed. path NULL: nothing to write. */
status output_try(const char *path, fault *f);
/* Name of the temporary beside `path`. FAULT when the path is too long. */
status output_temporary(const char *path, char *temporary, int size, fault *f);

#endif
