#include "harness/newton/bordered.h"

#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/newton/border.h"
#include "harness/newton/refinement.h"
#include "harness/newton/stiffness_parts.h"

status bordered_alloc(node_tangent *t, counters *n, bordered *out, fault *f)
{
    const border *b = &t->border;
    const size_t all = (size_t)t->all + 1;
    const int columns = t->condensed != NULL ? 0 : b->count;
    out->Z = calloc((size_t)(columns * t->free) + 1, sizeof *out->Z);
    out->solution = calloc(TANGENT_COMPONENTS * all, sizeof *out->solution);
    out->x = calloc(4 * all, sizeof *out->x);
    if (out->Z == NULL || out->x == NULL || out->solution == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a compliance");
    out->load = out->x + all;
    out->rest = out->load + all;
    out->weight = out->rest + all;
    memcpy(out->Z, b->U, (size_t)(columns * t->free) * sizeof *out->Z);
    factor_solve_many(t->factor, columns, t->free, out->Z);
    n->solutions += columns;
    for (int i = 0; i < columns; i++)
        for (int j = 0; j < columns; j++)
            out->S[i * b->count + j] = b->W[i * b->count + j] -
                                       dense_dot(t->free, b->V + i * t->free, out->Z + j * t->free);
    return columns > 0 && dense_lu_regular(b->count, out->S, out->pivot) != 0
               ? fault_set(f, STATUS_SINGULAR,
                           "the structure is not held when the prescribed motion is released")
               : STATUS_OK;
}

void bordered_free(bordered *s)
{
    free(s->Z);
    free(s->x);
    free(s->solution);
}

/* What is released, and what it takes from a solution without it. */
static void add_released(const node_tangent *t, const bordered *s, double x[])
{
    const border *b = &t->border;
    double z[TANGENT_BORDER];
    for (int i = 0; i < b->count; i++)
        z[i] = x[b->coordinate[i]] - dense_dot(t->free, b->V + i * t->free, x);
    dense_lu_solve(b->count, 1, s->S, s->pivot, z);
    for (int i = 0; i < b->count; i++) {
        for (int k = 0; k < t->free; k++)
            x[k] -= s->Z[i * t->free + k] * z[i];
        x[b->coordinate[i]] = z[i];
    }
}

void bordered_solve(node_tangent *t, counters *n, const bordered *s, int columns, double x[])
{
    factor_solve_many(t->factor, columns, t->all, x);
    n->solutions += columns;
    for (int c = 0; c < columns && t->condensed == NULL && t->border.count > 0; c++)
        add_released(t, s, x + c * t->all);
}

/* rest[all] = load - K x */
static void residual_of(const equations *eq, const node_tangent *t, const bordered *s)
{
    double *rest = s->rest;
    memset(rest, 0, (size_t)t->all * sizeof *rest);
    sparse_mul(&t->geometric, s->x, rest);
    stiffness_parts_material_product(eq->m, &eq->run->memory, t->state, s->x, rest);
    for (int k = 0; k < t->all; k++)
        rest[k] = k < t->free || border_place(&t->border, k) >= 0 ? s->load[k] - rest[k] : 0;
}

status bordered_refine(const equations *eq, node_tangent *t, const bordered *s, fault *f)
{
    /* x itself was the first, and of condensed members as good as the second */
    solution_refinement r = {.corrections = t->condensed != NULL ? 2 : 1, .last = 1};
    refinement_state state = REFINEMENT_GOES_ON;
    metric_of(eq->m, s->weight);
    while (state == REFINEMENT_GOES_ON) {
        residual_of(eq, t, s);
        bordered_solve(t, &eq->run->counters, s, 1, s->rest);
        for (int k = 0; k < t->all; k++)
            s->x[k] += s->rest[k];
        state = refinement_next(&r, refinement_part(t->all, s->weight, s->rest, s->x, 0));
    }
    return state == REFINEMENT_ENDS ? STATUS_OK : refinement_refuse(&r, "the compliance", f);
}
