/* Small dense algebra of one element or of several in lanes, row-major: the sums of
 * elements/math/dense.h in their order. */
#ifndef BEAMWORK_REAL_DENSE_H
#define BEAMWORK_REAL_DENSE_H

#include <float.h>

#include "elements/math/real.h"

/* Cholesky A = L L^T in place (lower triangle, n x n). Returns where A is positive definite. */
static inline real_truth real_cholesky(int n, real *A)
{
    real_truth good = real_true();
    for (int j = 0; j < n; j++) {
        real d = A[j * n + j];
        for (int k = 0; k < j; k++)
            d -= A[j * n + k] * A[j * n + k];
        good &= (d > 0) & (d <= DBL_MAX);
        d = real_sqrt(d);
        A[j * n + j] = d;
        for (int i = j + 1; i < n; i++) {
            real sum = A[i * n + j];
            for (int k = 0; k < j; k++)
                sum -= A[i * n + k] * A[j * n + k];
            A[i * n + j] = sum / d;
        }
    }
    return good;
}

/* Solves L L^T x = b in place. */
static inline void real_cholesky_solve(int n, const real *L, real *b)
{
    for (int i = 0; i < n; i++) {
        real sum = b[i];
        for (int k = 0; k < i; k++)
            sum -= L[i * n + k] * b[k];
        b[i] = sum / L[i * n + i];
    }
    for (int i = n - 1; i >= 0; i--) {
        real sum = b[i];
        for (int k = i + 1; k < n; k++)
            sum -= L[k * n + i] * b[k];
        b[i] = sum / L[i * n + i];
    }
}

#endif
