/* Gauss-Legendre quadrature: the one rule. */
#ifndef BEAMWORK_QUADRATURE_H
#define BEAMWORK_QUADRATURE_H

enum { QUADRATURE_MAX_POINTS = 32 };

/* n points x[n] in ascending order and weights w[n] on [0, 1], exact for polynomials of degree 2n
 * - 1. */
void quadrature_points(int n, double x[], double w[]);

#endif
