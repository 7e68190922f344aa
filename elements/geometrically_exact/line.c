#include "elements/geometrically_exact/line.h"

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
