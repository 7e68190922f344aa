/* Proof that no eigenvalue is missing among candidates. */
#ifndef BEAMWORK_CANDIDATES_COUNT_H
#define BEAMWORK_CANDIDATES_COUNT_H

#include "harness/numerics/candidates.h"

/* How many of the eigenvalues that lie clearly above the one of rank `wanted` (counted from 1) are
 * not among the candidates. NOT_CONVERGED when there are fewer than candidates. */
status candidates_count_missing(candidates *p, int wanted, int *missing, eigen_result *work,
                                fault *f);
/* Frees what counting keeps, where it is large: the next count allocates it again. */
void candidates_count_rest(candidates *p);
/* How many eigenvalues are larger than s > 0. */
status candidates_count_above(candidates *p, double s, int *above, eigen_result *work, fault *f);

#endif
