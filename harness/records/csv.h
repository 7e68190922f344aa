/* Results for spreadsheets: one row per value, full precision, empty where there is none. */
#ifndef BEAMWORK_CSV_H
#define BEAMWORK_CSV_H

#include <stdio.h>

#include "harness/study/study.h"

void csv_solution(FILE *to, const sweep *s);
void csv_convergence(FILE *to, const sweep *s, const truths *t);
/* Of a benchmark: a row for every cell and judged quantity. */
void csv_timing(FILE *to, const sweep *s, const judgement *j);

#endif
