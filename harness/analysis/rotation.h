/* Stationary rotation and small motions about it. */
#ifndef BEAMWORK_ROTATION_H
#define BEAMWORK_ROTATION_H

#include "harness/newton/newton.h"

status rotation_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
/* What the modes found say of the stability of the stations, when the steps have been judged. */
void rotation_judge_stations(analysis_context *, int analysis, const analysis_outcome *);

#endif
