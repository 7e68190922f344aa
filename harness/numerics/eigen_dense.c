#include "harness/numerics/eigen_dense.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>

static void fill_dense(const sparse *a, double factor_, double D[])
{
    const size_t n = (size_t)a->n;
    for (size_t j = 0; j < n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++)
            D[(size_t)a->row[k] * n + j] = D[j * n + (size_t)a->row[k]] = factor_ * a->value[k];
}

/* All eigenvalues mu[n], ascending, with their vectors x[n x n], one after the other. */
static status solve_dense(const eigen_problem *e, double mu[], double x[], fault *f)
{
    const int n = e->K->n;
    double *K = calloc((size_t)n * (size_t)n, sizeof *K);
    if (K == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a dense matrix of %d unknowns", n);
    fill_dense(e->A, e->sign, x);
    fill_dense(e->K, 1, K);
    const int info = LAPACKE_dsygv(LAPACK_COL_MAJOR, 1, 'V', 'U', n, x, n, K, n, mu);
    free(K);
    return info == 0
               ? STATUS_OK
               : fault_set(f, STATUS_NOT_CONVERGED,
                           "a dense eigenvalue problem of %d unknowns: LAPACK says %d", n, info);
}

/* Candidates of one or both sides (NULL: not asked for) from all eigenvectors; mu[n], x[n x n]. */
static status take_dense(candidates *const side[2], const int wanted[2], double mu[], double x[],
                         fault *f)
{
    const candidates *any = side[0] != NULL ? side[0] : side[1];
    const size_t n = (size_t)any->n;
    TRY(solve_dense(any->problem, mu, x, f));
    const double least = candidates_least(any->n, fmax(fabs(mu[0]), fabs(mu[n - 1])));
    for (int i = 0; i < 2; i++) {
        const size_t count = (size_t)(wanted[i] < any->n ? wanted[i] : any->n);
        if (side[i] != NULL) /* the most positive ones come last */
            TRY(candidates_add(side[i], (int)count, i == 0 ? x + (n - count) * n : x, least, f));
    }
    return STATUS_OK;
}

status eigen_dense_add(candidates *const side[2], const int wanted[2], fault *f)
{
    const size_t n = (size_t)(side[0] != NULL ? side[0] : side[1])->n;
    double *mu = calloc(n, sizeof *mu), *x = calloc(n * n, sizeof *x);
    const status outcome =
        mu != NULL && x != NULL
            ? take_dense(side, wanted, mu, x, f)
            : fault_set(f, STATUS_FAULT, "out of memory for an eigenvalue problem");
    free(mu);
    free(x);
    return outcome;
}
