#include "elements/exact/line.h"

#include <math.h>

#include "elements/math/pi.h"

void exact_line_gauss(int n, double x[], double w[])
{
    for (int i = 0; i < n; i++) {
        /* Newton on Legendre's polynomial from Tricomi's estimate; its quadratic convergence ends in a few steps. */
        double z = cos(PI * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int step = 0; step < 10; step++) {
            double p = 1, before = 0;
            for (int k = 1; k <= n; k++) {
                const double next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
                before = p;
                p = next;
            }
            slope = n * (z * p - before) / (z * z - 1);
            z -= p / slope;
        }
        x[n - 1 - i] = (1 + z) / 2;
        w[n - 1 - i] = 1 / ((1 - z * z) * slope * slope);
    }
}

void exact_line_lagrange(int n, const double p[], double x, double L[], double dL[])
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
        if (dL != 0)
            dL[k] = slope;
    }
}
