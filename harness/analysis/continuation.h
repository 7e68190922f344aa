/* Equilibrium paths under proportional loads, through limit points. */
#ifndef BEAMWORK_CONTINUATION_H
#define BEAMWORK_CONTINUATION_H

#include "harness/newton/newton.h"

status continuation_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);

#endif
