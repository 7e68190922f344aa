/* Where paths are stable, as far as the tangents along them tell. */
#ifndef BEAMWORK_TABLE_STABILITY_H
#define BEAMWORK_TABLE_STABILITY_H

#include <stdio.h>

#include "harness/study/study.h"

/* "yes", "no", "held" (by gyroscopic forces), "?" of a step. */
const char *table_stability_word(step_stability);
/* A line for each path that is not stable all along; its number of lines. */
int table_stability_paths(FILE *to, const scene *s, const solve_result *r);
/* A paragraph for each formulation that met unstable states: on which meshes, which failed. */
void table_stability_meshes(FILE *to, const sweep *s);

#endif
