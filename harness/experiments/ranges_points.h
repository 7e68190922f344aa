/* The parameters of a point of a sweep. */
#ifndef BEAMWORK_RANGES_POINTS_H
#define BEAMWORK_RANGES_POINTS_H

#include "harness/experiments/ranges.h"

/* Values of all parameters at a point whose axes have these. */
void ranges_points_values(const parameter_ranges *, const double at[],
                          double value[CASE_MAX_PARAMETERS]);
/* "NAME=VALUE, NAME=VALUE": of the axes, with as many digits as they need. */
void ranges_points_text(const parameter_ranges *, const double at[], char *text, int size);

#endif
