#include "harness/newton/border.h"

#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"
#include "harness/newton/context.h"

static int is_released(const analysis_context *c, const scene_compliance *a, int coordinate)
{
    for (int k = 0; k < TANGENT_COMPONENTS; k++)
        if ((a->released >> k & 1u) && kinematics_coordinate(c->model, a->node, k) == coordinate)
            return 1;
    return 0;
}

status border_alloc(const analysis_context *c, const scene_compliance *a, border *b, fault *f)
{
    const model_size size = model_sizes(c->model);
    for (int i = size.free; i < size.free + size.driven; i++)
        if (is_released(c, a, i))
            b->coordinate[b->count++] = i;
    b->U = calloc((size_t)(b->count * size.free) + 1, sizeof *b->U);
    b->V = calloc((size_t)(b->count * size.free) + 1, sizeof *b->V);
    return b->U == NULL || b->V == NULL
               ? fault_set(f, STATUS_FAULT, "out of memory for a compliance")
               : STATUS_OK;
}

void border_free(border *b)
{
    free(b->U);
    free(b->V);
}

int border_place(const border *b, int coordinate)
{
    for (int i = 0; i < b->count; i++)
        if (b->coordinate[i] == coordinate)
            return i;
    return -1;
}

void border_fill(border *b, int free_count, const sparse *K)
{
    memset(b->U, 0, (size_t)(b->count * free_count) * sizeof *b->U);
    memset(b->V, 0, (size_t)(b->count * free_count) * sizeof *b->V);
    memset(b->W, 0, sizeof b->W);
    for (int j = 0; j < K->n; j++)
        for (int k = K->column[j]; k < K->column[j + 1]; k++) {
            const int i = K->row[k], row = i >= free_count ? border_place(b, i) : -1,
                      column = j >= free_count ? border_place(b, j) : -1;
            const double value = K->value[k];
            if (i < free_count && column >= 0)
                b->U[column * free_count + i] = value;
            if (j < free_count && row >= 0)
                b->V[row * free_count + j] = value;
            if (row >= 0 && column >= 0)
                b->W[row * b->count + column] = value;
            if (K->symmetric && i < free_count && column >= 0)
                b->V[column * free_count + i] = value;
            if (K->symmetric && row >= 0 && column >= 0)
                b->W[column * b->count + row] = value;
        }
}
