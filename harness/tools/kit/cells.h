/* Runs for tests: a case, a formulation given by name, and a mesh. */
#ifndef BEAMWORK_TEST_CELLS_H
#define BEAMWORK_TEST_CELLS_H

#include "harness/study/study.h"

/* Returns a request for the default values of the case. formulation: "name:key=value,...". An
 * unknown name fails the test. */
cell_request cells_of(const case_type *, const char *formulation, int elements);
/* Sets parameters. assignment: "name=value" strings, terminated by NULL; NULL: none. */
void cells_set(cell_request *, const char *const assignment[]);
/* Solves the scene that the function builds as a case without parameters. A run without a solution
 * fails the test. */
void cells_solve(status (*build)(const double value[], scene *, fault *), const char *formulation,
                 int elements, cell_result *);
/* Returns the value of a quantity in SI units; NAN: there is no quantity with this name. */
double cells_value(const cell_result *, const char *quantity);

#endif
