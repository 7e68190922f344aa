/* What the solution of the linearised equations does to a state. */
#ifndef BEAMWORK_ADVANCE_H
#define BEAMWORK_ADVANCE_H

#include "harness/model/model.h"

/* After linearise_state and K dx = residual: strains, stresses, inner unknowns of every element and
 * then the frames take their increments. dx[free + driven]. Returns the largest correction,
 * dimensionless: translations by the size of the scene, rotations in rad, warping by the element
 * length, inner unknowns as the element says. */
double advance_state(model *, model_state *, const double dx[], double path);

#endif
