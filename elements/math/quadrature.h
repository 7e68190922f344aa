/* Gauss-Legendre quadrature: the one rule, by GSL's tables, which the first call prepares once in a
 * process. */
#ifndef BEAMWORK_QUADRATURE_H
#define BEAMWORK_QUADRATURE_H

enum { QUADRATURE_MAX_POINTS = 64 };

/* 1 to 20, 32 or 64 points: those whose digits are all right. */
int quadrature_is_tabulated(int n);

/* n points x[n] in ascending order and weights w[n] on [0, 1], exact for polynomials of degree 2n
 * - 1. */
void quadrature_points(int n, double x[], double w[]);

#endif
