/* Small dense algebra: vectors of 3 and matrices of known small size, row-major. No function
 * allocates memory. */
#ifndef BEAMWORK_MATH_DENSE_H
#define BEAMWORK_MATH_DENSE_H

#include "elements/math/vec3.h"

/* Computes C(m x n) = A(m x k) B(k x n). C must not alias A or B. */
void dense_mul(int m, int k, int n, const double *A, const double *B, double *C);
/* Adds A^T B to C(m x n), with A(k x m) and B(k x n). */
void dense_add_transpose_mul(int m, int k, int n, const double *A, const double *B, double *C);
double dense_dot(int n, const double a[], const double b[]);
double dense_quadratic(int n, const double A[], const double x[]); /* returns x^T A x */
/* Computes y(m) = A(m x n) x. */
void dense_mul_vec(int m, int n, const double *A, const double *x, double *y);
/* Adds J^T S J to K(n x n), with J(m x n) and S(m x m). S may be unsymmetric. `work` has m*n
 * entries. */
void dense_add_congruence(int m, int n, const double *J, const double *S, double *K, double *work);
/* Adds A^T S J to K(n x n), with A(m x n), S(m x m) and J(m x n). `work` has m*n entries. */
void dense_add_between(int m, int n, const double *A, const double *S, const double *J, double *K,
                       double *work);

/* Adds rows and columns of zeros to K in place: K[n x n] -> K[wide x wide]. */
void dense_widen(int n, int wide, double K[]);

/* Replaces A (n x n) by the mean of A and its transpose. Returns the largest difference of two
 * opposite entries, divided by the square root of the product of their diagonal entries. Returns 0
 * if A is symmetric. Returns INFINITY if two opposite entries differ and a diagonal entry of theirs
 * is zero or the difference is not finite. */
double dense_symmetrise(int n, double *A);
/* Computes the Cholesky factorisation A = L L^T in place (lower triangle, n x n). Returns 0, or 1 +
 * the index of the pivot that fails. */
int dense_cholesky(int n, double *A);
/* Solves L L^T X = B(n x m) in place. */
void dense_cholesky_solve(int n, int m, const double *L, double *B);
/* Computes the LU factorisation with partial pivoting in place. pivot[n]: rows that were exchanged.
 * Returns 0, or 1 + the index of the first pivot that is zero or not finite. */
int dense_lu(int n, double *A, int pivot[]);
/* Computes the factorisation of dense_lu, but treats a pivot as zero if it is only a rounding error
 * of the terms from which it was computed. */
int dense_lu_regular(int n, double *A, int pivot[]);
/* Solves A X = B(n x m) in place with the factors of dense_lu. */
void dense_lu_solve(int n, int m, const double *LU, const int pivot[], double *B);

enum { CONGRUENCE_WIDEST = 24 };

/* Adds J^T S J to K(n x n), with J(m x n) and S(m x m), where m and n are at most
 * CONGRUENCE_WIDEST. Results are bit-for-bit identical to those of plain loops in the same order.
 * The second function is for processors with AVX2 (real.h). */
void congruence_add_plain(int m, int n, const double *J, const double *S, double *K);
void congruence_add_avx2(int m, int n, const double *J, const double *S, double *K);
/* The same with A^T S J. */
void congruence_add_between_plain(int m, int n, const double *A, const double *S, const double *J,
                                  double *K);
void congruence_add_between_avx2(int m, int n, const double *A, const double *S, const double *J,
                                 double *K);
enum { UPPER_COLUMNS = 14 };
/* Adds factor T^T U to the upper half of A, with T and U of one or three rows of UPPER_COLUMNS, and
 * changes A next to its diagonal. */
void congruence_add_upper_plain(int rows, double factor, const double *T, const double *U,
                                double *A);
void congruence_add_upper_avx2(int rows, double factor, const double *T, const double *U,
                               double *A);

#endif
