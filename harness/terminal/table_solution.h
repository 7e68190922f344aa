/* One cell for people: its quantities, matrices and load steps. */
#ifndef BEAMWORK_TABLE_SOLUTION_H
#define BEAMWORK_TABLE_SOLUTION_H

#include <stdio.h>

#include "harness/study/study.h"

void table_solution(FILE *to, const sweep *s, const truths *t);

#endif
