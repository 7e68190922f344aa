#include "harness/study/richardson.h"

#include <math.h>

static const double lowest_order = 0.05, bisected_order = 40;

/* (n0^-p - n1^-p)/(n1^-p - n2^-p), which grows with p. */
static double ratio_at(double p, const double n[3])
{
    const double a = pow(n[2] / n[0], p), b = pow(n[2] / n[1], p);
    return (a - b) / (b - 1);
}

double richardson_order(const double n[3], const double f[3])
{
    const double ratio = (f[0] - f[1]) / (f[1] - f[2]);
    double low = lowest_order, high = bisected_order;
    if (!(ratio > ratio_at(low, n)) || isinf(ratio))
        return NAN;
    for (int i = 0; i < 60; i++) {
        const double middle = (low + high) / 2;
        *(ratio_at(middle, n) < ratio ? &low : &high) = middle;
    }
    return (low + high) / 2;
}

double richardson_limit(const double n[3], const double f[3], double p)
{
    return f[2] + (f[2] - f[1]) / (pow(n[2] / n[1], p) - 1);
}

double richardson_amplification(const double n[3], const double f[3], double p)
{
    const double h = 1e-4 * fmin(fabs(f[1] - f[0]), fabs(f[2] - f[1])),
                 base = richardson_limit(n, f, p), lost = 100;
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        double g[3] = {f[0], f[1], f[2]};
        g[i] += h;
        const double q = richardson_order(n, g),
                     slope = isnan(q) ? lost : (richardson_limit(n, g, q) - base) / h;
        sum += slope * slope;
    }
    return sqrt(sum);
}
