#include "elements/math/quadrature.h"

#include <assert.h>
#include <math.h>

#include "elements/math/pi.h"

/* Legendre's polynomial of degree n at z, |z| < 1, and its slope. */
static long double legendre(int n, long double z, long double *slope)
{
    long double p = 1, before = 0;
    for (int k = 1; k <= n; k++) {
        const long double next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
        before = p;
        p = next;
    }
    *slope = n * (z * p - before) / (z * z - 1);
    return p;
}

void quadrature_points(int n, double x[], double w[])
{
    enum { STEPS = 6 }; /* of Newton's method, from Tricomi's estimate: it doubles four digits */
    assert(n > 0 && n <= QUADRATURE_MAX_POINTS);
    for (int i = 0; i <= (n - 1) / 2; i++) {
        const int middle = 2 * i + 1 == n;
        long double z = middle ? 0 : cosl((long double)PI * (i + 0.75L) / (n + 0.5L)), slope;
        for (int step = 0; step < STEPS && !middle; step++) {
            const long double p = legendre(n, z, &slope);
            z -= p / slope;
        }
        legendre(n, z, &slope);
        x[i] = 0.5 - 0.5 * (double)z;
        x[n - 1 - i] = 0.5 + 0.5 * (double)z;
        w[i] = w[n - 1 - i] = 0.5 * (double)(2 / ((1 - z * z) * slope * slope));
    }
}
