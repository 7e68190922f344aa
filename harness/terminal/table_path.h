/* Load steps with their iterations, and matrices of nodes, as text. */
#ifndef BEAMWORK_TABLE_PATH_H
#define BEAMWORK_TABLE_PATH_H

#include <stdio.h>

#include "harness/analysis/analysis.h"

void table_path_steps(FILE *to, const solve_result *r);
/* Critical points and branch jumps of continued paths. */
void table_path_events(FILE *to, const solve_result *r);
/* At the last station that was reached. */
void table_path_matrices(FILE *to, const scene *s, const solve_result *r);

#endif
