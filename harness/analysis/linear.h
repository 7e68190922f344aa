/* Linear statics about the undeformed state. */
#ifndef BEAMWORK_LINEAR_H
#define BEAMWORK_LINEAR_H

#include "harness/newton/newton.h"

status linear_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);

#endif
