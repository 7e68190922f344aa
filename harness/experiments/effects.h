/* Of a feature that is offered something depends. */
#ifndef BEAMWORK_EFFECTS_H
#define BEAMWORK_EFFECTS_H

#include "harness/experiments/claims.h"
#include "harness/experiments/specimen.h"

/* Each feature of the section that it offers changes what some element of it says, against the
 * same element without that feature; with warping, the amplitudes do. */
void effects_check(const formulation *chosen, claims *c);

#endif
