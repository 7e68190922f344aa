/* What a run shows that nobody expected: together, in full, with commands that show it again. */
#ifndef BEAMWORK_TABLE_UNEXPECTED_H
#define BEAMWORK_TABLE_UNEXPECTED_H

#include <stdio.h>

#include "harness/judge/judgement.h"
#include "harness/tables/screen.h"

/* Nothing where all is as expected. */
void table_unexpected(FILE *to, screen, const sweep *s, const judgement *j, const truths *t);

#endif
