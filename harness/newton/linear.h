/* About the undeformed state. */
#ifndef BEAMWORK_MODEL_LINEAR_H
#define BEAMWORK_MODEL_LINEAR_H

#include "harness/newton/run_state.h"

/* Linear analyses about the undeformed state. */
status linear_stiffness(const equations *, sparse *K, fault *); /* J^T S J at e = 0 */
status linear_stresses(const equations *, const double x[], double sigma[],
                       fault *); /* sigma = S J x, [model_stresses] */
/* Largest strain of a member that would leave no stress; 0: there is none. */
double linear_initial(const model *);
/* The same with what these strains add: of the structure as it is, not of a motion. */
status linear_whole_stresses(const equations *, const double x[], double sigma[], fault *);
void linear_forces(const equations *, const double sigma[],
                   double f[]); /* f[free + driven] = sum J^T sigma */
status linear_geometric_stiffness(const equations *, const double sigma[], double path, sparse *G,
                                  fault *); /* sum sigma H + J^T G(sigma) J; offsets included */
/* Quadratic forms from the element strains, free of the cancellation of x^T (K x): error eps n^2
 * instead of eps n^4. */
double linear_strain_energy2(const equations *, const double x[]); /* x^T K x = sum (Jx)^T S (Jx) */
double linear_strain_rounding(const equations *,
                              const double x[]); /* what rounding may change in it */
double linear_geometric_energy2(const equations *, const double sigma[], const double x[]);
/* Size of what rounding changes in it, with sigma the stresses of the displacements load_x[free +
 * driven]. */
double linear_geometric_rounding(const equations *, const double load_x[], const double sigma[],
                                 const double x[]);

#endif
