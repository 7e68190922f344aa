/* How a difference becomes a line. */
#ifndef BEAMWORK_COMPARISON_LINES_H
#define BEAMWORK_COMPARISON_LINES_H

#include "harness/records/comparison.h"

/* Where the lines go, what they are counted in, and what they speak of. */
typedef struct listing {
    FILE *to;
    const comparison_limits *limits;
    comparison *out;
    const stored_results *before, *after;
    const char *name;
    int elements; /* 0: of no single mesh */
} listing;

/* Counts a line and writes its beginning: kind, name, mesh. */
void comparison_lines_heading(const listing *l, comparison_kind kind);
/* A line where something is in one of the two only. */
void comparison_lines_lone(const listing *l, comparison_kind kind);
void comparison_lines_status(const listing *l, const char *before, const char *after);
/* Sums of `meshes` meshes: what one of them may change by is noticed, whatever their number. */
void comparison_lines_work(const listing *l, const long before[RESULTS_WORKS],
                           const long after[RESULTS_WORKS], int meshes);

/* Of counted work, where both are known. */
void comparison_lines_cost(const listing *l, double before, double after);

void comparison_cells(const listing *l, const result_cell *a, const result_cell *b);
void comparison_series(const listing *l, const result_series *a, const result_series *b);
/* All of two sweeps: a line too for each point, formulation and mesh that one of them has not. */
void comparison_sweeps(const listing *l, const char *select);

#endif
