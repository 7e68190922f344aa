/* A few eigenpairs of A x = mu K x with K symmetric positive definite and A symmetric: LAPACK for small problems, ARPACK with
 * the factors of K beyond.  Buckling: A = -G, mu = 1/lambda.  Vibration: A = M, mu = 1/omega^2. */
#ifndef BEAMWORK_EIGEN_H
#define BEAMWORK_EIGEN_H

#include "harness/model/sparse.h"

typedef struct eigen_problem {
    const sparse *K, *A; /* same pattern */
    factor *K_factor;    /* factor_numeric done */
    double sign;         /* +1: A, -1: -A is meant */
    int largest;         /* wanted number of most positive mu */
    int smallest;        /* wanted number of most negative mu */
} eigen_problem;

typedef struct eigen_result {
    int n, positive, negative;             /* found: mu > 0 and mu < 0; fewer than wanted when no more exist */
    double *mu_positive, *mu_negative;     /* largest first; most negative first */
    double *mode_positive, *mode_negative; /* [count x n], x^T K x = 1 */
    long solutions;
} eigen_result;

/* NOT_CONVERGED when the iteration ends early. Values whose size is a rounding error of the largest are not returned. */
status eigen_solve(const eigen_problem *problem, eigen_result *out, fault *f);
void eigen_free(eigen_result *r);

#endif
