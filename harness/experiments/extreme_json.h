/* The table of extremes, counts and outcomes as JSON. */
#ifndef BEAMWORK_EXTREME_JSON_H
#define BEAMWORK_EXTREME_JSON_H

#include <stdio.h>

#include "harness/experiments/extreme_sweep.h"

status extreme_json(FILE *to, const extreme_sweep *s, fault *f);

#endif
