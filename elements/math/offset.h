/* From a point to the one that moves it rigidly.  Offset rho: dr = dr_b + theta x rho.  Second
 * derivatives in the exponential chart: d2(F . rho)/dtheta2 = sym(F rho^T) - (F . rho) I. */
#ifndef BEAMWORK_MATH_OFFSET_H
#define BEAMWORK_MATH_OFFSET_H

/* force[6: force, moment] of the point becomes that of the body. */
void offset_force(const double rho[3], double force[6]);
/* K[n x n] of coordinates of which the point's begin at `at`: K <- A^T K A, and the second
 * derivatives of the potential's gradient `force` on the point; NULL: without these. */
void offset_matrix(int n, int at, const double rho[3], const double force[3], double K[]);

#endif
