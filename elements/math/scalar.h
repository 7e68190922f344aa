#ifndef BEAMWORK_MATH_SCALAR_H
#define BEAMWORK_MATH_SCALAR_H

#include <math.h>

#define PI 3.14159265358979323846

/* Returns the larger of two numbers. Unlike fmax, returns NAN if either number is NAN. */
static inline double larger(double a, double b)
{
    return a >= b || isnan(a) ? a : b;
}

enum { QUADRATURE_MAX_POINTS = 64 };

/* Returns 1 for n from 1 to 20, 32 and 64, for which the tables are accurate to all digits, and
 * otherwise 0. */
int quadrature_is_tabulated(int n);

/* Computes n points x[n] in ascending order and weights w[n] on [0, 1]; n must be tabulated. All
 * are NaN if there is no memory for the table. The quadrature is exact for polynomials of degree 2n
 * - 1. */
void quadrature_points(int n, double x[], double w[]);

/* Computes the Lagrange polynomials L[n] on the points p[n] and their derivatives dL[n] at x. All
 * values are dimensionless. dL may be NULL. */
void lagrange_at(int n, const double p[], double x, double L[], double dL[]);

#endif
