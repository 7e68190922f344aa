/* What counts instead of negative pivots where a tangent K is not symmetric: the eigenvalues next
 * to zero of D^-1 K, D the metric, and which of them lie left of the imaginary axis.  That number
 * changes where one passes zero, which is a critical point, and where a pair passes the axis beside
 * zero, which is none; pairs that meet on the axis do not change it, nor does rounding that makes a
 * pair of a double value.  A symmetric K has as many of them as negative pivots. */
#ifndef BEAMWORK_LEFT_H
#define BEAMWORK_LEFT_H

#include <complex.h>

#include "harness/numerics/numerics.h"

enum { LEFT_NEAREST = 6 };

typedef struct left_of_axis {
    int count; /* -1: not known */
    int nearest;
    double complex mu[LEFT_NEAREST]; /* [nearest] next to zero, least size first */
    long solutions;
} left_of_axis;

/* K factored, [n]; weight [n] of the metric. */
status left_count(matrix_factor *K, int n, const double weight[], left_of_axis *, fault *);

#endif
