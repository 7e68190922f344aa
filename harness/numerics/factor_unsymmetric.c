/* KLU scales every row by its largest entry and orders by AMD on A + A^T; diagonal pivots are
 * preferred. */
#include "harness/numerics/factor_unsymmetric.h"

#include <float.h>
#include <klu.h>
#include <math.h>
#include <stdlib.h>

struct factor_unsymmetric {
    int n;
    klu_common common;
    klu_symbolic *symbolic;
    klu_numeric *numeric;
    double *largest; /* [n] entry of every column of the scaled matrix */
};

/* Old pivots are kept while the entries of U stay below this many times those of the matrix. */
static const double tolerable_growth = 1e4;

status factor_unsymmetric_alloc(const sparse *pattern, factor_unsymmetric **out,
                                factor_counts *counts, fault *f)
{
    factor_unsymmetric *fu = *out = calloc(1, sizeof *fu);
    if (fu == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for factors");
    fu->n = pattern->n;
    counts->negative_pivots = -1;
    klu_defaults(&fu->common);
    fu->largest = malloc((size_t)fu->n * sizeof *fu->largest);
    fu->symbolic = klu_analyze(fu->n, pattern->column, pattern->row, &fu->common);
    if (fu->largest != NULL && fu->symbolic != NULL)
        return STATUS_OK;
    if (fu->common.status == KLU_SINGULAR)
        return fault_set(f, STATUS_SINGULAR,
                         "the matrix is singular whatever its numbers: something is not held");
    return fault_set(f, STATUS_FAULT, "out of memory for ordering %d unknowns", fu->n);
}

void factor_unsymmetric_free(factor_unsymmetric *fu)
{
    if (fu == NULL)
        return;
    klu_free_numeric(&fu->numeric, &fu->common);
    klu_free_symbolic(&fu->symbolic, &fu->common);
    free(fu->largest);
    free(fu);
}

/* 1: the numeric factors belong to a, with the pivots of an earlier matrix. */
static int refactor(factor_unsymmetric *fu, const sparse *a)
{
    return fu->numeric != NULL &&
           klu_refactor(a->column, a->row, a->value, fu->symbolic, fu->numeric, &fu->common) &&
           fu->common.status == KLU_OK &&
           klu_rgrowth(a->column, a->row, a->value, fu->symbolic, fu->numeric, &fu->common) &&
           fu->common.rgrowth * tolerable_growth > 1;
}

static status factor_anew(factor_unsymmetric *fu, const sparse *a, factor_counts *counts)
{
    klu_free_numeric(&fu->numeric, &fu->common);
    fu->numeric = klu_factor(a->column, a->row, a->value, fu->symbolic, &fu->common);
    if (fu->numeric == NULL)
        return fu->common.status == KLU_SINGULAR ? STATUS_SINGULAR : STATUS_FAULT;
    klu_flops(fu->symbolic, fu->numeric, &fu->common);
    counts->entries =
        (long)fu->numeric->lnz + fu->numeric->unz - fu->n; /* both count the diagonal */
    counts->flops = fu->common.flops;
    return STATUS_OK;
}

/* Sign of a permutation: every member of a cycle but the first is one exchange. `done` is work
 * space. */
static int sign_of(int n, const int permutation[], double done[])
{
    int sign = 1;
    for (int i = 0; i < n; i++)
        done[i] = 0;
    for (int i = 0; i < n; i++)
        for (int k = i, length = 0; done[k] == 0; k = permutation[k], length++) {
            done[k] = 1;
            sign = length == 0 ? sign : -sign;
        }
    return sign;
}

/* P R^-1 A Q is block triangular with the pivots on its diagonal. */
static int determinant_of(factor_unsymmetric *fu)
{
    int sign = sign_of(fu->n, fu->numeric->Pnum, fu->largest) *
               sign_of(fu->n, fu->symbolic->Q, fu->largest);
    for (int k = 0; k < fu->n; k++)
        sign = ((const double *)fu->numeric->Udiag)[k] < 0 ? -sign : sign;
    return sign;
}

static status judge_pivots(factor_unsymmetric *fu, const sparse *a, factor_counts *counts, int *row,
                           int *column, double *ratio)
{
    const klu_numeric *u = fu->numeric;
    const double *pivot = u->Udiag;
    double largest = 0, smallest = INFINITY;
    for (int j = 0; j < fu->n; j++) {
        fu->largest[j] = 0;
        for (int k = a->column[j]; k < a->column[j + 1]; k++)
            fu->largest[j] = fmax(fu->largest[j], fabs(a->value[k]) / u->Rs[u->Pinv[a->row[k]]]);
    }
    *ratio = INFINITY;
    for (int k = 0; k < fu->n; k++) {
        const double d = fabs(pivot[k]), part = d / fu->largest[fu->symbolic->Q[k]];
        if (!isfinite(d) || d == 0)
            return STATUS_SINGULAR;
        if (part < *ratio) {
            *ratio = part;
            *row = u->Pnum[k];
            *column = fu->symbolic->Q[k];
        }
        largest = fmax(largest, d);
        smallest = fmin(smallest, d);
    }
    counts->condition = largest / smallest;
    return STATUS_OK;
}

status factor_unsymmetric_numeric(factor_unsymmetric *fu, const sparse *a, factor_counts *counts,
                                  int *row, int *column, double *ratio)
{
    if (!refactor(fu, a)) {
        TRY(factor_anew(fu, a, counts));
    }
    counts->determinant = determinant_of(fu);
    return judge_pivots(fu, a, counts, row, column, ratio);
}

void factor_unsymmetric_solve(factor_unsymmetric *fu, int columns, int stride, double x[])
{
    klu_solve(fu->symbolic, fu->numeric, stride, columns, x, &fu->common);
}

void factor_unsymmetric_solve_transposed(factor_unsymmetric *fu, double x[])
{
    klu_tsolve(fu->symbolic, fu->numeric, fu->n, 1, x, &fu->common);
}
