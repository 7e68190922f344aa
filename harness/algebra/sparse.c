#include "harness/algebra/sparse.h"

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
