/* A motion in time in short: its steps, energies and momenta. */
#ifndef BEAMWORK_TABLE_MOTION_H
#define BEAMWORK_TABLE_MOTION_H

#include <stdio.h>

#include "harness/newton/newton.h"

/* Nothing where nothing moves. Of loads it tells those that jump where the motion begins. */
void table_motion(FILE *to, const scene *, const solve_result *);

#endif
