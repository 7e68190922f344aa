/* Small motions and stability about a loaded, deformed state: the last one of the static path that
 * an analysis follows. */
#ifndef BEAMWORK_LOADED_H
#define BEAMWORK_LOADED_H

#include "harness/newton/newton.h"

/* Natural frequencies: M x = (1/omega^2) K x with tangent K and mass M of the deformed state. */
status loaded_modal(analysis_context *c, int analysis, analysis_outcome *o, fault *f);
/* The value of the path parameter, beyond the end of the static path, at which the tangent of the
 * nonlinear path first becomes singular (a bifurcation; loads and drivers go on as they are along
 * the path). */
status loaded_buckling(analysis_context *c, int analysis, analysis_outcome *o, fault *f);

#endif
