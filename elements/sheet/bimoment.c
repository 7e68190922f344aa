#include "elements/sheet/bimoment.h"

#include <math.h>

enum { TERMS = 24, DEGREE = 2 * TERMS + 6 };
static const double series_below = 1.0; /* the closed form cancels like lambda^-4, the series converges like (lambda/pi)^2 */

/* cosh(lambda y)/sinh(lambda) for 0 <= y <= 1, without overflow. */
static double cosh_ratio(double lambda, double y)
{
    if (lambda < 1)
        return cosh(lambda * y) / sinh(lambda);
    return (exp(-lambda * (1 - y)) + exp(-lambda * (1 + y))) / -expm1(-2 * lambda);
}

static double sinh_ratio(double lambda, double y)
{
    if (lambda < 1)
        return sinh(lambda * y) / sinh(lambda);
    return (exp(-lambda * (1 - y)) - exp(-lambda * (1 + y))) / -expm1(-2 * lambda);
}

void bimoment_functions(double lambda, double x, bimoment_values *out)
{
    out->c1 = cosh_ratio(lambda, x);
    out->c2 = cosh_ratio(lambda, 1 - x);
    out->dc1 = lambda * sinh_ratio(lambda, x);
    out->dc2 = -lambda * sinh_ratio(lambda, 1 - x);
    /* sinh(a - 2 a x)/cosh(a), a = lambda/2 */
    const double a = lambda / 2, y = 1 - 2 * x, edge = exp(-a * (1 - fabs(y))), far = exp(-a * (1 + fabs(y))),
                 both = 1 + exp(-2 * a);
    const double sine = lambda < 1 ? sinh(a * y) / cosh(a) : (y < 0 ? -1 : 1) * (edge - far) / both;
    out->torque = sine / lambda;
    out->dtorque = lambda < 1 ? -cosh(a * y) / cosh(a) : -(edge + far) / both;
}

/* b = sum lambda^2k b_k with b_0'' = -f, b_k'' = b_(k-1), every mean zero. */
static void by_series(double lambda, const bimoment_load *load, double x, double *b, double *db)
{
    double p[DEGREE + 1] = {0}, factor = 1;
    const double rhs[3] = {-load->f0, -load->f1, -load->f2};
    *b = *db = 0;
    for (int k = 0; k < TERMS; k++) {
        double next[DEGREE + 1] = {0}, mean = 0, value = 0, slope = 0;
        const int degree = 2 * k + 4;
        for (int i = 2; i <= degree; i++)
            next[i] = (k == 0 ? (i - 2 < 3 ? rhs[i - 2] : 0) : p[i - 2]) / (i * (i - 1));
        next[1] = k == 0 ? -load->m0 : 0;
        for (int i = 1; i <= degree; i++)
            mean += next[i] / (i + 1);
        next[0] = -mean;
        for (int i = degree; i >= 0; i--) {
            slope = slope * x + value;
            value = value * x + next[i];
        }
        *b += factor * value;
        *db += factor * slope;
        factor *= lambda * lambda;
        for (int i = 0; i <= degree; i++)
            p[i] = next[i];
    }
}

void bimoment_moment(double lambda, const bimoment_load *load, double x, double *b, double *db)
{
    if (lambda < series_below) {
        by_series(lambda, load, x, b, db);
        return;
    }
    bimoment_values v;
    const double l2 = lambda * lambda, C2 = (load->f1 / l2 + load->m0) / lambda,
                 C1 = (-load->m1 - (2 * load->f2 + load->f1) / l2) / lambda;
    bimoment_functions(lambda, x, &v);
    *b = (load->f2 * x * x + load->f1 * x + load->f0 + 2 * load->f2 / l2) / l2 + C1 * v.c1 + C2 * v.c2;
    *db = (2 * load->f2 * x + load->f1) / l2 + C1 * v.dc1 + C2 * v.dc2;
}
