/* Newton in coordinates, strains and stresses at once (N section 4): what every nonlinear analysis
 * iterates with. */
#ifndef BEAMWORK_NEWTON_H
#define BEAMWORK_NEWTON_H

#include <math.h>

#include "harness/condensation/condensation.h"
#include "harness/solver/arrival.h"
#include "harness/solver/context.h"
#include "harness/solver/predictor.h"

typedef struct newton {
    analysis_context *c;
    model_state *state, *backup;
    predictor *predictor;    /* NULL: every step begins at the last state */
    condensation *condensed; /* NULL: no member is condensed; else K is not assembled */
    sparse K;
    sparse whole; /* with the driven coordinates; no values: not asked for */
    factor *factor;
    double *residual, *dx;   /* [free + driven] */
    double *dense, *unknown; /* of the uncondensed system, allocated when it is asked for */
    int *pivot;
    double *column; /* [conditions x (free + driven)], behind dx */
    double
        *weight;   /* [free + driven] of metric_of: what makes displacements and turns comparable */
    double energy; /* |r . K^-1 r| of the last residual r [J]; NAN: not known */
    arrival arrival;
    int max_iterations, free, all;
    long counted; /* factorisations that are in the model's counters */
} newton;

/* condense 1: members of many elements are condensed to their ends. */
status newton_alloc(analysis_context *, int condense, newton *, fault *);
void newton_free(newton *);
/* From here on K is known of the driven coordinates too. */
status newton_keep_driven(newton *, fault *);

/* K, its factors and dx = K^-1 residual in the present state for the loads and drivers at `path`;
 * drivers are in dx. */
status newton_direction(newton *, double path, step_record *, fault *);
/* The state takes dx; *correction: dimensionless size of what changed. */
status newton_advance(newton *, double path, double *correction, step_record *, fault *);

/* What the formulation does not follow of the structure at rest: arcs of its elements. */
status newton_judge_rest(const model *m, fault *f);
/* Every state that an analysis accepts is asked here, with the one before it: NOT_CONVERGED names
 * an element that is turned by more than its formulation can follow, a spring whose rotation vector
 * has lost its direction, or what is driven too far in one step. A node's vector that has lost its
 * direction is no number from there on. */
status newton_accept(const model *, const model_state *from, model_state *, fault *);

/* How an iteration goes on. */
typedef struct newton_watch {
    int iteration, growing;
    double last, first, largest; /* corrections; the largest behind the first */
} newton_watch;
static const newton_watch newton_watch_start = {0, 0, INFINITY, INFINITY, 0};
/* OK with *done = 1 when converged, OK with 0 to go on, or NOT_CONVERGED with the reason. */
status newton_judge(const newton *, newton_watch *, double path, double correction, int *done,
                    fault *);

/* Newton to `path`: converged, or NOT_CONVERGED with the reason. */
status newton_to(newton *, double path, step_record *, fault *);

#endif
