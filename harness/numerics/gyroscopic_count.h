/* How many frequencies lie below one: the negative eigenvalues of the Hermitian K - omega^2 M + i
 * omega G, K positive definite. */
#ifndef BEAMWORK_GYROSCOPIC_COUNT_H
#define BEAMWORK_GYROSCOPIC_COUNT_H

#include "harness/numerics/sparse.h"

/* SINGULAR when omega is too near to a frequency. */
status gyroscopic_count(const sparse *K, const sparse *M, const sparse *G, double omega, int *below,
                        fault *f);

#endif
