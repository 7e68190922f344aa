/* Symmetric: AMD order and LDL of SuiteSparse, on the permuted upper triangle. Unsymmetric: KLU. */
#include <amd.h>
#include <float.h>
#include <klu.h>
#include <ldl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/sparse.h"

struct factor {
    int n, symmetric;
    factor_counts counts;
    /* Symmetric: C = upper triangle of P A P^T, place[k] of A's k-th entry in it. */
    int *order, *inverse, *column, *row, *place, *parent, *column_count, *flag, *L_column, *L_row, *stack;
    double *value, *L_value, *D, *work, *diagonal;
    /* Unsymmetric. */
    klu_common common;
    klu_symbolic *symbolic;
    klu_numeric *numeric;
    double *residual;
};

static int *integers(int n)
{
    return malloc((size_t)(n > 0 ? n : 1) * sizeof(int));
}

static double *doubles(int n)
{
    return malloc((size_t)(n > 0 ? n : 1) * sizeof(double));
}

/* Upper triangle of P A P^T and where the entries of A go. */
static void permute(const sparse *a, factor *fa)
{
    const int n = a->n;
    memset(fa->column, 0, ((size_t)n + 1) * sizeof *fa->column);
    for (int pass = 0; pass < 2; pass++) {
        for (int j = 0; j < n; j++)
            for (int k = a->column[j]; k < a->column[j + 1]; k++) {
                const int i = fa->inverse[a->row[k]], jj = fa->inverse[j], low = i < jj ? i : jj, high = i < jj ? jj : i;
                if (pass == 0) {
                    fa->column[high + 1]++;
                } else {
                    fa->place[k] = fa->flag[high]++;
                    fa->row[fa->place[k]] = low;
                }
            }
        for (int j = 0; j < n && pass == 0; j++) {
            fa->column[j + 1] += fa->column[j];
            fa->flag[j] = fa->column[j];
        }
    }
}

static status analyse_symmetric(const sparse *a, factor *fa, fault *f)
{
    const int n = a->n, entries = a->column[n];
    int **const lists[] = {&fa->order, &fa->inverse, &fa->parent, &fa->column_count, &fa->flag, &fa->stack};
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++)
        if ((*lists[i] = integers(n)) == NULL)
            return fault_set(f, STATUS_FAULT, "out of memory for factors");
    fa->column = integers(n + 1);
    fa->L_column = integers(n + 1);
    fa->row = integers(entries);
    fa->place = integers(entries);
    fa->value = doubles(entries);
    fa->D = doubles(n);
    fa->work = doubles(n);
    fa->diagonal = doubles(n);
    if (fa->column == NULL || fa->L_column == NULL || fa->row == NULL || fa->place == NULL || fa->value == NULL || fa->D == NULL ||
        fa->work == NULL || fa->diagonal == NULL || amd_order(n, a->column, a->row, fa->order, NULL, NULL) < AMD_OK)
        return fault_set(f, STATUS_FAULT, "out of memory for factors");
    for (int i = 0; i < n; i++)
        fa->inverse[fa->order[i]] = i;
    permute(a, fa);
    ldl_symbolic(n, fa->column, fa->row, fa->L_column, fa->parent, fa->column_count, fa->flag, NULL, NULL);
    fa->counts.entries = fa->L_column[n] + n;
    for (int j = 0; j < n; j++) {
        const double below = fa->L_column[j + 1] - fa->L_column[j];
        fa->counts.flops += below * (below + 2);
    }
    fa->L_row = integers(fa->L_column[n]);
    fa->L_value = doubles(fa->L_column[n]);
    if (fa->L_row == NULL || fa->L_value == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for %ld entries of a factor", fa->counts.entries);
    return STATUS_OK;
}

static status analyse_unsymmetric(const sparse *a, factor *fa, fault *f)
{
    klu_defaults(&fa->common);
    fa->symbolic = klu_analyze(a->n, a->column, a->row, &fa->common);
    if (fa->symbolic == NULL)
        return fault_set(f, fa->common.status == KLU_SINGULAR ? STATUS_SINGULAR : STATUS_FAULT,
                         fa->common.status == KLU_SINGULAR ? "the matrix has an empty row: something is not held"
                                                           : "out of memory for factors");
    fa->counts.negative_pivots = -1;
    return STATUS_OK;
}

status factor_alloc(const sparse *pattern, factor **out, fault *f)
{
    factor *fa = calloc(1, sizeof *fa);
    *out = fa;
    if (fa == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for factors");
    fa->n = pattern->n;
    fa->symmetric = pattern->symmetric;
    fa->residual = doubles(pattern->n);
    if (fa->residual == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for factors");
    if (fa->n == 0)
        return STATUS_OK;
    return pattern->symmetric ? analyse_symmetric(pattern, fa, f) : analyse_unsymmetric(pattern, fa, f);
}

void factor_free(factor *fa)
{
    if (fa == NULL)
        return;
    void *const all[] = {fa->order,        fa->inverse, fa->column,   fa->row,      fa->place,   fa->parent,
                         fa->column_count, fa->flag,    fa->L_column, fa->L_row,    fa->stack,   fa->value,
                         fa->L_value,      fa->D,       fa->work,     fa->diagonal, fa->residual};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        free(all[i]);
    if (fa->numeric != NULL)
        klu_free_numeric(&fa->numeric, &fa->common);
    if (fa->symbolic != NULL)
        klu_free_symbolic(&fa->symbolic, &fa->common);
    free(fa);
}

/* A pivot that is a rounding error of its own diagonal entry says that the matrix is singular. */
static status judge_pivots(factor *fa, fault *f)
{
    double largest = 0, smallest = INFINITY;
    fa->counts.negative_pivots = 0;
    for (int i = 0; i < fa->n; i++) {
        const double d = fabs(fa->D[i]);
        if (!isfinite(d) || d <= 16 * DBL_EPSILON * fa->diagonal[i])
            return fault_set(f, STATUS_SINGULAR,
                             "the stiffness matrix is singular: something is not held, or the structure is at a critical point");
        fa->counts.negative_pivots += fa->D[i] < 0;
        largest = fmax(largest, d);
        smallest = fmin(smallest, d);
    }
    fa->counts.condition = fa->n > 0 ? largest / smallest : 1;
    return STATUS_OK;
}

static status numeric_symmetric(factor *fa, const sparse *a, fault *f)
{
    const int n = fa->n;
    for (int j = 0; j < n; j++)
        fa->diagonal[fa->inverse[j]] = 0;
    for (int j = 0; j < n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            fa->value[fa->place[k]] = a->value[k];
            if (a->row[k] == j)
                fa->diagonal[fa->inverse[j]] = fabs(a->value[k]);
        }
    const int done = ldl_numeric(n, fa->column, fa->row, fa->value, fa->L_column, fa->parent, fa->column_count, fa->L_row,
                                 fa->L_value, fa->D, fa->work, fa->stack, fa->flag, NULL, NULL);
    if (done != n)
        return fault_set(f, STATUS_SINGULAR,
                         "the stiffness matrix is singular: something is not held, or the structure is at a critical point");
    return judge_pivots(fa, f);
}

static status numeric_unsymmetric(factor *fa, const sparse *a, fault *f)
{

    if (fa->numeric != NULL)
        klu_free_numeric(&fa->numeric, &fa->common);
    fa->numeric = klu_factor(a->column, a->row, a->value, fa->symbolic, &fa->common);
    if (fa->numeric == NULL)
        return fault_set(f, fa->common.status == KLU_SINGULAR ? STATUS_SINGULAR : STATUS_FAULT,
                         fa->common.status == KLU_SINGULAR
                             ? "the stiffness matrix is singular: something is not held, or the structure is at a critical point"
                             : "out of memory for factors");
    klu_rcond(fa->symbolic, fa->numeric, &fa->common);
    if (!(fa->common.rcond > DBL_EPSILON * DBL_EPSILON))
        return fault_set(f, STATUS_SINGULAR,
                         "the stiffness matrix is singular: something is not held, or the structure is at a critical point");
    klu_flops(fa->symbolic, fa->numeric, &fa->common);
    fa->counts.condition = 1 / fa->common.rcond;
    fa->counts.entries = fa->numeric->lnz + fa->numeric->unz;
    fa->counts.flops = fa->common.flops;
    return STATUS_OK;
}

status factor_numeric(factor *fa, const sparse *a, fault *f)
{
    if (fa->n == 0)
        return STATUS_OK;
    return fa->symmetric ? numeric_symmetric(fa, a, f) : numeric_unsymmetric(fa, a, f);
}

void factor_solve(factor *fa, double x[])
{
    const int n = fa->n;
    if (n == 0)
        return;
    if (!fa->symmetric) {
        klu_solve(fa->symbolic, fa->numeric, n, 1, x, &fa->common);
        return;
    }
    for (int i = 0; i < n; i++)
        fa->work[i] = x[fa->order[i]];
    ldl_lsolve(n, fa->work, fa->L_column, fa->L_row, fa->L_value);
    ldl_dsolve(n, fa->work, fa->D);
    ldl_ltsolve(n, fa->work, fa->L_column, fa->L_row, fa->L_value);
    for (int i = 0; i < n; i++)
        x[fa->order[i]] = fa->work[i];
    memset(fa->work, 0, (size_t)n * sizeof *fa->work); /* ldl_numeric expects zeros */
}

void factor_solve_refined(factor *fa, const sparse *a, double x[])
{
    double *b = malloc((size_t)(fa->n > 0 ? fa->n : 1) * sizeof *b);
    if (b == NULL) {
        factor_solve(fa, x);
        return;
    }
    memcpy(b, x, (size_t)fa->n * sizeof *b);
    factor_solve(fa, x);
    sparse_mul(a, x, fa->residual);
    for (int i = 0; i < fa->n; i++)
        b[i] -= fa->residual[i];
    factor_solve(fa, b);
    for (int i = 0; i < fa->n; i++)
        x[i] += b[i];
    free(b);
}

factor_counts factor_count(const factor *fa)
{
    return fa->counts;
}
