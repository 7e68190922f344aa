/* Motions and what is said of them, as JSON. */
#ifndef BEAMWORK_PACE_JSON_H
#define BEAMWORK_PACE_JSON_H

#include <stdio.h>

#include "harness/experiments/pace_verdict.h"

status pace_json(FILE *to, const pace *, const pace_verdicts *, fault *);

#endif
