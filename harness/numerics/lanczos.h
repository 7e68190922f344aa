/* Implicitly restarted Lanczos (ARPACK) for the algebraically largest eigenvalues of s A x = mu K
 * x. */
#ifndef BEAMWORK_LANCZOS_H
#define BEAMWORK_LANCZOS_H

#include "harness/numerics/sparse.h"

typedef struct lanczos_problem {
    const sparse *K, *A;
    matrix_factor *K_factor;
    double sign;      /* s */
    int known;        /* eigenvectors that are taken out of the problem ... */
    const double *X;  /* ... [known x n], K-orthonormal */
    const double *KX; /* [known x n] K times each */
} lanczos_problem;

/* `wanted` <= n - known - 1 eigenvalues mu[wanted] in descending order with K-orthonormal vectors
 * (*x)[wanted x n], which the caller frees; `found` of them, at least one, where the iteration
 * ended before the others had converged. */
status lanczos_largest(const lanczos_problem *p, int wanted, int *found, double mu[], double **x,
                       long *solutions, fault *f);

#endif
