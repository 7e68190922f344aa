/* Results for people: tables on a terminal. */
#ifndef BEAMWORK_TABLE_H
#define BEAMWORK_TABLE_H

#include <stdio.h>

#include "harness/judge/judgement.h"

void table_solution(FILE *to, const sweep *s, const truths *t);
void table_convergence(FILE *to, const sweep *s, const truths *t);
void table_verdicts(FILE *to, const sweep *s, const judgement *j, const truths *t);

#endif
