/* numerics/: sparse matrices, factors, eigenvalues, threads. */
#ifndef BEAMWORK_NUMERICS_H
#define BEAMWORK_NUMERICS_H

#include <stddef.h>

#include "elements/shared/status.h"

/* Sparse matrices in compressed columns, and their direct factorisation.
 *
 * Symmetric matrices store the upper triangle (row <= column) only, others all entries. Some of the
 * latter are factored as symmetric when their numbers are. The pattern is fixed once; numbers are
 * added by position, so assembly searches nothing. */

typedef struct sparse {
    int n, symmetric;
    int *column;    /* [n + 1] */
    int *row;       /* [column[n]], ascending in each column */
    double *value;  /* [column[n]] */
    int by_numbers; /* 1: stored whole; symmetric where its numbers are */
} sparse;

/* A second matrix with the same pattern shares column and row with the first and owns its values
 * only. */
status sparse_alloc_like(const sparse *pattern, sparse *out, fault *f);
void sparse_free_values(sparse *a);
void sparse_zero(sparse *a);
/* Copies the leading rows and columns of `whole`. */
void sparse_copy_leading(const sparse *whole, sparse *leading);
/* Entry (j, j); 0 where none is stored. */
double sparse_diagonal(const sparse *a, int j);
void sparse_mul(const sparse *a, const double x[], double y[]); /* y = A x */
/* Change of x^T A y by rounding of all its terms in the same direction; A symmetric, or skew where
 * the upper triangle is stored. */
double sparse_rounding(const sparse *a, const double x[], const double y[]);

/* Upper triangle of a matrix that is stored whole, and a test for symmetry. */
typedef struct by_numbers by_numbers;

status by_numbers_alloc(const sparse *pattern, by_numbers **out, fault *f);
void by_numbers_free(by_numbers *);
/* Copies the upper triangle of `a`. Returns its largest |a_ij - a_ji|/sqrt|a_ii a_jj|; INFINITY
 * where that is NaN. */
double by_numbers_take(by_numbers *, const sparse *a);
const sparse *by_numbers_upper(const by_numbers *);

typedef struct matrix_factor matrix_factor;

typedef struct factor_counts {
    long entries;        /* of the factors: fill */
    double flops;        /* of one numeric factorisation */
    long factorisations; /* numeric ones, so far */
    int negative_pivots; /* symmetric only; else -1 */
    double asymmetry;    /* of a matrix by its numbers: largest |a_ij - a_ji|/sqrt|a_ii a_jj| */
    int determinant;     /* its sign */
    double condition;    /* cheap estimate max|d|/min|d| */
} factor_counts;

/* Up to this asymmetry a matrix counts as symmetric by its numbers. */
#define FACTOR_SYMMETRIC_WITHIN 1e-11
/* Symbolic analysis once: fill-reducing order (AMD). Symmetric: LDL^T without pivoting, whose signs
 * give the inertia; unsymmetric: KLU. By its numbers: LDL^T of the upper triangle, bit-for-bit
 * that of a matrix that stores nothing else, or KLU. */
status factor_alloc(const sparse *pattern, matrix_factor **out, fault *f);
/* For a matrix with the pattern that `of` was made for: a symmetric one takes the order of `of`,
 * which must outlive it and not be factored at the same time. */
status factor_alloc_like(const matrix_factor *of, const sparse *pattern, matrix_factor **out,
                         fault *f);
void factor_free(matrix_factor *fa);
/* SINGULAR when a pivot is zero or not finite, or growth has destroyed the digits. */
status factor_numeric(matrix_factor *fa, const sparse *a, fault *f);
/* 1: the numbers factored last were taken for symmetric. */
int factor_is_symmetric(const matrix_factor *fa);
/* The upper triangle that was factored of a matrix by its numbers; NULL: none. It belongs to the
 * factor. */
const sparse *factor_upper(const matrix_factor *fa);
void factor_solve(matrix_factor *fa, double x[]); /* in place */
/* `columns` right-hand sides, each `stride` numbers after the one before it. */
void factor_solve_many(matrix_factor *fa, int columns, int stride, double x[]);
void factor_solve_transposed(matrix_factor *fa, double x[]); /* A^T x = b */
factor_counts factor_count(const matrix_factor *fa);

/* A solver that another module provides. */
typedef struct factor_operator {
    void *context;
    void (*solve)(void *context, int transposed, double x[]);
    factor_counts (*count)(const void *context);
    void (*free)(void *context);
} factor_operator;
/* factor_solve, factor_solve_transposed and factor_count are those of the operator, which the
 * factor owns; it factors no matrix. */
status factor_of(const factor_operator *, matrix_factor **out, fault *f);
/* 1-norm condition number of the factored matrix a, rows and columns scaled by the root of its
 * diagonal: Hager's estimate, a lower bound within a small factor. NAN when memory ran out. */
double factor_condition(matrix_factor *fa, const sparse *a);

/* A few eigenpairs of A x = mu K x with K symmetric positive definite and A symmetric, which may be
 * indefinite or singular.
 *
 * Buckling: A = -G, mu = 1/lambda.  Vibration: A = M, mu = 1/omega^2 (a structure without
 * supports: K + shift M in place of K). Small problems are solved densely (LAPACK), the others by
 * Lanczos in the inner product of K (ARPACK).  Each mu is the quotient of two quadratic forms,
 * which the caller can evaluate better than from the matrices, and the inertia of K - A/s proves
 * that no eigenvalue was missed, repeated ones included. */

/* Relative error of a value beyond which it has no digits. */
#define EIGEN_LARGEST_ERROR 1e-2

typedef double eigen_form(void *context, const double x[]);
typedef void eigen_product(void *context, const double x[], double y[]);

typedef struct eigen_problem {
    const sparse *K, *A;     /* same pattern */
    matrix_factor *K_factor; /* factor_numeric done */
    double sign;             /* +1: A, -1: -A is meant */
    int largest;             /* wanted number of most positive mu */
    int smallest;            /* wanted number of most negative mu */
    eigen_form *K_energy,
        *A_energy; /* x^T K x and x^T A x (A without the sign), [K's unit]; NULL: from the matrix */
    eigen_form *K_rounding, *A_rounding; /* their possible error by rounding; NULL: negligible */
    eigen_product *K_product; /* y = K x with fewer digits lost than by the matrix; NULL: none */
    void *context;            /* of all of them */
    int iterate;              /* 1: Lanczos whatever the size (for tests) */
} eigen_problem;

typedef struct eigen_side {
    int count;        /* found; fewer than wanted when no more exist, or for the reason below */
    double *mu;       /* [count] largest size first */
    double *mode;     /* [count x n] x^T K x = 1 */
    double *residual; /* [count] an eigenvalue lies within residual |mu| of mu */
    double *error; /* [count] estimate: |mu| is off by error |mu|, which is at most about residual^2
                      |mu| */
    int rounding;  /* number of candidates that were rejected as round-off of A */
    status status; /* NOT_CONVERGED: the iteration ended before all wanted ones were proved to be
                      there ... */
    char reason[FAULT_TEXT]; /* ... and why; those found are the first of their side all the same */
} eigen_side;

typedef struct eigen_result {
    int n;
    eigen_side positive, negative;
    long solutions, factorisations;
    double dense_operations; /* n^3 of what was solved densely */
} eigen_result;

/* REFUSED when K is not positive definite; NOT_CONVERGED when one of the sides is: what either side
 * found stays. Values that are a rounding error of the largest one or of their own form, or in
 * large problems 1e-9 of the largest, are taken for zero and not returned. The error of a value
 * gives the number of its digits; a value without digits is not returned. */
status eigen_solve(const eigen_problem *problem, eigen_result *out, fault *f);
void eigen_free(eigen_result *r);

/* Clocks. */

/* Wall-clock time [s] from an arbitrary origin. */
double clock_wall_seconds(void);
/* Processor time [s] of this thread: other programs on the machine do not count. */
double clock_processor_seconds(void);

/* Small motions x exp(lambda t) in a frame that turns steadily: (lambda^2 M + lambda G + K) x = 0,
 * K and M symmetric, G skew.
 *
 * With K positive definite every lambda = i omega is imaginary, whatever G is (Kelvin, Tait):
 * projected on a real basis the problem is Hermitian, mu [x; y] = [-i G, R^T; R, 0] [x; y] with mu
 * = 1/omega, M = R^T R and K the identity.  The basis starts with the modes without G and takes in
 * K^-1 times the residuals; inertia counts the frequencies, so that none is missed. With K
 * indefinite, or nearly singular as at a critical speed, K + shift M takes its place in the basis
 * and the projected problem is solved as it is; lambda has a real part where a motion grows; what
 * the count proves then: numerics_impl.h.
 *
 * Massless coordinates have no frequency. Coordinates with very little mass (frequencies above some
 * 1e4 times those of the heavy parts) may end the search before all wanted modes are found.
 *
 * Assembling K loses the digits of soft motions.  The basis is orthonormal in K_product, which
 * keeps them, and so are all residuals; the factors of the matrix only improve vectors by them. */

typedef struct gyroscopic_problem {
    const sparse *K, *M, *G; /* same symmetric pattern; of G the upper triangle is stored */
    matrix_factor
        *K_factor; /* factor_numeric done; its numbers are replaced where K is indefinite */
    int wanted;    /* number of lowest modes */
    eigen_product
        *K_product; /* y = K x with fewer digits lost than by the matrix; NULL: there is none */
    eigen_form *K_rounding; /* error of x^T K x by rounding; NULL: from the matrix */
    void *context;          /* of both */
} gyroscopic_problem;

typedef struct gyroscopic_result {
    int n, count;      /* fewer than wanted when no more exist */
    double *frequency; /* [count] lambda = growth + i frequency [1/s], ascending in size */
    double *growth;    /* [count] zero where K is positive definite */
    double *error;     /* [count] estimate: lambda is off by error |lambda| */
    double *mode;      /* [count x n] real part, the larger one, of the motion */
    int negative;      /* eigenvalues of K, and ... */
    int unproven;      /* ... those of them that no mode found accounts for: as many directions of
                          growing motions, or of frequencies of negative energy, were not found */
    long solutions, factorisations;
    double dense_operations; /* n^3 of what was solved densely */
} gyroscopic_result;

status gyroscopic_solve(const gyroscopic_problem *, gyroscopic_result *, fault *);
void gyroscopic_free(gyroscopic_result *);

/* Check of the memory before a problem is solved: a system that promises memory it does not have
 * would end the program, and others, without a message. And lists that grow. */

/* REFUSED: `what` needs more memory than the machine has. bytes: lower bound of the need. */
status memory_check(double bytes, const char *what, const char *remedy, fault *f);
/* Appends a copy of `entry`, of `size` bytes, to *list (the address of its pointer), which is freed
 * with free(). FAULT: "out of memory for WHAT". */
status memory_append(void *list, int *count, const void *entry, size_t size, const char *what,
                     fault *f);

/* Run time of a solution by parts of Newton's iterations, and the rest. The clock is the processor
 * time, as for the whole; where several threads share the elements, that of the leading thread with
 * its waiting for the others. It is read only on request and only inside an iteration. The time of
 * the readings, 0.4 us each, belongs to no part. */

typedef enum newton_phase {
    PHASE_ELEMENTS,
    PHASE_ASSEMBLY,
    PHASE_FACTORISATION,
    PHASE_SOLUTION,
    PHASE_REST, /* outside of the iterations; from here on no part of one */
    PHASES
} newton_phase;

typedef struct phases {
    int wanted, running;
    double last;            /* [s] last reading */
    double reading;         /* [s] that one takes */
    long readings;          /* between two of an iteration */
    double seconds[PHASES]; /* [s] */
} phases;

/* Sets all to zero; the time of a reading is the least of a few. */
static inline void phases_want(phases *p, int wanted)
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

/* Adds the time since the last reading to part k. */
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

/* All parts; their sum is `whole` [s] less the readings. */
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

/* Threads that share a loop. Each takes one run of consecutive indices, so that what is written
 * where does not depend on their number. */

typedef struct thread_team thread_team;
typedef void team_work(void *context, int first, int end); /* [first, end) */

/* One piece of work into a slot; all members. */
typedef void team_fill(void *context, int piece, int slot);
/* The caller uses the content of a slot; returns 0: no further piece is wanted. */
typedef int team_take(void *context, int piece, int slot);

enum { TEAM_MOST = 16, TEAM_SLOTS = 8 };

status team_alloc(int threads, thread_team **out,
                  fault *f); /* the caller is one of them; threads <= 1: *out = NULL */
void team_free(thread_team *t);
/* work over [0, count), shared; t NULL: by the caller alone. Returns when all is done. */
void team_run(thread_team *t, int count, team_work *work, void *context);
/* Pieces [0, pieces) are filled by any free thread, a few ahead, and taken in their order by the
 * caller, which fills too: slots stay in the cache, and sums keep their order. slot: below
 * TEAM_SLOTS, and 0 where t is NULL. */
void team_relay(thread_team *t, int pieces, team_fill *fill, team_take *take, void *context);

/* Matrices as lists of entries, to be kept and written. */

typedef enum matrix_kind { MATRIX_GENERAL, MATRIX_SYMMETRIC, MATRIX_SKEW } matrix_kind;

/* Entries that are not zero; where the kind is not general those on and below the diagonal only. */
typedef struct triplets {
    matrix_kind kind;
    int rows, columns, entries;
    int *row, *column; /* [entries] from zero, column by column */
    double *value;     /* [entries] */
} triplets;

/* Entries of a; skew: of a symmetric pattern the upper triangle of a skew matrix is stored. */
status triplets_of(const sparse *a, int skew, triplets *out, fault *);
/* From columns [columns x rows], one after the other. */
status triplets_of_columns(int rows, int columns, const double value[], triplets *out, fault *);
/* y[rows] = A x */
void triplets_mul(const triplets *A, const double x[], double y[]);
void triplets_free(triplets *);

#endif
