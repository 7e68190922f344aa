/* Natural frequencies about the undeformed state. */
#ifndef BEAMWORK_MODAL_H
#define BEAMWORK_MODAL_H

#include "harness/newton/newton.h"

status modal_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
/* How many modes the quantities of an analysis ask for. */
int modal_wanted(const analysis_context *, int analysis);

#endif
