/* How far curves of one quantity are apart: of the meshes of a formulation, of two formulations. */
#ifndef BEAMWORK_CURVE_ERROR_H
#define BEAMWORK_CURVE_ERROR_H

#include "harness/study/sweep.h"

/* Largest difference over the points that both have, by the largest value of the second; at (may be
 * NULL): the point of it. Points of a path with given stations are compared by their number, others
 * where they have the same abscissa. NAN: there are none, or `one` does not reach the end. */
double curve_error_between(const scene *s, int quantity, const solve_result *one,
                           const solve_result *two, int *at);
/* The finest mesh of a series that has all of the curve; -1: none. */
int curve_error_finest(const series *, int quantity);
/* The series that others are compared with: whose curve changed least when its last mesh was added;
 * -1: none. */
int curve_error_reference(const sweep *, int quantity);

#endif
