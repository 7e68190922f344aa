/* The columns of L and the pivots are those of C = P A P^T with P from AMD. A pivot is d_k = a_kk -
 * sum_j l_kj^2 d_j: when it is a rounding error of these terms, or when they dwarf the whole column
 * of A, the digits of A are gone. */
#include "harness/algebra/factor_symmetric.h"

#include <amd.h>
#include <float.h>
#include <ldl.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/algebra/column_run.h"

struct factor_symmetric {
    int n;
    int lent;             /* 1: `integers`, L_row and run are another one's */
    int *integers;        /* what the next ten arrays and run_of_row are parts of */
    int *order, *inverse; /* [n] P: C(i, j) = A(order[i], order[j]) */
    int *column, *row;    /* [n + 1], [entries] upper triangle of C */
    int *source;          /* [entries] of C: position in A */
    int *L_column;        /* [n + 1] */
    int *parent, *in_column, *mark, *path; /* [n] elimination tree and workspace of LDL */
    double *D, *work;                      /* [n]; D begins the block of these four */
    double *diagonal, *terms;              /* [n] |a_kk|, and |a_kk| + sum_j l_kj^2 |d_j| */
    int *L_row;                            /* [L_column[n]] */
    int *run_of_row;                       /* [n + 1] */
    column_run *run;                       /* [run_of_row[n]] columns that rows of L have */
    double *L_value;
};

/* 0: memory ran out, here and below. */
static int lay_out_numbers(factor_symmetric *fs, size_t n)
{
    fs->D = malloc((4 * n + 1) * sizeof *fs->D);
    if (fs->D == NULL)
        return 0;
    fs->work = fs->D + n;
    fs->terms = fs->work + n;
    fs->diagonal = fs->terms + n;
    return 1;
}

static int lay_out(factor_symmetric *fs, size_t n, size_t entries)
{
    fs->integers = malloc((6 * n + 3 * (n + 1) + 2 * entries) * sizeof *fs->integers);
    if (fs->integers == NULL || !lay_out_numbers(fs, n))
        return 0;
    int **const lists[] = {&fs->order,     &fs->inverse, &fs->parent,
                           &fs->in_column, &fs->mark,    &fs->path};
    int *next = fs->integers;
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++, next += n)
        *lists[i] = next;
    fs->column = next;
    fs->L_column = fs->column + n + 1;
    fs->run_of_row = fs->L_column + n + 1;
    fs->row = fs->run_of_row + n + 1;
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

/* Upper triangle of P A P^T and where its entries are in A. */
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

/* Columns of row k of L in the order in which they are subtracted: path[top], ..., path[n - 1], by
 * the up-looking algorithm (T.A. Davis, ACM Trans. Math. Softw. 31, 2005, section 2). */
static int find_row(factor_symmetric *fs, int k)
{
    int top = fs->n;
    fs->mark[k] = k;
    for (int p = fs->column[k]; p < fs->column[k + 1]; p++) {
        int length = 0;
        for (int i = fs->row[p]; fs->mark[i] != k; i = fs->parent[i]) {
            fs->path[length++] = i;
            fs->mark[i] = k;
        }
        while (length > 0)
            fs->path[--top] = fs->path[--length];
    }
    return top;
}

/* Does column j have j + 1 and the rows of that? */
static int is_nested(const factor_symmetric *fs, int j)
{
    return fs->parent[j] == j + 1 &&
           fs->L_column[j + 1] - fs->L_column[j] == fs->L_column[j + 2] - fs->L_column[j + 1] + 1;
}

/* How many columns from path[top] on are a run. */
static int run_length(const factor_symmetric *fs, int top)
{
    const int *path = fs->path + top, most = min_int(COLUMN_RUN_MOST, fs->n - top);
    int count = 1;
    while (count < most && path[count] == path[0] + count && is_nested(fs, path[count - 1]))
        count++;
    return count;
}

/* Runs of all rows, into run and, where that is there, L_row; returns their number. */
static int find_runs(factor_symmetric *fs)
{
    int runs = 0;
    for (int k = 0; k < fs->n; k++) {
        fs->in_column[k] = 0;
        fs->run_of_row[k] = runs;
        for (int top = find_row(fs, k), count; top < fs->n; top += count, runs++) {
            count = run_length(fs, top);
            if (fs->run == NULL)
                continue;
            fs->run[runs] = (column_run){fs->path[top], count};
            for (int i = fs->path[top]; i < fs->path[top] + count; i++)
                fs->L_row[fs->L_column[i] + fs->in_column[i]++] = k;
        }
    }
    fs->run_of_row[fs->n] = runs;
    return runs;
}

/* Elimination tree and fill. */
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
        return fault_set(f, STATUS_FAULT,
                         "a factor of %ld entries is more than its indices can count",
                         counts->entries);
    const size_t fill = (size_t)fs->L_column[n] + 1;
    fs->L_row = malloc(fill * sizeof *fs->L_row);
    fs->L_value = malloc(fill * sizeof *fs->L_value);
    for (int k = 0; k < n; k++)
        fs->mark[k] = -1;
    fs->run = malloc(((size_t)find_runs(fs) + 1) * sizeof *fs->run);
    if (fs->L_row == NULL || fs->L_value == NULL || fs->run == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for %ld entries of a factor",
                         counts->entries);
    for (int k = 0; k < n; k++)
        fs->mark[k] = -1;
    find_runs(fs);
    return STATUS_OK;
}

status factor_symmetric_alloc(const sparse *pattern, factor_symmetric **out, factor_counts *counts,
                              fault *f)
{
    const int n = pattern->n;
    factor_symmetric *fs = *out = calloc(1, sizeof *fs);
    if (fs == NULL || !lay_out(fs, (size_t)n, (size_t)pattern->column[n]))
        return fault_set(f, STATUS_FAULT, "out of memory for factors");
    fs->n = n;
    if (amd_order(n, pattern->column, pattern->row, fs->order, NULL, NULL) < AMD_OK)
        return fault_set(f, STATUS_FAULT, "out of memory for ordering %d unknowns", n);
    for (int i = 0; i < n; i++)
        fs->inverse[fs->order[i]] = i;
    permute(pattern, fs);
    return analyse(fs, counts, f);
}

status factor_symmetric_alloc_like(const factor_symmetric *of, factor_symmetric **out, fault *f)
{
    factor_symmetric *fs = *out = malloc(sizeof *fs);
    if (fs == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for factors");
    *fs = *of;
    fs->lent = 1;
    fs->L_value = malloc(((size_t)fs->L_column[fs->n] + 1) * sizeof *fs->L_value);
    return lay_out_numbers(fs, (size_t)fs->n) && fs->L_value != NULL
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "out of memory for %d entries of a factor",
                           fs->L_column[fs->n]);
}

void factor_symmetric_free(factor_symmetric *fs)
{
    if (fs == NULL)
        return;
    if (!fs->lent) {
        free(fs->integers);
        free(fs->run);
        free(fs->L_row);
    }
    free(fs->D);
    free(fs->L_value);
    free(fs);
}

/* Row k of L, in the order of sums of SuiteSparse's ldl_numeric, from values that stay in A.
 * Returns D_k. */
static double factor_row(factor_symmetric *fs, const double a[], int k)
{
    double *y = fs->work;
    y[k] = 0;
    fs->in_column[k] = 0;
    fs->diagonal[k] = 0;
    for (int p = fs->column[k]; p < fs->column[k + 1]; p++) {
        y[fs->row[p]] += a[fs->source[p]];
        if (fs->row[p] == k)
            fs->diagonal[k] = fabs(a[fs->source[p]]);
    }
    double pivot = y[k];
    y[k] = 0;
    const column_run_columns L = {fs->L_column, fs->L_row, fs->in_column, fs->L_value, fs->D, y};
    for (int r = fs->run_of_row[k]; r < fs->run_of_row[k + 1]; r++)
        pivot = column_run_use(&L, fs->run[r], pivot);
    return pivot;
}

/* Of row and column k of C. */
static double largest_entry(const factor_symmetric *fs, const double a[], int k)
{
    double largest = 0;
    for (int j = k; j < fs->n; j++)
        for (int i = fs->column[j]; i < fs->column[j + 1]; i++)
            if (j == k || fs->row[i] == k)
                largest = fmax(largest, fabs(a[fs->source[i]]));
    return largest;
}

/* While all pivots are positive the terms do not exceed a_kk; otherwise they are summed. */
static void sum_terms(factor_symmetric *fs, int negative_pivots)
{
    memcpy(fs->terms, fs->diagonal, (size_t)fs->n * sizeof *fs->terms);
    if (negative_pivots == 0)
        return;
    for (int j = 0; j < fs->n; j++)
        for (int k = fs->L_column[j]; k < fs->L_column[j + 1]; k++)
            fs->terms[fs->L_row[k]] += fs->L_value[k] * fs->L_value[k] * fabs(fs->D[j]);
}

static status judge_pivots(factor_symmetric *fs, const double a[], factor_counts *counts,
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
    for (int k = 0; k < fs->n; k++)
        if ((fs->D[k] = factor_row(fs, a->value, k)) == 0)
            return STATUS_SINGULAR;
    return judge_pivots(fs, a->value, counts, weakest, ratio);
}

void factor_symmetric_solve(factor_symmetric *fs, double x[])
{
    ldl_perm(fs->n, fs->work, x, fs->order);
    ldl_lsolve(fs->n, fs->work, fs->L_column, fs->L_row, fs->L_value);
    ldl_dsolve(fs->n, fs->work, fs->D);
    ldl_ltsolve(fs->n, fs->work, fs->L_column, fs->L_row, fs->L_value);
    ldl_permt(fs->n, x, fs->work, fs->order);
}
