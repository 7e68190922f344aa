/* Polynomials on the unit interval: Gauss points and Lagrange's basis.  All dimensionless. */
#ifndef BEAMWORK_EXACT_LINE_H
#define BEAMWORK_EXACT_LINE_H

/* Gauss-Legendre points and weights on [0, 1], ascending; exact to degree 2 n - 1. */
void exact_line_gauss(int n, double x[], double w[]);

/* L[n], dL[n] (NULL: not wanted): Lagrange polynomials on the points p[n] and their derivatives at x. */
void exact_line_lagrange(int n, const double p[], double x, double L[], double dL[]);

#endif
