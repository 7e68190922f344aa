#include "elements/math/scalar.h"

#include <assert.h>
#include <gsl/gsl_integration.h>
#include <math.h>
#include <pthread.h>

/* Tables of points and weights, which are read-only after creation. GSL stores some tables with
 * full precision and computes the other tables. */
static gsl_integration_glfixed_table *tables[QUADRATURE_MAX_POINTS + 1];
static pthread_once_t prepared = PTHREAD_ONCE_INIT;

static void prepare(void)
{
    for (int n = 1; n <= QUADRATURE_MAX_POINTS; n++)
        if (quadrature_is_tabulated(n))
            tables[n] = gsl_integration_glfixed_table_alloc((size_t)n);
}

int quadrature_is_tabulated(int n)
{
    return (n >= 1 && n <= 20) || n == 32 || n == 64;
}

void quadrature_points(int n, double x[], double w[])
{
    assert(quadrature_is_tabulated(n));
    pthread_once(&prepared, prepare);
    for (int i = 0; i < n; i++)
        if (tables[n] != NULL)
            gsl_integration_glfixed_point(0, 1, (size_t)i, &x[i], &w[i], tables[n]);
        else /* out of memory: returns NaN instead of a wrong number */
            x[i] = w[i] = NAN;
}

void lagrange_at(int n, const double p[], double x, double L[], double dL[])
{
    for (int k = 0; k < n; k++) {
        double value = 1, slope = 0;
        for (int j = 0; j < n; j++) {
            if (j == k)
                continue;
            slope = (slope * (x - p[j]) + value) / (p[k] - p[j]);
            value *= (x - p[j]) / (p[k] - p[j]);
        }
        L[k] = value;
        if (dL != NULL)
            dL[k] = slope;
    }
}
