/* Which motions are run. */
#ifndef BEAMWORK_PACE_PLAN_H
#define BEAMWORK_PACE_PLAN_H

#include "harness/experiments/pace.h"

/* What is run of one structure. */
typedef struct pace_plan_request {
    const case_type *type;
    const double *parameter;
    formulation formulation;
    int elements; /* 0: the second of its meshes */
    int methods;
    const pace_method *method;
    pace_list steps, tolerances; /* counts 0: none */
    int errors;                  /* 1: against a reference */
    int whole; /* 1: a step that finds no solution ends a motion, instead of being halved */
} pace_plan_request;

/* Steps or tolerances of the request, where none are given: from that of the scene. */
status pace_plan_usual(pace_plan_request *, fault *);
/* A group behind those that there are. REFUSED: no motion, or nothing to run. */
status pace_plan_add(pace *, const pace_plan_request *, fault *);
#endif
