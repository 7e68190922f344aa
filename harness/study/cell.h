/* One cell: case x parameter point x formulation with options x mesh. */
#ifndef BEAMWORK_CELL_H
#define BEAMWORK_CELL_H

#include "cases/case.h"
#include "cases/scene/edit.h"
#include "harness/analysis/analysis.h"
#include "harness/formulations/formulations.h"

typedef struct cell_request {
    const scene *scene; /* valid, and shared by all cells of a point; NULL: to be built from ... */
    const case_type *type;
    double parameter[CASE_MAX_PARAMETERS];
    scene_edit edit; /* ... these three */
    const element_type *formulation;
    double option[ELEMENT_MAX_OPTIONS];
    solve_options solve;
    int elements;
    int keep_all;
    unsigned omit; /* physics that the model leaves out: model_request */
    int threads;   /* of the loop over elements; 0, 1: one */
    /* Is the same thing solved already? Asked once the model is made; NULL: nobody is asked. */
    int (*is_known)(void *context, const model *);
    void *context;
} cell_request;

typedef struct cell_result {
    scene scene; /* owned: that the cell built itself, else empty */
    model_size size;
    counters counters;
    int left_out_lines;
    char **left_out;
    solve_result solve;
} cell_result;

/* Formulation, its options and its form of Newton's method. */
void cell_formulation(cell_request *, const formulation *chosen);
/* The scene of a case at its parameters, changed by the edit (NULL: as it is), and valid. The
 * caller frees it, also after a failure. */
status cell_scene(const case_type *type, const double parameter[], const scene_edit *edit,
                  scene *out, fault *f);
status cell_run(const cell_request *, cell_result *, fault *);
/* Quantities that have a value, of an analysis that failed too: what cannot be had takes nothing
 * with it. */
int cell_values(const cell_result *);
void cell_result_free(cell_result *);

#endif
