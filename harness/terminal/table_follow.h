/* Modes followed over a parameter. */
#ifndef BEAMWORK_TABLE_FOLLOW_H
#define BEAMWORK_TABLE_FOLLOW_H

#include <stdio.h>

#include "harness/study/study.h"

/* A line for each value that was asked for, a column for each mode [Hz]; crossings and veerings. */
void table_follow(FILE *to, const char *parameter, const follow_curves *);

#endif
