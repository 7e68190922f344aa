/* Small dense algebra: plain loops in the order that runs along rows. */
#include "elements/math/dense.h"

#include <float.h>
#include <string.h>

void dense_mul(int m, int k, int n, const double *restrict A, const double *restrict B,
               double *restrict C)
{
    memset(C, 0, sizeof(double) * (size_t)m * (size_t)n);
    for (int i = 0; i < m; i++)
        for (int l = 0; l < k; l++) {
            const double a = A[i * k + l];
            if (a == 0) /* blocks of zeros are the rule */
                continue;
            for (int j = 0; j < n; j++)
                C[i * n + j] += a * B[l * n + j];
        }
}

void dense_add_transpose_mul(int m, int k, int n, const double *restrict A,
                             const double *restrict B, double *restrict C)
{
    for (int l = 0; l < k && n == 1; l++)
        for (int i = 0; i < m; i++)
            C[i] += A[l * m + i] * B[l];
    for (int l = 0; l < k && n > 1; l++)
        for (int i = 0; i < m; i++) {
            const double a = A[l * m + i];
            if (a == 0)
                continue;
            for (int j = 0; j < n; j++)
                C[i * n + j] += a * B[l * n + j];
        }
}

double dense_dot(int n, const double a[], const double b[])
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

double dense_quadratic(int n, const double A[], const double x[])
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            sum += x[i] * A[i * n + j] * x[j];
    return sum;
}

void dense_mul_vec(int m, int n, const double *A, const double *x, double *y)
{
    for (int i = 0; i < m; i++) {
        double sum = 0;
        for (int j = 0; j < n; j++)
            sum += A[i * n + j] * x[j];
        y[i] = sum;
    }
}

/* K += J^T (S J); sizes that are known where it is inlined make straight code. */
static inline void congruence(int m, int n, const double *restrict J, const double *restrict S,
                              double *restrict K, double *restrict work)
{
    for (int i = 0; i < m; i++) {
        double *row = work + i * n;
        for (int j = 0; j < n; j++)
            row[j] = 0;
        for (int l = 0; l < m; l++) {
            const double s = S[i * m + l];
            for (int j = 0; j < n && s != 0; j++)
                row[j] += s * J[l * n + j];
        }
    }
    for (int l = 0; l < m; l++)
        for (int i = 0; i < n; i++) {
            const double a = J[l * n + i];
            for (int j = 0; j < n && a != 0; j++)
                K[i * n + j] += a * work[l * n + j];
        }
}

void dense_add_congruence(int m, int n, const double *J, const double *S, double *K, double *work)
{
    if (m == 8 && n == 14)
        congruence(8, 14, J, S, K, work);
    else if (m == 8 && n == 8)
        congruence(8, 8, J, S, K, work);
    else
        congruence(m, n, J, S, K, work);
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
        for (int k = 0; p != j && k < n; k++) {
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
        for (int c = 0; pivot[i] != i && c < m; c++) {
            const double swap = B[i * m + c];
            B[i * m + c] = B[pivot[i] * m + c];
            B[pivot[i] * m + c] = swap;
        }
    for (int i = 0; i < n; i++)
        for (int k = 0; k < i; k++)
            for (int c = 0; c < m; c++)
                B[i * m + c] -= LU[i * n + k] * B[k * m + c];
    for (int i = n - 1; i >= 0; i--)
        for (int c = 0; c < m; c++) {
            double sum = B[i * m + c];
            for (int k = i + 1; k < n; k++)
                sum -= LU[i * n + k] * B[k * m + c];
            B[i * m + c] = sum / LU[i * n + i];
        }
}
