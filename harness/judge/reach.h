/* Which mesh, and which formulation, reaches an error. */
#ifndef BEAMWORK_REACH_H
#define BEAMWORK_REACH_H

#include "harness/judge/verdict.h"
#include "harness/timing/timing.h"

enum { REACH_LEVELS = 4 };
extern const double reach_level[REACH_LEVELS]; /* 10 %, 1 %, 0.1 %, 0.01 % */

/* Index of the coarsest mesh from which on the error of every mesh is within the level, or -1. */
int reach_mesh(const sweep *s, const verdict *v, double level);
/* The same of a series and every quantity that has a reference: a truth to judge by, or what
 * formulations agree on. -1 too where no quantity has one. */
int reach_every(const sweep *s, const truths *t, int series_index, double level);
/* As reach_mesh, or a finer mesh where that has the least time of those measured; -1. */
int reach_fastest(const sweep *s, const verdict *v, double level);

#endif
