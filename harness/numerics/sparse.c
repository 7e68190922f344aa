#include "harness/numerics/sparse.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

status sparse_alloc_like(const sparse *pattern, sparse *out, fault *f)
{
    *out = *pattern;
    const int entries = pattern->column[pattern->n];
    out->value = calloc((size_t)(entries > 0 ? entries : 1), sizeof *out->value);
    if (out->value == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a matrix of %d coordinates",
                         pattern->n);
    return STATUS_OK;
}

void sparse_free_values(sparse *a)
{
    free(a->value);
    a->value = NULL;
}

void sparse_zero(sparse *a)
{
    memset(a->value, 0, (size_t)a->column[a->n] * sizeof *a->value);
}

void sparse_copy_leading(const sparse *whole, sparse *leading)
{
    for (int j = 0; j < leading->n; j++)
        memcpy(&leading->value[leading->column[j]], &whole->value[whole->column[j]],
               (size_t)(leading->column[j + 1] - leading->column[j]) * sizeof *leading->value);
}

/* The upper triangle stands for both; its diagonal entry, where there is one, ends the column. */
static void mul_symmetric(const sparse *a, const double x[], double y[])
{
    for (int j = 0; j < a->n; j++) {
        int end = a->column[j + 1];
        const double xj = x[j];
        double sum = 0;
        if (end > a->column[j] && a->row[end - 1] == j)
            sum = a->value[--end] * xj;
        for (int k = a->column[j]; k < end; k++) {
            y[a->row[k]] += a->value[k] * xj;
            sum += a->value[k] * x[a->row[k]];
        }
        y[j] += sum;
    }
}

void sparse_mul(const sparse *a, const double x[], double y[])
{
    for (int j = 0; j < a->n; j++)
        y[j] = 0;
    if (a->symmetric) {
        mul_symmetric(a, x, y);
        return;
    }
    for (int j = 0; j < a->n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++)
            y[a->row[k]] += a->value[k] * x[j];
}

double sparse_rounding(const sparse *a, const double x[], const double y[])
{
    double sum = 0;
    for (int j = 0; j < a->n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            const int i = a->row[k];
            double terms = fabs(x[i] * y[j]);
            if (a->symmetric && i != j)
                terms += fabs(y[i] * x[j]);
            sum += fabs(a->value[k]) * terms;
        }
    return DBL_EPSILON * sum;
}

struct by_numbers {
    sparse upper;
    int *from, *mirror; /* [entries of upper] in the whole matrix; mirror -1: not stored there */
    double *diagonal;   /* [n] */
};

/* Where the entry is stored; -1: nowhere. */
static int place_of(const sparse *a, int row, int column)
{
    int low = a->column[column], high = a->column[column + 1] - 1;
    while (low <= high) {
        const int middle = (low + high) / 2;
        if (a->row[middle] == row)
            return middle;
        if (a->row[middle] < row)
            low = middle + 1;
        else
            high = middle - 1;
    }
    return -1;
}

double sparse_diagonal(const sparse *a, int j)
{
    const int place = place_of(a, j, j);
    return place < 0 ? 0 : a->value[place];
}

static void fill(const sparse *a, by_numbers *b)
{
    int entries = 0;
    for (int j = 0; j < a->n; j++) {
        b->upper.column[j] = entries;
        for (int k = a->column[j]; k < a->column[j + 1] && a->row[k] <= j; k++) {
            b->upper.row[entries] = a->row[k];
            b->from[entries] = k;
            b->mirror[entries++] = place_of(a, j, a->row[k]);
        }
    }
    b->upper.column[a->n] = entries;
}

status by_numbers_alloc(const sparse *pattern, by_numbers **out, fault *f)
{
    const size_t n = (size_t)pattern->n + 1, entries = (size_t)pattern->column[pattern->n] + 1;
    by_numbers *b = *out = calloc(1, sizeof *b);
    if (b != NULL) {
        b->upper = (sparse){.n = pattern->n, .symmetric = 1};
        b->upper.column = calloc(n, sizeof *b->upper.column);
        b->upper.row = calloc(entries, sizeof *b->upper.row);
        b->upper.value = calloc(entries, sizeof *b->upper.value);
        b->from = calloc(2 * entries, sizeof *b->from);
        b->diagonal = calloc(n, sizeof *b->diagonal);
    }
    if (b == NULL || b->upper.column == NULL || b->upper.row == NULL || b->upper.value == NULL ||
        b->from == NULL || b->diagonal == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a matrix of %d coordinates",
                         pattern->n);
    b->mirror = b->from + entries;
    fill(pattern, b);
    return STATUS_OK;
}

void by_numbers_free(by_numbers *b)
{
    if (b == NULL)
        return;
    free(b->upper.column);
    free(b->upper.row);
    free(b->upper.value);
    free(b->from);
    free(b->diagonal);
    free(b);
}

double by_numbers_take(by_numbers *b, const sparse *a)
{
    double largest = 0;
    for (int j = 0; j < a->n; j++) {
        const int end = b->upper.column[j + 1] - 1;
        const int stored = end >= b->upper.column[j] && b->upper.row[end] == j;
        b->diagonal[j] = stored ? sqrt(fabs(a->value[b->from[end]])) : 0;
    }
    for (int j = 0; j < a->n; j++)
        for (int k = b->upper.column[j]; k < b->upper.column[j + 1]; k++) {
            const double value = b->upper.value[k] = a->value[b->from[k]],
                         other = b->mirror[k] >= 0 ? a->value[b->mirror[k]] : 0;
            if (value == other)
                continue;
            const double part =
                fabs(value - other) / (b->diagonal[j] * b->diagonal[b->upper.row[k]]);
            largest = part <= largest ? largest : part; /* what is no number is not symmetric */
        }
    return isnan(largest) ? INFINITY : largest;
}

const sparse *by_numbers_upper(const by_numbers *b)
{
    return &b->upper;
}
