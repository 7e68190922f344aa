#ifndef BEAMWORK_NUMERICS_IMPL_H
#define BEAMWORK_NUMERICS_IMPL_H

#include <complex.h>

#include "harness/numerics/numerics.h"

/* Candidates for the largest eigenvalues of s A x = mu K x, improved by Rayleigh quotients, checked
 * and sorted. */

typedef struct candidates {
    const eigen_problem *problem;
    /* sign s of the problem, which is reversed when the most negative values are sought */
    double sign;
    int n, count, room;
    double *mu; /* [room] descending */
    /* [room] Rayleigh quotient of the assembled matrices, which includes their rounding errors */
    double *matrix_mu;
    double *stiffness;          /* [room] x^T K x from the caller's function */
    double *x;                  /* [room x n] vectors, with x^T K x = 1 for the matrix K */
    int certain;                /* 1: the first candidate is known not to be a rounding error */
    double *work, *form, *part; /* [2 n], [n], [room] work space */
    int refinements;            /* number of refinements of every solution */
    double *correction; /* [n] work space for refined solutions; NULL: solutions are not refined */
    sparse shifted;     /* K - sign A/mu, allocated when it is first needed */
    matrix_factor *shifted_factor;
} candidates;

status candidates_alloc(candidates *p, const eigen_problem *problem, double sign, fault *f);
void candidates_free(candidates *p);
/* Returns 1 if x^T A x could be as large as `energy` because of rounding alone. */
int candidates_is_rounding(const candidates *p, double energy, const double x[]);
/* Returns the largest relative change of x^T K x due to the assembly of K, over the first `count`
 * candidates. */
double candidates_departure(const candidates *p, int count);
/* Makes all later solutions K^-1 A x use K_product, with so many iterative refinements (at most 12)
 * that their error is reduced from the current departure to 1e-6. */
status candidates_refine(candidates *p, int count, fault *f);
/* Returns the threshold below which values are rounding errors of the largest value `scale`. */
double candidates_least(int n, double scale);
/* Adds the vectors x[count x n], which may have any norm. Omits vectors with mu <= least. */
status candidates_add(candidates *p, int count, const double x[], double least, fault *f);
/* Like candidates_add, for allocated vectors, which the candidates then own. */
status candidates_take(candidates *p, int count, double *x, double least, fault *f);
/* Returns K times each candidate, [count x n], which the caller frees; NULL: out of memory. */
double *candidates_products(const candidates *p);
/* Computes the residual of candidate i and the estimated error of its mu, both relative to mu. */
void candidates_evaluate(candidates *p, int i, double *residual, double *error);

/* Sets *missing to the number of eigenvalues that are missing among the candidates and are clearly
 * larger than the candidate of rank `wanted` (counted from 1). Requires wanted <= count.
 * NOT_CONVERGED: the inertia counts fewer eigenvalues than were found, or cannot be computed. */
status candidates_count_missing(candidates *p, int wanted, int *missing, eigen_result *work,
                                fault *f);
/* Frees the memory used for counting if it is large. */
void candidates_count_rest(candidates *p);
/* Sets *above to the number of eigenvalues larger than s > 0. */
status candidates_count_above(candidates *p, double s, int *above, eigen_result *work, fault *f);

typedef struct subspace {
    eigen_product *S; /* computes y = S x, where S = K + shift M is positive definite */
    void *context;
    const sparse *M, *G; /* M has a symmetric pattern; the upper triangle of G is stored */
    int n, count, room;
    double *V, *SV, *MV, *GV; /* [room x n] basis, and its products with S, M and G */
    double *Mp, *Gp;          /* [room x room] V^T M V, V^T G V */
} subspace;

status subspace_alloc(subspace *b, eigen_product *S, void *context, const sparse *M,
                      const sparse *G, int room, fault *f);
void subspace_free(subspace *b);
/* Adds the component of x that is S-orthogonal to the basis, normalised. Returns 0 if this
 * component is negligible or the basis is full. */
int subspace_add(subspace *b, const double x[]);

typedef struct ritz {
    int room, count,
        /* largest number of pairs; number of pairs found; size of the basis when they were found */
        size;
    /* [room] eigenvalues in ascending order of magnitude, with one of each set lambda, -lambda,
     * conj lambda, -conj lambda */
    double complex *lambda;
    double complex
        *c; /* [room x basis room] coefficients of x in the basis, normalised to length 1 */
    /* coefficients of the left eigenvectors, w^H (lambda^2 M + lambda G + K) = 0; they equal those
     * of x if S = K */
    double complex *left;
} ritz;

/* Relative real part of lambda up to which it counts as rounding. */
static const double ritz_imaginary = 1e-7;

status ritz_alloc(ritz *r, int room, const subspace *b, fault *f);
void ritz_free(ritz *r);
/* Solves with S = K. Only values with a positive imaginary part are returned. */
status ritz_hermitian(const subspace *b, ritz *r, fault *f);
/* Solves with S = K + shift M. */
status ritz_general(const subspace *b, double shift, ritz *r, fault *f);

/* Accuracy of a mode found in a subspace. If w^H (lambda^2 M + lambda G + K) = 0, a change d of
 * K changes lambda by -w^H d x/(w^H (2 lambda M + G) x), and lambda w^H (2 lambda M + G) x = w^H
 * (lambda^2 M - K) x. For an oscillation, w = x, and the effect of the error of the vector is
 * quadratic: r^H S^-1 r with the residual r, divided by the distance to other frequencies. If
 * two frequencies coincide, this quotient is unbounded, and the square root of r^H S^-1 r
 * replaces it. */

typedef struct motion_estimate {
    const gyroscopic_problem *p;
    const subspace *basis;   /* basis that is orthonormal with respect to S = K + shift M */
    matrix_factor *S_factor; /* factored S */
    const ritz *pairs;
    double shift;
    int found;    /* number of returned pairs, which come first */
    double *work; /* [9 n] */
} motion_estimate;

status estimate_alloc(int n, motion_estimate *, fault *);
void estimate_free(motion_estimate *);
/* Estimates the error of pair i, x = re + i im. For an oscillation, *lambda is improved by solving
 * k - omega^2 m + omega g = 0 with the quadratic forms of x. The error of this solution is of the
 * order of the square of the error of x. grows 1: the mode is not an oscillation. *error: estimated
 * error of lambda relative to |lambda|. */
void estimate_pair(motion_estimate *, int i, const double re[], const double im[], int grows,
                   double complex *lambda, double *error);
/* Computes y = K x, using K_product if it is available. */
void estimate_stiffness(const gyroscopic_problem *, const double x[], double y[]);

/* What is solved with P A P^T = L D L^T: A, or one of the factors of A = R R^T with R = P^T L
 * sqrt(D), for a positive D. The unknowns between R and R^T are in the order of elimination. */
typedef enum triangular_part {
    TRIANGULAR_WHOLE,
    TRIANGULAR_ROOT,
    TRIANGULAR_ROOT_TRANSPOSED
} triangular_part;

/* Replaces x by R^-1 x or R^-T x. The last factored matrix must be symmetric and positive
 * definite. Counts as half a solution in the solved entries; R^-1 x counts the right-hand side. */
void factor_solve_root(matrix_factor *, triangular_part, int columns, int stride, double x[]);

/* LDL^T of a sparse symmetric matrix without pivoting (SuiteSparse AMD and LDL). The signs of D
 * give the inertia. */

typedef struct factor_symmetric factor_symmetric;

status factor_symmetric_alloc(const sparse *pattern, factor_symmetric **out, factor_counts *counts,
                              fault *f);
/* Allocates a factor for a matrix with the same pattern as `of`, whose order, pattern and work
 * space are shared. `of` must outlive the factor. The two must not be factored or used for
 * solutions at the same time. */
status factor_symmetric_alloc_like(const factor_symmetric *of, factor_symmetric **out, fault *f);
void factor_symmetric_free(factor_symmetric *fs);
/* Factors the values without allocating memory. Returns OK or SINGULAR. *weakest: unknown whose
 * pivot has lost the most digits. *ratio: this pivot divided by the magnitude of the terms of its
 * sum. */
status factor_symmetric_numeric(factor_symmetric *fs, const sparse *a, factor_counts *counts,
                                int *weakest, double *ratio);
/* Solves in place for `columns` right-hand sides, with the whole matrix or a part of it. */
void factor_symmetric_solve(factor_symmetric *fs, triangular_part, int columns, int stride,
                            double x[]);

/* LU of a sparse unsymmetric matrix. A matrix with a symmetric pattern is factored by dense fronts
 * without exchanges of rows. If this is not accurate, it is factored by SuiteSparse KLU. */

typedef struct factor_unsymmetric factor_unsymmetric;

/* copies: see factor_alloc_copies; 0: KLU factors all matrices. */
status factor_unsymmetric_alloc(const sparse *pattern, int copies, factor_unsymmetric **out,
                                factor_counts *counts, fault *f);
void factor_unsymmetric_free(factor_unsymmetric *fu);
/* Factors the values. Returns OK, SINGULAR, or FAULT if out of memory. The first pivot order is
 * used again for all later matrices, without allocation, until pivot growth requires a new order.
 * *ratio: smallest magnitude of a pivot relative to the terms of its sum (fronts), or relative to
 * the largest entry of its column, after every row is divided by its largest entry (KLU). *row,
 * *column: position of this pivot. */
status factor_unsymmetric_numeric(factor_unsymmetric *fu, const sparse *a, factor_counts *counts,
                                  int *row, int *column, double *ratio);
/* Solves in place for `columns` right-hand sides. */
void factor_unsymmetric_solve(factor_unsymmetric *fu, int columns, int stride, double x[]);
void factor_unsymmetric_solve_transposed(factor_unsymmetric *fu, double x[]);
/* Returns 1 if the last values were factored by fronts. */
int factor_unsymmetric_has_fronts(const factor_unsymmetric *fu);

/* LU by dense fronts. Every column is eliminated with its diagonal entry as the pivot. */

enum { FRONTS_LANES = 4 };

/* Some consecutive columns in the order of elimination, with the rows in which they have entries.
 * Its values are a row-major matrix [rows x stride] whose last columns are zero. The first `pivots`
 * rows and columns become those of L and U; the rest is added to the parent. */
typedef struct front {
    int first, pivots, rows, stride;
    int parent;          /* -1: none */
    size_t below, value; /* starts in `below` and `value` of the fronts */
} front;

typedef struct fronts {
    int n, copies, count, most_rows, entries;
    front *front; /* [count] in the order of elimination */
    int *order;   /* [n] order[k] is the unknown at position k */
    int *place;   /* [entries] where each entry of the matrix is in `value` */
    /* for each row of a front below its pivots: its position; its row in the parent; the index
     * after the rows that are consecutive in the parent */
    int *below, *in_parent, *until;
    size_t below_count, size;
    double *value; /* [size] */
    /* [n] magnitude of the diagonal (of copies: the largest); with rows and columns divided by its
     * square root, |L| |U| is at most sqrt(left_i right_j)/scale */
    double *scale, *left, *right;
    double *work; /* [n + most_rows + 2 FRONTS_LANES] */
} fronts;

typedef struct fronts_pivots {
    int weakest, determinant;
    double ratio, condition;
} fronts_pivots;

/* Returns NULL if the pattern is not symmetric, if fronts would be mostly zeros, or if out of
 * memory. */
fronts *fronts_alloc(const sparse *pattern, int copies, factor_counts *counts);
void fronts_free(fronts *);
/* Factors the values. Returns 0 if the factors are not accurate: if |L| |U| exceeds the scaled
 * matrix by a factor of 1e4, or if a pivot is only a rounding error or not finite. */
int triangular_fronts_factor_plain(const fronts *, const double a[], fronts_pivots *);
int triangular_fronts_factor_avx2(const fronts *, const double a[], fronts_pivots *);
void triangular_fronts_solve_plain(const fronts *, int columns, int stride, double x[]);
void triangular_fronts_solve_avx2(const fronts *, int columns, int stride, double x[]);
void triangular_fronts_solve_transposed_plain(const fronts *, double x[]);
void triangular_fronts_solve_transposed_avx2(const fronts *, double x[]);

/* Counts the negative eigenvalues of the Hermitian matrix K - omega^2 M + i omega G. If K is
 * positive definite, their number is that of the frequencies below omega. SINGULAR: omega is too
 * close to a frequency. */
status gyroscopic_count(const sparse *K, const sparse *M, const sparse *G, double omega, int *below,
                        fault *f);

/* Proves, from the negative eigenvalues of K, that no mode about an unstable state is missing.
 *
 * The problem is (lambda^2 M + lambda G + K) x = 0 with positive M. Each negative eigenvalue of K
 * belongs to a mode, so negative(K) = real + 2 complex + 2 opposed. The three numbers on the right
 * count the real lambda > 0, the lambda = a + i b with a, b > 0, and the frequencies with a
 * negative energy x^H (K + omega^2 M) x (T. Kapitula, P. Kevrekidis, B. Sandstede, Physica D 195
 * (2004) 263-282). The number of negative eigenvalues of K - omega^2 M + i omega G is then that of
 * K, plus one for each frequency with positive energy below omega, minus one for each opposed
 * frequency below omega. */

typedef struct gyroscopic_index {
    int negative; /* number of negative eigenvalues of K that the modes explain */
    /* number of frequencies with positive energy minus number of frequencies with negative
     * energy */
    int crossed;
} gyroscopic_index;

/* Returns 1 if mode i grows: if the real part of lambda is too large for a rounding error, or if
 * the energy x^H (K + |lambda|^2 M) x is zero, as it is only for growing modes. */
int gyroscopic_index_grows(const ritz *, const subspace *, double shift, int i);
/* Computes the index from the first `count` pairs found with S = K + shift M. */
gyroscopic_index gyroscopic_index_of(const ritz *, const subspace *, double shift, int count);

/* Lanczos method for the algebraically largest eigenvalues of s A x = mu K x. */

typedef struct lanczos_problem {
    const sparse *K, *A;
    matrix_factor *K_factor;
    double sign;
    int known;        /* number of eigenvectors that are removed from the problem */
    const double *KX; /* [known x n] K times each of these eigenvectors, which are K-orthonormal */
    /* largest magnitude of an eigenvalue that is known already; eigenvalues up to `least` times the
     * largest magnitude count as zero */
    double scale, least;
    int certain; /* 1: the requested eigenvalues exist */
    int spare;   /* number of the requested eigenvalues, the last ones, that may be inaccurate */
} lanczos_problem;

typedef struct lanczos_result {
    int found;    /* number of values that have converged */
    double scale; /* largest magnitude of an eigenvalue */
    double *x;    /* [found x n] vectors, which the caller frees; found 0: [n], the vector of the
                     eigenvalue with the largest magnitude */
} lanczos_result;

/* Computes the K-orthonormal vectors of `wanted` <= n - known - 1 eigenvalues in descending order.
 * Finds fewer if the others count as zero, are copies of an eigenvalue, or have not converged.
 * NOT_CONVERGED: no value has converged. */
status lanczos_largest(const lanczos_problem *p, int wanted, lanczos_result *, fault *f);
/* Products of vectors V[count x n] with w[n]: part[count] = V w, and w -= V^T part. */
void basis_measure_plain(int n, int count, const double V[], const double w[], double part[]);
void basis_measure_avx2(int n, int count, const double V[], const double w[], double part[]);
void basis_subtract_plain(int n, int count, const double V[], const double part[], double w[]);
void basis_subtract_avx2(int n, int count, const double V[], const double part[], double w[]);

/* Replaces the candidates by Ritz vectors of K^-1 A times the candidates, computed with refined
 * solutions (candidates_refine). */
status polish(candidates *p, fault *f);

/* Computes the values of L and D in P A P^T = L D L^T, row by row. The terms of every number are
 * summed in the order of SuiteSparse's ldl_numeric, so the numbers agree bitwise. */

enum { TRIANGULAR_LANES = 4, TRIANGULAR_RUN = 7 };

/* A run of consecutive columns of L with entries in the same rows below the run. */
typedef struct triangular_run {
    int first, count; /* count: 1 .. TRIANGULAR_RUN */
} triangular_run;

typedef struct triangular_rows {
    int groups; /* number of groups, each with 1 .. TRIANGULAR_LANES rows */
    const int *first_of_group, *run_of_group; /* [groups + 1] first row of each group; [groups + 1]
                                                 first run of each group */
    const triangular_run *run; /* [run_of_group[groups]] runs in the order of summation */
    const int *begin_A;        /* [n + 1] start of the entries of each row of P A P^T */
    const int *place, *source; /* for each entry: TRIANGULAR_LANES times its column + lane of its
                                  row; index in the values of A */
    const int *begin, *row;    /* L: starts of the columns [n + 1], and rows [begin[n]] */
    int *filled;               /* [n] number of entries of a column so far */
    double *value;             /* L: [begin[n]] */
    double *D;                 /* [n] */
    double *diagonal;          /* [n] magnitude of the diagonal entries of P A P^T */
    /* [n + TRIANGULAR_LANES][TRIANGULAR_LANES] work space, zero before each call */
    double *rest;
} triangular_rows;

/* Returns the column of an entry of P A P^T from its position. */
static inline int triangular_column_of(int place)
{
    return place / TRIANGULAR_LANES;
}

/* Computes the rows. Returns 0 if a pivot is zero; this row and the following rows are then not
 * computed. */
int triangular_rows_factor_plain(const triangular_rows *, const double a[]);
int triangular_rows_factor_avx2(const triangular_rows *, const double a[]);

/* Sparsity pattern of a symmetric matrix and of its factor, in the order of elimination. */
typedef struct triangular_pattern {
    int n;
    /* upper triangle of the matrix: starts of the columns [n + 1], and rows [column[n]] */
    const int *column, *row;
    const int *parent; /* [n] elimination tree; -1: a root */
    const int *begin;  /* [n + 1] starts of the columns of L */
    int *mark, *path;
} triangular_pattern;

typedef struct triangular_groups {
    int groups;
    int *first_of_group, *run_of_group;
    triangular_run *run; /* [run_of_group[groups]] */
    int columns;
    triangular_run *of_columns; /* [columns] runs of all columns */
} triangular_groups;

/* Finds the groups, and fills L_row[begin[n]]. Returns 0 if out of memory. Call
 * triangular_groups_free even after a failure. */
int triangular_groups_find(const triangular_pattern *, int L_row[], triangular_groups *out);
/* Converts rows of the matrix [column[n]] to the positions where triangular_rows adds its entries.
 * column: [n + 1]. */
void triangular_groups_place(const triangular_groups *, const int column[], int row[]);
void triangular_groups_free(triangular_groups *);

enum { TRIANGULAR_MATRICES = 2 };

/* Compute y = A x from the upper triangle of A, and the products with two matrices of the same
 * pattern. */
void triangular_product_plain(const sparse *a, const double x[], double y[]);
void triangular_product_avx2(const sparse *a, const double x[], double y[]);
void triangular_products_plain(const sparse *a, const sparse *b, const double x[], double ax[],
                               double bx[]);
void triangular_products_avx2(const sparse *a, const sparse *b, const double x[], double ax[],
                              double bx[]);

/* Solves with P^T L D L^T P, or a part of it, for one or several right-hand sides. */

enum { TRIANGULAR_TOGETHER = 4 };

typedef struct triangular_factors {
    int n;
    const int *order; /* [n] order[k] is the unknown at position k */
    /* L: starts of the columns [n + 1], and rows [begin[n]] in ascending order within each
     * column */
    const int *begin, *row;
    const double *value, *D; /* L: [begin[n]]; [n] */
    int runs;
    /* runs; each column of a run has the rows of the next column of the run and one more: the row
     * with the index of the next column */
    const triangular_run *run;
} triangular_factors;

/* Solves in place. x: `columns` right-hand sides of length n, whose starts are `stride` numbers
 * apart. work: [TRIANGULAR_TOGETHER n]. */
void triangular_solve_plain(const triangular_factors *, triangular_part, int columns, int stride,
                            double x[], double work[]);
void triangular_solve_avx2(const triangular_factors *, triangular_part, int columns, int stride,
                           double x[], double work[]);

#endif
