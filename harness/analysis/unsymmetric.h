/* Small motions x exp(s t) about a state whose stiffness is not symmetric: (s^2 M + s C + K) x = 0,
 * M symmetric and positive semidefinite, C of damping or absent.
 *
 * The least s are the largest 1/s^2 of -K^-1 M, or with C the largest 1/s of its companion with the
 * rates of what has a mass.  What has no mass is a zero of these and no motion. */
#ifndef BEAMWORK_UNSYMMETRIC_H
#define BEAMWORK_UNSYMMETRIC_H

#include "harness/numerics/numerics.h"

typedef struct unsymmetric_problem {
    const sparse *K, *M, *C; /* same pattern; C NULL: nothing is damped */
    matrix_factor *K_factor; /* factor_numeric done */
    int wanted;              /* least motions */
    int estimate;            /* 1: errors are wanted: twice the work */
} unsymmetric_problem;

/* s = growth + i frequency, ascending in size.  Without damping both motions of a flutter are
 * there, which have one frequency and opposite rates; of a divergence the growing one.  With
 * damping every motion that oscillates, and those that grow without. */
typedef struct unsymmetric_result {
    int n, count;
    double *frequency, *growth; /* [count] [rad/s], [1/s]; growth 0: below what rounding makes of a
                                   double value */
    double *split; /* [count] imaginary part of s^2 in parts of its size; 1: divergence */
    double *error; /* [count] estimate of what rounding changes, in parts of |s| */
    double *mode;  /* [count x n] real */
    long solutions;
} unsymmetric_result;

/* Below this part the imaginary part of s^2 is rounding of a double value. */
static const double unsymmetric_same = 1e-6;

status unsymmetric_solve(const unsymmetric_problem *, unsymmetric_result *, fault *);
void unsymmetric_free(unsymmetric_result *);

#endif
