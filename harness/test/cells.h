/* Cells of tests: a case, a formulation by its name, a mesh. */
#ifndef BEAMWORK_TEST_CELLS_H
#define BEAMWORK_TEST_CELLS_H

#include "harness/study/cell.h"

/* At the defaults of the case; formulation: "name:key=value,...". What does not exist fails the
 * test. */
cell_request cells_of(const case_type *, const char *formulation, int elements);
/* assignment: "name=value" of parameters, ends with NULL; NULL: none. */
void cells_set(cell_request *, const char *const assignment[]);
/* SI; NAN when there is none of that name. */
double cells_value(const cell_result *, const char *quantity);

#endif
