/* The integrator that a motion asks for. */
#ifndef BEAMWORK_INTEGRATOR_H
#define BEAMWORK_INTEGRATOR_H

#include "harness/time/scheme.h"

/* REFUSED: it cannot integrate this model, and why. */
status integrator_alloc(const scheme_request *, motion_scheme **, fault *);
void integrator_free(motion_scheme *);

#endif
