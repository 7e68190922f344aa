/* Small dense algebra for one element or several in lanes, row-major. Sums have the same order as
 * in elements/math/dense.h. */
#ifndef BEAMWORK_REAL_DENSE_H
#define BEAMWORK_REAL_DENSE_H

#include <float.h>

#include "elements/math/real.h"

enum { REAL_WIDEST = 11 };

/* Adds the sum over l of c[l stride] times row l of `rows` (row length n) to out[width], in
 * ascending l. If the width is a compile-time constant, sums stay in registers. */
static inline __attribute__((always_inline)) void
real_add_row(int count, int width, const real *c, int stride, const real *rows, int n, real *out)
{
    real sum[REAL_WIDEST];
    for (int j = 0; j < width; j++)
        sum[j] = out[j];
    for (int l = 0; l < count; l++) {
        const real factor = c[l * stride];
        for (int j = 0; j < width; j++)
            sum[j] += factor * rows[l * n + j];
    }
    for (int j = 0; j < width; j++)
        out[j] = sum[j];
}

/* Adds J^T S J to K(n x n) for columns and rows from `first` on, with J(m x n) and S(m x m), in
 * pieces of `width` columns. `width` must divide n - first. SJ(m x n) is overwritten in these
 * columns. */
static inline __attribute__((always_inline)) void real_add_congruence(int m, int n, int first,
                                                                      int width, const real *J,
                                                                      const real *S, real *SJ,
                                                                      real *K)
{
    for (int j = first; j < n; j += width) {
        for (int i = 0; i < m; i++) {
            for (int k = 0; k < width; k++)
                SJ[i * n + j + k] = real_of(0);
            real_add_row(m, width, S + i * m, 1, J + j, n, SJ + i * n + j);
        }
        for (int i = first; i < n; i++)
            real_add_row(m, width, J + i, n, SJ + j, n, K + i * n + j);
    }
}

/* Computes the Cholesky factorisation A = L L^T in place (lower triangle, n x n). Returns the lanes
 * in which A is positive definite. */
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
