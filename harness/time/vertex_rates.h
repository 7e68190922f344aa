/* Velocity and acceleration of frames. */
#ifndef BEAMWORK_VERTEX_RATES_H
#define BEAMWORK_VERTEX_RATES_H

#include "harness/time/forms.h"

/* Of a node's frame or of a released end: forms_rates. */
void inertia_rates(const model *, const model_state *, int vertex, const double v[],
                   const double a[], frame_rates *);
/* Of any. */
void vertex_rates(const model *, const model_state *, int vertex, const double v[],
                  const double a[], frame_rates *);

#endif
