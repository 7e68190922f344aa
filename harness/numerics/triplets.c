#include "harness/numerics/triplets.h"

#include <stdlib.h>
#include <string.h>

static status triplets_alloc(int rows, int columns, matrix_kind kind, int most, triplets *out,
                             fault *f)
{
    *out = (triplets){.kind = kind, .rows = rows, .columns = columns};
    out->row = malloc(((size_t)most + 1) * sizeof *out->row);
    out->column = malloc(((size_t)most + 1) * sizeof *out->column);
    out->value = malloc(((size_t)most + 1) * sizeof *out->value);
    return out->row != NULL && out->column != NULL && out->value != NULL
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "out of memory for a matrix of %d rows", rows);
}

void triplets_free(triplets *t)
{
    free(t->row);
    free(t->column);
    free(t->value);
}

static void add(triplets *t, int row, int column, double value)
{
    if (value == 0)
        return;
    t->row[t->entries] = row;
    t->column[t->entries] = column;
    t->value[t->entries++] = value;
}

status triplets_of(const sparse *a, int skew, triplets *out, fault *f)
{
    const matrix_kind half = skew ? MATRIX_SKEW : MATRIX_SYMMETRIC;
    TRY(triplets_alloc(a->n, a->n, a->symmetric ? half : MATRIX_GENERAL, a->column[a->n], out, f));
    for (int j = 0; j < a->n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            if (!a->symmetric)
                add(out, a->row[k], j, a->value[k]);
            else if (!skew || a->row[k] != j) /* from the upper triangle to the lower one */
                add(out, j, a->row[k], skew ? -a->value[k] : a->value[k]);
        }
    return STATUS_OK;
}

status triplets_of_columns(int rows, int columns, const double value[], triplets *out, fault *f)
{
    TRY(triplets_alloc(rows, columns, MATRIX_GENERAL, rows * columns, out, f));
    for (int j = 0; j < columns; j++)
        for (int i = 0; i < rows; i++)
            add(out, i, j, value[(size_t)j * (size_t)rows + (size_t)i]);
    return STATUS_OK;
}

void triplets_mul(const triplets *A, const double x[], double y[])
{
    const double turned[] = {[MATRIX_GENERAL] = 0, [MATRIX_SYMMETRIC] = 1, [MATRIX_SKEW] = -1};
    memset(y, 0, (size_t)A->rows * sizeof *y);
    for (int k = 0; k < A->entries; k++) {
        const int i = A->row[k], j = A->column[k];
        y[i] += A->value[k] * x[j];
        if (i != j && A->kind != MATRIX_GENERAL)
            y[j] += turned[A->kind] * A->value[k] * x[i];
    }
}
