#include "elements/math/quadrature.h"

#include <assert.h>
#include <gsl/gsl_integration.h>

status quadrature_points(int n, double x[], double w[], fault *f)
{
    assert(n > 0 && n <= QUADRATURE_MAX_POINTS);
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc((size_t)n);
    if (table == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for quadrature");
    for (int i = 0; i < n; i++)
        gsl_integration_glfixed_point(0, 1, (size_t)i, &x[i], &w[i], table);
    gsl_integration_glfixed_table_free(table);
    return STATUS_OK;
}
