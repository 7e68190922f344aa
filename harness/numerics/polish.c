/* With Y = K^-1 s A X the projections need no product with K: Y^T K Y = Y^T s A X. */
#include "harness/numerics/polish.h"

#include <lapacke.h>
#include <stdlib.h>

#include "elements/math/dense.h"

/* Ax = s A x. */
static void signed_product(const candidates *p, const double x[], double Ax[])
{
    sparse_mul(p->problem->A, x, Ax);
    for (int i = 0; i < p->n; i++)
        Ax[i] *= p->sign;
}

/* Column-major Y^T K Y and Y^T s A Y, upper triangles. */
static void project(candidates *p, const double Y[], double K[], double A[])
{
    const size_t n = (size_t)p->n, count = (size_t)p->count;
    for (size_t j = 0; j < count; j++) {
        signed_product(p, p->x + j * n, p->work);
        for (size_t i = 0; i <= j; i++)
            K[j * count + i] = dense_dot(p->n, Y + i * n, p->work);
        signed_product(p, Y + j * n, p->work);
        for (size_t i = 0; i <= j; i++)
            A[j * count + i] = dense_dot(p->n, Y + i * n, p->work);
    }
}

/* Y <- Y C, column-major C[count x count]; row[count] is work space. */
static void combine(size_t n, size_t count, double Y[], const double C[], double row[])
{
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < count; k++)
            row[k] = Y[k * n + i];
        for (size_t j = 0; j < count; j++)
            Y[j * n + i] = dense_dot((int)count, row, C + j * count);
    }
}

/* The Ritz vectors of Y = K^-1 s A X become the candidates; where LAPACK fails they stay as they
 * are.  Y[count x n], small[2 count^2 + count]. */
static status replace(candidates *p, double Y[], double small[], long *solutions, fault *f)
{
    const size_t n = (size_t)p->n, count = (size_t)p->count;
    double *A = small, *K = A + count * count, *mu = K + count * count;
    const int m = (int)count;
    for (size_t i = 0; i < count; i++)
        candidates_apply(p, p->x + i * n, Y + i * n);
    *solutions += m;
    project(p, Y, K, A);
    if (LAPACKE_dsygv(LAPACK_COL_MAJOR, 1, 'V', 'U', m, A, m, K, m, mu) != 0)
        return STATUS_OK;
    combine(n, count, Y, A, mu);
    p->count = 0;
    return candidates_add(p, m, Y, 0, f);
}

status polish(candidates *p, long *solutions, fault *f)
{
    const size_t n = (size_t)p->n, count = (size_t)p->count;
    double *Y = malloc((count * n + 1) * sizeof *Y),
           *small = calloc(2 * count * count + count + 1, sizeof *small);
    const status outcome =
        Y != NULL && small != NULL
            ? replace(p, Y, small, solutions, f)
            : fault_set(f, STATUS_FAULT, "out of memory for %zu vectors of %zu unknowns", count, n);
    free(Y);
    free(small);
    return outcome;
}
