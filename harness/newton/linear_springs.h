/* Springs about the undeformed state, as linear.h has it for elements: sigma[6 x springs] are the
 * last of its stresses. */
#ifndef BEAMWORK_MODEL_LINEAR_SPRINGS_H
#define BEAMWORK_MODEL_LINEAR_SPRINGS_H

#include "harness/model/model.h"

void linear_springs_stiffness(const model *, sparse *K); /* += */
void linear_springs_stresses(const model *, const double x[], double sigma[]);
void linear_springs_forces(const model *, const double sigma[], double f[]); /* += */
/* F[6] += on the frame of a node. */
void linear_springs_node_force(const model *, const double sigma[], int node, double F[6]);
void linear_springs_geometric_stiffness(const model *, const double sigma[], sparse *G); /* += */
double linear_springs_energy2(const model *, const double x[]);
double linear_springs_rounding(const model *, const double x[]);
double linear_springs_geometric_energy2(const model *, const double sigma[], const double x[]);

#endif
