/* Pi, the larger of two numbers, and the one quadrature. */
#ifndef BEAMWORK_MATH_SCALAR_H
#define BEAMWORK_MATH_SCALAR_H

#include <math.h>

#define PI 3.14159265358979323846

/* The larger of two numbers: NAN where one of them is, which fmax passes over. */
static inline double larger(double a, double b)
{
    return a >= b || isnan(a) ? a : b;
}

/* Gauss-Legendre quadrature: the one rule, by GSL's tables, which the first call prepares once in a
 * process. */

enum { QUADRATURE_MAX_POINTS = 64 };

/* 1 to 20, 32 or 64 points: those whose digits are all right. */
int quadrature_is_tabulated(int n);

/* n points x[n] in ascending order and weights w[n] on [0, 1], exact for polynomials of degree 2n
 * - 1. */
void quadrature_points(int n, double x[], double w[]);

#endif
