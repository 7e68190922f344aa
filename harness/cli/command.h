/* A command line as a verb reads and answers it; exit codes. */
#ifndef BEAMWORK_COMMAND_H
#define BEAMWORK_COMMAND_H

#include <stdio.h>

#include "harness/cli/options.h"

enum {
    EXIT_AS_EXPECTED = 0,
    EXIT_DIFFERS = 1,
    EXIT_REFUSED = 2,
    EXIT_NOTHING = 3,
    EXIT_FAULT = 4,
    EXIT_INTERRUPTED = 5 /* or parts are missing */
};

/* request: of verb->request bytes. Errors are printed and end the program with EXIT_REFUSED. */
void command_parse(const verb *, const verb *const *verbs, int count, char **arguments,
                   command_line *line, void *request);
/* Reads, answers; the exit code. arguments[0]: the verb. */
int command_run(const verb *, const verb *const *verbs, int count, char **arguments);

/* What a verb says of itself: usage, what it does, options, examples, within PARAGRAPH_WIDTH
 * columns. */
void help_write(FILE *to, const verb *v);

#endif
