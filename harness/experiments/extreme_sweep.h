/* Every formulation at every extreme: the cells, what came of them, and the counts. */
#ifndef BEAMWORK_EXTREME_SWEEP_H
#define BEAMWORK_EXTREME_SWEEP_H

#include "cases/extremes/extreme.h"
#include "harness/experiments/outcome.h"
#include "harness/study/study.h"

/* Of one formulation; a cell is an extreme at one value of x, and as bad as its worst quantity. */
typedef struct extreme_count {
    const char *formulation; /* its key */
    int tried, survived, coarse, named, wrong, faults;
} extreme_count;

typedef struct extreme_sweep {
    int formulations, outcomes, findings, unexpected, unobserved;
    int is_new; /* outcomes of new formulations that would need a finding: they do not gate */
    formulation *formulation;
    truths truths; /* exact values */
    sweep first, neighbours;
    extreme_outcome *outcome;
    extreme_finding *finding;
    extreme_count *count; /* [formulations] */
} extreme_sweep;

/* The cell of an outcome; its quantity in the scene; its value on the first mesh (refinement 0) or
 * on a neighbouring one (NAN: there is none). */
const cell_result *extreme_sweep_cell(const extreme_sweep *s, const extreme_outcome *o);
const scene_quantity *extreme_sweep_quantity(const extreme_sweep *s, const extreme_outcome *o);
const quantity_result *extreme_sweep_result(const extreme_sweep *s, const extreme_outcome *o,
                                            const cell_result *cell);
double extreme_sweep_value(const extreme_sweep *s, const extreme_outcome *o, int refinement);
/* The same formulation and quantity at the x that others are compared with, or NULL. */
extreme_outcome *extreme_sweep_base(const extreme_sweep *s, const extreme_outcome *o);
/* Exit code: 0 as expected, 1 an outcome differs, 3 nothing was tried. */
int extreme_sweep_exit(const extreme_sweep *s);
void extreme_sweep_free(extreme_sweep *s);

#endif
