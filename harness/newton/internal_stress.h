/* Stresses in members: of the points of a section, from its resultants. */
#ifndef BEAMWORK_MODEL_INTERNAL_STRESS_H
#define BEAMWORK_MODEL_INTERNAL_STRESS_H

#include "elements/section/stress.h"
#include "harness/newton/internal.h"
#include "harness/newton/run_state.h"

/* At a place of a member, 0 from .. 1 to [Pa].  REFUSED: given constants, which have no points;
 * else as internal_at. */
status internal_stress_at(const equations *, const internal_state *, const internal_place *,
                          stress_measure, double *out, fault *);
/* Of all its sections. */
status internal_stress_largest(const equations *, const internal_state *, int member,
                               stress_measure, double *out, fault *);

#endif
