/* The pages of the manual, from the tables that the program itself works with. */
#ifndef BEAMWORK_MANUAL_H
#define BEAMWORK_MANUAL_H

#include "harness/cli/help.h"

/* A line of the program's help; text NULL: name is a heading. */
typedef struct manual_row {
    const char *name, *text;
} manual_row;

/* What the program says of itself. Rows end with a name of NULL. */
typedef struct manual_program {
    const char *summary, *question; /* one line each */
    const manual_row *verbs, *examples, *statuses;
    const char *of_compare; /* exit status of the verb that is as diff */
} manual_program;

/* beamwork(1). */
void manual_write_program(FILE *to, const manual_program *p);
/* beamwork-VERB(1), a help_writer; context: the verb's manual_row. */
help_writer manual_write_verb;
/* beamwork-scene-file(5): what may stand in a scene file. */
void manual_write_scene(FILE *to);
/* beamwork-results(5): what a result file consists of. */
void manual_write_results(FILE *to);

#endif
