/* The cells of a stored run in one line for each series. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/records/results.h"

/* Adds the errors of a mesh to those of its series. */
static void take_errors(result_series *s, const result_cell *cell)
{
    result_error here = {0};
    for (int i = 0; i < cell->values; i++) {
        const double size = fabs(cell->value[i].error);
        if (!isfinite(size))
            continue;
        s->errors++;
        s->decades += log10(size + RESULTS_FLOOR);
        if (here.elements == 0 || size > here.size) {
            here = (result_error){size, cell->elements, ""};
            memcpy(here.quantity, cell->value[i].quantity, sizeof here.quantity);
        }
    }
    if (here.elements > 0 && (s->least.elements == 0 || here.size <= s->least.size))
        s->least = here;
    if (here.elements > 0 && (s->largest.elements == 0 || here.size > s->largest.size))
        s->largest = here;
}

static int take_limits(result_series *s, const result_cell *cell)
{
    for (int i = 0; i < cell->values; i++) {
        const result_value *v = &cell->value[i];
        result_limit *limit = isfinite(v->limit) ? results_add_limit(s) : NULL;
        if (limit == NULL && isfinite(v->limit))
            return 0;
        if (limit == NULL)
            continue;
        limit->value = v->limit;
        limit->near_zero = v->near_zero;
        memcpy(limit->quantity, v->quantity, sizeof limit->quantity);
    }
    return 1;
}

/* 0: out of memory. */
static int take_cell(result_series *s, const result_cell *cell)
{
    result_mesh *mesh = results_add_mesh(s);
    if (mesh == NULL)
        return 0;
    mesh->elements = cell->elements;
    memcpy(mesh->status, cell->status, sizeof mesh->status);
    for (int k = 0; k < RESULTS_WORKS; k++)
        s->work[k] += cell->work[k];
    take_errors(s, cell);
    return take_limits(s, cell);
}

status results_series_summarise(stored_results *r, fault *f)
{
    result_series *s = NULL;
    for (int i = 0; i < r->cells; i++) {
        if (s == NULL || strcmp(s->name, r->cell[i].name) != 0) {
            s = results_add_series(r);
            if (s == NULL || (s->name = strdup(r->cell[i].name)) == NULL)
                return fault_set(f, STATUS_FAULT, "out of memory for results");
        }
        if (!take_cell(s, &r->cell[i]))
            return fault_set(f, STATUS_FAULT, "out of memory for results");
    }
    return STATUS_OK;
}
