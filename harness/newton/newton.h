/* Newton in coordinates, strains and stresses at once (N section 4): what every nonlinear analysis
 * iterates with. */
#ifndef BEAMWORK_NEWTON_H
#define BEAMWORK_NEWTON_H

#include <math.h>

#include "harness/newton/arrival.h"
#include "harness/newton/condensation.h"
#include "harness/newton/context.h"
#include "harness/newton/predictor.h"

typedef struct newton_run {
    analysis_context *c;
    model_state *state, *backup;
    predictor *predictor;    /* NULL: every step begins at the last state */
    condensation *condensed; /* NULL: no member is condensed; else K is not assembled */
    sparse K;
    sparse whole; /* with the driven coordinates; no values: not asked for */
    matrix_factor *factor;
    double *residual, *dx;   /* [free + driven] */
    double *dense, *unknown; /* of the uncondensed system, allocated when it is asked for */
    int *pivot;
    double *column; /* [conditions x (free + driven)], behind dx */
    double
        *weight;   /* [free + driven] of metric_of: what makes displacements and turns comparable */
    double energy; /* |r . K^-1 r| of the last residual r [J]; NAN: not known */
    double path;   /* that newton_to goes to */
    arrival arrival;
    int max_iterations, free, all;
    long counted; /* factorisations that are in the model's counters */
} newton_run;

/* condense 1: members of many elements are condensed to their ends. */
status newton_alloc(analysis_context *, int condense, newton_run *, fault *);
void newton_free(newton_run *);
/* From here on K is known of the driven coordinates too. */
status newton_keep_driven(newton_run *, fault *);

/* One correction of an iteration. */
typedef struct newton_correction {
    double at;     /* path parameter or, of motions, instant [s] that it goes to */
    double size;   /* dimensionless, of what changed: advance_state */
    double energy; /* |r . K^-1 r| of the residual r before it [J]; NAN: not known */
    advance_stress stress;
} newton_correction;

/* K, its factors and dx = K^-1 residual in the present state for the loads and drivers at `path`;
 * drivers are in dx. */
status newton_direction(newton_run *, double path, step_record *, fault *);
/* The state takes dx, at that path parameter. */
void newton_advance(newton_run *, double path, newton_correction *);
/* What the formulation does not follow of the structure at rest: arcs of its elements. */
status newton_judge_rest(const model *m, fault *f);
/* Every state that an analysis accepts is asked here, with the one before it: NOT_CONVERGED names
 * an element that is turned by more than its formulation can follow, a spring whose rotation vector
 * has lost its direction, or what is driven too far in one step. A node's vector that has lost its
 * direction is no number from there on. */
status newton_accept(const model *, const model_state *from, model_state *, fault *);

/* What Newton's iteration differs by from analysis to analysis. */
typedef struct newton_use {
    void *of;
    newton_run *on;  /* of a path: its states are asked newton_accept, and what strayed from its
                    first  correction, and may be at another equilibrium, has not converged; NULL: of
                    a  motion */
    int least, most; /* iterations */
    /* The equations of the present state are solved, and the state takes the correction. */
    status (*correct)(void *of, int iteration, newton_correction *, step_record *, fault *);
    void (*prepare)(void *of, int iteration, double correction); /* another one; NULL: nothing */
    status (*accept)(void *of, fault *); /* asked when it has converged; NULL: always */
} newton_use;

/* Of states on a path. */
newton_use newton_on_path(newton_run *, void *of,
                          status (*correct)(void *of, int iteration, newton_correction *,
                                            step_record *, fault *));
/* Of steps in time. */
newton_use newton_in_time(const analysis_context *, void *of,
                          status (*correct)(void *of, int iteration, newton_correction *,
                                            step_record *, fault *),
                          void (*prepare)(void *of, int iteration, double correction));

/* Newton's iteration of every nonlinear step, with one table of limits: converged, or NOT_CONVERGED
 * with the reason. Counters, records and the arrival take each correction. */
status newton_iterate(analysis_context *, const newton_use *, arrival *, step_record *, fault *);

/* Newton to `path`: converged, or NOT_CONVERGED with the reason. */
status newton_to(newton_run *, double path, step_record *, fault *);

#endif
