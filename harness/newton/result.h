/* What a solution is asked for and what it leaves: quantities, steps, iterations, events, matrices,
 * shapes. */
#ifndef BEAMWORK_RESULT_H
#define BEAMWORK_RESULT_H

#include "harness/formulations/formulations.h"
#include "harness/newton/outcome.h"
#include "harness/newton/run_state.h"
#include "harness/newton/shapes.h"
#include "harness/newton/system_matrices.h"

typedef struct solve_options {
    int threads; /* of the loop over elements; 0, 1: one */
    newton_form newton;
    double criterion;   /* relative size of the corrections; 0: default */
    int max_iterations; /* per step; 0: default */
    int steps_between;  /* overrides the scene's; 0: the scene's */
    int condition; /* 1: estimate the condition of the tangents (of a static path: at its stations)
                    */
    int condensed; /* elements of a member from which on it is condensed to its ends; 0: default */
    int phases;    /* 1: read the clock between the parts of an iteration */
    int sample;  /* > 0: only so many iterations of each static path, for their time: there will be
                   no values */
    int shapes;  /* most states of every path whose centre lines are kept; 0: no shapes */
    int systems; /* 1: the matrices of small motions about all states are kept */
    int whole_steps; /* 1: a step in time that fails ends the motion, instead of being halved */
    int keep_ends;   /* 1: where motions stop is kept, for another run that goes on from there */
    int restarts;
    const outcome_end *restart; /* [restarts] where those stopped that motions go on from */
    int all_analyses;           /* 1: those that no quantity reads run, too */
    int looks;       /* 1: static paths are judged where pivots do not, and within their steps */
    int values_only; /* 1: what only curves and matrices show at a station is not computed */
} solve_options;

typedef struct curve {
    int points;
    double *x, *value;
} curve;

typedef struct quantity_result {
    status status;   /* OK: value is a number */
    double value;    /* NAN where it does not exist */
    double x;        /* abscissa where a maximum or minimum was found */
    double rounding; /* critical loads, frequencies: estimate of |error| by round-off; of a motion
                        what reading it between its steps adds; in parts of the value; else 0 */
    double change;   /* from the mesh that was solved before, by the value; of a curve, by its
                        largest; NAN: not known */
    curve curve;     /* of SCENE_CURVE, else 0 points */
    char reason[FAULT_TEXT];       /* why there is no value */
    char meaning[OUTCOME_MEANING]; /* see outcome_spectrum */
} quantity_result;

/* All dimensionless.  Quadratic convergence: each correction is about the square of the one
 * before. */
typedef struct iteration_record {
    double residual; /* sqrt(r . K^-1 r) of the unbalanced forces r before it, by that of the step's
                        first; NAN: newton=dense */
    double correction;      /* what the iteration changed: advance_state */
    double incompatibility; /* max |D(x) - e|/l before it */
} iteration_record;

/* Of a state under small disturbances that keep what is held and driven. */
typedef enum step_stability {
    STEP_OPEN, /* not decided by the signs of pivots: no symmetric tangent, or axes that turn */
    STEP_NO_DIVERGENCE, /* no symmetric tangent and no mass: no eigenvalue has passed zero */
    STEP_STABLE,
    STEP_UNSTABLE,
    STEP_GROWS, /* in axes that turn, or without a symmetric tangent: a small motion grows, by an
                   odd number of negative eigenvalues (det K < 0) or by a mode that was found */
    STEP_HELD,  /* in axes that turn: held by gyroscopic forces alone, no motion grows without
                   damping; one that turns with the structure makes it grow */
    STEP_STABILITIES
} step_stability;
const char *result_stability_name(step_stability);
int result_is_unstable(step_stability);

typedef struct step_record {
    int analysis;             /* of the scene */
    step_stability stability; /* where it ended */
    double path, increment;
    int iterations, rejected,
        negative_pivots;   /* rejected: tries of longer steps that failed before this one */
    int by_eigenvalues;    /* 1: its tangent is not symmetric; its eigenvalues were followed: */
    int passed;            /* so many have passed zero */
    step_stability judged; /* by the frequencies of small motions; STEP_OPEN: not asked or known */
    double residual, correction, incompatibility; /* of the last iteration */
    double remaining; /* what the next one would have changed, as the contraction so far predicts;
                         NAN: not known */
    int first;        /* of its iterations in solve_result.iteration */
    double energy;    /* r . K^-1 r of the first one [J] */
} step_record;

/* Compliance and stiffness [6 x 6] (ux uy uz thx thy thz by Fx Fy Fz Mx My Mz; SI) of a node at
 * stations of a path. */
typedef struct nodal_matrices {
    int node;
    scene_moments moments; /* convention */
    int stations;
    double *path;                   /* [stations] */
    double *compliance, *stiffness; /* [stations x 36]; held components: zero; not computed because
                                       nothing asked: NAN */
} nodal_matrices;
/* What happened along a continued path. */
typedef enum event_kind {
    EVENT_LIMIT_POINT, /* the load has an extremum */
    EVENT_BIFURCATION, /* other branches start here; this one is followed */
    EVENT_BRANCH_JUMP, /* a step converged to another branch: it was noticed and not followed */
    EVENT_KINDS
} event_kind;

typedef struct path_event {
    event_kind kind;
    int analysis, negative_before,
        negative_after;     /* negative pivots of the tangent stiffness; -1: not symmetric */
    double factor, control; /* of the point; of a jump: where both branches have this value of the
                               control coordinate [m] */
    double other_factor;    /* of a jump: on the branch that was not followed; else NAN */
    double measure; /* of a point: |phi . f|/(|phi| |f|), null vector phi, load f; of a jump:
                       distance of the branches */
} path_event;

/* Of a motion in time: its begin, and where each of its steps ended. */
typedef struct motion_record {
    int analysis; /* of the scene */
    double path;  /* parameter of the state that the motion starts from; NAN: it has none */
    outcome_step at;
} motion_record;

typedef struct solve_result {
    status status;
    char reason[FAULT_TEXT];
    int quantities;
    quantity_result *quantity; /* [scene quantities], same order */
    int steps;
    step_record *step;
    int iterations; /* of all the steps that were kept */
    iteration_record *iteration;
    int matrix_sets;
    nodal_matrices *matrices;
    int events;
    path_event *event;
    int motions;
    motion_record *motion; /* [motions] one motion after the other */
    int ends;
    outcome_end *end; /* [ends] of motions that no other one of the scene goes on from */
    double seconds_setup,
        seconds_solve; /* scene, sections, quadrature, mesh, analysis of the pattern | the rest */
    counters counters; /* its work; of shapes and matrices none */
    double phase[PHASES]; /* [s] of seconds_solve, when asked for */
    shapes shapes;
    system_matrices systems;
} solve_result;

const char *result_event_name(event_kind); /* "limit point", ... */
/* How many eigenvalues of the tangent pass zero there: one load each. */
int result_event_multiplicity(const path_event *);
void result_free(solve_result *);

#endif
