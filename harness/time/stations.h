/* What a motion leaves of the instants that were asked for, wherever its steps end: places and
 * rates are those of the polynomial inside the step, and where forces or energies are read a step
 * of its own leads to the instant, which the motion does not go on from. */
#ifndef BEAMWORK_STATIONS_H
#define BEAMWORK_STATIONS_H

#include "harness/time/between.h"
#include "harness/time/scheme.h"

typedef struct stations {
    analysis_context *c;
    int analysis;
    const carried_masses *masses;
    motion_scheme *scheme;
    outcome_motion *out;
    step_between inside;
    instant at;
} stations;

/* c, analysis, masses, scheme and out are given. */
status stations_alloc(stations *, fault *);
void stations_free(stations *);
/* Those inside a step, the end excepted. */
status stations_inside(stations *, const instant *from, const instant *to, fault *);
/* The one where the motion is now, if there is one. */
status stations_here(stations *, const instant *now, const double balance[SCENE_BALANCES], fault *);

#endif
