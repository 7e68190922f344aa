/* Times of a benchmark for people: error against run time, and the cheapest way to an error. */
#ifndef BEAMWORK_TABLE_TIMING_H
#define BEAMWORK_TABLE_TIMING_H

#include <stdio.h>

#include "harness/study/study.h"

/* every_mesh: 1: a row for each mesh and the cheapest way for every quantity; 0: defaults and their
 * first quantity only. */
void table_timing(FILE *to, const sweep *s, const judgement *j, int every_mesh);

#endif
