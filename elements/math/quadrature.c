#include "elements/math/quadrature.h"

#include <gsl/gsl_integration.h>

static status panel(int n, double from, double to, double x[], double weight[], fault *f)
{
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc((size_t)n);
    if (table == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for quadrature");
    for (int i = 0; i < n; i++)
        gsl_integration_glfixed_point(from, to, (size_t)i, &x[i], &weight[i], table);
    gsl_integration_glfixed_table_free(table);
    return STATUS_OK;
}

status quadrature_points(int n, double x[], double weight[], fault *f)
{
    return panel(n, 0, 1, x, weight, f);
}

status quadrature_graded(double layer, int *n, double x[QUADRATURE_MAX_GRADED], double weight[QUADRATURE_MAX_GRADED], fault *f)
{
    double edge[32] = {0};
    int edges = 1;
    for (double width = 2 * layer; edges < 31 && edge[edges - 1] + width < 0.45; width *= 1.6, edges++)
        edge[edges] = edge[edges - 1] + width;
    edge[edges] = 0.5;
    *n = 0;
    for (int side = 0; side < 2; side++)
        for (int k = 0; k < edges; k++) {
            const double from = side == 0 ? edge[k] : 1 - edge[k + 1], to = side == 0 ? edge[k + 1] : 1 - edge[k];
            const status made = panel(QUADRATURE_MAX_POINTS, from, to, x + *n, weight + *n, f);
            if (made != STATUS_OK)
                return made;
            *n += QUADRATURE_MAX_POINTS;
        }
    return STATUS_OK;
}
