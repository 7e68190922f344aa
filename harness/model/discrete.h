/* Discrete elements, beside those of the members: rigid bodies at nodes, and springs.  None: no
 * work. */
#ifndef BEAMWORK_MODEL_DISCRETE_H
#define BEAMWORK_MODEL_DISCRETE_H

#include "harness/model/mesh.h"

status discrete_build(model *, fault *);
/* Internal less centrifugal force (of the frame in that state) [7 nodes] and its tangent [7 nodes x
 * 7 nodes] in a state, in model coordinates. */
void discrete_equations(const model *, const model_state *, const mesh_discrete *,
                        const element_rotating_frame *, double force[], double K[]);
/* M, G += theirs (rotating_frame_inertia); G NULL: not wanted. */
void discrete_inertia(const model *, const model_state *, const element_rotating_frame *, sparse *M,
                      sparse *G);
/* The tangent in two parts, as in stiffness_parts.h: y += its product with x[free + driven], out +=
 * the other. */
void discrete_material_product(const model *, const model_state *, const double x[], double y[]);
void discrete_geometric(const model *, const model_state *, const element_rotating_frame *,
                        sparse *out);
/* What rounding may change in x^T of the first. */
double discrete_material_rounding(const model *, const model_state *, const double x[]);
/* Energy of all springs [J]. */
double discrete_stored(const model *, const model_state *);
/* F += what the structure needs on a node's frame to hold them in the state [6: N, N m]. */
void discrete_node_force(const model *, const model_state *, const element_rotating_frame *,
                         int node, double F[6]);

#endif
