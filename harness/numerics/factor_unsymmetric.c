/* KLU scales every row by its largest entry and orders by AMD on A + A^T. Diagonal pivots are
 * preferred. It is used only after a matrix that the fronts cannot factor accurately. */

#include "harness/numerics/numerics_impl.h"

#include <klu.h>
#include <math.h>
#include <stdlib.h>

#include "elements/math/real.h"

struct factor_unsymmetric {
    int n;
    fronts *fronts; /* NULL: KLU factors all matrices */
    int by_fronts;  /* 1: the last matrix was factored by fronts */
    factor_counts of_fronts;
    klu_common common;
    klu_symbolic *symbolic;
    klu_numeric *numeric;
    double *largest;
};

/* The pivot order is reused as long as the entries of U are below this factor times the entries of
 * the matrix. */
static const double tolerable_growth = 1e4;

static status analyse(factor_unsymmetric *fu, const sparse *pattern, fault *f)
{
    fu->symbolic = klu_analyze(fu->n, pattern->column, pattern->row, &fu->common);
    if (fu->symbolic != NULL)
        return STATUS_OK;
    if (fu->common.status == KLU_SINGULAR)
        return fault_set(f, STATUS_SINGULAR,
                         "the matrix is structurally singular, because a part is not supported; "
                         "support this part");
    return fault_memory(f, "ordering %d unknowns", fu->n);
}

status factor_unsymmetric_alloc(const sparse *pattern, int copies, factor_unsymmetric **out,
                                factor_counts *counts, fault *f)
{
    factor_unsymmetric *fu = *out = calloc(1, sizeof *fu);
    if (fu == NULL)
        return fault_memory(f, "factors");
    fu->n = pattern->n;
    counts->negative_pivots = -1;
    klu_defaults(&fu->common);
    fu->largest = malloc(((size_t)fu->n + 1) * sizeof *fu->largest);
    if (fu->largest == NULL)
        return fault_memory(f, "ordering %d unknowns", fu->n);
    fu->fronts = copies > 0 ? fronts_alloc(pattern, copies, counts) : NULL;
    fu->of_fronts = *counts;
    return fu->fronts != NULL ? STATUS_OK : analyse(fu, pattern, f);
}

void factor_unsymmetric_free(factor_unsymmetric *fu)
{
    if (fu == NULL)
        return;
    fronts_free(fu->fronts);
    klu_free_numeric(&fu->numeric, &fu->common);
    klu_free_symbolic(&fu->symbolic, &fu->common);
    free(fu->largest);
    free(fu);
}

/* Factors `a` with the pivot order of an earlier matrix. Returns 0 if there is no earlier matrix,
 * or if this order is not accurate for `a`. */
static int refactor(factor_unsymmetric *fu, const sparse *a)
{
    return fu->numeric != NULL &&
           klu_refactor(a->column, a->row, a->value, fu->symbolic, fu->numeric, &fu->common) &&
           fu->common.status == KLU_OK &&
           klu_rgrowth(a->column, a->row, a->value, fu->symbolic, fu->numeric, &fu->common) &&
           fu->common.rgrowth * tolerable_growth > 1;
}

static status factor_anew(factor_unsymmetric *fu, const sparse *a)
{
    klu_free_numeric(&fu->numeric, &fu->common);
    fu->numeric = klu_factor(a->column, a->row, a->value, fu->symbolic, &fu->common);
    if (fu->numeric == NULL)
        return fu->common.status == KLU_SINGULAR ? STATUS_SINGULAR : STATUS_FAULT;
    klu_flops(fu->symbolic, fu->numeric, &fu->common);
    return STATUS_OK;
}

/* Returns the sign of a permutation. A cycle of k members consists of k - 1 exchanges. done: work
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

/* Returns the sign of the determinant. P R^-1 A Q is block triangular and has the pivots on its
 * diagonal. */
static int determinant_of(factor_unsymmetric *fu)
{
    int sign = sign_of(fu->n, fu->numeric->Pnum, fu->largest) *
               sign_of(fu->n, fu->symbolic->Q, fu->largest);
    for (int k = 0; k < fu->n; k++)
        sign = ((const double *)fu->numeric->Udiag)[k] < 0 ? -sign : sign;
    return sign;
}

static status check_pivots(factor_unsymmetric *fu, const sparse *a, factor_counts *counts, int *row,
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

static int factor_by_fronts(factor_unsymmetric *fu, const sparse *a, factor_counts *counts,
                            int *row, int *column, double *ratio)
{
    fronts_pivots pivots;
    if (fu->fronts == NULL || !REAL_CHOSEN(triangular_fronts_factor)(fu->fronts, a->value, &pivots))
        return 0;
    counts->entries = fu->of_fronts.entries;
    counts->flops = fu->of_fronts.flops;
    counts->determinant = pivots.determinant;
    counts->condition = pivots.condition;
    *row = *column = pivots.weakest;
    *ratio = pivots.ratio;
    return 1;
}

status factor_unsymmetric_numeric(factor_unsymmetric *fu, const sparse *a, factor_counts *counts,
                                  int *row, int *column, double *ratio)
{
    fu->by_fronts = factor_by_fronts(fu, a, counts, row, column, ratio);
    if (fu->by_fronts)
        return STATUS_OK;
    if (fu->symbolic == NULL && analyse(fu, a, NULL) != STATUS_OK)
        return STATUS_FAULT;
    if (!refactor(fu, a)) {
        TRY(factor_anew(fu, a));
    }
    counts->entries = (long)fu->numeric->lnz + fu->numeric->unz - fu->n;
    counts->flops = fu->common.flops;
    counts->determinant = determinant_of(fu);
    return check_pivots(fu, a, counts, row, column, ratio);
}

void factor_unsymmetric_solve(factor_unsymmetric *fu, int columns, int stride, double x[])
{
    if (fu->by_fronts)
        REAL_CHOSEN(triangular_fronts_solve)(fu->fronts, columns, stride, x);
    else
        klu_solve(fu->symbolic, fu->numeric, stride, columns, x, &fu->common);
}

void factor_unsymmetric_solve_transposed(factor_unsymmetric *fu, double x[])
{
    if (fu->by_fronts)
        REAL_CHOSEN(triangular_fronts_solve_transposed)(fu->fronts, x);
    else
        klu_tsolve(fu->symbolic, fu->numeric, fu->n, 1, x, &fu->common);
}

int factor_unsymmetric_has_fronts(const factor_unsymmetric *fu)
{
    return fu->by_fronts;
}
