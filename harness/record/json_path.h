/* Load steps with their iterations, and matrices of nodes, as JSON. */
#ifndef BEAMWORK_JSON_PATH_H
#define BEAMWORK_JSON_PATH_H

#include <jansson.h>

#include "harness/analysis/solve.h"

json_t *json_number(double value); /* JSON has no NaN: a value that does not exist is null */
json_t *json_numbers(int count, const double value[]);
/* Analytic value beside the elements, with its error against a truth (NAN: none); null where there is none. */
json_t *json_prediction(const scene_quantity *q, double error);
json_t *json_steps(const solve_result *r);
json_t *json_events(const solve_result *r); /* of continued paths */
json_t *json_matrices(const solve_result *r);

#endif
