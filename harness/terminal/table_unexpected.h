/* What a run shows that nobody expected: together, in full, with commands that show it again. */
#ifndef BEAMWORK_TABLE_UNEXPECTED_H
#define BEAMWORK_TABLE_UNEXPECTED_H

#include <stdio.h>

#include "harness/study/study.h"
#include "harness/terminal/screen.h"

/* Nothing where all is as expected. */
/* Formulations that break the contract of the interface: before all else. */
void table_breaches(FILE *to, screen, const judgement *j);
void table_unexpected(FILE *to, screen, const sweep *s, const judgement *j, const truths *t);

#endif
