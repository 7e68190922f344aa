/* Whether a motion can be integrated as it was asked for. REFUSED: it cannot. */
#ifndef BEAMWORK_MOTION_CHECKS_H
#define BEAMWORK_MOTION_CHECKS_H

#include "harness/newton/newton.h"
#include "harness/time/carried.h"

/* The form of Newton has what the integrator needs; inertia and drivers can be written in time,
 * with the mass that is asked for. */
status checks_of(const analysis_context *, int analysis, fault *);
/* What has no inertia is found from balance body by body, and not beside masses that elements
 * spread. Without numerical damping accelerations of what has no inertia grow until they overflow.
 */
status checks_massless(const analysis_context *, const carried_masses *, const scene_motion *,
                       const model_state *begin, fault *);

#endif
