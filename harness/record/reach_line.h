/* What a table of convergence comes to: which formulation, with how many elements. */
#ifndef BEAMWORK_REACH_LINE_H
#define BEAMWORK_REACH_LINE_H

#include <stdio.h>

#include "harness/judge/reach.h"

#define REACH_LINE_LEVEL 0.01

/* "for 1 % in every quantity: collocation n = 1 (0.3 ms); sheet_third n = 2 (0.7 ms)": of each
 * formulation the least mesh from which on all are within 1 % of truth or agreement, soonest first;
 * then those that are not, and quantities that have neither. One line. */
void reach_line_write(FILE *to, const sweep *s, const truths *t);

#endif
