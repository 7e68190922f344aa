/* A request written out as a command line: what another process has to be asked for the same. */
#ifndef BEAMWORK_COMMAND_WORDS_H
#define BEAMWORK_COMMAND_WORDS_H

#include <jansson.h>

#include "harness/cli/command.h"

/* How files are named: as they were, by paths that hold in any folder, by what stands behind their
 * folders. */
typedef enum command_paths { PATHS_GIVEN, PATHS_ABSOLUTE, PATHS_LEAVES } command_paths;

/* Array of the arguments behind the verb: all that answers depend on, in one order however they
 * were given; not where results go, how they look, nor how many processes work. NULL: out of
 * memory. The caller owns it. */
json_t *command_words(const command_request *, command_paths paths);

#endif
