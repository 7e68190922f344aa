/* Small motions x exp(lambda t) in a frame that turns steadily: (lambda^2 M + lambda G + K) x = 0,
 * K and M symmetric, G skew.
 *
 * With K positive definite every lambda = i omega is imaginary, whatever G is (Kelvin, Tait):
 * projected on a real basis the problem is Hermitian, mu [x; y] = [-i G, R^T; R, 0] [x; y] with mu
 * = 1/omega, M = R^T R and K the identity.  The basis starts with the modes without G and takes in
 * K^-1 times the residuals; inertia counts the frequencies, so that none is missed. With K
 * indefinite, or nearly singular as at a critical speed, K + shift M takes its place in the basis
 * and the projected problem is solved as it is; lambda has a real part where a motion grows; what
 * the count proves then: gyroscopic_index.h.
 *
 * What has no mass has no frequency, and what has too little beside the rest (frequencies above
 * some 1e4 times those of the heavy parts) may end the search before all wanted modes are found.
 *
 * Assembling K loses the digits of soft motions.  The basis is orthonormal in K_product, which
 * keeps them, and so are all residuals; the factors of the matrix only improve vectors by them. */
#ifndef BEAMWORK_GYROSCOPIC_H
#define BEAMWORK_GYROSCOPIC_H

#include "harness/numerics/eigen.h"

typedef struct gyroscopic_problem {
    const sparse *K, *M, *G; /* same symmetric pattern; of G the upper triangle is stored */
    matrix_factor
        *K_factor; /* factor_numeric done; its numbers are replaced where K is indefinite */
    int wanted;    /* number of lowest modes */
    eigen_product
        *K_product; /* y = K x with fewer digits lost than by the matrix; NULL: there is none */
    eigen_form *K_rounding; /* what rounding may change in x^T K x of it; NULL: from the matrix */
    void *context;          /* of both */
} gyroscopic_problem;

typedef struct gyroscopic_result {
    int n, count;      /* fewer than wanted when no more exist */
    double *frequency; /* [count] lambda = growth + i frequency [1/s], ascending in size */
    double *growth;    /* [count] zero where K is positive definite */
    double *error;     /* [count] estimate: lambda is off by error |lambda| */
    double *mode;      /* [count x n] real part, the larger one, of the motion */
    int negative;      /* eigenvalues of K, and ... */
    int unproven;      /* ... those of them that no mode found accounts for: as many directions of
                          growing motions, or of frequencies of negative energy, were not found */
    long solutions, factorisations;
    double dense_operations; /* as in eigen.h */
} gyroscopic_result;

status gyroscopic_solve(const gyroscopic_problem *, gyroscopic_result *, fault *);
void gyroscopic_free(gyroscopic_result *);

#endif
