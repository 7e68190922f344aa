/* Where something has no inertia, what belongs to places and rates at one instant. */
#ifndef BEAMWORK_SETTLE_H
#define BEAMWORK_SETTLE_H

#include "harness/time/instant.h"
#include "harness/time/stage.h"

/* What has no inertia comes into balance with what acts from now on and with the rates of the rest,
 * whose gyroscopic moments it takes; then accelerations follow, 0 of what has none. What damping
 * holds where it is for longer than a part of the step h [s] stays there and takes the rates that
 * make the balance. zero[free + driven]. NOT_CONVERGED: there is no such balance. */
status settle(motion_stage *, const double zero[], double h, instant *now, fault *);

#endif
