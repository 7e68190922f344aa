/* bench --against: one cell in alternation with another formulation, or with the same cell of
 * another program. */
#ifndef BEAMWORK_CONTEST_H
#define BEAMWORK_CONTEST_H

#include "harness/cli/command.h"

/* The exit code. */
int contest_run(command_request *r);

#endif
