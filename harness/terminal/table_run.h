/* What a whole run comes to, for people. */
#ifndef BEAMWORK_TABLE_RUN_H
#define BEAMWORK_TABLE_RUN_H

#include <stdio.h>

#include "harness/study/study.h"
#include "harness/terminal/screen.h"

/* Behind the long table: published values that limits contradict, cells without a solution, how
 * often limits hold what they promise. */
void table_run_details(FILE *to, const sweep *s, const judgement *j);
/* The counts. seconds: that the run took. */
void table_run(FILE *to, const sweep *s, const judgement *j, double seconds);
/* The last sentence, and nothing where there is none. */
void table_run_end(FILE *to, screen, const char *sentence);

#endif
