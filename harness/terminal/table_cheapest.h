/* The cheapest way to an error, by counted work, with the times of a benchmark. */
#ifndef BEAMWORK_TABLE_CHEAPEST_H
#define BEAMWORK_TABLE_CHEAPEST_H

#include <stdio.h>

#include "harness/study/study.h"

/* What is cheapest for the quantities of a point (`every`), or for the first with a truth; 0: none
 * has. list[series]: room. */
int table_cheapest(FILE *to, const sweep *, const judgement *, int point, int every,
                   reached list[]);

#endif
