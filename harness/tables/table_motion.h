/* A motion in time in short: its steps, energies and momenta. */
#ifndef BEAMWORK_TABLE_MOTION_H
#define BEAMWORK_TABLE_MOTION_H

#include <stdio.h>

#include "harness/solver/result.h"

/* Nothing where nothing moves. */
void table_motion(FILE *to, const solve_result *);

#endif
