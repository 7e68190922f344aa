/* Frequencies in a rotating frame: problems with dense matrices, and their solution by LAPACK. */
#ifndef BEAMWORK_TEST_GYROSCOPIC_PROBLEM_H
#define BEAMWORK_TEST_GYROSCOPIC_PROBLEM_H

#include <gsl/gsl_test.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>

#include "harness/numerics/numerics.h"
#include "harness/numerics/test/matrices.h"

enum { WANTED = 8 };

/* Dense matrices, row-major [n x n]. G is skew. */
typedef struct problem {
    int n;
    double *K, *M, *G;
} problem;

static inline void gyroscopic_problem_alloc(int n, problem *p)
{
    p->n = n;
    p->K = calloc(3 * (size_t)n * (size_t)n, sizeof(double));
    p->M = p->K + n * n;
    p->G = p->M + n * n;
}

/* Fills K, M and G. K has eigenvalues of many magnitudes; softening * n is subtracted from its
 * diagonal, and it is positive definite for softening 0. M is zero for the last `massless`
 * coordinates and definite for the others. G is proportional to `gyroscopic`. */
static inline void gyroscopic_problem_fill(problem *p, double gyroscopic, int massless,
                                           double softening)
{
    const int n = p->n;
    uint64_t seed = (unsigned long long)n * 77 + 5;
    double *B = malloc((size_t)n * (size_t)n * sizeof *B);
    for (int i = 0; i < n * n; i++)
        B[i] = random_number(&seed);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            for (int k = 0; k < n; k++)
                p->K[i * n + j] += B[i * n + k] * B[j * n + k] * (1 + k * k);
            p->M[i * n + j] = i < n - massless && j < n - massless
                                  ? (i == j ? 1 + 0.3 * i / n : 0.2 / (1 + abs(i - j)))
                                  : 0;
            const double upper = 0.3 + B[(i < j ? i : j) * n + (i < j ? j : i)];
            p->G[i * n + j] = gyroscopic * ((i < j) - (i > j)) * upper;
        }
    for (int i = 0; i < n; i++)
        p->K[i * n + i] += n - softening * n;
    free(B);
}

static inline sparse gyroscopic_problem_upper(int n, const double A[])
{
    sparse s = {n, 1, calloc((size_t)n + 1, sizeof(int)), NULL, NULL, 0};
    s.row = malloc((size_t)n * (size_t)(n + 1) / 2 * sizeof *s.row);
    s.value = malloc((size_t)n * (size_t)(n + 1) / 2 * sizeof *s.value);
    for (int j = 0, at = 0; j < n; j++) {
        for (int i = 0; i <= j; i++) {
            s.row[at] = i;
            s.value[at++] = A[i * n + j];
        }
        s.column[j + 1] = at;
    }
    return s;
}

static inline int gyroscopic_problem_ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Finds all frequencies in ascending order, which belong to almost imaginary lambda, and the
 * largest real part of all lambda, at least 0. Returns the number of frequencies. */
static inline int gyroscopic_problem_by_lapack(const problem *p, double frequency[], double *growth)
{
    const int n = p->n, m = 2 * n;
    double *A = calloc((size_t)m * (size_t)m, sizeof *A),
           *B = calloc((size_t)m * (size_t)m, sizeof *B);
    double *re = calloc(3 * (size_t)m, sizeof *re), *im = re + m, *beta = im + m;
    int count = 0;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) { /* matrices of nu [K, 0; 0, 1] z = [-G, -M; 1, 0] z with nu =
                                         1/lambda, column-major */
            A[j * m + i] = -p->G[i * n + j];
            A[(n + j) * m + i] = -p->M[i * n + j];
            B[j * m + i] = p->K[i * n + j];
        }
        A[i * m + n + i] = B[(n + i) * m + n + i] = 1;
    }
    gsl_test(LAPACKE_dggev(LAPACK_COL_MAJOR, 'N', 'N', m, A, m, B, m, re, im, beta, NULL, m, NULL,
                           m) != 0,
             "LAPACK");
    *growth = 0;
    for (int i = 0; i < m; i++) {
        const double size = hypot(re[i], im[i]);
        if (!(size > 1e-7 * fabs(beta[i])))
            continue;
        const double real_part = beta[i] * re[i] / (size * size),
                     imaginary = -beta[i] * im[i] / (size * size);
        *growth = fmax(*growth, real_part);
        if (imaginary > 0 && fabs(real_part) < 1e-6 * imaginary)
            frequency[count++] = imaginary;
    }
    qsort(frequency, (size_t)count, sizeof *frequency, gyroscopic_problem_ascending);
    free(A);
    free(B);
    free(re);
    return count;
}

static inline void gyroscopic_problem_product(void *context, const double x[], double y[])
{
    const problem *p = context;
    for (int i = 0; i < p->n; i++) {
        y[i] = 0;
        for (int j = 0; j < p->n; j++)
            y[i] += p->K[i * p->n + j] * x[j];
    }
}

/* Solves the problem with K_of as the sparse matrix of K. If a product K x and its rounding error
 * are given, they are used. */
static inline status gyroscopic_problem_solve_by(problem *p, const double K_of[],
                                                 eigen_product *product, eigen_form *rounding,
                                                 gyroscopic_result *r, fault *f)
{
    sparse K = gyroscopic_problem_upper(p->n, K_of), M = gyroscopic_problem_upper(p->n, p->M),
           G = gyroscopic_problem_upper(p->n, p->G);
    matrix_factor *factors = NULL;
    status outcome = factor_alloc(&K, &factors, f);
    if (outcome == STATUS_OK)
        outcome = factor_numeric(factors, &K, f);
    const gyroscopic_problem problem_ = {.K = &K,
                                         .M = &M,
                                         .G = &G,
                                         .K_factor = factors,
                                         .wanted = WANTED,
                                         .K_product = product,
                                         .K_rounding = rounding,
                                         .context = p};
    if (outcome == STATUS_OK)
        outcome = gyroscopic_solve(&problem_, r, f);
    factor_free(factors);
    matrices_free(&K);
    matrices_free(&M);
    matrices_free(&G);
    return outcome;
}

static inline status gyroscopic_problem_solve(const problem *p, gyroscopic_result *r, fault *f)
{
    problem copy = *p;
    return gyroscopic_problem_solve_by(&copy, p->K, NULL, NULL, r, f);
}

#endif
