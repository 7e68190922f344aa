/* Discrete elements, beside those of the members: rigid bodies at nodes.  None: no work. */
#ifndef BEAMWORK_MODEL_DISCRETE_H
#define BEAMWORK_MODEL_DISCRETE_H

#include "harness/model/model_impl.h"

status discrete_build(model *, fault *);
/* Internal less centrifugal force [7 nodes] and its tangent [7 nodes x 7 nodes] in a state, in
 * model coordinates. */
void discrete_equations(const model *, const model_state *, const mesh_discrete *, double path,
                        double force[], double K[]);
/* M, G += theirs (rotating_frame_inertia); G NULL: not wanted. */
void discrete_inertia(const model *, const model_state *, double path, sparse *M, sparse *G);
/* out += the tangent of all; x^T of it x, x[free + driven]. */
void discrete_stiffness(const model *, const model_state *, double path, sparse *out);
double discrete_energy2(const model *, const model_state *, double path, const double x[]);
/* F += what the structure needs on a node's frame to hold them in the state [6: N, N m]. */
void discrete_node_force(const model *, const model_state *, int node, double F[6]);

#endif
