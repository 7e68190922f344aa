/* The inside of numerics/. */
#ifndef BEAMWORK_NUMERICS_IMPL_H
#define BEAMWORK_NUMERICS_IMPL_H

#include <complex.h>

#include "harness/numerics/numerics.h"

/* Candidates for the largest eigenvalues of s A x = mu K x: refined by Rayleigh's quotient, judged
 * and sorted. */

typedef struct candidates {
    const eigen_problem *problem;
    double sign; /* s: of the problem, reversed for the most negative values */
    int n, count, room;
    double *mu;          /* [room] descending */
    double *matrix_mu;   /* [room] the same quotient of the matrices as they are, rounding errors of
                            all elements included */
    double *noise;       /* [room] part of it that rounding the sums changes */
    double *stiffness;   /* [room] x^T K x as the caller evaluates it */
    double *x;           /* [room x n] x^T K x = 1 by the matrix */
    double *work, *form; /* [n] each */
    int refinements;     /* of every solution */
    double *correction;  /* [n] while solutions are refined, else NULL */
    sparse shifted;      /* K - s A/mu; without values until it is needed */
    matrix_factor *shifted_factor;
} candidates;

status candidates_alloc(candidates *p, const eigen_problem *problem, double sign, fault *f);
void candidates_free(candidates *p);
/* Size of the largest |mu|, from below, by a few powers of K^-1 A; 0 where A is nothing but
 * rounding. */
double candidates_scale(candidates *p, long *solutions);
/* 1: rounding alone makes x^T A x as large as `energy`. */
int candidates_is_rounding(const candidates *p, double energy, const double x[]);
/* Largest part of x^T K x that assembling K has changed, of the first `count` candidates. */
double candidates_departure(const candidates *p, int count);
/* From here on K^-1 A x is what K_product says: refined until the present departure leaves 1e-6 of
 * it. */
status candidates_refine(candidates *p, int count, fault *f);
/* y = K^-1 s A x. */
void candidates_apply(candidates *p, const double x[], double y[]);
/* Values below are rounding errors of the largest one, `scale`: n^(3/2) of them add up in a slender
 * structure of n unknowns. */
double candidates_least(int n, double scale);
/* Takes in vectors x[count x n], whatever their length; those with mu <= least are dropped. */
status candidates_add(candidates *p, int count, const double x[], double least, fault *f);
/* The same of vectors that were allocated and are the candidates' from now on. */
status candidates_take(candidates *p, int count, double *x, double least, fault *f);
/* K times each candidate, [count x n], for the caller to free; NULL: out of memory. */
double *candidates_products(const candidates *p);
/* Residual of candidate i and estimated error of its mu, both relative to mu. One solution. */
void candidates_judge(candidates *p, int i, double *residual, double *error);

/* Proof that no eigenvalue is missing among candidates. */

/* How many of the eigenvalues that lie clearly above the one of rank `wanted` (counted from 1) are
 * not among the candidates. NOT_CONVERGED when there are fewer than candidates. */
status candidates_count_missing(candidates *p, int wanted, int *missing, eigen_result *work,
                                fault *f);
/* Frees what counting keeps, where it is large: the next count allocates it again. */
void candidates_count_rest(candidates *p);
/* How many eigenvalues are larger than s > 0. */
status candidates_count_above(candidates *p, double s, int *above, eigen_result *work, fault *f);

/* Eigenvectors of small problems: all of them, by LAPACK. */

/* The first wanted[i] of the most positive (0) and of the most negative (1) side become candidates;
 * NULL: a side that is not requested. */
status eigen_dense_add(candidates *const side[2], const int wanted[2], fault *f);

/* A growing real basis V of a quadratic eigenvalue problem, orthonormal in K + shift M, with the
 * matrices projected on it. */

typedef struct subspace {
    eigen_product *S; /* y = S x, S = K + shift M, positive definite */
    void *context;
    const sparse *M, *G; /* of G a symmetric pattern stores the upper triangle */
    int n, count, room;
    double *V, *SV, *MV, *GV; /* [room x n] the basis and its products */
    double *Mp, *Gp;          /* [room x room] V^T M V, V^T G V */
} subspace;

status subspace_alloc(subspace *b, eigen_product *S, void *context, const sparse *M,
                      const sparse *G, int room, fault *f);
void subspace_free(subspace *b);
/* Takes in what x adds to the basis; returns 1 if that was anything and there was room. */
int subspace_add(subspace *b, const double x[]);
/* y = G x with G skew, of which the upper triangle is stored. */
void subspace_skew_mul(const sparse *G, const double x[], double y[]);

/* Approximate eigenpairs of (lambda^2 M + lambda G + K) x = 0 in a subspace: dense problems of
 * twice its size (LAPACK). */

typedef struct ritz {
    int room, count, size;  /* pairs wanted and found; vectors in the basis when they were */
    double complex *lambda; /* [room], ascending in size; one of every lambda, -lambda, conj lambda,
                               -conj lambda */
    double complex *c;      /* [room x basis room] coefficients of x in the basis, of length 1 */
    double complex *left; /* the same of w, w^H (lambda^2 M + lambda G + K) = 0; with S = K it is x
                           */
} ritz;

/* Real part of lambda that is round-off, relative to |lambda|. */
static const double ritz_imaginary = 1e-7;

status ritz_alloc(ritz *r, int room, const subspace *b, fault *f);
void ritz_free(ritz *r);
/* Solves with S = K: Hermitian, every lambda is imaginary, and the positive ones are found. */
status ritz_hermitian(const subspace *b, ritz *r, fault *f);
/* Solves with S = K + shift M. */
status ritz_general(const subspace *b, double shift, ritz *r, fault *f);

/* How many digits a motion has that was found in a subspace.
 *
 * With w^H (lambda^2 M + lambda G + K) = 0 and a change d of K, lambda moves by w^H d x/(w^H
 * (2 lambda M + G) x), and lambda w^H (2 lambda M + G) x = w^H (lambda^2 M - K) x.  Of an
 * oscillation w is x, and what the vector misses counts as its square: r^H S^-1 r of the residual
 * r, by the distance of the frequencies it may belong to.  Where two frequencies meet that has no
 * bound, and the root of the change has. */

typedef struct motion_estimate {
    const gyroscopic_problem *p;
    const subspace *basis;   /* orthonormal in S = K + shift M, ... */
    matrix_factor *S_factor; /* ... which is factored as a matrix */
    const ritz *pairs;
    double shift;
    int found;    /* the pairs that are handed over: the first of them */
    double *work; /* [11 n] */
    long solutions;
} motion_estimate;

status estimate_alloc(int n, motion_estimate *, fault *);
void estimate_free(motion_estimate *);
/* Pair i, x = re + i im; grows: not an oscillation.  *lambda: of an oscillation better, the
 * quotient of quadratic forms k - omega^2 m + omega g = 0, whose error is the square of the
 * vector's; *error: an estimate, |lambda| is off by error |lambda|. */
void estimate_pair(motion_estimate *, int i, const double re[], const double im[], int grows,
                   double complex *lambda, double *error);
/* y = K x */
void estimate_stiffness(const gyroscopic_problem *, const double x[], double y[]);

/* LDL^T of a sparse symmetric matrix without pivoting (SuiteSparse AMD and LDL): the signs of D are
 * the inertia. */

typedef struct factor_symmetric factor_symmetric;

status factor_symmetric_alloc(const sparse *pattern, factor_symmetric **out, factor_counts *counts,
                              fault *f);
/* Allocates for a matrix with the same pattern: order, pattern and workspace are those of `of`,
 * which must outlive it; only one of the two may be factored at a time. */
status factor_symmetric_alloc_like(const factor_symmetric *of, factor_symmetric **out, fault *f);
void factor_symmetric_free(factor_symmetric *fs);
/* OK or SINGULAR; allocates nothing. *weakest: unknown whose pivot lost most digits; *ratio: its
 * size by that of the terms it is the sum of. */
status factor_symmetric_numeric(factor_symmetric *fs, const sparse *a, factor_counts *counts,
                                int *weakest, double *ratio);
/* In place: `columns` right-hand sides, each `stride` numbers after the one before it. */
void factor_symmetric_solve(factor_symmetric *fs, int columns, int stride, double x[]);

/* LU of a sparse unsymmetric matrix with partial pivoting (SuiteSparse KLU). */

typedef struct factor_unsymmetric factor_unsymmetric;

status factor_unsymmetric_alloc(const sparse *pattern, factor_unsymmetric **out,
                                factor_counts *counts, fault *f);
void factor_unsymmetric_free(factor_unsymmetric *fu);
/* OK, SINGULAR, or FAULT when memory ran out. The pivots chosen once serve all later matrices (and
 * nothing is allocated) until their growth asks for new ones. *row, *column: of the smallest pivot;
 * *ratio: its size by the largest entries of these. */
status factor_unsymmetric_numeric(factor_unsymmetric *fu, const sparse *a, factor_counts *counts,
                                  int *row, int *column, double *ratio);
/* In place: `columns` right-hand sides, each `stride` numbers after the one before it. */
void factor_unsymmetric_solve(factor_unsymmetric *fu, int columns, int stride, double x[]);
void factor_unsymmetric_solve_transposed(factor_unsymmetric *fu, double x[]);

/* How many frequencies lie below one: the negative eigenvalues of the Hermitian K - omega^2 M + i
 * omega G, K positive definite. */

/* SINGULAR when omega is too near to a frequency. */
status gyroscopic_count(const sparse *K, const sparse *M, const sparse *G, double omega, int *below,
                        fault *f);

/* Proof that no mode about an unstable state is missing, from the negative eigenvalues of K.
 *
 * (lambda^2 M + lambda G + K) x = 0 with M positive.  Each negative eigenvalue of K belongs to a
 * motion:  negative(K) = real + 2 complex + 2 opposed  counts the growing lambda > 0, the
 * lambda = a + i b with a, b > 0, and the frequencies whose energy x^H (K + omega^2 M) x is
 * negative (T. Kapitula, P. Kevrekidis, B. Sandstede, Physica D 195 (2004) 263-282).  When those
 * found make up the number, none of them is missing.  Then K - omega^2 M + i omega G has the
 * negative eigenvalues of K, one more for each frequency of positive energy below omega, and one
 * less for each opposed one. */

typedef struct gyroscopic_index {
    int negative; /* eigenvalues of K that the modes account for */
    int crossed;  /* frequencies of positive energy less the opposed ones */
} gyroscopic_index;

/* Does motion i grow? Its energy is zero then; that of an oscillation is not, so that its real part
 * is rounding, and none. Where two frequencies meet there is neither: they count as oscillations.
 */
int gyroscopic_index_grows(const ritz *, const subspace *, double shift, int i);
/* Index of the first `count` pairs, found with S = K + shift M. */
gyroscopic_index gyroscopic_index_of(const ritz *, const subspace *, double shift, int count);

/* Implicitly restarted Lanczos (ARPACK) for the algebraically largest eigenvalues of s A x = mu K
 * x. */

typedef struct lanczos_problem {
    const sparse *K, *A;
    matrix_factor *K_factor;
    double sign;      /* s */
    int known;        /* eigenvectors that are taken out of the problem ... */
    const double *X;  /* ... [known x n], K-orthonormal */
    const double *KX; /* [known x n] K times each */
} lanczos_problem;

/* `wanted` <= n - known - 1 eigenvalues mu[wanted] in descending order with K-orthonormal vectors
 * (*x)[wanted x n], which the caller frees; `found` of them, at least one, where the iteration
 * ended before the others had converged. */
status lanczos_largest(const lanczos_problem *p, int wanted, int *found, double mu[], double **x,
                       long *solutions, fault *f);

/* Candidates made better where assembling K has lost digits of its soft motions. */

/* Replaces the candidates by Ritz vectors among K^-1 A times them, with refined solutions
 * (candidates_refine): parts that are not among them shrink by the quotient of their mu and the
 * candidate's. One refined solution each. */
status polish(candidates *p, long *solutions, fault *f);

/* The numbers of L and D in P A P^T = L D L^T, row by row. Rows that follow each other and have the
 * same columns, but for themselves, are made side by side, one in each lane; columns that follow
 * each other, each with the next one and the rows of that, are subtracted together. Every number is
 * the sum of its terms in the order of the columns, so that all have the bits of SuiteSparse's
 * ldl_numeric. */

enum { TRIANGULAR_LANES = 4, TRIANGULAR_RUN = 7 };

/* Columns of L that rows have. */
typedef struct triangular_run {
    int first, count; /* 1 .. TRIANGULAR_RUN */
} triangular_run;

typedef struct triangular_rows {
    int groups;                               /* of 1 .. TRIANGULAR_LANES rows */
    const int *first_of_group, *run_of_group; /* [groups + 1] */
    const triangular_run *run;                /* [run_of_group[groups]] in the order of sums */
    const int *begin_A;                       /* [n + 1] entries of each row of P A P^T ... */
    const int *place, *source; /* ... column TRIANGULAR_LANES + lane of the row; index in a */
    const int *begin, *row;    /* L: [n + 1], [begin[n]] */
    int *filled;               /* [n] entries of a column so far */
    double *value;             /* L: [begin[n]] */
    double *D;                 /* [n] */
    double *diagonal;          /* [n] of |A| */
    double *rest; /* [n + TRIANGULAR_LANES][TRIANGULAR_LANES] work space, zero before and after */
} triangular_rows;

/* The column of an entry of P A P^T, from its place. */
static inline int triangular_column_of(int place)
{
    return place / TRIANGULAR_LANES;
}

/* 0: a pivot is zero, and the rows from there on are not made. The second is for processors with
 * AVX2: elements/math/real.h. */
int triangular_rows_factor_plain(const triangular_rows *, const double a[]);
int triangular_rows_factor_avx2(const triangular_rows *, const double a[]);

/* Which rows of L are made together, and which columns they take together. */

/* A symmetric matrix and its factor, in the order of elimination. */
typedef struct triangular_pattern {
    int n;
    const int *column, *row; /* upper triangle of the matrix: [n + 1], [column[n]] */
    const int *parent;       /* [n] elimination tree, -1: a root */
    const int *begin;        /* [n + 1] of L */
    int *mark, *path;        /* [n] work space */
} triangular_pattern;

typedef struct triangular_groups {
    int groups;
    int *first_of_group, *run_of_group; /* [groups + 1] */
    triangular_run *run;                /* [run_of_group[groups]] */
    int columns;                        /* runs of all columns ... */
    triangular_run *of_columns;         /* ... [columns] */
} triangular_groups;

/* Fills L_row[begin[n]] too. 0: out of memory; triangular_groups_free in either case. */
int triangular_groups_find(const triangular_pattern *, int L_row[], triangular_groups *out);
/* Rows of the matrix [column[n]] into where triangular_rows adds its entries; column: [n + 1]. */
void triangular_groups_place(const triangular_groups *, const int column[], int row[]);
void triangular_groups_free(triangular_groups *);

/* P^T L D L^T P x = b for one or several right-hand sides at once. Every number is the sum of its
 * terms in the order of SuiteSparse's ldl_lsolve and ldl_ltsolve: the same bits, however many are
 * solved together. */

enum { TRIANGULAR_TOGETHER = 4 };

typedef struct triangular_factors {
    int n;
    const int *order;          /* [n] place k has unknown order[k] */
    const int *begin, *row;    /* L: [n + 1], [begin[n]] ascending in each column */
    const double *value, *D;   /* L: [begin[n]]; [n] */
    int runs;                  /* all columns: each but the last of a run has the next one ... */
    const triangular_run *run; /* ... and the rows of that */
} triangular_factors;

/* In place. x: `columns` right-hand sides [n], each `stride` numbers after the one before it; work:
 * [TRIANGULAR_TOGETHER n]. The second is for processors with AVX2: elements/math/real.h. */
void triangular_solve_plain(const triangular_factors *, int columns, int stride, double x[],
                            double work[]);
void triangular_solve_avx2(const triangular_factors *, int columns, int stride, double x[],
                           double work[]);

#endif
