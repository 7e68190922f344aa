/* Compliance and stiffness of a node in a deformed state. */
#ifndef BEAMWORK_COMPLIANCE_H
#define BEAMWORK_COMPLIANCE_H

#include "harness/newton/newton.h"

status compliance_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
/* The analysis at a state that Newton has just reached, from his last tangent where that stands. */
status compliance_take(analysis_context *, int analysis, const newton_run *, node_tangent *,
                       station_matrices *out, fault *);

#endif
