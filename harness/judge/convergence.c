#include "harness/judge/convergence.h"

#include <math.h>

static const double round_off = 3e-11; /* relative: differences below say nothing of an order */
enum { HIGHEST_ORDER = 24 };

/* (n1^-p - n2^-p)/(n2^-p - n3^-p), which grows with p. */
static double ratio_at(double p, const int n[3])
{
    const double a = pow((double)n[2] / n[0], p), b = pow((double)n[2] / n[1], p);
    return (a - b) / (b - 1);
}

/* Order from three values by bisection; NAN when their differences do not fit any. */
static double order_of(const int n[3], const double v[3])
{
    const double ratio = (v[0] - v[1]) / (v[1] - v[2]);
    double low = 0.05, high = HIGHEST_ORDER;
    if (!(ratio > ratio_at(low, n)) || !(ratio < ratio_at(high, n)))
        return NAN;
    for (int i = 0; i < 100; i++) {
        const double middle = (low + high) / 2;
        *(ratio_at(middle, n) < ratio ? &low : &high) = middle;
    }
    return (low + high) / 2;
}

static double limit_of(double p, const int n[3], const double v[3])
{
    return v[2] + (v[2] - v[1]) / (pow((double)n[2] / n[1], p) - 1);
}

/* Coarsest mesh from which on all triples show the order; those at the floor [same unit as v] show nothing. */
static int range_of(int count, const int n[], const double v[], double order, double floor)
{
    const double apart = 0.5;
    int from = 0;
    for (int i = count - 3; i >= 0; i--) {
        if (fabs(v[i + 2] - v[i + 1]) <= 30 * floor)
            continue;
        if (!(fabs(order_of(n + i, v + i) - order) <= apart))
            break;
        from = n[i];
    }
    return from;
}

convergence convergence_of(int count, const int n[], const double v[], double scale)
{
    convergence c = {CONVERGENCE_NONE, NAN, NAN, NAN, NAN, 0};
    if (count < 1)
        return c;
    const int last = count - 1;
    c.limit = v[last];
    c.limit_uncertainty = count > 1 ? fabs(v[last] - v[last - 1]) : NAN;
    if (count > 1 && c.limit_uncertainty <= round_off * scale) {
        c.kind = CONVERGENCE_FLOOR;
        /* The order, if any, from the last differences that still say something. */
        for (int i = last - 1; i >= 2 && isnan(c.order); i--)
            if (fabs(v[i] - v[i - 1]) > 30 * round_off * scale)
                c.order = order_of(n + i - 2, v + i - 2);
        c.from = range_of(count, n, v, c.order, round_off * scale);
        return c;
    }
    if (count < 3)
        return c;
    const double p = order_of(n + last - 2, v + last - 2);
    if (isnan(p))
        return c;
    c.kind = CONVERGENCE_ORDERLY;
    c.order = p;
    c.limit = limit_of(p, n + last - 2, v + last - 2);
    c.limit_uncertainty = fabs(c.limit - v[last]);
    const double before = count > 3 ? order_of(n + last - 3, v + last - 3) : NAN;
    if (!isnan(before)) {
        c.order_uncertainty = fabs(p - before);
        c.limit_uncertainty = fmin(c.limit_uncertainty, fabs(c.limit - limit_of(before, n + last - 3, v + last - 3)));
    }
    c.limit_uncertainty = fmax(c.limit_uncertainty, round_off * scale);
    c.from = range_of(count, n, v, p, round_off * scale);
    return c;
}
