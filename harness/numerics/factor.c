/* Symmetric: LDL^T; unsymmetric: LU; and the check that a weak pivot is more than round-off.
 *
 * With x = A^-1 e_i and y = A^-T e_k the number x_k = y^T A x is a sum of the terms y_i a_ij x_j,
 * and rounding A changes it by about eps times the root of the sum of their squares: when that is
 * as large as x_k itself, A is singular to working precision. (A free beam of n elements has a last
 * pivot of eps n^2 times its diagonal entry and not of eps times it.) */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "harness/numerics/factor_symmetric.h"
#include "harness/numerics/factor_unsymmetric.h"

struct matrix_factor {
    int n;
    factor_operator by;              /* without functions: none */
    factor_symmetric *symmetric;     /* one of the two; both of a matrix by its numbers */
    factor_unsymmetric *unsymmetric; /* NULL both: nothing to solve for */
    by_numbers *whole;               /* of a matrix by its numbers; NULL: another one */
    int upper;                       /* 1: `symmetric` has the numbers factored last */
    factor_counts counts, of_upper;  /* of_upper: entries and flops of `symmetric` beside a whole */
    double *residual, *other;        /* [n]; other: unsymmetric */
};

/* All but the factors. */
static status begin(const sparse *pattern, matrix_factor **out, fault *f)
{
    matrix_factor *fa = *out = calloc(1, sizeof *fa);
    if (fa == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for factors");
    fa->n = pattern->n;
    fa->upper = pattern->symmetric;
    fa->counts.condition = fa->counts.determinant = 1;
    fa->counts.negative_pivots = pattern->symmetric ? 0 : -1;
    fa->residual = malloc(((size_t)fa->n + 1) * sizeof *fa->residual);
    if (!pattern->symmetric)
        fa->other = malloc(((size_t)fa->n + 1) * sizeof *fa->other);
    return fa->residual != NULL && (pattern->symmetric || fa->other != NULL)
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "out of memory for factors");
}

status factor_alloc(const sparse *pattern, matrix_factor **out, fault *f)
{
    TRY(begin(pattern, out, f));
    matrix_factor *fa = *out;
    if (fa->n == 0)
        return STATUS_OK;
    if (pattern->symmetric)
        return factor_symmetric_alloc(pattern, &fa->symmetric, &fa->counts, f);
    if (pattern->by_numbers)
        TRY(by_numbers_alloc(pattern, &fa->whole, f));
    return factor_unsymmetric_alloc(pattern, &fa->unsymmetric, &fa->counts, f);
}

status factor_alloc_like(const matrix_factor *of, const sparse *pattern, matrix_factor **out,
                         fault *f)
{
    if (of->symmetric == NULL || !pattern->symmetric)
        return factor_alloc(pattern, out, f);
    const factor_counts *counts = of->whole != NULL ? &of->of_upper : &of->counts;
    TRY(begin(pattern, out, f));
    (*out)->counts.entries = counts->entries;
    (*out)->counts.flops = counts->flops;
    return factor_symmetric_alloc_like(of->symmetric, &(*out)->symmetric, f);
}

status factor_of(const factor_operator *by, matrix_factor **out, fault *f)
{
    matrix_factor *fa = *out = calloc(1, sizeof *fa);
    if (fa == NULL) {
        by->free(by->context);
        return fault_set(f, STATUS_FAULT, "out of memory for factors");
    }
    fa->by = *by;
    return STATUS_OK;
}

void factor_free(matrix_factor *fa)
{
    if (fa == NULL)
        return;
    if (fa->by.free != NULL)
        fa->by.free(fa->by.context);
    factor_symmetric_free(fa->symmetric);
    factor_unsymmetric_free(fa->unsymmetric);
    by_numbers_free(fa->whole);
    free(fa->residual);
    free(fa->other);
    free(fa);
}

static void unit_vector(int n, int i, double e[])
{
    for (int k = 0; k < n; k++)
        e[k] = 0;
    e[i] = 1;
}

/* Part of x_column that is round-off, with x = A^-1 e_row. */
static double lost_part(matrix_factor *fa, const sparse *a, int row, int column)
{
    double *x = fa->residual, *y = fa->residual, sum = 0;
    unit_vector(fa->n, row, x);
    factor_solve(fa, x);
    if (!fa->upper) {
        y = fa->other;
        unit_vector(fa->n, column, y);
        factor_unsymmetric_solve_transposed(fa->unsymmetric, y);
    }
    const double scale =
        fabs(x[column]); /* of every term: a sum of squares of x alone may overflow */
    for (int j = 0; j < fa->n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            const double term = y[a->row[k]] / scale * a->value[k] * x[j];
            sum += (a->symmetric && a->row[k] != j ? 2 : 1) * term * term;
        }
    return DBL_EPSILON * sqrt(sum);
}

/* LDL^T where the numbers of the whole matrix are symmetric: *a becomes its upper triangle. */
static status choose(matrix_factor *fa, const sparse **a, fault *f)
{
    const factor_counts before = fa->counts;
    fa->counts.asymmetry = by_numbers_take(fa->whole, *a);
    fa->upper = fa->counts.asymmetry <= FACTOR_SYMMETRIC_WITHIN;
    fa->counts.negative_pivots = -1;
    if (!fa->upper)
        return STATUS_OK;
    *a = by_numbers_upper(fa->whole);
    if (fa->symmetric == NULL) {
        fa->of_upper = before;
        TRY(factor_symmetric_alloc(*a, &fa->symmetric, &fa->of_upper, f));
    }
    return STATUS_OK;
}

status factor_numeric(matrix_factor *fa, const sparse *a, fault *f)
{
    const double n = fa->n, lost = 0.25;
    int row = 0, column = 0;
    double ratio = 1;
    status outcome = STATUS_OK;
    fa->counts.factorisations++;
    if (fa->whole != NULL)
        TRY(choose(fa, &a, f));
    if (fa->upper && fa->symmetric != NULL) {
        outcome = factor_symmetric_numeric(fa->symmetric, a, &fa->counts, &row, &ratio);
        column = row;
    } else if (!fa->upper && fa->unsymmetric != NULL) {
        outcome =
            factor_unsymmetric_numeric(fa->unsymmetric, a, &fa->counts, &row, &column, &ratio);
    }
    if (outcome == STATUS_OK && ratio <= n * n * n * DBL_EPSILON &&
        !(lost_part(fa, a, row, column) < lost))
        outcome = STATUS_SINGULAR;
    if (outcome == STATUS_SINGULAR)
        fault_set(f, outcome, "the stiffness matrix is singular");
    else if (outcome == STATUS_FAULT)
        fault_set(f, outcome, "out of memory for the factors of %d unknowns", fa->n);
    return outcome;
}

void factor_solve(matrix_factor *fa, double x[])
{
    factor_solve_many(fa, 1, fa->n, x);
}

void factor_solve_many(matrix_factor *fa, int columns, int stride, double x[])
{
    for (int c = 0; c < columns && fa->by.solve != NULL; c++)
        fa->by.solve(fa->by.context, 0, x + c * stride);
    if (fa->by.solve == NULL && fa->upper && fa->symmetric != NULL)
        factor_symmetric_solve(fa->symmetric, columns, stride, x);
    if (fa->by.solve == NULL && !fa->upper && fa->unsymmetric != NULL)
        factor_unsymmetric_solve(fa->unsymmetric, columns, stride, x);
}

void factor_solve_transposed(matrix_factor *fa, double x[])
{
    if (fa->by.solve != NULL)
        fa->by.solve(fa->by.context, 1, x);
    else if (!fa->upper && fa->unsymmetric != NULL)
        factor_unsymmetric_solve_transposed(fa->unsymmetric, x);
    else
        factor_solve(fa, x);
}

factor_counts factor_count(const matrix_factor *fa)
{
    if (fa->by.count != NULL)
        return fa->by.count(fa->by.context);
    factor_counts counts = fa->counts;
    if (fa->whole != NULL && fa->upper) {
        counts.entries = fa->of_upper.entries;
        counts.flops = fa->of_upper.flops;
    }
    return counts;
}

int factor_is_symmetric(const matrix_factor *fa)
{
    return factor_count(fa).negative_pivots >= 0;
}

const sparse *factor_upper(const matrix_factor *fa)
{
    return fa->whole != NULL && fa->upper ? by_numbers_upper(fa->whole) : NULL;
}
