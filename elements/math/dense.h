/* Small dense algebra: vectors of 3, matrices of known small size, row-major.
 * Nothing here allocates.  Sizes that grow with a mesh belong to harness/algebra/sparse.h. */
#ifndef BEAMWORK_DENSE_H
#define BEAMWORK_DENSE_H

#include <math.h>

static inline double vec3_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void vec3_cross(const double a[3], const double b[3],
                              double c[3]) /* c must not alias */
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline double vec3_norm(const double a[3])
{
    return hypot(hypot(a[0], a[1]), a[2]);
}

/* |d| - l0 for d = d0 + moved, |d0| = l0: (2 d - moved) . moved/(|d| + l0), no difference of nearly
 * equal lengths. */
static inline double vec3_elongation(const double d[3], const double moved[3], double l0)
{
    const double sum[3] = {2 * d[0] - moved[0], 2 * d[1] - moved[1], 2 * d[2] - moved[2]};
    return vec3_dot(sum, moved) / (sqrt(vec3_dot(d, d)) + l0);
}

static inline void mat3_mul(const double A[9], const double B[9],
                            double C[9]) /* C = A B, no alias */
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            C[3 * i + j] = A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j];
}

static inline void mat3_transpose_mul(const double A[9], const double B[9],
                                      double C[9]) /* C = A^T B, no alias */
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            C[3 * i + j] = A[i] * B[j] + A[3 + i] * B[3 + j] + A[6 + i] * B[6 + j];
}

static inline void mat3_mul_vec(const double A[9], const double v[3], double w[3]) /* no alias */
{
    for (int i = 0; i < 3; i++)
        w[i] = A[3 * i] * v[0] + A[3 * i + 1] * v[1] + A[3 * i + 2] * v[2];
}

static inline void mat3_transpose_mul_vec(const double A[9], const double v[3],
                                          double w[3]) /* w = A^T v, no alias */
{
    for (int i = 0; i < 3; i++)
        w[i] = A[i] * v[0] + A[3 + i] * v[1] + A[6 + i] * v[2];
}

/* C(m x n) = A(m x k) B(k x n); C must not alias. */
void dense_mul(int m, int k, int n, const double *A, const double *B, double *C);
/* C(m x n) += A^T B with A(k x m), B(k x n). */
void dense_add_transpose_mul(int m, int k, int n, const double *A, const double *B, double *C);
double dense_dot(int n, const double a[], const double b[]);
double dense_quadratic(int n, const double A[], const double x[]); /* x^T A x */
/* y(m) = A(m x n) x. */
void dense_mul_vec(int m, int n, const double *A, const double *x, double *y);
/* K(n x n) += J^T S J with J(m x n), S(m x m) (S need not be symmetric); work: m*n doubles. */
void dense_add_congruence(int m, int n, const double *J, const double *S, double *K, double *work);

/* Cholesky A = L L^T in place (lower triangle, n x n); 0, or 1 + the index of the failing pivot. */
int dense_cholesky(int n, double *A);
/* Solves L L^T X = B in place, B(n x m). */
void dense_cholesky_solve(int n, int m, const double *L, double *B);
/* LU with partial pivoting in place; pivot[n]; 0, or 1 + the index of the zero pivot. */
int dense_lu(int n, double *A, int pivot[]);
/* The same, and 1 + the index of the first pivot that is a rounding error of the terms it is the
 * difference of. */
int dense_lu_regular(int n, double *A, int pivot[]);
/* Solves A X = B in place with the factors of dense_lu, B(n x m). */
void dense_lu_solve(int n, int m, const double *LU, const int pivot[], double *B);

#endif
