#include "elements/math/dense.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "elements/math/real.h"

enum { WIDEST = 14 };

/* Adds the sum over l of (times c[l stride]) times row l of `rows` (row length n) to `out`, in
 * ascending l. If the width is a compile-time constant, sums stay in registers. `skip` omits rows
 * whose factor is zero. */
static inline __attribute__((always_inline)) void add_block(int count, int width, double times,
                                                            int skip, const double *restrict c,
                                                            int stride, const double *restrict rows,
                                                            int n, double *restrict out)
{
    double sum[WIDEST];
    for (int j = 0; j < width; j++)
        sum[j] = out[j];
    for (int l = 0; l < count; l++) {
        const double factor = times * c[l * stride];
        if (skip && factor == 0)
            continue;
        for (int j = 0; j < width; j++)
            sum[j] += factor * rows[l * n + j];
    }
    for (int j = 0; j < width; j++)
        out[j] = sum[j];
}

/* Returns the width of the next block of `left` remaining columns: the largest compiled width that
 * fits. */
static inline __attribute__((always_inline)) int width_of(int left)
{
    static const int widths[] = {14, 8, 7, 3};
    for (size_t i = 0; i < sizeof widths / sizeof widths[0]; i++)
        if (left >= widths[i])
            return widths[i];
    return 1;
}

static inline __attribute__((always_inline)) void add_rows(int count, int n, double times, int skip,
                                                           const double *c, int stride,
                                                           const double *rows, double *out)
{
    for (int j = 0, width; j < n; j += width) {
        width = width_of(n - j);
        if (width == 14)
            add_block(count, 14, times, skip, c, stride, rows + j, n, out + j);
        else if (width == 8)
            add_block(count, 8, times, skip, c, stride, rows + j, n, out + j);
        else if (width == 7)
            add_block(count, 7, times, skip, c, stride, rows + j, n, out + j);
        else if (width == 3)
            add_block(count, 3, times, skip, c, stride, rows + j, n, out + j);
        else
            add_block(count, 1, times, skip, c, stride, rows + j, n, out + j);
    }
}

void dense_mul(int m, int k, int n, const double *restrict A, const double *restrict B,
               double *restrict C)
{
    memset(C, 0, sizeof(double) * (size_t)m * (size_t)n);
    for (int i = 0; i < m; i++)
        add_rows(k, n, 1, 1, &A[i * k], 1, B, &C[i * n]);
}

void dense_add_transpose_mul(int m, int k, int n, const double *restrict A,
                             const double *restrict B, double *restrict C)
{
    if (n == 1)
        add_rows(k, m, 1, 0, B, 1, A, C);
    if (n > 1)
        for (int i = 0; i < m; i++)
            add_rows(k, n, 1, 1, &A[i], m, B, &C[i * n]);
}

double dense_dot(int n, const double a[], const double b[])
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

static inline __attribute__((always_inline)) double quadratic(int n, const double *A,
                                                              const double *x)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            sum += x[i] * A[i * n + j] * x[j];
    return sum;
}

double dense_quadratic(int n, const double A[], const double x[])
{
    return n == 15 ? quadratic(15, A, x) : n == 8 ? quadratic(8, A, x) : quadratic(n, A, x);
}

/* Computes y(m) = A(m x n) x. */
static inline __attribute__((always_inline)) void mul_rows(int m, int n, const double *A,
                                                           const double *x, double *y)
{
    for (int i = 0; i < m; i++) {
        double sum = 0;
        for (int j = 0; j < n; j++)
            sum += A[i * n + j] * x[j];
        y[i] = sum;
    }
}

void dense_mul_vec(int m, int n, const double *A, const double *x, double *y)
{
    if (n == 15)
        mul_rows(m, 15, A, x, y);
    else if (n == 14)
        mul_rows(m, 14, A, x, y);
    else if (n == 8)
        mul_rows(m, 8, A, x, y);
    else
        mul_rows(m, n, A, x, y);
}

void dense_add_congruence(int m, int n, const double *J, const double *S, double *K, double *work)
{
    dense_add_between(m, n, J, S, J, K, work);
}

void dense_add_between(int m, int n, const double *A, const double *S, const double *J, double *K,
                       double *work)
{
    if (m <= CONGRUENCE_WIDEST && n <= CONGRUENCE_WIDEST) {
        REAL_CHOSEN(congruence_add_between)(m, n, A, S, J, K);
        return;
    }
    dense_mul(m, m, n, S, J, work);
    dense_add_transpose_mul(n, m, n, A, work, K);
}

double dense_symmetrise(int n, double *A)
{
    double largest = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) {
            double *const one = &A[i * n + j], *const other = &A[j * n + i];
            const double apart = fabs(*one - *other),
                         scale = sqrt(fabs(A[i * n + i]) * fabs(A[j * n + j]));
            if (apart == 0)
                continue;
            largest = fmax(largest, apart <= DBL_MAX && scale > 0 ? apart / scale : INFINITY);
            *one = *other = (*one + *other) / 2;
        }
    return largest;
}

int dense_cholesky(int n, double *A)
{
    for (int j = 0; j < n; j++) {
        double d = A[j * n + j];
        for (int k = 0; k < j; k++)
            d -= A[j * n + k] * A[j * n + k];
        if (!(d > 0) || !isfinite(d))
            return j + 1;
        d = sqrt(d);
        A[j * n + j] = d;
        for (int i = j + 1; i < n; i++) {
            double sum = A[i * n + j];
            for (int k = 0; k < j; k++)
                sum -= A[i * n + k] * A[j * n + k];
            A[i * n + j] = sum / d;
        }
    }
    return 0;
}

void dense_cholesky_solve(int n, int m, const double *L, double *B)
{
    for (int i = 0; i < n; i++)
        for (int c = 0; c < m; c++) {
            double sum = B[i * m + c];
            for (int k = 0; k < i; k++)
                sum -= L[i * n + k] * B[k * m + c];
            B[i * m + c] = sum / L[i * n + i];
        }
    for (int i = n - 1; i >= 0; i--)
        for (int c = 0; c < m; c++) {
            double sum = B[i * m + c];
            for (int k = i + 1; k < n; k++)
                sum -= L[k * n + i] * B[k * m + c];
            B[i * m + c] = sum / L[i * n + i];
        }
}

int dense_lu(int n, double *A, int pivot[])
{
    for (int j = 0; j < n; j++) {
        int p = j;
        for (int i = j + 1; i < n; i++)
            if (fabs(A[i * n + j]) > fabs(A[p * n + j]))
                p = i;
        pivot[j] = p;
        if (!(fabs(A[p * n + j]) > 0) || !isfinite(A[p * n + j]))
            return j + 1;
        if (p != j)
            for (int k = 0; k < n; k++) {
                const double swap = A[j * n + k];
                A[j * n + k] = A[p * n + k];
                A[p * n + k] = swap;
            }
        for (int i = j + 1; i < n; i++) {
            const double factor = A[i * n + j] / A[j * n + j];
            A[i * n + j] = factor;
            if (factor != 0)
                for (int k = j + 1; k < n; k++)
                    A[i * n + k] -= factor * A[j * n + k];
        }
    }
    return 0;
}

int dense_lu_regular(int n, double *A, int pivot[])
{
    const int failed = dense_lu(n, A, pivot);
    for (int j = 0; j < n && failed == 0; j++) {
        double terms = fabs(A[j * n + j]);
        for (int k = 0; k < j; k++)
            terms += fabs(A[j * n + k] * A[k * n + j]);
        if (!(fabs(A[j * n + j]) > 16 * n * DBL_EPSILON * terms))
            return j + 1;
    }
    return failed;
}

void dense_lu_solve(int n, int m, const double *LU, const int pivot[], double *B)
{
    for (int i = 0; i < n; i++)
        if (pivot[i] != i)
            for (int c = 0; c < m; c++) {
                const double swap = B[i * m + c];
                B[i * m + c] = B[pivot[i] * m + c];
                B[pivot[i] * m + c] = swap;
            }
    for (int i = 0; i < n; i++)
        add_rows(i, m, -1, 0, &LU[i * n], 1, B, &B[i * m]);
    for (int i = n - 1; i >= 0; i--) {
        add_rows(n - 1 - i, m, -1, 0, &LU[i * n + i + 1], 1, &B[(i + 1) * m], &B[i * m]);
        for (int c = 0; c < m; c++)
            B[i * m + c] /= LU[i * n + i];
    }
}

void dense_widen(int n, int wide, double K[])
{
    for (int i = n; i-- > 0;) {
        memmove(&K[i * wide], &K[i * n], (size_t)n * sizeof *K);
        memset(&K[i * wide + n], 0, (size_t)(wide - n) * sizeof *K);
    }
    memset(&K[n * wide], 0, (size_t)(wide * (wide - n)) * sizeof *K);
}
