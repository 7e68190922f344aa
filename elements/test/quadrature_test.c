/* The one Gauss rule: GSL's tables to the last digit, and monomials up to its degree. */
#include <float.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_test.h>
#include <math.h>

#include "elements/math/quadrature.h"

static void against_tables(int n, const double x[], const double w[])
{
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc((size_t)n);
    double apart = 0;
    for (int i = 0; i < n; i++) {
        double at, weight;
        gsl_integration_glfixed_point(0, 1, (size_t)i, &at, &weight, table);
        apart = fmax(apart, fmax(fabs(x[i] - at), fabs(w[i] / weight - 1)));
    }
    gsl_integration_glfixed_table_free(table);
    gsl_test(!(apart <= 2 * DBL_EPSILON), "%d points: %.1e from the tables", n, apart);
}

static void monomials(int n, const double x[], const double w[])
{
    double worst = 0;
    for (int degree = 0; degree < 2 * n; degree++) {
        double sum = 0;
        for (int i = 0; i < n; i++)
            sum += w[i] * pow(x[i], degree);
        worst = fmax(worst, fabs(sum * (degree + 1) - 1));
    }
    gsl_test(!(worst <= 1e-13), "%d points: %.1e of a monomial", n, worst);
}

int main(void)
{
    double x[QUADRATURE_MAX_POINTS], w[QUADRATURE_MAX_POINTS];
    for (int n = 1; n <= QUADRATURE_MAX_POINTS; n++) {
        quadrature_points(n, x, w);
        if (n <= 20) /* GSL tabulates these; beyond, it computes some in double precision */
            against_tables(n, x, w);
        monomials(n, x, w);
    }
    return gsl_test_summary();
}
