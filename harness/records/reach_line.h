/* What a table of convergence comes to: which formulation, with how many elements. */
#ifndef BEAMWORK_REACH_LINE_H
#define BEAMWORK_REACH_LINE_H

#include <stdio.h>

#include "harness/study/study.h"

#define REACH_LINE_LEVEL 0.01 /* where none is asked for */

/* "for 1 % in every quantity: collocation n = 1 (0.3 ms), sheet_third n = 2 (0.4 ms): within noise
 * of each other; beamw n = 8 (2 ms)": in the order of study.h, with the cost of their counted work;
 * behind it those that have a defect, those that are not within the level, and how far the ones
 * that pass are from truths of another model. "in 5 of 6 quantities (without a reference:
 * frequency_1)" where some have neither a truth nor an agreement; curves do not count. Of the first
 * point. One line. */
void reach_line_write(FILE *to, const sweep *s, const truths *t, double level);

#endif
