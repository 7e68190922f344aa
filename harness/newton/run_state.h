/* The equations of a model under a loading, and what a run changes besides its states: the model
 * and the loading stay. Nothing of it outlives a solution. */
#ifndef BEAMWORK_RUN_STATE_H
#define BEAMWORK_RUN_STATE_H

#include "harness/model/model.h"
#include "harness/numerics/numerics.h"

/* Work done so far. */
typedef struct counters {
    long strain_evaluations, stress_evaluations, inertia_evaluations;
    long geometric_evaluations; /* of the stiffness of a prestress */
    long iterations, steps, rejected_steps, factorisations, solutions;
    long factor_entries;
    double factor_flops;
    double dense_operations; /* n^3 of every eigenvalue problem solved densely */
    long negative_pivots;    /* most of a symmetric tangent at a state that was reached */
    double condition; /* largest estimate of the solved systems (factor_condition), where it was
                         asked for; else 0 */
} counters;

/* Derivatives of elements at rest: harness/newton/undeformed.h. */
typedef struct run_undeformed {
    int *of;         /* [elements] index of its values, or NONE; NULL: nothing is known */
    int count, room; /* of values */
    int last;        /* element that the last of them are of */
    double *value;   /* [room x (J, C, initial stresses)] */
} run_undeformed;

/* Of all elements, from linearise_state for advance_state. */
typedef struct linear_memory {
    double *slot; /* [elements x model.work_size]: J, C, P' + C (D - e), D - e, memory of the last
                     linearisation */
} linear_memory;

/* What of the loads along members goes to the ends of elements. */
enum { LUMPS_NOTHING, LUMPS_WEIGHTS, LUMPS_LOADS };

/* What the path parameter means, what acts, and how the axes turn: of one analysis. */
typedef struct loading {
    int in_time;      /* the path parameter is the time: loads and drivers are functions of that */
    double held_path; /* path parameter at which those stay in time that have no such function */
    int unloaded;     /* neither loads nor drivers act */
    int lumps;        /* LUMPS_* */
    element_rotating_frame frame; /* its velocity times the path if that is followed */
    int rotates, rotation_follows_path;
} loading;

/* Stresses of a motion gain eta S0 e', eta of the member: see harness/time/damping.h. */
typedef struct run_damping {
    double *stiffness;          /* [kinds x strains^2] S0 */
    double *none;               /* [elements x strains] zero */
    double g;                   /* e' = known + g (e - from) */
    const double *known, *from; /* [elements x strains] */
} run_damping;

struct run_ahead;
struct element_part;

typedef struct run_state {
    assemble_patterns *patterns; /* of the matrices of the model, made when they are asked for */
    counters counters;
    phases phases;
    thread_team *team;         /* of the loop over elements; NULL: one thread */
    struct element_part *part; /* of a few elements, before they are added up in order; NULL: none
                                  yet: equations_impl.h */
    struct run_ahead *ahead;   /* one block; NULL: nothing has been evaluated ahead: ahead.h */
    run_undeformed undeformed;
    run_damping *damping; /* of a motion; NULL: none */
    linear_memory memory; /* of those who linearise one state at a time */
} run_state;

typedef struct equations {
    const model *m;
    loading loading;
    run_state *run;
} equations;

status linear_memory_alloc(const model *, linear_memory *, fault *);
void linear_memory_free(linear_memory *);

/* For a model, nothing done yet. threads share the loop over elements; 0, 1: one. Sums keep their
 * order: results do not depend on it. */
status run_state_begin(run_state *, const model *, int threads, fault *);
void run_state_end(run_state *);
/* How the frame turns at that path parameter. */
element_rotating_frame loading_frame(const loading *, double path);

#endif
