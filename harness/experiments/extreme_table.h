/* Outcomes of a sweep of extremes for people, and one line each for programs. */
#ifndef BEAMWORK_EXTREME_TABLE_H
#define BEAMWORK_EXTREME_TABLE_H

#include <stdio.h>

#include "harness/experiments/extreme_sweep.h"

void extreme_table(FILE *to, const extreme_sweep *s);
void extreme_table_csv(FILE *to, const extreme_sweep *s);

#endif
