/* Motion in time: states at the instants that were asked for. */
#ifndef BEAMWORK_MOTION_H
#define BEAMWORK_MOTION_H

#include "harness/newton/newton.h"

status motion_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);

#endif
