/* Warping inside an exact element, beside the closed solution of non-uniform torsion: whatever the
 * layers at its ends are, thick or thin.
 *
 * The warping amplitude a = p(x) + A exp(-lambda x) + B exp(-lambda (1 - x)), p a polynomial of
 * degree stages - 1, minimises the energy for the warping torque T = GJ (p - P a) - EIw p'' and the
 * twist rate P a + F T at the Gauss points; the bimoments at its ends are -EIw a'(0), EIw a'(1). */
#include <gsl/gsl_integration.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/geometrically_exact/line.h"
#include "elements/geometrically_exact/warping.h"
#include "elements/math/quadrature.h"
#include "elements/test/random.h"
#include "elements/test/worst.h"

enum { WARPING_MOST = EXACT_WARPING_MAX_STAGES };

/* p by its coefficients of x^k, and the amplitudes of both layers. */
typedef struct amplitude {
    int stages;
    double lambda, p[WARPING_MOST], layer[2];
} amplitude;

/* Derivative `order` of the polynomial. */
static double polynomial(const amplitude *a, double x, int order)
{
    double sum = 0;
    for (int k = a->stages - 1; k >= order; k--) {
        double factor = 1;
        for (int i = 0; i < order; i++)
            factor *= k - i;
        sum = sum * x + factor * a->p[k];
    }
    return sum;
}

static double layers(const amplitude *a, double x, double rest)
{
    return a->layer[0] * exp(-a->lambda * x) + a->layer[1] * exp(-a->lambda * rest);
}

/* Means of the layers with the Lagrange polynomials of the points, over intervals that double from
 * 1/1000 of a layer's thickness at each end. */
static void layer_means(const amplitude *a, const double x[], const double w[], double mean[])
{
    gsl_integration_glfixed_table *t = gsl_integration_glfixed_table_alloc(12);
    memset(mean, 0, (size_t)a->stages * sizeof *mean);
    for (double from = 0, to = fmin(1e-3 / a->lambda, 0.5); from < 0.5;
         from = to, to = fmin(2 * to, 0.5))
        for (size_t g = 0; g < 12; g++) {
            double at, weight, L[WARPING_MOST];
            gsl_integration_glfixed_point(from, to, g, &at, &weight, t);
            exact_line_lagrange(a->stages, x, at, L, NULL);
            for (int i = 0; i < a->stages; i++)
                mean[i] += weight * L[i] / w[i] * layers(a, at, 1 - at);
            exact_line_lagrange(a->stages, x, 1 - at, L, NULL);
            for (int i = 0; i < a->stages; i++)
                mean[i] += weight * L[i] / w[i] * layers(a, 1 - at, at);
        }
    gsl_integration_glfixed_table_free(t);
}

/* Largest departure of S z from the exact gradient, in parts of its largest entry. */
static double warping_departure(const beam_constants *c, const amplitude *a)
{
    const int m = a->stages + 2;
    double x[WARPING_MOST], w[WARPING_MOST], mean[WARPING_MOST], z[EXACT_WARPING_MAX],
        exact[EXACT_WARPING_MAX], S[EXACT_WARPING_MAX * EXACT_WARPING_MAX], size = 0, worst = 0;
    quadrature_points(a->stages, x, w);
    layer_means(a, x, w, mean);
    for (int i = 0; i < a->stages; i++) {
        const double T = -c->GJ * mean[i] - c->EIw * polynomial(a, x[i], 2);
        z[i] = polynomial(a, x[i], 0) + mean[i] + c->F[8] * T;
        exact[i] = w[i] * T;
    }
    const double far = exp(-a->lambda), l = a->lambda;
    z[m - 2] = polynomial(a, 0, 0) + a->layer[0] + a->layer[1] * far;
    z[m - 1] = polynomial(a, 1, 0) + a->layer[0] * far + a->layer[1];
    exact[m - 2] = -c->EIw * (polynomial(a, 0, 1) + l * (-a->layer[0] + a->layer[1] * far));
    exact[m - 1] = c->EIw * (polynomial(a, 1, 1) + l * (-a->layer[0] * far + a->layer[1]));
    exact_warping_energy(c, a->stages, x, w, S);
    for (int i = 0; i < m; i++) {
        double sum = 0;
        for (int j = 0; j < m; j++)
            sum += S[i * m + j] * z[j];
        size = fmax(size, fabs(exact[i]));
        worst = worst_of(worst, fabs(sum - exact[i]));
    }
    return worst / size;
}

/* One layer or polynomial term at a time: none hides behind a larger one. */
static void warping_compare(int stages, double lambda, double shear)
{
    const beam_constants c = {.GJ = 0.7, .EIw = 0.7 / (lambda * lambda), .F = {[8] = shear}};
    double layer = 0, smooth = 0, mixed = 0;
    uint64_t seed = (uint64_t)stages;
    for (int side = 0; side < 2; side++) {
        amplitude a = {.stages = stages, .lambda = lambda};
        a.layer[side] = 1;
        layer = worst_of(layer, warping_departure(&c, &a));
    }
    for (int k = 0; k < stages; k++) {
        amplitude a = {.stages = stages, .lambda = lambda};
        a.p[k] = 1;
        if (k > 0) /* a constant needs no torque and no bimoment: it is seen in the mixture */
            smooth = worst_of(smooth, warping_departure(&c, &a));
    }
    amplitude a = {.stages = stages, .lambda = lambda};
    for (int k = 0; k < stages; k++)
        a.p[k] = random_number(&seed);
    a.layer[0] = random_number(&seed);
    a.layer[1] = random_number(&seed);
    mixed = warping_departure(&c, &a);
    gsl_test(!(layer < 1e-9), "lambda = %g, %d stages, shear %g: layers (%.1e)", lambda, stages,
             shear, layer);
    gsl_test(!(smooth < 1e-9), "lambda = %g, %d stages, shear %g: between them (%.1e)", lambda,
             stages, shear, smooth);
    gsl_test(!(mixed < 1e-9), "lambda = %g, %d stages, shear %g: both (%.1e)", lambda, stages,
             shear, mixed);
}

int main(void)
{
    static const double lambda[] = {0.1, 1, 5, 15, 19.9, 20.1, 50, 300, 1e4},
                        shear[] = {0, 0.3, 40};
    for (int stages = 3; stages <= WARPING_MOST; stages++)
        for (size_t i = 0; i < sizeof lambda / sizeof lambda[0]; i++)
            for (size_t k = 0; k < sizeof shear / sizeof shear[0]; k++)
                warping_compare(stages, lambda[i], shear[k]);
    return gsl_test_summary();
}
