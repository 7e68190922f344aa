/* One cell: case x parameter point x formulation with options x mesh. */
#ifndef BEAMWORK_CELL_H
#define BEAMWORK_CELL_H

#include "cases/case.h"
#include "cases/scene/edit.h"
#include "harness/analysis/solve.h"

typedef struct cell_request {
    const case_type *type;
    double parameter[CASE_MAX_PARAMETERS];
    const element_type *formulation;
    double option[ELEMENT_MAX_OPTIONS];
    solve_options solve;
    scene_edit edit; /* of the scene the parameters give */
    int elements;
    int keep_all;
    int threads; /* of the loop over elements; 0, 1: one */
} cell_request;

typedef struct cell_result {
    scene scene; /* owned: names, units, tolerances of the quantities */
    model_size size;
    counters counters;
    int left_out_lines;
    char **left_out;
    solve_result solve;
} cell_result;

status cell_run(const cell_request *, cell_result *, fault *);
void cell_result_free(cell_result *);

#endif
