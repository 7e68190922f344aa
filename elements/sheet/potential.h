/* The Hellinger-Reissner potential of N section 3 as a polynomial in the local coordinates (N Eqs.
 * 44-50): P = P0 + b.s - 1/2 s^T A s at the stresses s = A^-1 b, s = (F~x, M~x, M~yp, M~yq, M~zp,
 * M~zq). */
#ifndef BEAMWORK_SHEET_POTENTIAL_H
#define BEAMWORK_SHEET_POTENTIAL_H

#include "elements/sheet/local.h"

enum { SHEET_STRESSES = 6 };

/* c v_a v_b in A_ij (i >= j, and in A_ji), in b_i or in P0; v_0 = 1, v_(1+k) = x_k, a <= b. */
typedef struct sheet_potential_term {
    double c;
    int i, j, a, b;
} sheet_potential_term;

enum { SHEET_TERMS_A = 96, SHEET_TERMS_B = 64, SHEET_TERMS_P0 = 12 };

typedef struct sheet_potential {
    int terms_A, terms_b, terms_P0;
    /* Terms are ordered by degree in x; where the linear and the quadratic ones begin. */
    int linear_A, quadratic_A, linear_b, quadratic_b, linear_P0, quadratic_P0;
    sheet_potential_term A[SHEET_TERMS_A], b[SHEET_TERMS_B], P0[SHEET_TERMS_P0];
} sheet_potential;

/* printed: u_y in M_x with the sign of N Eq. 49 as printed.  Refuses a section without torsional
 * stiffness. */
status sheet_coefficients_prepare(const element_request *request, int printed, sheet_potential *out,
                                  fault *f);

/* P[1], its gradient[8] and Hessian[8 x 8] at x; NULL: not wanted.  SINGULAR when A is not positive
 * definite there. */
status sheet_potential_evaluate(const sheet_potential *p, const double x[SHEET_LOCAL_COORDINATES],
                                double *P, double *gradient, double *hessian);

/* T[8 x 8] = derivative of the Hessian at x in the direction dx. */
status sheet_potential_third(const sheet_potential *p, const double x[SHEET_LOCAL_COORDINATES],
                             const double dx[SHEET_LOCAL_COORDINATES],
                             double T[SHEET_LOCAL_COORDINATES * SHEET_LOCAL_COORDINATES]);

#endif
