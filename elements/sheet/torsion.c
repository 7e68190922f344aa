#include "elements/sheet/sheet.h"

#include <math.h>

#include "elements/math/scalar.h"

enum { COEFFICIENTS = SHEET_TORSION_DEGREE + 1, POINTS = 16, LOADS = SHEET_TORSION_MODES + 2 };

/* Value of lambda above which the closed form is used. */
static const double closed_from = 6;

/* Coefficients of phi_x' for a unit value of px/L, Wp and Wq (N Eq. 19). Those of `chord` belong to
 * h_p and h_q for lambda -> 0. */
static const double rate[SHEET_TORSION_TWISTS][COEFFICIENTS] = {{0, 6, -6}, {1, -4, 3}, {0, -2, 3}};
static const double chord[2][COEFFICIENTS] = {{1, -1}, {0, 1}};

static double value(const double t[COEFFICIENTS], double x)
{
    return t[0] + x * (t[1] + x * (t[2] + x * t[3]));
}

static double second(const double t[COEFFICIENTS], double x)
{
    return 2 * t[2] + 6 * t[3] * x;
}

/* Returns int a b dx with a single rounding error: 420/(n + 1) is an integer for every power n <=
 * 6. */
static double integral_of_product(const double a[COEFFICIENTS], const double b[COEFFICIENTS])
{
    double sum = 0;
    for (int i = 0; i < COEFFICIENTS; i++)
        for (int j = 0; j < COEFFICIENTS; j++) {
            const int share = 420 / (i + j + 1);
            sum += a[i] * b[j] * share;
        }
    return sum / 420;
}

/* Returns int t h_q dx (end 1) or int t h_p dx (end 0), by two integrations by parts with h'' =
 * lambda^2 h. */
static double end_integral(double lambda, const double t[COEFFICIENTS], int end)
{
    const double decay = exp(-lambda), scale = -expm1(-2 * lambda),
                 coth = (1 + decay * decay) / scale, csch = 2 * decay / scale;
    const double l2 = lambda * lambda, slope = t[1] + end * (2 * t[2] + 3 * t[3]) + 6 * t[3] / l2;
    const double near = value(t, end) + second(t, end) / l2,
                 far = value(t, 1 - end) + second(t, 1 - end) / l2;
    return (lambda * (near * coth - far * csch) - (end == 1 ? slope : -slope)) / l2;
}

/* Computes the integrals by the closed form: lambda^2 g = t + t''/lambda^2 minus the values of this
 * sum at the ends times h_p and h_q. */
static void closed(double lambda, const double t[SHEET_TORSION_MODES][COEFFICIENTS],
                   sheet_torsion_integrals *out)
{
    const double l2 = lambda * lambda;
    for (int k = 0; k < SHEET_TORSION_MODES; k++) {
        const double end[2] = {end_integral(lambda, t[k], 0), end_integral(lambda, t[k], 1)};
        for (int l = 0; l < SHEET_TORSION_MODES; l++) {
            const double curved[COEFFICIENTS] = {2 * t[l][2], 6 * t[l][3]}; /* t_l'' */
            out->compliance[k][l] = integral_of_product(t[k], t[l]) +
                                    integral_of_product(t[k], curved) / l2 -
                                    (value(t[l], 0) + second(t[l], 0) / l2) * end[0] -
                                    (value(t[l], 1) + second(t[l], 1) / l2) * end[1];
        }
        out->work[k][SHEET_TORSION_WP] = integral_of_product(t[k], rate[SHEET_TORSION_WP]) - end[0];
        out->work[k][SHEET_TORSION_WQ] = integral_of_product(t[k], rate[SHEET_TORSION_WQ]) - end[1];
    }
}

/* Integrates with Green's function sinh(lambda y) sinh(lambda (1 - x))/(lambda sinh(lambda)), y <
 * x, over the triangle y = x z. The same integrals give the end functions, because chord - h solves
 * lambda^2 g - g'' = lambda^2 chord. */
static void by_quadrature(double lambda, const double t[SHEET_TORSION_MODES][COEFFICIENTS],
                          const double point[POINTS], const double weight[POINTS],
                          sheet_torsion_integrals *out)
{
    double sum[SHEET_TORSION_MODES][LOADS] = {{0}};
    for (int i = 0; i < POINTS; i++) {
        double at_x[LOADS], at_y[LOADS];
        const double x = point[i], h_p = sinh(lambda * (1 - x)) / sinh(lambda);
        for (int k = 0; k < LOADS; k++)
            at_x[k] = value(k < SHEET_TORSION_MODES ? t[k] : chord[k - SHEET_TORSION_MODES], x);
        for (int j = 0; j < POINTS; j++) {
            const double y = x * point[j],
                         kernel = weight[i] * weight[j] * x * lambda * sinh(lambda * y) * h_p;
            for (int k = 0; k < LOADS; k++)
                at_y[k] = value(k < SHEET_TORSION_MODES ? t[k] : chord[k - SHEET_TORSION_MODES], y);
            for (int k = 0; k < SHEET_TORSION_MODES; k++)
                for (int l = 0; l < LOADS; l++)
                    sum[k][l] += kernel * (at_x[k] * at_y[l] + at_x[l] * at_y[k]);
        }
    }
    for (int k = 0; k < SHEET_TORSION_MODES; k++) {
        for (int l = 0; l < SHEET_TORSION_MODES; l++)
            out->compliance[k][l] = sum[k][l];
        for (int end = 0; end < 2; end++) {
            double gap[COEFFICIENTS];
            for (int i = 0; i < COEFFICIENTS; i++)
                gap[i] = rate[SHEET_TORSION_WP + end][i] - chord[end][i];
            out->work[k][SHEET_TORSION_WP + end] =
                integral_of_product(t[k], gap) + sum[k][SHEET_TORSION_MODES + end];
        }
    }
}

static void uniform(const double t[SHEET_TORSION_MODES][COEFFICIENTS], sheet_torsion_integrals *out)
{
    const double one[COEFFICIENTS] = {1};
    for (int k = 0; k < SHEET_TORSION_MODES; k++) {
        out->work[k][SHEET_TORSION_PX] = integral_of_product(t[k], one);
        for (int l = 0; l < SHEET_TORSION_MODES; l++)
            out->compliance[k][l] = integral_of_product(t[k], t[l]);
    }
}

void sheet_torsion_integrate(double lambda, const double t[SHEET_TORSION_MODES][COEFFICIENTS],
                             sheet_torsion_integrals *out)
{
    *out = (sheet_torsion_integrals){0};
    if (isinf(lambda)) {
        uniform(t, out);
        return;
    }
    out->same = lambda * (1 + exp(-2 * lambda)) / -expm1(-2 * lambda);
    out->other = -2 * lambda * exp(-lambda) / -expm1(-2 * lambda);
    for (int k = 0; k < SHEET_TORSION_MODES; k++)
        out->work[k][SHEET_TORSION_PX] = integral_of_product(t[k], rate[SHEET_TORSION_PX]);
    if (lambda >= closed_from) {
        closed(lambda, t, out);
        return;
    }
    double x[POINTS], w[POINTS];
    quadrature_points(POINTS, x, w);
    by_quadrature(lambda, t, x, w, out);
}
