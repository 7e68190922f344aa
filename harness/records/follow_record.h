/* Modes followed over a parameter, for programs. */
#ifndef BEAMWORK_FOLLOW_RECORD_H
#define BEAMWORK_FOLLOW_RECORD_H

#include <stdio.h>

#include "harness/study/study.h"

/* A row for each value and mode. */
void follow_record_csv(FILE *to, const char *parameter, const follow_curves *);
/* Columns of each mode, crossings and veerings. */
status follow_record_json(FILE *to, const char *parameter, const follow_curves *, fault *);

#endif
