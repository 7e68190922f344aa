/* The files of a command line, looked at before the work begins. */
#ifndef BEAMWORK_FILES_H
#define BEAMWORK_FILES_H

#include "harness/cli/command.h"

/* Every output can be written and is a file of its own, and none is an input. whole_file: -o is
 * HDF5. truths_path: NULL where no truths are read. */
status files_check(const command_request *r, int whole_file, const char *truths_path, fault *f);
/* The same of a further input, alone. */
status files_check_input(const command_request *r, const char *path, fault *f);

#endif
