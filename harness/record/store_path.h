/* Load steps with their iterations, and matrices of nodes, in the result file. */
#ifndef BEAMWORK_STORE_PATH_H
#define BEAMWORK_STORE_PATH_H

#include "harness/analysis/solve.h"
#include "harness/record/record.h"

void store_steps(record *r, hid_t at, const solve_result *result);
void store_events(record *r, hid_t at, const solve_result *result); /* nothing where there are none */
void store_matrices(record *r, hid_t at, const solve_result *result);

#endif
