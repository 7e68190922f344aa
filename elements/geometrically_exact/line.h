/* Polynomials on the unit interval: Lagrange's basis.  All dimensionless. */
#ifndef BEAMWORK_EXACT_LINE_H
#define BEAMWORK_EXACT_LINE_H

/* L[n], dL[n] (NULL: not wanted): Lagrange polynomials on the points p[n] and their derivatives at
 * x. */
void exact_line_lagrange(int n, const double p[], double x, double L[], double dL[]);

#endif
