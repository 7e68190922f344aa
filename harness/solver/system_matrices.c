#include "harness/solver/system_matrices.h"

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
               : fault_set(f, STATUS_FAULT, "out of memory for matrices of a state");
}

static void triplets_free(triplets *t)
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

status system_matrices_triplets(const sparse *a, int skew, triplets *out, fault *f)
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

status system_matrices_triplets_of_columns(int rows, int columns, const double value[],
                                           triplets *out, fault *f)
{
    TRY(triplets_alloc(rows, columns, MATRIX_GENERAL, rows * columns, out, f));
    for (int j = 0; j < columns; j++)
        for (int i = 0; i < rows; i++)
            add(out, i, j, value[(size_t)j * (size_t)rows + (size_t)i]);
    return STATUS_OK;
}

void system_matrices_free(system_matrices *s)
{
    for (int i = 0; i < s->states; i++) {
        triplets *const each[] = {&s->state[i].K, &s->state[i].M, &s->state[i].G, &s->state[i].B};
        for (int k = 0; k < 4; k++)
            triplets_free(each[k]);
    }
    free(s->state);
    free(s->label);
    memset(s, 0, sizeof *s);
}
