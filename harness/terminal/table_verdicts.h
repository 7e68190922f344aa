/* The verdicts of a run for people, a block for each point. */
#ifndef BEAMWORK_TABLE_VERDICTS_H
#define BEAMWORK_TABLE_VERDICTS_H

#include <stdio.h>

#include "harness/study/study.h"

void table_verdicts(FILE *to, const sweep *s, const judgement *j);

#endif
