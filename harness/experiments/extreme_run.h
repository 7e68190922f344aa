/* Every formulation at every extreme: a value with its error, or a named refusal or failure, and
 * never a silent wrong number. */
#ifndef BEAMWORK_EXTREME_RUN_H
#define BEAMWORK_EXTREME_RUN_H

#include "harness/experiments/extreme_plan.h"

/* Reads the exact values and findings of the packed truths at `path`, runs and judges. */
status extreme_run(const extreme_request *request, const char *path, extreme_sweep *out, fault *f);

#endif
