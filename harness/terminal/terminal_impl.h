/* The inside of terminal/. */
#ifndef BEAMWORK_TERMINAL_IMPL_H
#define BEAMWORK_TERMINAL_IMPL_H

#include <stdio.h>

#include "harness/analysis/analysis.h"
#include "harness/newton/newton.h"
#include "harness/study/study.h"
#include "harness/terminal/terminal.h"

/* The cheapest way to an error, by counted work, with the times of a benchmark. */

/* Lowest cost for the quantities of a point (`every`), or for the first with a reference value; 0:
 * none has. list[series]: room. */
int table_cheapest(FILE *to, const sweep *, const judgement *, int point, int every,
                   reached list[]);

/* Curves as text: their values, and how far meshes and formulations are apart. */

/* Prints curves over one abscissa in adjacent columns; of many points a selection. */
void table_curves_values(FILE *to, const scene *s, const solve_result *r);
/* Table of one point: for each curve the largest error of each mesh, then the values of the
 * formulation that the others are compared with. */
void table_curves_errors(FILE *to, const sweep *s);

/* A motion in time in short: its steps, energies and momenta. */

/* Nothing where nothing moves. For loads it reports those that jump at the start of the motion. */
void table_motion(FILE *to, const scene *, const solve_result *);

/* Load steps with their iterations, and matrices of nodes, as text. */

void table_path_steps(FILE *to, const solve_result *r);
/* Critical points and branch jumps of continued paths. */
void table_path_events(FILE *to, const solve_result *r);
/* At the last station that was reached. */
void table_path_matrices(FILE *to, const scene *s, const solve_result *r);

/* Stability of the states of paths, as far as the tangents along them show. */

/* "yes", "no", "held" (by gyroscopic forces), "?" of a step. */
const char *table_stability_word(step_stability);
/* A line for each path that is not stable all along; its number of lines. */
int table_stability_paths(FILE *to, const scene *s, const solve_result *r);
/* A paragraph for each formulation that met unstable states: on which meshes, which failed. */
void table_stability_meshes(FILE *to, const sweep *s);

#endif
