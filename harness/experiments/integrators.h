/* Integrators side by side on motions in time: what is asked for, and what is found. */
#ifndef BEAMWORK_INTEGRATORS_H
#define BEAMWORK_INTEGRATORS_H

#include "harness/experiments/experiment.h"
#include "harness/experiments/pace_verdict.h"

typedef struct motion_request {
    const char *expected;  /* table of verdicts, in the place of all that describes motions */
    const case_type *type; /* at the parameters */
    const double *parameter;
    const char *vary; /* NAME=A..B/N or NAME=A,B,C: of a parameter; NULL: none */
    const formulation *formulation;
    int formulations, elements;                   /* elements 0: those of the case */
    const char *integrators, *steps, *tolerances; /* lists; NULL: the usual ones */
    int no_errors;                                /* 1: without a reference */
    int each; /* 1: a line for each of them in what is for people, not only verdicts */
    sweep_request cells;
} motion_request;

typedef struct motions {
    pace pace;
    pace_verdicts verdicts;
    int each, methods;
    pace_method method[PACE_LIST_MOST]; /* of all of them */
} motions;

extern const experiment_type experiment_motion;
void motions_free(motions *);

#endif
