/* Stationary rotation and small motions about it. */
#ifndef BEAMWORK_ROTATION_H
#define BEAMWORK_ROTATION_H

#include "harness/solver/context.h"

status rotation_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);

#endif
