/* The tangent of a state in two parts. */
#ifndef BEAMWORK_MODEL_STIFFNESS_PARTS_H
#define BEAMWORK_MODEL_STIFFNESS_PARTS_H

#include "harness/newton/run_state.h"

/* K x of the last linearisation in two parts. The stiff one goes through the element strains, y +=
 * sum J^T P'' (J x): as a sum of matrices it would lose all digits of the soft motions. x, y: [free
 * + driven]. The other is a matrix on the pattern of G: sum sigma_i H_i with the second derivatives
 * of offsets and sequences, less the loads' and the rotation's stiffness. */
void stiffness_parts_material_product(const model *, const linear_memory *, const model_state *,
                                      const double x[], double y[]);
/* What rounding may change in x^T of the stiff part. */
double stiffness_parts_material_rounding(const model *, const linear_memory *, const model_state *,
                                         const double x[]);
status stiffness_parts_geometric(const equations *, const linear_memory *, const model_state *,
                                 sparse *G, fault *);

#endif
