#include "elements/sheet/torsion.h"

#include <math.h>

#include "elements/math/quadrature.h"

enum { COEFFICIENTS = TORSION_DEGREE + 1, POINTS = 20 };

/* Below, the closed form would cancel like lambda^-4; above, the kernel has boundary layers that few points miss. */
static const double closed_from = 6;

static double value(const double t[COEFFICIENTS], double x)
{
    return t[0] + x * (t[1] + x * (t[2] + x * t[3]));
}

static double second(const double t[COEFFICIENTS], double x)
{
    return 2 * t[2] + 6 * t[3] * x;
}

static double integral_of_product(const double a[COEFFICIENTS], const double b[COEFFICIENTS])
{
    double sum = 0;
    for (int i = 0; i < COEFFICIENTS; i++)
        for (int j = 0; j < COEFFICIENTS; j++)
            sum += a[i] * b[j] / (i + j + 1);
    return sum;
}

/* int t h_q dx and, with t reversed, int t h_p dx: twice by parts with h'' = lambda^2 h. */
static double end_closed(double lambda, const double t[COEFFICIENTS], int at_q)
{
    const double decay = exp(-lambda), coth = (1 + decay * decay) / -expm1(-2 * lambda), csch = 2 * decay / -expm1(-2 * lambda);
    const double near = at_q ? 1 : 0, far = 1 - near, outwards = at_q ? 1 : -1, l2 = lambda * lambda;
    const double slope_near = t[1] + near * (2 * t[2] + 3 * t[3]); /* dt/dx at x = 0 or 1 */
    const double third = 6 * t[3];
    return ((value(t, near) + second(t, near) / l2) * lambda * coth - (value(t, far) + second(t, far) / l2) * lambda * csch -
            outwards * (slope_near + third / l2)) /
           l2;
}

static void closed(double lambda, const double t[TORSION_MODES][COEFFICIENTS], torsion_integrals *out)
{
    const double l2 = lambda * lambda;
    for (int k = 0; k < TORSION_MODES; k++) {
        out->ends[k][0] = end_closed(lambda, t[k], 0);
        out->ends[k][1] = end_closed(lambda, t[k], 1);
    }
    for (int k = 0; k < TORSION_MODES; k++)
        for (int l = 0; l < TORSION_MODES; l++) {
            const double curved[COEFFICIENTS] = {2 * t[l][2], 6 * t[l][3]}; /* t_l'' */
            out->compliance[k][l] = integral_of_product(t[k], t[l]) + integral_of_product(t[k], curved) / l2 -
                                    (value(t[l], 0) + second(t[l], 0) / l2) * out->ends[k][0] -
                                    (value(t[l], 1) + second(t[l], 1) / l2) * out->ends[k][1];
        }
}

/* Green's function sinh(lambda y) sinh(lambda (1 - x))/(lambda sinh(lambda)), y < x, over the triangle y = x z. */
static void by_quadrature(double lambda, const double t[TORSION_MODES][COEFFICIENTS], const double point[POINTS],
                          const double weight[POINTS], torsion_integrals *out)
{
    const double sine = sinh(lambda);
    for (int i = 0; i < POINTS; i++) {
        const double x = point[i], h_p = sinh(lambda * (1 - x)) / sine, h_q = sinh(lambda * x) / sine;
        for (int k = 0; k < TORSION_MODES; k++) {
            out->ends[k][0] += weight[i] * h_p * value(t[k], x);
            out->ends[k][1] += weight[i] * h_q * value(t[k], x);
        }
        for (int j = 0; j < POINTS; j++) {
            const double y = x * point[j], kernel = weight[i] * weight[j] * x * lambda * sinh(lambda * y) * h_p;
            for (int k = 0; k < TORSION_MODES; k++)
                for (int l = 0; l < TORSION_MODES; l++)
                    out->compliance[k][l] += kernel * (value(t[k], x) * value(t[l], y) + value(t[l], x) * value(t[k], y));
        }
    }
}

status torsion_integrate(double lambda, const double t[TORSION_MODES][COEFFICIENTS], torsion_integrals *out, fault *f)
{
    *out = (torsion_integrals){0};
    if (isinf(lambda)) {
        for (int k = 0; k < TORSION_MODES; k++)
            for (int l = 0; l < TORSION_MODES; l++)
                out->compliance[k][l] = integral_of_product(t[k], t[l]);
        return STATUS_OK;
    }
    out->same = lambda * (1 + exp(-2 * lambda)) / -expm1(-2 * lambda);
    out->other = -2 * lambda * exp(-lambda) / -expm1(-2 * lambda);
    if (lambda >= closed_from) {
        closed(lambda, t, out);
        return STATUS_OK;
    }
    double x[POINTS], w[POINTS];
    const status made = quadrature_points(POINTS, x, w, f);
    if (made == STATUS_OK)
        by_quadrature(lambda, t, x, w, out);
    return made;
}
