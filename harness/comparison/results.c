#include "harness/comparison/results.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const results_work_names[RESULTS_WORKS] = {"iterations", "evaluations", "factorisations"};

result_cell *results_add(results *r)
{
    enum { GROWTH = 1024 };
    if (r->cells % GROWTH == 0) {
        result_cell *more = realloc(r->cell, ((size_t)r->cells + GROWTH) * sizeof *more);
        if (more == NULL)
            return NULL;
        r->cell = more;
    }
    result_cell *one = &r->cell[r->cells++];
    memset(one, 0, sizeof *one);
    return one;
}

void results_summarise(result_cell *cell)
{
    result_summary *s = &cell->summary;
    memset(s, 0, sizeof *s);
    for (int i = 0; i < cell->values; i++) {
        const double error = fabs(cell->value[i].error);
        if (!isfinite(error))
            continue;
        s->judged++;
        s->decades += log10(error + RESULTS_FLOOR);
        if (s->judged == 1 || error > s->worst) {
            s->worst = error;
            memcpy(s->quantity, cell->value[i].quantity, sizeof s->quantity);
        }
    }
}

int results_order(const result_cell *a, const result_cell *b)
{
    const int names = strcmp(a->name, b->name);
    return names != 0 ? names : (a->elements > b->elements) - (a->elements < b->elements);
}

void results_free(results *r)
{
    for (int i = 0; i < r->cells; i++) {
        free(r->cell[i].name);
        free(r->cell[i].value);
    }
    free(r->cell);
    memset(r, 0, sizeof *r);
}
