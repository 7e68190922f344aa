#ifndef BEAMWORK_TERMINAL_IMPL_H
#define BEAMWORK_TERMINAL_IMPL_H

#include <stdio.h>

#include "harness/analysis/analysis.h"
#include "harness/newton/newton.h"
#include "harness/study/study.h"
#include "harness/terminal/terminal.h"

/* Prints a relative error in percent, in 12 columns with a leading blank, or a dash if there is no
 * error. */
void table_percent(FILE *to, double error);
/* Prints a value with the digits that its uncertainty allows (harness/study/study.h). */
void table_known(FILE *to, int width, double value, double uncertainty);
void table_digits(FILE *to, int width, double value, int digits);
/* Prints "case: parameters", with the parameters that differ from their defaults. */
void table_point(FILE *to, const sweep_point *p);

/* Prints curves with a common abscissa in adjacent columns. If there are many points, prints a
 * selection. */
void table_curves_values(FILE *to, const scene *s, const solve_result *r);
/* Prints a table for one point: for each curve the largest error of each mesh, then the values of
 * the formulation with which the others are compared. */
void table_curves_errors(FILE *to, const sweep *s);

/* Returns the word for a step: "yes", "no", "held" (stable only because of gyroscopic forces), or
 * "?" (unknown). */
const char *table_stability_word(step_stability);
/* Prints a line for each path that is not stable everywhere. Returns the number of lines. */
int table_stability_paths(FILE *to, const scene *s, const solve_result *r);
/* Prints a paragraph for each formulation with unstable states. */
void table_stability_meshes(FILE *to, const sweep *s);

/* Prints the summaries of motions, or nothing if there are none. Reports loads that jump at the
 * start of a motion. */
void table_motion(FILE *to, const scene *, const solve_result *);
void table_path_steps(FILE *to, const solve_result *r);
void table_path_events(FILE *to, const solve_result *r);
/* Prints the matrices of nodes at the last station that was reached. */
void table_path_matrices(FILE *to, const scene *s, const solve_result *r);

#endif
