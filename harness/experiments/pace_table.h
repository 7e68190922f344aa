/* Motions and what is said of them, for people. */
#ifndef BEAMWORK_PACE_TABLE_H
#define BEAMWORK_PACE_TABLE_H

#include <stdio.h>

#include "harness/experiments/pace_verdict.h"

/* runs: 1: a line for each of them too, not only verdicts. */
void pace_table(FILE *to, const pace *, const pace_verdicts *, int runs);

#endif
