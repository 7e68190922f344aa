/* The columns of L and the pivots are those of C = P A P^T with the permutation P from AMD. A pivot
 * is d_k = a_kk - sum_j l_kj^2 d_j. The digits of A are lost if d_k is as small as a rounding error
 * of these terms, or if the terms are much larger than the whole column of A. */
#include "harness/numerics/numerics_impl.h"

#include <amd.h>
#include <float.h>
#include <ldl.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/real.h"

struct factor_symmetric {
    int n;
    int lent;
    int *integers;
    int *order, *inverse; /* [n] P: C(i, j) = A(order[i], order[j]); inverse of this permutation */
    /* [n + 1] and [entries] upper triangle of C; triangular_groups_place converts `row` */
    int *column, *row;
    int *source; /* [entries] position in A of each entry of C */
    int *L_column;
    int *parent, *in_column, *mark; /* [n] elimination tree, and work space of LDL */
    double *D;
    double *diagonal, *terms; /* [n] |a_kk|, and |a_kk| + sum_j l_kj^2 |d_j| */
    double *rest;
    triangular_groups groups;
    int *L_row;
    double *L_value;
};

static int lay_out_numbers(factor_symmetric *fs, size_t n)
{
    fs->D = malloc((3 * n + 1) * sizeof *fs->D);
    if (fs->D == NULL)
        return 0;
    fs->terms = fs->D + n;
    fs->diagonal = fs->terms + n;
    return 1;
}

static size_t size_of_rest(size_t n)
{
    return (n + TRIANGULAR_LANES) * TRIANGULAR_LANES * sizeof(double);
}

static int lay_out(factor_symmetric *fs, size_t n, size_t entries)
{
    fs->integers = malloc((5 * n + 2 * (n + 1) + 2 * entries) * sizeof *fs->integers);
    fs->rest = malloc(size_of_rest(n));
    if (fs->integers == NULL || fs->rest == NULL || !lay_out_numbers(fs, n))
        return 0;
    int **const lists[] = {&fs->order, &fs->inverse, &fs->parent, &fs->in_column, &fs->mark};
    int *next = fs->integers;
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++, next += n)
        *lists[i] = next;
    fs->column = next;
    fs->L_column = fs->column + n + 1;
    fs->row = fs->L_column + n + 1;
    fs->source = fs->row + entries;
    return 1;
}

static int max_int(int a, int b)
{
    return a > b ? a : b;
}

static int min_int(int a, int b)
{
    return a < b ? a : b;
}

static void permute(const sparse *a, factor_symmetric *fs)
{
    const int n = a->n;
    for (int j = 0; j <= n; j++)
        fs->column[j] = 0;
    for (int j = 0; j < n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++)
            fs->column[max_int(fs->inverse[a->row[k]], fs->inverse[j]) + 1]++;
    for (int j = 0; j < n; j++) {
        fs->column[j + 1] += fs->column[j];
        fs->mark[j] = fs->column[j];
    }
    for (int j = 0; j < n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            const int i = fs->inverse[a->row[k]], place = fs->mark[max_int(i, fs->inverse[j])]++;
            fs->source[place] = k;
            fs->row[place] = min_int(i, fs->inverse[j]);
        }
}

static status analyse(factor_symmetric *fs, factor_counts *counts, fault *f)
{
    const int n = fs->n;
    ldl_symbolic(n, fs->column, fs->row, fs->L_column, fs->parent, fs->in_column, fs->mark, NULL,
                 NULL);
    counts->entries = n;
    counts->flops = 0;
    for (int j = 0; j < n; j++) {
        const double below = fs->in_column[j];
        counts->entries += fs->in_column[j];
        counts->flops += below * (below + 2);
    }
    if (counts->entries > INT_MAX)
        return fault_set(
            f, STATUS_FAULT,
            "a factor of %ld entries exceeds the range of its indices; use fewer elements",
            counts->entries);
    const size_t fill = (size_t)fs->L_column[n] + 1;
    fs->L_row = malloc(fill * sizeof *fs->L_row);
    fs->L_value = malloc(fill * sizeof *fs->L_value);
    int *path = malloc(((size_t)n + 1) * sizeof *path);
    const triangular_pattern of = {n,        fs->column, fs->row, fs->parent, fs->L_column,
                                   fs->mark, path};
    const int found = path != NULL && fs->L_row != NULL && fs->L_value != NULL &&
                      triangular_groups_find(&of, fs->L_row, &fs->groups);
    free(path);
    if (found)
        triangular_groups_place(&fs->groups, fs->column, fs->row);
    return found ? STATUS_OK : fault_memory(f, "%ld entries of a factor", counts->entries);
}

status factor_symmetric_alloc(const sparse *pattern, factor_symmetric **out, factor_counts *counts,
                              fault *f)
{
    const int n = pattern->n;
    factor_symmetric *fs = *out = calloc(1, sizeof *fs);
    if (fs == NULL || !lay_out(fs, (size_t)n, (size_t)pattern->column[n]))
        return fault_memory(f, "factors");
    fs->n = n;
    if (amd_order(n, pattern->column, pattern->row, fs->order, NULL, NULL) < AMD_OK)
        return fault_memory(f, "ordering %d unknowns", n);
    for (int i = 0; i < n; i++)
        fs->inverse[fs->order[i]] = i;
    permute(pattern, fs);
    return analyse(fs, counts, f);
}

status factor_symmetric_alloc_like(const factor_symmetric *of, factor_symmetric **out, fault *f)
{
    factor_symmetric *fs = *out = malloc(sizeof *fs);
    if (fs == NULL)
        return fault_memory(f, "factors");
    *fs = *of;
    fs->lent = 1;
    fs->L_value = malloc(((size_t)fs->L_column[fs->n] + 1) * sizeof *fs->L_value);
    return lay_out_numbers(fs, (size_t)fs->n) && fs->L_value != NULL
               ? STATUS_OK
               : fault_memory(f, "%d entries of a factor", fs->L_column[fs->n]);
}

void factor_symmetric_free(factor_symmetric *fs)
{
    if (fs == NULL)
        return;
    if (!fs->lent) {
        free(fs->integers);
        free(fs->rest);
        triangular_groups_free(&fs->groups);
        free(fs->L_row);
    }
    free(fs->D);
    free(fs->L_value);
    free(fs);
}

static double largest_entry(const factor_symmetric *fs, const double a[], int k)
{
    double largest = 0;
    for (int j = k; j < fs->n; j++)
        for (int i = fs->column[j]; i < fs->column[j + 1]; i++)
            if (j == k || triangular_column_of(fs->row[i]) == k)
                largest = fmax(largest, fabs(a[fs->source[i]]));
    return largest;
}

/* Sums the absolute values of the terms of the pivots. If no pivot is negative, the sum over j does
 * not exceed a_kk and is omitted. */
static void sum_terms(factor_symmetric *fs, int negative_pivots)
{
    memcpy(fs->terms, fs->diagonal, (size_t)fs->n * sizeof *fs->terms);
    if (negative_pivots == 0)
        return;
    for (int j = 0; j < fs->n; j++)
        for (int k = fs->L_column[j]; k < fs->L_column[j + 1]; k++)
            fs->terms[fs->L_row[k]] += fs->L_value[k] * fs->L_value[k] * fabs(fs->D[j]);
}

static status check_pivots(factor_symmetric *fs, const double a[], factor_counts *counts,
                           int *weakest, double *ratio)
{
    const double digits = 16 * DBL_EPSILON;
    double largest = 0, smallest = INFINITY;
    counts->negative_pivots = 0;
    *ratio = INFINITY;
    for (int k = 0; k < fs->n; k++)
        counts->negative_pivots += fs->D[k] < 0;
    counts->determinant = counts->negative_pivots % 2 == 0 ? 1 : -1;
    sum_terms(fs, counts->negative_pivots);
    for (int k = 0; k < fs->n; k++) {
        const double d = fabs(fs->D[k]), terms = fs->terms[k];
        if (!isfinite(d) || d <= digits * terms ||
            (terms * digits >= fs->diagonal[k] && terms * digits >= largest_entry(fs, a, k)))
            return STATUS_SINGULAR;
        if (d < *ratio * terms) {
            *ratio = d / terms;
            *weakest = fs->order[k];
        }
        largest = fmax(largest, d);
        smallest = fmin(smallest, d);
    }
    counts->condition = largest / smallest;
    return STATUS_OK;
}

status factor_symmetric_numeric(factor_symmetric *fs, const sparse *a, factor_counts *counts,
                                int *weakest, double *ratio)
{
    const triangular_groups *g = &fs->groups;
    const triangular_rows rows = {.groups = g->groups,
                                  .first_of_group = g->first_of_group,
                                  .run_of_group = g->run_of_group,
                                  .run = g->run,
                                  .begin_A = fs->column,
                                  .place = fs->row,
                                  .source = fs->source,
                                  .begin = fs->L_column,
                                  .row = fs->L_row,
                                  .filled = fs->in_column,
                                  .value = fs->L_value,
                                  .D = fs->D,
                                  .diagonal = fs->diagonal,
                                  .rest = fs->rest};
    memset(fs->rest, 0, size_of_rest((size_t)fs->n));
    if (!REAL_CHOSEN(triangular_rows_factor)(&rows, a->value))
        return STATUS_SINGULAR;
    return check_pivots(fs, a->value, counts, weakest, ratio);
}

void factor_symmetric_solve(factor_symmetric *fs, triangular_part part, int columns, int stride,
                            double x[])
{
    const triangular_factors t = {.n = fs->n,
                                  .order = fs->order,
                                  .begin = fs->L_column,
                                  .row = fs->L_row,
                                  .value = fs->L_value,
                                  .D = fs->D,
                                  .runs = fs->groups.columns,
                                  .run = fs->groups.of_columns};
    REAL_CHOSEN(triangular_solve)(&t, part, columns, stride, x, fs->rest);
}
