/* Coefficients of the Hellinger-Reissner potential as polynomials in the local coordinates (N Eqs. 44-50). */
#ifndef BEAMWORK_SHEET_POTENTIAL_H
#define BEAMWORK_SHEET_POTENTIAL_H

#include "elements/sheet/relations.h"

/* Stress variables F~x, M~x, M~yp, M~yq, M~zp, M~zq; affine variables 1, px, zp, zq, Wp, Wq. */
enum { STRESSES = 6, AFFINE = 6, QUARTIC = 35 };

typedef struct potential {
    double A[STRESSES][STRESSES][AFFINE][AFFINE]; /* A_ij = sum y_a y_b A[i][j][a][b]/2, symmetric in both pairs */
    double b[STRESSES][LOCALS][LOCALS];           /* quadratic part: x^T b_i x/2 */
    double b_linear[STRESSES][LOCALS];
    double P0[LOCALS][LOCALS]; /* x^T P0 x/2 */
    double wagner[5][3];       /* weight c L and phi_x' (px, Wp, Wq) at five points: sum w (phi_x')^4 */
    double wagner_weight[5];
} potential;

/* Local coordinate of an affine variable (0: the constant). */
extern const int potential_local[AFFINE];

status potential_prepare(const element_request *request, int printed, potential *out, fault *f);

/* P(x) after eliminating the stress variables, its gradient [8] and Hessian [8 x 8]. SINGULAR when A is not positive definite. */
status potential_evaluate(const potential *p, const double x[LOCALS], double *P, double gradient[LOCALS],
                          double hessian[LOCALS * LOCALS]);

#endif
