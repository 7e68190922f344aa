/* One case with several formulations on several meshes: errors, orders, limits. */
#ifndef BEAMWORK_CONVERGENCE_H
#define BEAMWORK_CONVERGENCE_H

#include "harness/experiments/experiment.h"

typedef struct convergence_request {
    const case_type *type;
    const double *parameter;
    const int *mesh; /* [meshes] 0: those of the case */
    int meshes;
    double level; /* error that is asked for */
    int verbose;  /* 1: each formulation by itself, with values and times */
    sweep_request cells;
} convergence_request;

typedef struct convergence {
    truths truths; /* read before it is planned */
    sweep sweep;
    judgement judgement;
    environment made;
    double level;
    int verbose;
} convergence;

extern const experiment_type experiment_converge;
void convergence_free(convergence *);

#endif
