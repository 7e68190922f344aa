/* Every formulation at every extreme: a value with its error, or a named refusal or failure, and
 * never a silent wrong number. */
#ifndef BEAMWORK_EXTREME_RUN_H
#define BEAMWORK_EXTREME_RUN_H

#include "harness/experiments/experiment.h"
#include "harness/experiments/extreme_plan.h"

/* Asked by an extreme_request, finds an extreme_sweep: extreme_sweep_free. */
extern const experiment_type experiment_stress;

#endif
