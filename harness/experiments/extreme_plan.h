/* Which cells a sweep of extremes consists of. */
#ifndef BEAMWORK_EXTREME_PLAN_H
#define BEAMWORK_EXTREME_PLAN_H

#include "harness/experiments/extreme_sweep.h"

typedef struct extreme_request {
    const char *truths; /* path of the packed ones */
    const char *select; /* expression over "name/group/case/formulation", or NULL */
    int jobs, formulations;
    const formulation *formulation; /* restrict to these; 0: all */
    int named; /* 1: these were asked for by name: they affect the exit status */
    FILE *progress;
} extreme_request;

/* A point for every extreme and value, in order, with a series for every formulation; an outcome
 * for each of its quantities. */
status extreme_plan(const extreme_request *request, extreme_sweep *out, fault *f);

#endif
