#include "harness/newton/symmetric.h"

#include <float.h>
#include <math.h>
#include <string.h>

int symmetric_negative(int n, double A[])
{
    const double digits = 16 * DBL_EPSILON;
    double terms[SYMMETRIC_MOST];
    int negative = 0;
    for (int k = 0; k < n; k++)
        terms[k] = fabs(A[k * n + k]);
    for (int k = 0; k < n; k++) {
        const double d = A[k * n + k];
        if (!(fabs(d) > digits * terms[k]) || !isfinite(d))
            return -1;
        negative += d < 0;
        for (int i = k + 1; i < n; i++) {
            const double l = A[i * n + k] / d;
            for (int j = k + 1; j <= i; j++)
                A[i * n + j] -= l * A[j * n + k];
        }
        for (int i = k + 1; i < n; i++)
            A[i * n + k] /= d;
    }
    return negative;
}

int symmetric_inverse(int n, const double A[], double inverse[])
{
    double L[SYMMETRIC_MOST * SYMMETRIC_MOST];
    memcpy(L, A, (size_t)(n * n) * sizeof *L);
    const int negative = symmetric_negative(n, L);
    if (negative < 0)
        return negative;
    for (int c = 0; c < n; c++) {
        double x[SYMMETRIC_MOST] = {0};
        x[c] = 1;
        for (int i = c + 1; i < n; i++)
            for (int j = c; j < i; j++)
                x[i] -= L[i * n + j] * x[j];
        for (int i = c; i < n; i++)
            x[i] /= L[i * n + i];
        for (int i = n; i-- > c;) {
            for (int j = i + 1; j < n; j++)
                x[i] -= L[j * n + i] * x[j];
            inverse[i * n + c] = inverse[c * n + i] = x[i];
        }
    }
    return negative;
}
