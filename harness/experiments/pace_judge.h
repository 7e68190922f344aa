/* Runs all motions and measures them. */
#ifndef BEAMWORK_PACE_JUDGE_H
#define BEAMWORK_PACE_JUDGE_H

#include "harness/experiments/pace.h"

/* After pace_plan. A motion that fails is a result. */
status pace_judge(pace *, const sweep_request *, fault *);

#endif
