/* numerics/: sparse matrices, factors, eigenvalues, linear models and threads. */
#ifndef BEAMWORK_NUMERICS_H
#define BEAMWORK_NUMERICS_H

#include <stddef.h>

#include "elements/shared/status.h"

/* Sparse matrices in compressed columns, and their direct factorisation. Of a symmetric matrix,
 * only the upper triangle (row <= column) is stored; of any other matrix, all entries are stored.
 * by_numbers 1: all entries are stored, and the matrix is factored as symmetric if its values are
 * symmetric within FACTOR_SYMMETRIC_WITHIN. */

typedef struct sparse {
    int n, symmetric;
    int *column;   /* [n + 1] */
    int *row;      /* [column[n]] rows, in ascending order within each column */
    double *value; /* [column[n]] */
    int by_numbers;
} sparse;

/* Allocates a matrix of zeros with the pattern's `column` and `row`, which it shares. */
status sparse_alloc_like(const sparse *pattern, sparse *out, fault *f);
void sparse_free_values(sparse *a);
void sparse_zero(sparse *a);
/* Copies the values of the first leading->n rows and columns of `whole`, in which the two patterns
 * must agree. */
void sparse_copy_leading(const sparse *whole, sparse *leading);
/* Returns the position of an entry in `value`, or -1 if it is not stored. */
int sparse_position(const sparse *a, int row, int column);
/* Returns entry (j, j), or 0 if it is not stored. */
double sparse_diagonal(const sparse *a, int j);
void sparse_mul(const sparse *a, const double x[], double y[]);            /* y = A x */
void sparse_mul_transposed(const sparse *a, const double x[], double y[]); /* y = A^T x */
/* Returns eps times the sum of the absolute values of the terms of x^T A y. A may be skew-symmetric
 * with its upper triangle stored. */
double sparse_rounding(const sparse *a, const double x[], const double y[]);

typedef struct by_numbers by_numbers;

status by_numbers_alloc(const sparse *pattern, by_numbers **out, fault *f);
void by_numbers_free(by_numbers *);
/* Copies the upper triangle of `a`. Returns the largest |a_ij - a_ji|/sqrt|a_ii a_jj| of `a`;
 * INFINITY: this value is NaN. */
double by_numbers_take(by_numbers *, const sparse *a);
const sparse *by_numbers_upper(const by_numbers *);

/* Work of a thread in factors and dense matrices. */
typedef struct numerics_work {
    long solutions; /* number of right-hand sides solved with factors */
    /* sum, over these right-hand sides, of the numbers of entries of the factors */
    double solved_entries;
    double factor_flops; /* number of floating-point operations of all numeric factorisations */
    /* sum of n^3 over all dense n x n matrices that were factored or whose eigenvalues were
     * computed
     */
    double dense_operations;
} numerics_work;

/* Returns the work of this thread since it started. */
numerics_work numerics_work_done(void);
numerics_work numerics_work_since(const numerics_work *start);
void numerics_work_add(const numerics_work *);
void numerics_work_add_dense(double n); /* adds n^3 to dense_operations */

typedef struct matrix_factor matrix_factor;

typedef struct factor_counts {
    long entries; /* number of nonzero entries of the factors */
    double flops; /* number of floating-point operations of one numeric factorisation */
    long factorisations;
    int negative_pivots; /* number of negative pivots of a symmetric matrix; otherwise -1 */
    double asymmetry;    /* largest |a_ij - a_ji|/sqrt|a_ii a_jj| of a matrix with by_numbers */
    int determinant;
    double
        condition; /* inexpensive estimate of the condition number, max|d|/min|d| of the pivots d */
    /* 1: A is singular to working precision, but its factors are those of a matrix that differs
     * from A by rounding errors */
    int lost;
} factor_counts;

#define FACTOR_SYMMETRIC_WITHIN 1e-11
/* Makes a symbolic analysis, once, with an order that reduces fill-in (AMD). A symmetric matrix is
 * factored as LDL^T without pivoting; the signs of D give the inertia. An unsymmetric matrix is
 * factored by KLU. A matrix with by_numbers is factored as LDL^T, from its upper triangle,
 * if its asymmetry is at most FACTOR_SYMMETRIC_WITHIN, and otherwise by KLU. */
status factor_alloc(const sparse *pattern, matrix_factor **out, fault *f);
/* Like factor_alloc, for an unsymmetric matrix of a motion, which is factored by dense fronts, and
 * by KLU only if rows must be exchanged. The matrix consists of [copies x copies] blocks of equal
 * size, such as the stages of a step. The unknowns with the same index in all blocks are eliminated
 * one after the other, the last block first. */
status factor_alloc_copies(const sparse *pattern, int copies, matrix_factor **out, fault *f);
/* Like factor_alloc, for a matrix with the same pattern as `of`. A symmetric matrix uses the order
 * of `of`, which must outlive the new factor. */
status factor_alloc_like(const matrix_factor *of, const sparse *pattern, matrix_factor **out,
                         fault *f);
void factor_free(matrix_factor *fa);
/* Factors the values. SINGULAR: a pivot is zero, not finite or only a rounding error. FAULT: out of
 * memory. */
status factor_numeric(matrix_factor *fa, const sparse *a, fault *f);
/* Reports a singular stiffness matrix. Returns SINGULAR. */
status factor_report_singular(fault *f);
/* Returns 1 if the last values were factored as symmetric. */
int factor_is_symmetric(const matrix_factor *fa);
/* Returns the upper triangle of a matrix with by_numbers that was factored as symmetric, otherwise
 * NULL. The factor owns this triangle. */
const sparse *factor_upper(const matrix_factor *fa);
void factor_solve(matrix_factor *fa, double x[]); /* solves A x = b in place */
/* Solves for `columns` right-hand sides. Their starts are `stride` numbers apart. */
void factor_solve_many(matrix_factor *fa, int columns, int stride, double x[]);
void factor_solve_transposed(matrix_factor *fa, double x[]); /* solves A^T x = b in place */
factor_counts factor_count(const matrix_factor *fa);

typedef struct factor_operator {
    void *context;
    void (*solve)(void *context, int transposed, double x[]);
    factor_counts (*count)(const void *context);
    void (*free)(void *context);
} factor_operator;
/* Makes a factor from an operator, which is freed with the factor, or at once if this function
 * fails. factor_solve, factor_solve_transposed and factor_count call the operator, and no matrix is
 * factored. */
status factor_of(const factor_operator *, matrix_factor **out, fault *f);
/* Returns an estimate of the 1-norm condition number of the factored matrix a, with rows and
 * columns divided by the square roots of its diagonal. NAN: out of memory. */
double factor_condition(matrix_factor *fa, const sparse *a);

/* A few eigenpairs of A x = mu K x with K symmetric positive definite and A symmetric, which may be
 * indefinite or singular.
 *
 * Buckling: A = -G, mu = 1/lambda. Vibration: A = M, mu = 1/omega^2 (for a structure without
 * supports, K + shift M replaces K). Small problems are solved with dense matrices (LAPACK), large
 * problems by the Lanczos method in the inner product of K. Each mu is the quotient of two
 * quadratic forms, which the caller can evaluate more accurately than the matrices do. In large
 * problems, the inertia of K - A/s with s between two eigenvalues proves that no eigenvalue is
 * missing, including repeated eigenvalues. */

/* An eigenvalue with a larger relative error has no significant digits. */
#define EIGEN_LARGEST_ERROR 1e-2

typedef double eigen_form(void *context, const double x[]);
typedef void eigen_product(void *context, const double x[], double y[]);

typedef struct eigen_problem {
    const sparse *K, *A;     /* both have the same pattern */
    matrix_factor *K_factor; /* factor of K after factor_numeric */
    double sign;             /* +1: A; -1: -A */
    int largest;             /* number of requested eigenvalues mu on the most positive side */
    int smallest;            /* number of requested eigenvalues mu on the most negative side */
    /* return x^T K x and x^T A x (A without the sign), in the unit of K; NULL: the matrix is
     * used */
    eigen_form *K_energy, *A_energy;
    eigen_form *K_rounding,
        *A_rounding; /* return estimated rounding errors of the two forms; NULL: negligible */
    eigen_product *K_product; /* computes y = K x more accurately than the matrix product; NULL: not
                                 available */
    void *context;            /* passed to all functions of this structure */
    int iterate; /* 1: the Lanczos method is used for small problems as well (for tests) */
} eigen_problem;

typedef struct eigen_side {
    /* number of eigenvalues; smaller than requested if there are no more, or because of `reason` */
    int count;
    double *mu;       /* [count] largest magnitude first; NaN: lost in rounding errors */
    double *mode;     /* [count x n] vectors with x^T K x = 1 */
    double *residual; /* [count] the distance from mu to an eigenvalue is at most residual |mu| */
    double *error; /* [count] estimated relative error of mu, about residual^2 if mu is isolated */
    int rounding;  /* number of candidates that were rejected as rounding errors of A */
    /* NOT_CONVERGED: the iteration ended before the requested eigenvalues were proved to be
     * complete, or a value is NaN */
    status status;
    /* reason for NOT_CONVERGED; the values found are still the first values of their side */
    char reason[FAULT_TEXT];
} eigen_side;

typedef struct eigen_result {
    int n;
    eigen_side positive, negative;
    long factorisations;
} eigen_result;

/* Solves the problem. REFUSED: K is not positive definite, or was not factored as symmetric.
 * NOT_CONVERGED: one of the sides did not converge; the values found on both sides are kept. A
 * value is not returned if it does not exceed the rounding error of the largest value or of its
 * quadratic form or, in large problems, below 1e-9 of the largest value. */
status eigen_solve(const eigen_problem *problem, eigen_result *out, fault *f);
void eigen_free(eigen_result *r);

/* Eigenpairs with the largest eigenvalues of a real unsymmetric operator, from the projection of
 * the operator on a growing orthonormal basis (Arnoldi). For such an operator, there is no inertia
 * count that could prove that no eigenvalue is missing. Therefore, after the requested eigenvalues
 * have converged, further start vectors are added until one of them gives no new eigenvalue of this
 * magnitude. */

typedef struct arnoldi_result {
    /* number of eigenvalues. It is smaller than `wanted` if the remaining eigenvalues are rounding
     * errors, and larger by one if the last eigenvalue is the first of a conjugate pair. */
    int count;
    /* [count] eigenvalues, with the largest magnitude first and conjugates next to each other */
    double _Complex *theta;
    double _Complex *mode; /* [count x n] eigenvectors of length 1 */
    double *residual;      /* [count] |T x - theta x|/|theta| */
    double next; /* approximate magnitude of the largest other eigenvalue; 0: there is none */
} arnoldi_result;

typedef struct arnoldi_problem {
    int n, wanted;
    void (*apply)(void *context, const double x[], double y[]); /* y = T x */
    void *context;
    int values_only; /* 1: the result contains neither modes nor residuals */
    int rough;       /* 1: six digits of real eigenvalues that are not nearly equal are enough */
    /* For few coordinates, T is formed as a matrix. Then `left` receives the eigenvectors of the
     * transpose of T, if it is not NULL. */
    arnoldi_result *left;
} arnoldi_problem;

status arnoldi_solve(const arnoldi_problem *, arnoldi_result *, fault *);
void arnoldi_free(arnoldi_result *);

/* Returns the wall-clock time [s] from an arbitrary origin. */
double clock_wall_seconds(void);

void stop_observe(int descriptor);
/* Returns FAULT if this thread must stop. Iterations and steps of motions call this function. */
status stop_check(fault *f);
/* Returns the processor time [s] of this thread, which the load of other programs does not
 * affect. */
double clock_processor_seconds(void);

/* Small motions x exp(lambda t) in a frame that rotates at a constant rate: (lambda^2 M + lambda G
 * + K) x = 0, with symmetric K and M and skew-symmetric G.
 *
 * If K is positive definite, every lambda = i omega is imaginary for any G (Kelvin, Tait).
 * Projected on a real basis, the problem is then Hermitian: mu [x; y] = [-i G, R^T; R, 0] [x; y]
 * with mu = 1/omega, M = R^T R and K the identity matrix. The basis starts with the modes for G = 0
 * and is extended by K^-1 times the residuals. The inertia counts the frequencies and proves that
 * none is missing. If K is indefinite, or nearly singular as at a critical speed, K + shift M
 * replaces it in the basis and the general projected problem is solved. A growing mode then has a
 * lambda with positive real part; numerics_impl.h explains what the count proves in this case.
 *
 * Massless coordinates have no frequency.
 *
 * The assembly of K loses digits of soft motions, which K_product keeps. */

typedef struct gyroscopic_problem {
    /* K, M and G have the same pattern; the upper triangle of each is stored */
    const sparse *K, *M, *G;
    /* factor after factor_numeric; its values are replaced if K + shift M replaces K */
    matrix_factor *K_factor;
    int wanted;               /* number of requested modes, which have the lowest frequencies */
    eigen_product *K_product; /* computes y = K x more accurately than the matrix product; NULL: not
                                 available */
    /* returns the rounding error of x^T K x; NULL: estimated from the matrix */
    eigen_form *K_rounding;
    void *context; /* passed to both functions */
} gyroscopic_problem;

typedef struct gyroscopic_result {
    int n, count; /* count: number of modes; smaller than requested if there are no more, or if the
                     others have no significant digits */
    /* [count] imaginary part of lambda = growth + i frequency [1/s], in ascending order of
     * |lambda| */
    double *frequency;
    double *growth; /* [count] real part of lambda; zero for oscillations */
    double *error;  /* [count] estimated error of lambda, relative to |lambda| */
    double *mode;   /* [count x n] real part of the motion, at the phase at which it is largest */
    int negative;   /* number of negative eigenvalues of K */
    /* number of negative eigenvalues of K that the modes do not explain: as many growing modes, or
     * modes with negative energy, are missing */
    int unproven;
    long factorisations;
} gyroscopic_result;

status gyroscopic_solve(const gyroscopic_problem *, gyroscopic_result *, fault *);
void gyroscopic_free(gyroscopic_result *);

/* REFUSED: `what` needs more memory than the machine has or this process may use. bytes: lower
 * bound of the required memory. */
status memory_check(double bytes, const char *what, const char *remedy, fault *f);
/* Appends a copy of `entry` (`size` bytes) to the list at *list. The caller frees the list with
 * free(). FAULT: "out of memory for WHAT", where WHAT is the text `what`. */
status memory_append(void *list, int *count, const void *entry, size_t size, const char *what,
                     fault *f);

/* Processor time of a solution, divided into the parts of a Newton iteration and the remaining
 * time. If several threads share the elements, the time is that of the leading thread, including
 * the time in which it waits. */

typedef enum newton_phase {
    PHASE_ELEMENTS,
    PHASE_ASSEMBLY,
    PHASE_FACTORISATION,
    PHASE_SOLUTION,
    PHASE_REST, /* time outside the iterations */
    PHASES
} newton_phase;

typedef struct phases {
    int wanted, running;
    double last;    /* [s] time of the last reading */
    double reading; /* [s] duration of a reading */
    long readings;  /* number of readings inside iterations */
    double seconds[PHASES];
} phases;

/* Sets all parts to zero. wanted 1: also measures the duration of a reading, which is the shortest
 * of several. */
static inline void phases_request(phases *p, int wanted)
{
    enum { FEW = 50 };
    *p = (phases){.wanted = wanted, .reading = 1};
    for (int i = 0; wanted && i < FEW; i++) {
        const double start = clock_processor_seconds(), took = clock_processor_seconds() - start;
        if (took < p->reading)
            p->reading = took;
    }
}

static inline void phases_start(phases *p)
{
    p->running = p->wanted;
    if (p->running)
        p->last = clock_processor_seconds();
}

static inline void phases_lap(phases *p, newton_phase k)
{
    if (!p->running)
        return;
    const double now = clock_processor_seconds();
    p->seconds[k] += now - p->last - p->reading;
    p->readings++;
    p->last = now;
}

static inline void phases_stop(phases *p)
{
    p->running = 0;
}

/* Computes the durations of all parts. Their sum is `whole` [s] minus the duration of the
 * readings. */
static inline void phases_of_whole(const phases *p, double whole, double part[PHASES])
{
    part[PHASE_REST] = whole - (double)p->readings * p->reading;
    for (int k = 0; k < PHASE_REST; k++) {
        part[k] = p->seconds[k];
        part[PHASE_REST] -= part[k];
    }
}

static inline const char *phase_name(newton_phase k)
{
    static const char *const name[PHASES] = {"elements", "assembly", "factorisation", "solution",
                                             "rest"};
    return name[k];
}

/* Threads that share a loop. */

typedef struct thread_pool thread_pool;
typedef void thread_pool_work(void *context, int first, int end); /* [first, end) */

/* Computes a piece of the work and stores the results in a slot. */
typedef void thread_pool_fill(void *context, int piece, int slot);
/* Uses the contents of a slot, in the calling thread. Returns 0 to stop. */
typedef int thread_pool_take(void *context, int piece, int slot);

enum { THREAD_POOL_MOST = 16, THREAD_POOL_SLOTS = 8 };

status thread_pool_alloc(int threads, thread_pool **out,
                         fault *f); /* the caller counts as one thread; threads <= 1: *out is NULL;
                                       at most THREAD_POOL_MOST threads */
void thread_pool_free(thread_pool *t);
/* Runs `work` over [0, count) on all threads, and returns when all work is done. t NULL: only the
 * calling thread is used. */
void thread_pool_run(thread_pool *t, int count, thread_pool_work *work, void *context);
/* Fills and uses the pieces [0, pieces). Any free thread fills the next piece, at most
 * THREAD_POOL_SLOTS pieces ahead of the caller. The caller uses the pieces in order, and also fills
 * pieces. */
void thread_pool_relay(thread_pool *t, int pieces, thread_pool_fill *fill, thread_pool_take *take,
                       void *context);

typedef enum matrix_kind { MATRIX_GENERAL, MATRIX_SYMMETRIC, MATRIX_SKEW } matrix_kind;

/* Nonzero entries of a matrix; only those of the lower triangle if the matrix is symmetric or
 * skew-symmetric. */
typedef struct triplets {
    matrix_kind kind;
    int rows, columns, entries;
    int *row, *column; /* [entries] indices from zero; column by column for a general matrix, row by
                          row otherwise */
    double *value;
} triplets;

/* Sets *out to the entries of `a`. skew 1: `a` contains the upper triangle of a skew-symmetric
 * matrix. */
status triplets_of(const sparse *a, int skew, triplets *out, fault *);
/* Removes all rows and columns except the leading n. */
void triplets_lead(triplets *, int n);
/* Copies the nonzero entries of a dense matrix [columns x rows], column by column. */
status triplets_of_columns(int rows, int columns, const double value[], triplets *out, fault *);
/* Computes y[rows] = A x. */
void triplets_mul(const triplets *A, const double x[], double y[]);
void triplets_free(triplets *);

/* Linear models with inputs u and outputs y, as dense matrices row by row: M q'' + C q' + K q = B
 * u, y = L0 q + L1 q' + L2 q'' + D u. The last coordinates are prescribed motions, whose
 * accelerations are inputs. Their rows of M and B are those of the identity matrix, and their rows
 * of K and C are zero. */
typedef struct second_order {
    /* number of coordinates other than prescribed motions, and number of prescribed motions */
    int n, motions;
    int inputs, outputs;
    /* [inputs] prescribed motion whose acceleration is the input; -1: the input is a force */
    int *motion_of;
    double *K, *C, *M; /* [(n + motions)^2] */
    double *B;         /* [(n + motions) x inputs] */
    double *L[3], *D;  /* [outputs x (n + motions)], [outputs x inputs] */
} second_order;

status second_order_alloc(int n, int motions, int inputs, int outputs, second_order *, fault *);
void second_order_free(second_order *);

/* Computes a reduced model q = T x. The caller frees T [(n + motions) x (out->n + motions)] in any
 * case. T consists of the static shapes of the interface coordinates (edge[n] 1) and the first
 * modes with the interface fixed. Without an interface, T consists of modes and the static shapes
 * of forces. The last columns are the static shapes of the prescribed motions. REFUSED: the
 * structure can move while the interface is fixed, or has fewer modes with mass than *modes. *modes
 * becomes the number of modes in T, which is larger if the requested number would separate modes
 * with the same frequency. */
status second_order_reduce(const second_order *, const char edge[], int *modes, second_order *out,
                           double **T, fault *);
/* Computes the undamped natural frequencies hertz[n] [Hz] in ascending order, with the prescribed
 * motions at rest. NAN: a coordinate without mass; all NAN: K is not positive definite. */
status second_order_frequencies(const second_order *, double hertz[], fault *);
/* Computes the transfer functions from u to y at a circular frequency: out[outputs x inputs x 2],
 * real and imaginary parts. rounding[outputs x inputs]: bound of the rounding errors, for which
 * kind[n + motions] contains small numbers, equal for coordinates with the same unit; both may be
 * NULL. SINGULAR: the functions are infinite. */
status second_order_transfer(const second_order *, double w, double out[], const char kind[],
                             double rounding[], fault *);

/* State-space form x' = A x + B u, y = C x + D u, as dense matrices row by row. */
typedef struct state_space {
    int states, eliminated; /* eliminated: number of coordinates without mass and without damping */
    int improper;           /* index of an output that has no state-space form; -1: none */
    double *A, *B, *C, *D;
} state_space;

/* Computes the state-space form. The caller frees *out, even after a failure. REFUSED: there is no
 * state-space form; the message gives the reason. */
status state_space_of(const second_order *, state_space *out, fault *);
void state_space_free(state_space *);

/* A feedback loop. It adds proportional (r - y) + derivative (r' - y') + integral (integral of r -
 * y), multiplied by `times`, to an input. y is the output `measured`, and y' is the output `rate`
 * (only if there is a derivative gain). */
typedef struct state_space_loop {
    int input, measured, rate;
    int reference; /* input that becomes the rate of r; the input must have no other effect */
    double times, proportional, derivative, integral;
} state_space_loop;

status state_space_close(state_space *, int inputs, int outputs, int loops,
                         const state_space_loop[], fault *);

#endif
