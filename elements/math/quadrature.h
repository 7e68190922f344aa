/* Gauss-Legendre quadrature (GSL), plain and graded towards both ends for functions with boundary layers. */
#ifndef BEAMWORK_QUADRATURE_H
#define BEAMWORK_QUADRATURE_H

#include "elements/math/status.h"

enum { QUADRATURE_MAX_POINTS = 16, QUADRATURE_MAX_GRADED = 16 * 64 };

/* n <= 16 points on [0, 1]. FAULT when memory runs out. */
status quadrature_points(int n, double x[], double weight[], fault *f);
/* Panels of 16 points on [0, 1] whose widths double away from both ends, beginning with `layer`: exp(-x/layer) and
 * exp(-(1-x)/layer) are integrated to round-off. Returns the number of points through *n. */
status quadrature_graded(double layer, int *n, double x[QUADRATURE_MAX_GRADED], double weight[QUADRATURE_MAX_GRADED], fault *f);

#endif
