/* Outcomes of a sweep of extremes for people. */
#ifndef BEAMWORK_EXTREME_TABLE_H
#define BEAMWORK_EXTREME_TABLE_H

#include <stdio.h>

#include "harness/experiments/extreme_sweep.h"

void extreme_table(FILE *to, const void *found); /* extreme_sweep */

#endif
