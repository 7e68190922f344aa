#include "harness/record/store_path.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A table of numbers whose columns are named in an attribute. */
static void put_table(record *r, hid_t at, const char *name, int rows, int columns, const double *value, const char *names)
{
    const hsize_t size[2] = {(hsize_t)rows, (hsize_t)columns};
    const hid_t set = record_values(r, at, name, 2, size, value, NULL);
    record_text(r, set, "columns", names);
    H5Dclose(set);
}

void store_steps(record *r, hid_t at, const solve_result *result)
{
    enum { STEP = 8, ITERATION = 4 };
    double *step = calloc((size_t)(result->steps + 1) * STEP, sizeof *step),
           *iteration = calloc((size_t)(result->iterations + 1) * ITERATION, sizeof *iteration);
    r->bad |= step == NULL || iteration == NULL;
    for (int i = 0; i < result->steps && !r->bad; i++) {
        const step_record *k = &result->step[i];
        const double row[STEP] = {k->path,     k->increment,  k->iterations,     k->rejected, k->negative_pivots,
                                  k->residual, k->correction, k->incompatibility};
        memcpy(step + STEP * (size_t)i, row, sizeof row);
        for (int j = k->first; j < k->first + k->iterations; j++) {
            const iteration_record *one = &result->iteration[j];
            const double line[ITERATION] = {i, one->residual, one->correction, one->incompatibility};
            memcpy(iteration + ITERATION * (size_t)j, line, sizeof line);
        }
    }
    put_table(r, at, "steps", result->steps, STEP, step,
              "path increment iterations rejected negative_pivots residual correction incompatibility");
    if (result->iterations > 0)
        put_table(r, at, "iterations", result->iterations, ITERATION, iteration, "step residual correction incompatibility");
    free(step);
    free(iteration);
}

void store_matrices(record *r, hid_t at, const solve_result *result)
{
    static const char order[] = "rows ux uy uz thx thy thz, columns Fx Fy Fz Mx My Mz (compliance); transposed (stiffness); SI";
    for (int i = 0; i < result->matrix_sets; i++) {
        const nodal_matrices *m = &result->matrices[i];
        const hsize_t size[2] = {(hsize_t)m->stations, 36};
        char name[32];
        snprintf(name, sizeof name, "matrices%d", i);
        const hid_t group = record_group(r, at, name);
        record_count(r, group, "node", m->node);
        record_text(r, group, "moments", scene_moments_name(m->moments));
        record_text(r, group, "order", order);
        H5Dclose(record_values(r, group, "path", 1, size, m->path, NULL));
        H5Dclose(record_values(r, group, "compliance", 2, size, m->compliance, NULL));
        H5Dclose(record_values(r, group, "stiffness", 2, size, m->stiffness, NULL));
        H5Gclose(group);
    }
}

void store_events(record *r, hid_t at, const solve_result *result)
{
    enum { COLUMNS = 8 };
    if (result->events == 0)
        return;
    double *table = calloc((size_t)(result->events + 1) * COLUMNS, sizeof *table);
    r->bad |= table == NULL;
    for (int i = 0; i < result->events && table != NULL; i++) {
        const path_event *e = &result->event[i];
        const double row[COLUMNS] = {e->kind,   e->analysis, e->negative_before, e->negative_after,
                                     e->factor, e->control,  e->other_factor,    e->measure};
        memcpy(table + COLUMNS * (size_t)i, row, sizeof row);
    }
    put_table(r, at, "events", result->events, COLUMNS, table,
              "kind(limit_point=0,bifurcation=1,branch_jump=2) analysis negative_before negative_after factor control other_factor "
              "measure");
    free(table);
}
