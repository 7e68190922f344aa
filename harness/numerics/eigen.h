/* A few eigenpairs of A x = mu K x with K symmetric positive definite and A symmetric, however
 * indefinite or singular.
 *
 * Buckling: A = -G, mu = 1/lambda.  Vibration: A = M, mu = 1/omega^2 (a structure that is not held:
 * K + shift M in place of K). Small problems are solved densely (LAPACK), the others by Lanczos in
 * the inner product of K (ARPACK).  Each mu is the quotient of two quadratic forms, which the
 * caller can evaluate better than from the matrices, and the inertia of K - A/s proves that no
 * eigenvalue was missed, repeated ones included. */
#ifndef BEAMWORK_EIGEN_H
#define BEAMWORK_EIGEN_H

#include "harness/numerics/sparse.h"

/* Error of a value, in parts of itself, beyond which no digit is worth telling. */
#define EIGEN_LARGEST_ERROR 1e-2

typedef double eigen_form(void *context, const double x[]);
typedef void eigen_product(void *context, const double x[], double y[]);

typedef struct eigen_problem {
    const sparse *K, *A;     /* same pattern */
    matrix_factor *K_factor; /* factor_numeric done */
    double sign;             /* +1: A, -1: -A is meant */
    int largest;             /* wanted number of most positive mu */
    int smallest;            /* wanted number of most negative mu */
    eigen_form *K_energy,
        *A_energy; /* x^T K x and x^T A x (A without the sign), [K's unit]; NULL: from the matrix */
    eigen_form *K_rounding,
        *A_rounding; /* what rounding may change in them; NULL: nothing worth asking */
    eigen_product
        *K_product; /* y = K x with fewer digits lost than by the matrix; NULL: there is none */
    void *context;  /* of all of them */
    int iterate;    /* 1: Lanczos whatever the size (for tests) */
} eigen_problem;

typedef struct eigen_side {
    int count;        /* found; fewer than wanted when no more exist, or for the reason below */
    double *mu;       /* [count] largest size first */
    double *mode;     /* [count x n] x^T K x = 1 */
    double *residual; /* [count] an eigenvalue lies within residual |mu| of mu */
    double *error; /* [count] estimate: |mu| is off by error |mu|, which is at most about residual^2
                      |mu| */
    int rounding;  /* candidates that were round-off of A and are left out */
    status status; /* NOT_CONVERGED: the iteration ended before all wanted ones were proved to be
                      there ... */
    char reason[FAULT_TEXT]; /* ... and why; those found are the first of their side all the same */
} eigen_side;

typedef struct eigen_result {
    int n;
    eigen_side positive, negative;
    long solutions, factorisations;
    double dense_operations; /* n^3 of what was solved densely */
} eigen_result;

/* REFUSED when K is not positive definite; NOT_CONVERGED when one of the sides is: what either side
 * found stays. Values that are a rounding error of the largest one or of their own form, or in
 * large problems 1e-9 of the largest, are taken for zero and not returned. The error of a value
 * tells how many digits it has; without one it is not returned. */
status eigen_solve(const eigen_problem *problem, eigen_result *out, fault *f);
void eigen_free(eigen_result *r);

#endif
