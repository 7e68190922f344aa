/* The verbs of the command line. */
#ifndef BEAMWORK_CLI_H
#define BEAMWORK_CLI_H

#include "harness/cli/case_input.h"
#include "harness/cli/command.h"
#include "harness/cli/files.h"
#include "harness/cli/message.h"
#include "harness/cli/options.h"
#include <stdio.h>

/* In the order of help, below headings. A new verb is its file and a line here. */
#define VERBS(HEADING, VERB)                                                                       \
    HEADING(look)                                                                                  \
    VERB(list)                                                                                     \
    VERB(explain)                                                                                  \
    HEADING(compute)                                                                               \
    VERB(solve)                                                                                    \
    VERB(converge)                                                                                 \
    VERB(sweep)                                                                                    \
    VERB(truth)                                                                                    \
    VERB(scene)                                                                                    \
    HEADING(judge_and_compare)                                                                     \
    VERB(verify)                                                                                   \
    VERB(bench)                                                                                    \
    VERB(stress)                                                                                   \
    VERB(motion)                                                                                   \
    VERB(element_test)                                                                             \
    VERB(merge)                                                                                    \
    VERB(compare)                                                                                  \
    HEADING(exchange)                                                                              \
    VERB(export)                                                                                   \
    VERB(import)                                                                                   \
    VERB(schema)
#define VERB_DECLARED(name) extern const verb verb_##name;
#define NO_HEADING(name)
VERBS(NO_HEADING, VERB_DECLARED)

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
