/* Internal declarations of terminal/. */
#ifndef BEAMWORK_TERMINAL_IMPL_H
#define BEAMWORK_TERMINAL_IMPL_H

#include <stdio.h>

#include "harness/analysis/analysis.h"
#include "harness/newton/newton.h"
#include "harness/study/study.h"
#include "harness/terminal/terminal.h"

/* Lowest cost for an error, by counted work, with the times of a benchmark. */

/* Lowest cost for the quantities of a point (`every`), or for the first with a reference value.
 * Returns 0 when none has one. list[series]: work space. */
int table_cheapest(FILE *to, const sweep *, const judgement *, int point, int every,
                   reached list[]);

/* Curves as text: values, and differences between meshes and formulations. */

/* Prints curves with a common abscissa in adjacent columns; a selection if there are many points.
 */
void table_curves_values(FILE *to, const scene *s, const solve_result *r);
/* Table for one point: for each curve the largest error of each mesh, then the values of the
 * formulation with which the others are compared. */
void table_curves_errors(FILE *to, const sweep *s);

/* Summary of a motion: its steps, energies and momenta. */

/* Prints nothing if there is no motion. Reports loads that jump at the start of the motion. */
void table_motion(FILE *to, const scene *, const solve_result *);

/* Load steps with their iterations, and matrices of nodes, as text. */

void table_path_steps(FILE *to, const solve_result *r);
/* Critical points and branch jumps of continued paths. */
void table_path_events(FILE *to, const solve_result *r);
/* At the last station reached. */
void table_path_matrices(FILE *to, const scene *s, const solve_result *r);

/* Stability of the states of paths, as far as their tangents show it. */

/* Word for a step: "yes", "no", "held" (by gyroscopic forces), "?". */
const char *table_stability_word(step_stability);
/* Prints a line for each path that is not stable everywhere; returns the number of lines. */
int table_stability_paths(FILE *to, const scene *s, const solve_result *r);
/* Prints a paragraph for each formulation with unstable states: on which meshes, and which meshes
 * failed. */
void table_stability_meshes(FILE *to, const sweep *s);

#endif
