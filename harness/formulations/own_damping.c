#include <math.h>

#include "harness/formulations/formulations.h"

/* Returns the longest relaxation time V_ii/C_ii [s]. */
static double longest(int n, const double C[], const double V[])
{
    double most = 0;
    for (int k = 0; k < n * n; k += n + 1)
        if (C[k] > 0)
            most = fmax(most, fabs(V[k]) / C[k]);
    return most;
}

int damping_scale(int n, const double C[], const double V[], double B[])
{
    const double rounding = 1e-14, eta = longest(n, C, V);
    double largest = 0;
    for (int k = 0; k < n * n; k++) {
        if (!isfinite(V[k]))
            return k;
        largest = fmax(largest, fabs(V[k]));
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            B[n * i + j] = V[n * i + j];
    for (int i = 0; i < n && largest > 0; i++) {
        const int k = i * n + i;
        const double least = rounding * (C[k] > 0 && eta > 0 ? eta * C[k] : largest);
        if (fabs(V[k]) <= least)
            B[k] = fmax(V[k], 0); /* the diagonal entry is negative only because of round-off */
        const double factor = 1 / sqrt(fmax(fabs(V[k]), least));
        for (int j = 0; j < n; j++) {
            B[i * n + j] *= factor;
            B[j * n + i] *= factor;
        }
    }
    return n * n;
}
