/* How many digits a motion has that was found in a subspace.
 *
 * With w^H (lambda^2 M + lambda G + K) = 0 and a change d of K, lambda moves by w^H d x/(w^H
 * (2 lambda M + G) x), and lambda w^H (2 lambda M + G) x = w^H (lambda^2 M - K) x.  Of an
 * oscillation w is x, and what the vector misses counts as its square: r^H S^-1 r of the residual
 * r, by the distance of the frequencies it may belong to.  Where two frequencies meet that has no
 * bound, and the root of the change has. */
#ifndef BEAMWORK_ESTIMATE_H
#define BEAMWORK_ESTIMATE_H

#include "harness/numerics/gyroscopic.h"
#include "harness/numerics/ritz.h"

typedef struct motion_estimate {
    const gyroscopic_problem *p;
    const subspace *basis;   /* orthonormal in S = K + shift M, ... */
    matrix_factor *S_factor; /* ... which is factored as a matrix */
    const ritz *pairs;
    double shift;
    int found;    /* the pairs that are handed over: the first of them */
    double *work; /* [11 n] */
    long solutions;
} motion_estimate;

status estimate_alloc(int n, motion_estimate *, fault *);
void estimate_free(motion_estimate *);
/* Pair i, x = re + i im; grows: not an oscillation.  *lambda: of an oscillation better, the
 * quotient of quadratic forms k - omega^2 m + omega g = 0, whose error is the square of the
 * vector's; *error: an estimate, |lambda| is off by error |lambda|. */
void estimate_pair(motion_estimate *, int i, const double re[], const double im[], int grows,
                   double complex *lambda, double *error);
/* y = K x */
void estimate_stiffness(const gyroscopic_problem *, const double x[], double y[]);

#endif
