/* What there is at some points of a sweep, before anything is solved: quantities, meshes,
 * formulations that run, and what a point costs. */
#ifndef BEAMWORK_SURVEY_H
#define BEAMWORK_SURVEY_H

#include "harness/experiments/ranges.h"

/* Fills formulations, meshes, quantities, left_out and point_cost from the scenes of the first, the
 * last and some points between. REFUSED: no scene can be built at any of them, no formulation runs,
 * the selection names nothing or holds for nothing. */
status survey(parameter_ranges *r, fault *f);

#endif
