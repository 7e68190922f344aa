#include "harness/comparison/results.h"

#include <stdlib.h>
#include <string.h>

const char *const results_work_names[RESULTS_WORKS] = {"iterations", "evaluations",
                                                       "factorisations"};

/* The array with a zeroed item at [count], where it grows by `step` items; NULL: out of memory. */
static void *grow(void *array, int count, int step, size_t size)
{
    char *all = count % step == 0 ? realloc(array, ((size_t)count + (size_t)step) * size) : array;
    if (all != NULL)
        memset(all + (size_t)count * size, 0, size);
    return all;
}

result_cell *results_add(results *r)
{
    result_cell *all = grow(r->cell, r->cells, 1024, sizeof *all);
    r->cell = all != NULL ? all : r->cell;
    return all != NULL ? &all[r->cells++] : NULL;
}

result_series *results_add_series(results *r)
{
    result_series *all = grow(r->series, r->seriess, 1024, sizeof *all);
    r->series = all != NULL ? all : r->series;
    return all != NULL ? &all[r->seriess++] : NULL;
}

result_mesh *results_add_mesh(result_series *s)
{
    result_mesh *all = grow(s->mesh, s->meshes, 8, sizeof *all);
    s->mesh = all != NULL ? all : s->mesh;
    return all != NULL ? &all[s->meshes++] : NULL;
}

result_limit *results_add_limit(result_series *s)
{
    result_limit *all = grow(s->limit, s->limits, 8, sizeof *all);
    s->limit = all != NULL ? all : s->limit;
    return all != NULL ? &all[s->limits++] : NULL;
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
    for (int i = 0; i < r->seriess; i++) {
        free(r->series[i].name);
        free(r->series[i].mesh);
        free(r->series[i].limit);
    }
    free(r->cell);
    free(r->series);
    memset(r, 0, sizeof *r);
}
