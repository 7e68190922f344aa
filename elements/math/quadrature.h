/* Gauss-Legendre quadrature: points and weights of the GSL tables, copied into the caller's arrays. */
#ifndef BEAMWORK_QUADRATURE_H
#define BEAMWORK_QUADRATURE_H

#include "elements/shared/status.h"

enum { QUADRATURE_MAX_POINTS = 32 };

/* n points x[n] in ascending order and weights w[n] on [0, 1], exact for polynomials of degree 2n - 1.
 * FAULT when memory for GSL's table runs out. */
status quadrature_points(int n, double x[], double w[], fault *f);

#endif
