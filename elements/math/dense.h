/* Small dense algebra: vectors of 3, matrices of known small size, row-major.
 * Nothing here allocates.  Sizes that grow with a mesh belong to harness/numerics/numerics.h. */
#ifndef BEAMWORK_MATH_DENSE_H
#define BEAMWORK_MATH_DENSE_H

#include "elements/math/vec3.h"

/* C(m x n) = A(m x k) B(k x n); C must not alias A or B. */
void dense_mul(int m, int k, int n, const double *A, const double *B, double *C);
/* C(m x n) += A^T B with A(k x m), B(k x n). */
void dense_add_transpose_mul(int m, int k, int n, const double *A, const double *B, double *C);
double dense_dot(int n, const double a[], const double b[]);
double dense_quadratic(int n, const double A[], const double x[]); /* x^T A x */
/* y(m) = A(m x n) x. */
void dense_mul_vec(int m, int n, const double *A, const double *x, double *y);
/* K(n x n) += J^T S J with J(m x n), S(m x m) (S may be unsymmetric). work: m*n doubles. */
void dense_add_congruence(int m, int n, const double *J, const double *S, double *K, double *work);

/* Replaces A (n x n) by the mean of A and its transpose. Returns the largest difference of two
 * opposite entries, relative to the square roots of their diagonal entries: 0 if A is symmetric,
 * INFINITY if the diagonal is zero. */
double dense_symmetrise(int n, double *A);
/* Cholesky factorisation A = L L^T in place (lower triangle, n x n). Returns 0, or 1 + the index of
 * the failing pivot. */
int dense_cholesky(int n, double *A);
/* Solves L L^T X = B in place, B(n x m). */
void dense_cholesky_solve(int n, int m, const double *L, double *B);
/* LU factorisation with partial pivoting in place; pivot[n]. Returns 0, or 1 + the index of the
 * zero pivot. */
int dense_lu(int n, double *A, int pivot[]);
/* Like dense_lu, but a pivot that is only a rounding error of the terms from which it was computed
 * also counts as zero. */
int dense_lu_regular(int n, double *A, int pivot[]);
/* Solves A X = B in place with the factors of dense_lu, B(n x m). */
void dense_lu_solve(int n, int m, const double *LU, const int pivot[], double *B);

/* K += J^T S J with the sums along rows in registers. The result is bit-for-bit equal to that of
 * plain loops in the same order. */

enum { CONGRUENCE_WIDEST = 24 };

/* K(n x n) += J^T S J with J(m x n), S(m x m); m and n at most CONGRUENCE_WIDEST. The second
 * function is for processors with AVX2 (real.h). */
void congruence_add_plain(int m, int n, const double *J, const double *S, double *K);
void congruence_add_avx2(int m, int n, const double *J, const double *S, double *K);

#endif
