/* Resultants of the stresses on a section at an end of a member.
 *
 * They are what the element's nodal forces J^T sigma leave when the loads along the element that its node takes are
 * taken off: in equilibrium with everything beyond, whatever a formulation assumes inside. */
#ifndef BEAMWORK_MODEL_INTERNAL_H
#define BEAMWORK_MODEL_INTERNAL_H

#include "harness/model/model.h"

/* Of what lies towards `to` on what lies towards `from`, in the principal axes of the turned section, moments about its
 * centroid: N, Qy, Qz [N], Mx, My, Mz [N m], bimoment [N m^2] (work: that of the warping amplitude's rate). sigma
 * [elements x strains]: stresses; NULL: those of the state. at: path parameter of the loads. end: 0 from, 1 to. */
void internal_at_end(model *, const model_state *, const double sigma[], double at, int member,
                     int end, double out[7]);

#endif
