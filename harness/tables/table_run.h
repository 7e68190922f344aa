/* What a whole run comes to, for people: what contradicts itself or the truths, what failed, what
 * was not met, and the counts. */
#ifndef BEAMWORK_TABLE_RUN_H
#define BEAMWORK_TABLE_RUN_H

#include <stdio.h>

#include "harness/judge/judgement.h"

void table_run(FILE *to, const sweep *s, const judgement *j, const truths *t);

#endif
