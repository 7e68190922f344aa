/* Cells of tests: a case, a formulation by its name, a mesh. */
#ifndef BEAMWORK_TEST_CELLS_H
#define BEAMWORK_TEST_CELLS_H

#include "harness/study/study.h"

/* At the defaults of the case; formulation: "name:key=value,...". What does not exist fails the
 * test. */
cell_request cells_of(const case_type *, const char *formulation, int elements);
/* assignment: "name=value" of parameters, ends with NULL; NULL: none. */
void cells_set(cell_request *, const char *const assignment[]);
/* Solves what the function builds, a case of the test's own without parameters; a cell that is not
 * solved fails the test. */
void cells_solve(status (*build)(const double value[], scene *, fault *), const char *formulation,
                 int elements, cell_result *);
/* SI; NAN when there is none of that name. */
double cells_value(const cell_result *, const char *quantity);

#endif
