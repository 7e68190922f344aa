/* Formulations and processes of a call. */
#ifndef BEAMWORK_CONTESTANTS_H
#define BEAMWORK_CONTESTANTS_H

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

enum { CONTESTANTS_MOST = 64 };

/* Names between blanks; NULL: none is named, count 0. *named (may be NULL): 1 where none of them is
 * "all". */
status contestants_parse(const char *names, formulation list[CONTESTANTS_MOST], int *count,
                         int *named, fault *f);
int contestants_jobs(void); /* processes where nobody said how many */
/* TIME_LIMIT: who may end the run did so before all cells were done. */
status contestants_finished(const sweep *, fault *);

#endif
