/* What the solution of the linearised equations does to a state. */
#ifndef BEAMWORK_ADVANCE_H
#define BEAMWORK_ADVANCE_H

#include "harness/newton/run_state.h"

/* Of all elements [N]. */
typedef struct advance_stress {
    double largest, change; /* after it; by it */
} advance_stress;

/* After linearise_state with that memory and K dx = residual: strains, stresses, inner unknowns of
 * every element and then the frames take their increments. dx[free + driven]. Returns the largest
 * correction, dimensionless: translations by the size of the scene, rotations in rad, warping by
 * the element length, inner unknowns as the element says. stress: NULL where nobody asks. */
double advance_state(const equations *, const linear_memory *, model_state *, const double dx[],
                     double path, advance_stress *);
/* The state is in equilibrium: the next increments start from it with the tangent of the last
 * linearisation, and nothing that this had left open is closed again. */
void advance_settle(const model *, const linear_memory *, const model_state *);

#endif
