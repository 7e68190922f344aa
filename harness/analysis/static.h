/* Nonlinear equilibrium along a path. */
#ifndef BEAMWORK_STATIC_H
#define BEAMWORK_STATIC_H

#include "harness/newton/newton.h"

status static_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
/* From the present path to `target` in steps that halve when Newton fails and double when it is
 * easy; *increment: the first one, then the next. */
status static_walk(newton_run *, double target, double *increment, fault *);

#endif
