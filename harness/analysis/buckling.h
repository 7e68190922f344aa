/* Linear buckling about the undeformed state. */
#ifndef BEAMWORK_BUCKLING_H
#define BEAMWORK_BUCKLING_H

#include "harness/newton/newton.h"

status buckling_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);

#endif
