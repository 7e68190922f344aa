/* What may stand where the cursor is on a command line, from the tables of the program. */
#ifndef BEAMWORK_COMPLETION_H
#define BEAMWORK_COMPLETION_H

#include "harness/cli/help.h"

/* The words behind the verb up to the cursor; the last one, which may be empty, is begun. */
typedef struct completion_line {
    int count;
    char *const *word;
} completion_line;

/* Of a verb, a help_writer; context: completion_line with a word at least. Lines as of
 * harness/cli/offer.h. */
help_writer completion_write;

#endif
