/* What a motion makes of energy and momenta. */
#ifndef BEAMWORK_PACE_DRIFT_H
#define BEAMWORK_PACE_DRIFT_H

#include "harness/experiments/pace.h"

/* Drifts, E/E0 and the fate of a run that is done. */
void pace_drift(const pace *, pace_run *);

#endif
