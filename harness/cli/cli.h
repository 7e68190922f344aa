/* The verbs of the command line. */
#ifndef BEAMWORK_CLI_H
#define BEAMWORK_CLI_H

#include "harness/cli/case_input.h"
#include "harness/cli/command.h"
#include "harness/cli/files.h"
#include "harness/cli/message.h"
#include "harness/cli/options.h"
#include <stdio.h>

extern const verb verb_list, verb_solve, verb_verify, verb_converge, verb_bench, verb_stress,
    verb_compare, verb_truth, verb_schema, verb_scene, verb_import, verb_export, verb_explain,
    verb_element_test, verb_merge, verb_sweep, verb_motion;

/* `beamwork VERB ...`, `beamwork help [VERB]`, --help, --version: the exit code. arguments[0] is
 * the program. */
int verb_table_run(int count, char **arguments);

/* The word that is being written: `before` of it stays as it is, `begun` is to be completed. */
typedef struct offer {
    FILE *to;
    const char *before;
    int length; /* of before */
    const char *begun;
} offer;

/* A line "WORD<tab>SUMMARY" where the text begins as what was begun: the whole word, the text
 * behind `before`. What ends in '=' or ':' goes on; ":files" and ":folders" are for the shell to
 * do. */
void offer_text(const offer *o, const char *text, const char *summary);

/* The words behind the verb up to the cursor; the last one, which may be empty, is begun. */
void completion_write(FILE *to, const verb *v, int count, char *const *word);

#endif
