/* The files of a command line, looked at before the work begins. */
#ifndef BEAMWORK_FILES_H
#define BEAMWORK_FILES_H

#include "harness/cli/options.h"

/* Every output can be written and is a file of its own, and none is an input. whole_file: -o is
 * HDF5. truths_path: NULL where no truths are read. */
status files_check(const command_line *, int whole_file, const char *truths_path, fault *f);
/* The same; stored: -o is a file of results, which other experiments may have written into. */
status files_check_results(const command_line *, int stored, const char *truths_path, fault *f);
/* A file, every *.yaml of a folder in the order of their names, the files that exec:COMMAND
 * names. */
typedef status file_visit(const void *context, const char *path, fault *f);
status files_named(const char *input, file_visit *visit, const void *context, fault *f);

#endif
