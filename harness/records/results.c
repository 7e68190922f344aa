#include "harness/records/results.h"

#include <stdlib.h>
#include <string.h>

const char *const results_work_names[RESULTS_WORKS] = {"iterations", "evaluations",
                                                       "factorisations"};

/* A zeroed item at the end of *list (the address of its pointer), which grows by `step` items;
 * NULL: out of memory. */
static void *add(void *list, int *count, int step, size_t size)
{
    char *all;
    memcpy(&all, list, sizeof all);
    if (*count % step == 0) {
        char *longer = realloc(all, ((size_t)*count + (size_t)step) * size);
        if (longer == NULL)
            return NULL;
        all = longer;
        memcpy(list, &all, sizeof all);
    }
    return memset(all + (size_t)(*count)++ * size, 0, size);
}

result_cell *results_add(stored_results *r)
{
    return add(&r->cell, &r->cells, 1024, sizeof *r->cell);
}

result_series *results_add_series(stored_results *r)
{
    return add(&r->series, &r->seriess, 1024, sizeof *r->series);
}

result_mesh *results_add_mesh(result_series *s)
{
    return add(&s->mesh, &s->meshes, 8, sizeof *s->mesh);
}

result_limit *results_add_limit(result_series *s)
{
    return add(&s->limit, &s->limits, 8, sizeof *s->limit);
}

int results_order(const result_cell *a, const result_cell *b)
{
    const int names = strcmp(a->name, b->name);
    return names != 0 ? names : (a->elements > b->elements) - (a->elements < b->elements);
}

void results_free(stored_results *r)
{
    for (int i = 0; i < r->cells; i++) {
        free(r->cell[i].name);
        free(r->cell[i].value);
    }
    for (int i = 0; i < r->seriess; i++) {
        free(r->series[i].name);
        free(r->series[i].mesh);
        free(r->series[i].limit);
    }
    results_part_free(&r->part);
    free(r->cell);
    free(r->series);
    memset(r, 0, sizeof *r);
}
