/* Compliance and stiffness of a node in a deformed state. */
#ifndef BEAMWORK_COMPLIANCE_H
#define BEAMWORK_COMPLIANCE_H

#include "harness/solver/context.h"

status compliance_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);

#endif
