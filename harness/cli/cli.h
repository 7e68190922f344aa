/* The verbs of the command line. Each returns an exit code. */
#ifndef BEAMWORK_CLI_H
#define BEAMWORK_CLI_H

#include "harness/cli/case_input.h"
#include "harness/cli/command.h"
#include "harness/cli/files.h"
#include "harness/cli/message.h"

typedef int cli_verb(int count, char **arguments);
cli_verb cli_list, cli_solve, cli_verify, cli_converge, cli_bench, cli_stress, cli_compare,
    cli_truth, cli_schema, cli_scene, cli_import, cli_export, cli_explain, cli_element_test,
    cli_merge, cli_sweep, cli_motion;

#endif
